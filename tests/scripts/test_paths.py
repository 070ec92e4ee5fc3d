"""What the recorded flights promise, read back from the files in the repository."""
import json
import math
import os
import unittest

REPOSITORY = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def load(name):
    with open(os.path.join(REPOSITORY, name), encoding="utf-8") as f:
        return json.load(f)


def altitudes_m(path, scene):
    return [math.hypot(*f["position_m"]) - scene["planet"]["radius_m"] for f in path["frames"]]


def turned(q, v):
    """v turned by the unit quaternion q = x y z w."""
    x, y, z, w = q
    t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])]
    return [v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2], v[2] + w * t[2] + x * t[1] - y * t[0]]


class OrbitToGround(unittest.TestCase):
    def setUp(self):
        self.path = load("benchmarks/orbit-to-ground.json")
        self.scene = load("benchmarks/orbit-to-ground.scene.json")
        self.h = altitudes_m(self.path, self.scene)

    def test_from_orbit_to_eye_height(self):
        self.assertGreaterEqual(len(self.h), 600)
        self.assertGreaterEqual(sum(h < 20_000 for h in self.h), 200)
        self.assertAlmostEqual(self.h[0], 1e6, delta=1)   # positions are written to 0.1 mm; the top is bisected
        self.assertAlmostEqual(self.h[-1], 2, delta=1e-3)
        self.assertGreaterEqual(self.scene["quality"]["depth"], 16)

    def test_sinks_smoothly(self):
        rate = [math.log(a / b) for a, b in zip(self.h, self.h[1:])]
        self.assertGreater(min(rate), 0)
        # 13.1 = ln(1e6 / 2) over 659 frames is 0.02 a frame; no frame may be twice that, no jump in the rate over a twentieth of it.
        self.assertLess(max(rate), 0.04)
        self.assertLess(max(abs(a - b) for a, b in zip(rate, rate[1:])), 0.001)

    def test_speed_follows_altitude(self):
        places = [f["position_m"] for f in self.path["frames"]]
        speed = [math.dist(a, b) / h for a, b, h in zip(places, places[1:], self.h)]
        self.assertLess(max(speed), 0.05)  # a few percent of the altitude a frame

    def test_looks_ahead_level_and_turns_slowly(self):
        previous = None
        for f in self.path["frames"]:
            q, r = f["orientation_xyzw"], math.hypot(*f["position_m"])
            self.assertAlmostEqual(math.hypot(*q), 1, delta=1e-11)  # written to 12 digits
            up = [x / r for x in f["position_m"]]
            right = turned(q, [1, 0, 0])
            self.assertAlmostEqual(sum(a * b for a, b in zip(up, right)), 0, delta=1e-9)  # no roll
            if previous:
                cosine = min(1.0, abs(sum(a * b for a, b in zip(q, previous))))
                self.assertLess(math.degrees(2 * math.acos(cosine)), 0.5)  # 5 px of 180 at a 58 degree field of view are 1.6
            previous = q

    def test_scene_is_there(self):
        for name in ["orbit-to-ground", "moving-orbit", "moving-near"]:
            path = load(f"benchmarks/{name}.json")
            self.assertTrue(os.path.exists(os.path.join(REPOSITORY, "benchmarks", path["scene"])))


class Moving(unittest.TestCase):
    def test_speed(self):
        for name, metres in [("orbit", 7000), ("near", 100)]:
            path, scene = load(f"benchmarks/moving-{name}.json"), load(f"benchmarks/poses/{name}.json")
            view = scene["views"][name]
            for h in altitudes_m(path, scene):
                self.assertAlmostEqual(h, view["altitude_m"], delta=1e-3)
            places = [f["position_m"] for f in path["frames"]]
            for a, b in zip(places, places[1:]):
                self.assertAlmostEqual(math.dist(a, b), metres, delta=1e-3)  # the chord of 7 km is 0.3 mm shorter


if __name__ == "__main__":
    unittest.main()
