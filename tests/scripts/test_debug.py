"""Debug views through the real program: a picture in false colours, its numbers, and what is refused. A scene of one layer of clouds, small."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
WELKIN = os.environ.get("WELKIN", str(ROOT / "build" / "welkin"))
SCENE = ROOT / "benchmarks" / "left-out" / "one-layer.json"
SMALL = ["--size", "96x54", "--detail", "5", "--depth", "10", "--quiet"]


def run(*arguments):
    return subprocess.run([WELKIN, *map(str, arguments)], capture_output=True, text=True, check=False)


class Debug(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def render(self, view, *more):
        picture, report = self.folder / f"{view}.png", self.folder / f"{view}.json"
        done = run("render", SCENE, "--debug", view, "-o", picture, "--json", report, *SMALL, *more)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"{view}: ", done.stdout)
        return picture, json.loads(report.read_text())["debug"]

    def test_numbers_with_scale(self):
        _, debug = self.render("steps")
        self.assertEqual((debug["view"], debug["unit"]), ("steps", "samples"))
        self.assertEqual(debug["pixels"] + debug["without"], 96 * 54)
        self.assertEqual(debug["not_a_number"], 0)
        self.assertTrue(0 <= debug["minimum"] < debug["mean"] < debug["maximum"])
        self.assertEqual((debug["scale"]["low"], debug["scale"]["high"], debug["scale"]["logarithmic"]), (1, 256, True))

    def test_numbers_of_kinds(self):
        _, debug = self.render("history")
        self.assertNotIn("scale", debug)
        self.assertEqual(sum(k["pixels"] for k in debug["kinds"]), 96 * 54)
        self.assertNotIn("marched: no valid history", [k["name"] for k in debug["kinds"]], "at rest")

    def test_a_picture_brings_back_the_scene(self):
        picture, _ = self.render("density")
        normal, again = self.folder / "normal.png", self.folder / "again.png"
        for what, where in ((SCENE, normal), (picture, again)):
            done = run("render", what, "-o", where, *SMALL)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(again.read_bytes(), normal.read_bytes())
        self.assertNotEqual(picture.read_bytes(), normal.read_bytes())

    def test_refuses(self):
        unknown = run("render", SCENE, "--debug", "colours", "-o", self.folder / "x.png")
        self.assertEqual(unknown.returncode, 2)
        self.assertIn("occupancy", unknown.stderr, "the names that there are")
        linear = run("render", SCENE, "--debug", "steps", "-o", self.folder / "x.exr", "--quiet")
        self.assertEqual((linear.returncode, len(linear.stderr.splitlines())), (1, 1))
        self.assertIn(".png", linear.stderr)
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
