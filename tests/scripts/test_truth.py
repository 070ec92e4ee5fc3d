"""The stored truth of the sky: made of the scenes and rays that are there, exact enough, and the reference still gives it."""
import math
import os
import sys
import tempfile
import unittest

REPOSITORY = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(REPOSITORY, "scripts"))

import make_truth  # noqa: E402
import sky  # noqa: E402

WELKIN = os.environ.get("WELKIN", os.path.join(REPOSITORY, "build", "welkin"))
SEED = 20_001  # not the one of the truth: an independent estimate
RELATIVE_ERROR = 0.02  # of the second estimate: a fraction of a second a ray
Z = 4.5  # of some 60 comparisons one passes it by chance once in 2,000 seeds; standard errors of 24 batches or more
SHARE = 0.01  # of the rows


class Truth(unittest.TestCase):
    def setUp(self):
        self.index = make_truth.load_index()

    def test_made_of_what_is_there(self):
        for group in sky.groups():
            with self.subTest(group["name"]):
                self.assertTrue(make_truth.is_current(group, self.index), "scene, rays or file have changed: make truth")
        stray = {os.path.splitext(f)[0] for f in os.listdir(sky.TRUTH)} - {g["name"] for g in sky.groups()} - {"truth"}
        self.assertEqual(stray, set())

    def test_rays_are_those_asked(self):
        for group in sky.groups():
            rays, truth = sky.rays_of(group), sky.read_rows(sky.truth_file(group))
            self.assertEqual(len(rays), len(truth), group["name"])
            for a, b in zip(rays, truth):
                for column in sky.ANGLES:
                    self.assertEqual(float(a[column] or -1), float(b[column] or -1), group["name"])

    def test_standard_errors(self):
        """A third of the least limit at most, and what was asked, of the radiance or of its floor where it is less."""
        self.assertLessEqual(make_truth.SHARE, 1 / 3)
        for group in sky.groups():
            if group["orders"] == 1:
                continue
            truth = sky.read_rows(sky.truth_file(group))
            for i, (row, limits) in enumerate(zip(truth, make_truth.allowed(group, truth))):
                for error, limit in zip(sky.values(row, sky.STANDARD_ERROR), limits):
                    self.assertLessEqual(error, limit * (1 + 1e-6), f"{group['name']} row {i}")  # the file has nine digits

    def test_again(self):
        """One row in a hundred of each group, at least one, by the reference of today."""
        together = {}
        for group in sky.groups():
            count = len(sky.rays_of(group))
            rows = max(1, round(SHARE * count))
            start = int(sky.physics_hash(group["scene"], sky.rays_of(group), group["orders"])[:8], 16)
            picked = sorted({(start + k * count // rows) % count for k in range(rows)})
            together.setdefault((group["scene"], group["orders"]), []).extend((group, i) for i in picked)
        compared = 0
        for (scene, orders), members in together.items():
            rays = [sky.rays_of(g)[i] for g, i in members]
            options = [] if orders == 1 else ["--relative-error", RELATIVE_ERROR, "--max-paths", 200_000, "--seed", SEED]
            with tempfile.TemporaryDirectory() as out:
                rows = sky.probe(WELKIN, scene, rays, "reference", out, orders, options)
            self.assertIsInstance(rows, list, rows)
            for (group, i), row in zip(members, rows):
                truth = sky.read_rows(sky.truth_file(group))[i]
                where = f"{group['name']} row {i}"
                for a, b in zip(sky.values(row, sky.TRANSMITTANCE), sky.values(truth, sky.TRANSMITTANCE)):
                    self.assertLess(abs(a - b), 1e-8, where)  # quadrature converged to 1e-9; nine digits in the file
                values, known = sky.values(row, sky.RADIANCE), sky.values(truth, sky.RADIANCE)
                if orders == 1:
                    for a, b in zip(values, known):
                        self.assertLessEqual(abs(a - b), 1e-5 * abs(b) + 1e-12, where)
                    continue
                for a, b, s, t in zip(values, known, sky.values(row, sky.STANDARD_ERROR), sky.values(truth, sky.STANDARD_ERROR)):
                    sigma = math.hypot(s, t)
                    self.assertLessEqual(abs(a - b), Z * sigma + 1e-9 * abs(b), where)
                    compared += 1
        self.assertGreater(compared, 3 * 5)


if __name__ == "__main__":
    unittest.main()
