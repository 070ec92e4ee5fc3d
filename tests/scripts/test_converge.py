"""A whole sweep through the real program, as small as it goes."""
import json
import os
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

WELKIN = os.environ["WELKIN"]
ROOT = Path(__file__).resolve().parents[2]
PLOT = ["/usr/bin/python3", "-B", str(ROOT / "scripts/plot_converge.py")]
SCENE = ROOT / "tests/image/scene.json"
SMALL = ["--size", "96x54", "--budget", "48MiB", "--depth", "9", "--detail", "12", "--gpu", "software", "--quiet"]


class Converge(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.json = Path(self.folder.name) / "r.json"
        self.html = Path(self.folder.name) / "r.html"

    def tearDown(self):
        self.folder.cleanup()

    def command(self, *more, repeat=2):
        return [WELKIN, "converge", str(SCENE), "--view", "layers", *SMALL, "--repeat", str(repeat), "--json", str(self.json), "--html", str(self.html), *more]

    def test_small_sweep(self):
        done = subprocess.run(self.command("--preset", "quick"), capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        report = json.loads(self.json.read_text())
        rows = {row["name"]: row for row in report["settings"]}
        self.assertEqual(len(rows), 6)
        self.assertEqual(report["truth"]["kind"], "gpu")
        for row in rows.values():
            self.assertGreater(row["time_ms"], 0)
            self.assertGreater(row["passes"]["march"]["median"], 0)
            self.assertEqual(row["time_spread_ms"]["n"], 2)
            self.assertGreater(row["samples"], 0)
            self.assertLessEqual(row["bytes"], row["budget_bytes"])
            self.assertEqual(row["error"]["not_finite"], 0)
            self.assertGreater(row["error"]["rmse_255"], 0)
        fine, coarse = rows["exponential-linear optical 0.32"], rows["exponential-linear optical 1.28"]
        self.assertLess(fine["error"]["rmse_255"], coarse["error"]["rmse_255"])
        self.assertLess(coarse["samples"], fine["samples"])
        # Rectangles know nothing of what the exponential is made for.
        self.assertGreater(rows["rectangle optical 0.32"]["error"]["rmse_255"], fine["error"]["rmse_255"])
        self.assertTrue(set(report["pareto"]) <= set(rows))
        self.assertIn(min(rows, key=lambda n: rows[n]["error"]["rmse_255"]), report["pareto"])
        html = self.html.read_text()
        self.assertNotIn("http", html)
        self.assertIn("data:image/png;base64,", html)

        picture = Path(self.folder.name) / "p.png"
        plot = subprocess.run([*PLOT, str(self.json), "-o", str(picture)], capture_output=True, text=True)
        self.assertEqual(plot.returncode, 0, plot.stderr)
        if "matplotlib is not installed" not in plot.stderr:
            self.assertGreater(picture.stat().st_size, 10_000)  # an empty figure of this size is 8 kB

    def test_plot_of_something_else_is_one_line(self):
        for text in ["", "{", "[]", "{}", '{"settings": []}', '{"settings": [{"name": "a"}]}']:
            self.json.write_text(text)
            plot = subprocess.run([*PLOT, str(self.json), "-o", str(self.html)], capture_output=True, text=True)
            self.assertEqual(plot.returncode, 1, text)
            self.assertEqual(len(plot.stderr.strip().splitlines()), 1, plot.stderr)

    def test_truth_in_double_precision(self):
        errors = {}
        for truth in ["tree", "source"]:
            done = subprocess.run(self.command("--sweep", "step=0.02", "--truth", truth, "--truth-every", "4", repeat=1), capture_output=True,
                                  text=True, timeout=120)
            self.assertEqual(done.returncode, 0, done.stderr)
            report = json.loads(self.json.read_text())
            self.assertEqual(report["truth"]["kind"], truth)
            self.assertLess(report["truth"]["tolerance"], 0.1)
            errors[truth] = report["settings"][0]["error"]["rmse_255"]
        # A fine march comes to the tree: 0.25 is half floats, and levels that turn where exactly a ray enters a node.
        self.assertLess(errors["tree"], 0.25)
        # What is left against the source is voxels: this tree's are as wide as hills.
        self.assertGreater(errors["source"], 2)

    def test_settings_that_need_trees_of_their_own(self):
        done = subprocess.run(
            self.command("--sweep", "brick-bits=8,16", "--sweep", "light=0.5,1", "--step", "0.04"), capture_output=True, text=True, timeout=120
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = json.loads(self.json.read_text())["settings"]
        self.assertEqual([(r["brick_bits"], r["light"]) for r in rows], [(8, 0.5), (8, 1), (16, 0.5), (16, 1)])
        errors = [r["error"]["rmse_255"] for r in rows]
        self.assertEqual(len(set(errors)), 4)  # each setting does something
        self.assertEqual(min(errors), errors[3])  # at a step whose own error is small beside them

    def test_a_stop_leaves_nothing(self):
        self.json.write_text("old")
        run = subprocess.Popen(self.command("--preset", "quick", repeat=1000), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        time.sleep(2)
        run.send_signal(signal.SIGINT)
        _, err = run.communicate(timeout=60)
        self.assertEqual(run.returncode, 1)
        self.assertIn("stopped", err)
        self.assertEqual(len(err.strip().splitlines()), 1)
        self.assertEqual(self.json.read_text(), "old")
        self.assertEqual([p.name for p in Path(self.folder.name).iterdir()], ["r.json"])

    def test_frames_of_a_still_camera_are_drawn(self):
        done = subprocess.run(self.command("--sweep", "frames=full,still"), capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        full, still = json.loads(self.json.read_text())["settings"]
        self.assertGreater(still["passes"]["march"]["median"], 0)  # though nothing moves
        self.assertLess(still["samples"], full["samples"] / 2)
        self.assertAlmostEqual(still["error"]["rmse_255"], full["error"]["rmse_255"], delta=0.01)  # its history is that of the full march

    def test_moving_needs_a_path(self):
        done = subprocess.run(self.command("--sweep", "frames=moving"), capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 1)
        self.assertIn("needs a path", done.stderr)


if __name__ == "__main__":
    unittest.main()
