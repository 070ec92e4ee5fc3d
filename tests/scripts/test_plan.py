"""welkin plan: what is left out, by name; what it saves, measured."""

import json
import os
import subprocess
import tempfile
import unittest

ROOT = os.path.join(os.path.dirname(__file__), "../..")
WELKIN = os.environ.get("WELKIN", os.path.join(ROOT, "build/welkin"))


class Plan(unittest.TestCase):
    def plan(self, name, *more):
        with tempfile.TemporaryDirectory() as folder:
            report = os.path.join(folder, "plan.json")
            done = subprocess.run([WELKIN, "plan", os.path.join(ROOT, f"benchmarks/left-out/{name}.json"), "--quiet", "--gpu", "software",
                                   "--json", report, *more], capture_output=True, text=True, check=False)
            if not os.path.exists(report):
                return done, None
            with open(report, encoding="utf-8") as f:
                return done, json.load(f)

    def test_one_picture_and_a_flight(self):
        done, picture = self.plan("nothing-moves")
        self.assertEqual(done.returncode, 0, done.stderr)
        _, flight = self.plan("nothing-moves", "--flight")
        names = [{x["name"] for x in of["left_out"]} for of in (picture, flight)]
        self.assertIn("one-picture", names[0] - names[1])
        self.assertIn("nothing-moves", names[1] - names[0])
        self.assertIn("reproject", flight["passes"])
        self.assertNotIn("reproject", picture["passes"])
        for left in picture["left_out"]:
            self.assertTrue(left["what"] and left["reason"])

    def test_measured(self):
        done, report = self.plan("no-aov", "--measure", "--reason", "no-aov", "--size", "96x54", "--turns", "1", "--frames", "2")
        self.assertEqual(done.returncode, 0, done.stderr)
        [saving] = report["measured"]
        self.assertEqual((saving["name"], saving["asked"]), ("no-aov", "picture"))
        self.assertLessEqual(saving["max_difference_255"], 1)
        # The linear picture is 16 bytes a pixel, and a picture without air and clouds has little else.
        self.assertGreaterEqual(saving["bytes"]["forced"] - saving["bytes"]["left_out"], 96 * 54 * 16)
        self.assertAlmostEqual(saving["saved"]["bytes"], 1 - saving["bytes"]["left_out"] / saving["bytes"]["forced"])
        self.assertGreaterEqual(saving["saved"]["most"], saving["saved"]["bytes"])

    def test_wrong_reasons(self):
        done, _ = self.plan("no-aov", "--measure", "--reason", "boredom")
        self.assertEqual(done.returncode, 2)
        done, _ = self.plan("no-aov", "--measure", "--reason", "night")
        self.assertEqual((done.returncode, len(done.stderr.strip().splitlines())), (1, 1), done.stderr)


if __name__ == "__main__":
    unittest.main()
