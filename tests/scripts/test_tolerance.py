"""--tolerance of render and converge: what was picked and what was reached stands in the report."""

import json
import os
import subprocess
import tempfile
import unittest

ROOT = os.path.join(os.path.dirname(__file__), "../..")
WELKIN = os.environ.get("WELKIN", os.path.join(ROOT, "build/welkin"))
SCENE = os.path.join(ROOT, "tests/image/scene.json")


class Tolerance(unittest.TestCase):
    def run_welkin(self, command, *more):
        with tempfile.TemporaryDirectory() as folder:
            report = os.path.join(folder, "report.json")
            output = ["-o", os.path.join(folder, "out.png")] if command == "render" else []
            done = subprocess.run([WELKIN, command, SCENE, *output, "--view", "layers", "--size", "96x54", "--budget", "40MiB", "--detail", "8", "--quiet", "--json", report,
                                   *more], capture_output=True, text=True, check=False)
            if not os.path.exists(report):
                return done, None
            with open(report, encoding="utf-8") as f:
                return done, json.load(f)

    def test_render(self):
        done, report = self.run_welkin("render", "--tolerance", "3")
        self.assertEqual(done.returncode, 0, done.stderr)
        t = report["tolerance"]
        self.assertEqual((t["asked"], t["kept"]), (3, True))
        self.assertLessEqual(t["reached_rmse_255"], 3)
        self.assertLess(t["settings"]["step"], 10)
        self.assertGreater(report["time_ms"], 0)
        self.assertIn("reached", done.stdout)

    def test_converge(self):
        done, report = self.run_welkin("converge", "--tolerance", "1,4")
        self.assertEqual(done.returncode, 0, done.stderr)
        [view] = report["views"]
        for choice in view["choices"]:
            self.assertLessEqual(choice["reached_rmse_255"], choice["asked"])
            self.assertLessEqual(choice["cheapest"]["time_ms"], choice["time_ms"])

    def test_wrong(self):
        for text in ("0", "-1", "much", ""):
            self.assertEqual(self.run_welkin("render", "--tolerance", text)[0].returncode, 2, text)
        self.assertEqual(self.run_welkin("converge", "--tolerance", "1,,2")[0].returncode, 2)


if __name__ == "__main__":
    unittest.main()
