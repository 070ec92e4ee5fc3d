"""Metered pictures through the real program: their state brings them back equal, and flights adapt the same on every run.

The Moon is drawn, which takes a fifth of a second.
"""

import json
import math
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
WELKIN = os.environ.get("WELKIN", str(ROOT / "build" / "welkin"))
MOON = ROOT / "scenes" / "moon.json"
SMALL = ["--size", "96x54", "--quiet"]
RADIUS_M = 1_737_400.0


def run(*arguments):
    subprocess.run([WELKIN, *map(str, arguments)], check=True, capture_output=True, text=True)


class Exposure(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def at(self, name):
        return self.folder / name

    def render(self, what, name, *more):
        report = self.at("report.json")
        run("render", what, "-o", self.at(name), "--json", report, *SMALL, *more)
        return json.loads(report.read_text())["frames"][0]["exposure_ev"]

    def test_a_metered_picture_comes_back_equal(self):
        ev = self.render(MOON, "a.png", "--view", "terminator")
        self.assertNotEqual(ev, 0)
        self.assertEqual(self.render(self.at("a.png"), "again.png"), ev)
        self.assertEqual(self.at("again.png").read_bytes(), self.at("a.png").read_bytes())
        self.assertEqual(self.render(MOON, "number.png", "--view", "terminator", "--exposure", str(ev)), ev)
        run("compare", self.at("a.png"), self.at("number.png"), "--json", self.at("c.json"), "--quiet")
        self.assertEqual(json.loads(self.at("c.json").read_text())["max_255"], 0, "the number by hand: the same pixels")
        # An EXR is linear, before exposure; its state has the number too.
        self.assertEqual(self.render(MOON, "a.exr", "--view", "terminator"), ev)
        self.assertEqual(self.render(self.at("a.exr"), "b.png"), ev)
        self.assertEqual(self.at("b.png").read_bytes(), self.at("a.png").read_bytes())
        # Metered anew from a picture whose view has a number.
        self.assertEqual(self.render(self.at("a.png"), "auto.png", "--exposure", "auto"), ev)
        self.assertEqual(self.render(self.at("a.png"), "two.png", "--exposure", "2"), 2)

    def test_curves_differ_and_stay_with_the_picture(self):
        pictures = {}
        for curve in ["aces", "reinhard", "lottes", "uchimura"]:
            self.render(MOON, f"{curve}.png", "--view", "space", "--exposure", "1", "--tone-curve", curve)
            self.render(self.at(f"{curve}.png"), "again.png")
            pictures[curve] = self.at(f"{curve}.png").read_bytes()
            self.assertEqual(self.at("again.png").read_bytes(), pictures[curve])
        self.assertEqual(len(set(pictures.values())), 4)
        self.render(MOON, "plain.png", "--view", "space", "--exposure", "1")
        self.assertEqual(self.at("plain.png").read_bytes(), pictures["aces"], "the default")

    def fly(self, name):
        """From high noon to the terminator and on: 40 frames at 20 a second, straight down."""
        def frame(i):
            a = math.radians(-2.0 if i < 20 else 86.0)  # east of the point under the sun
            # Looking down over longitude 0 is a quarter turn around Y, +Z of the view to +X; then a turn by the longitude around Z.
            h, s, c = math.sqrt(0.5), math.sin(a / 2), math.cos(a / 2)
            return {"position_m": [(RADIUS_M + 5e4) * math.cos(a), (RADIUS_M + 5e4) * math.sin(a), 0.0],
                    "orientation_xyzw": [-s * h, c * h, s * h, c * h], "fov_deg": 40.0}

        path = self.at("path.json")
        path.write_text(json.dumps({"scene": str(MOON), "size": [96, 54], "time_step_s": 0.05, "frames": [frame(i) for i in range(40)]}))
        run("fly", path, "--out", self.at(name), "--every", "13", "--quiet")
        return [f["exposure_ev"] for f in json.loads((self.at(name) / "timings.json").read_text())["frames"]]

    def test_flights_adapt_and_repeat(self):
        evs = self.fly("one")
        self.assertEqual(len(set(evs[:20])), 1, "the first frame is adapted to fully")
        dark = evs[20:]
        self.assertTrue(all(b > a for a, b in zip(dark, dark[1:])), "opens up frame by frame")
        # 20 frames of 0.05 s are 1 s: with the default 1.2 s to the dark, 1 - exp(-1 / 1.2) = 57 % of the way.
        target = self.render(self.at("one") / "frame-00039.png", "target.png", "--exposure", "auto")
        self.assertAlmostEqual((evs[39] - evs[0]) / (target - evs[0]), 0.565, delta=0.01)  # EV is rounded to 1/256
        self.assertEqual(self.fly("two"), evs)
        for name in ["frame-00000.png", "frame-00026.png", "frame-00039.png"]:
            self.assertEqual((self.at("one") / name).read_bytes(), (self.at("two") / name).read_bytes())
        # A frame in the middle of adapting, drawn again: at the exposure that the flight had.
        self.assertEqual(self.render(self.at("one") / "frame-00026.png", "again.png"), evs[26])
        run("compare", self.at("one") / "frame-00026.png", self.at("again.png"), "--json", self.at("c.json"), "--quiet")
        self.assertEqual(json.loads(self.at("c.json").read_text())["max_255"], 0)


if __name__ == "__main__":
    unittest.main()
