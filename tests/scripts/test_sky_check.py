"""The check of the sky: its measure of error, its furnace, that it fails when it should, and the figure."""
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest

REPOSITORY = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SCRIPTS = os.path.join(REPOSITORY, "scripts")
sys.path.insert(0, SCRIPTS)

import sky  # noqa: E402
import sky_furnace  # noqa: E402


def row(*radiance, transmittance=(1.0, 1.0, 1.0), **more):
    return {**dict(zip(sky.RADIANCE, map(str, radiance))), **dict(zip(sky.TRANSMITTANCE, map(str, transmittance))), **more}


def script(name, *arguments):
    return subprocess.run(["/usr/bin/python3", "-B", os.path.join(SCRIPTS, name), *arguments], capture_output=True, text=True, check=False)


class Error(unittest.TestCase):
    def test_share_of_the_truth_or_of_the_floor(self):
        truth = [row(1, 2, 4), row(0.5, 0, 1e-3)]
        floor = sky.floors(truth, ["", ""])
        self.assertEqual(floor, [[0.01, 0.02, 0.04]] * 2)
        found = sky.errors([row(1.1, 2, 4), row(0.5, 0.002, 2e-3)], truth, floor)
        for a, b in zip([x for line in found for x in line], [0.1, 0, 0, 0, 0.1, 0.025]):
            self.assertAlmostEqual(a, b, places=12)

    def test_keys_have_floors_of_their_own(self):
        self.assertEqual(sky.floors([row(1, 1, 1), row(100, 100, 100)], ["1000", "30000"]), [[0.01] * 3, [1.0] * 3])

    def test_not_a_number_is_infinitely_wrong(self):
        for bad in ["nan", "inf", "", "x"]:
            self.assertEqual(sky.rms(e for line in sky.errors([row(1, bad, 1)], [row(1, 1, 1)], [[0.01] * 3]) for e in line), math.inf)
        self.assertEqual(sky.rms([]), math.inf)  # nothing measured is no success

    def test_nothing_where_nothing_is(self):
        self.assertEqual(sky.errors([row(0, 0, 0)], [row(0, 0, 0)], [[0.0] * 3]), [[0.0] * 3])


class Furnace(unittest.TestCase):
    def test_gauss(self):
        for n in [2, 3, 8]:
            for power in range(2 * n):
                self.assertAlmostEqual(sum(w * x**power for x, w in sky_furnace.gauss(n)), 1 / (power + 1), places=13)

    def test_bare_ground_and_clear_limb(self):
        """White ground without air sends back what it gets, and the beam passes the limb; a hundredth of light too much is seen."""
        for radius, top in [(6.36e6, 1e5), (100.0, 1e5)]:
            for fine in [0, 1]:
                design = sky_furnace.rays(radius, top, fine)
                rows = [row(*[max(0.0, self.cosine_below(ray, radius, top)) / math.pi] * 3) for ray, _, _ in design]
                for total in sky_furnace.energy(design, rows):
                    self.assertAlmostEqual(total, 1, places=6)
                rows = [row(*[1.01 * x for x in sky.values(r, sky.RADIANCE)]) for r in rows]
                share = (radius / (radius + top)) ** 2
                self.assertAlmostEqual(sky_furnace.energy(design, rows)[1], 1 + 0.01 * share, places=6)

    def cosine_below(self, ray, radius, top):
        """Of the sun where the ray meets the ground, from the angles that the observer at the top has."""
        _, sun, view, azimuth = [math.radians(float(ray[c])) for c in sky.ANGLES[:4]]
        r, c = radius + top, math.cos(view)
        q = radius**2 - (r * math.sin(view)) ** 2
        if q < 0 or c >= 0:
            return 0.0
        t = top * (2 * radius + top) / (-r * c + math.sqrt(q))
        return (t * math.sin(view) * math.sin(sun) * math.cos(azimuth) + (r + t * c) * math.cos(sun)) / radius


class Check(unittest.TestCase):
    def test_without_a_program_every_line_fails(self):
        with tempfile.TemporaryDirectory() as folder:
            done = script("check_sky.py", "--build", os.path.join(folder, "nowhere"), "--out", folder, "--quick", "--only", "accuracy,robust,night,cost")
            self.assertEqual((done.returncode, done.stderr), (1, ""))
            with open(os.path.join(folder, "check-sky.json"), encoding="utf-8") as f:
                data = json.load(f)
            self.assertEqual(data["failed"], len(data["lines"]))
            self.assertGreater(len(data["lines"]), 10)

    def test_wrong_names(self):
        for name, option in [("check_sky.py", ["--only", "weather"]), ("make_truth.py", ["--only", "weather"])]:
            done = script(name, *option)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("expected some of", done.stderr)


def fake_results():
    def group(values):
        return {"rms": 1.0, "rays": [[0, s, 10, 0, None, *e] for s, e in values]}
    skies = {"sky-75": [(s, [0.3, 0.2, 0.1]) for s in range(0, 76, 5)], "sky-85-90": [(85 + s / 4, [0.5, 0.2, 0.4]) for s in range(21)],
             "sky-92-96": [(92 + s / 4, [1.5, 2, None if s == 3 else 0]) for s in range(17)]}
    return {"details": {m: {**{name + end: group(v) for name, v in skies.items() for end in ["", "-albedo"]},
                            **{g: {"rms": 0.5} for g in ["space", "segments-75", "segments-85-90", "x10-75", "x10-85-90"]}} for m in ["tables-4d", "tables-2d"]}}


class Figure(unittest.TestCase):
    def run_on(self, text):
        with tempfile.TemporaryDirectory() as folder:
            source, picture = os.path.join(folder, "check.json"), os.path.join(folder, "sky.png")
            with open(source, "w", encoding="utf-8") as f:
                f.write(text)
            return script("plot_sky.py", source, "-o", picture), os.path.getsize(picture) if os.path.exists(picture) else 0

    def test_picture(self):
        done, size = self.run_on(json.dumps(fake_results()))
        self.assertEqual(done.returncode, 0, done.stderr)
        if "matplotlib is not installed" not in done.stderr:
            self.assertGreater(size, 40_000)  # axes alone are 30 kB

    def test_bad_input_is_one_line(self):
        for text in ["", "{", "[]", "{}", '{"details": 1}', '{"details": {}}']:
            done, size = self.run_on(text)
            self.assertEqual((done.returncode, size), (1, 0), text)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)


if __name__ == "__main__":
    unittest.main()
