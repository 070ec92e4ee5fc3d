"""The plot of a flight: a picture from good timings, one line for bad ones."""
import json
import os
import subprocess
import tempfile
import unittest

REPOSITORY = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SCRIPT = os.path.join(REPOSITORY, "scripts", "plot_timings.py")


def rows(n):
    return [{"frame": i, "altitude_m": 1e6 * 0.98**i, "wall_ms": 9.0, "cpu_ms": 18.0, "wait_ms": 0.0,
             "passes": {name: {"wall_ms": k + i % 7, "cpu_ms": 2.0 * k} for k, name in enumerate("abcdefghij")},
             "counters": {}, "bytes": 1} for i in range(n)]


class Plot(unittest.TestCase):
    def run_on(self, text, output="passes.png"):
        with tempfile.TemporaryDirectory() as folder:
            source, picture = os.path.join(folder, "timings.json"), os.path.join(folder, output)
            with open(source, "w", encoding="utf-8") as f:
                f.write(text)
            done = subprocess.run(["/usr/bin/python3", "-B", SCRIPT, source, "-o", picture], capture_output=True, text=True, check=False)
            return done, os.path.getsize(picture) if os.path.exists(picture) else 0

    def test_picture(self):
        for n in [1, 2, 300]:
            done, size = self.run_on(json.dumps({"context": {"software": True, "gl_renderer": "r", "settings": {"width": 320, "height": 180}}, "frames": rows(n)}))
            self.assertEqual(done.returncode, 0, done.stderr)
            if "matplotlib is not installed" not in done.stderr:
                self.assertGreater(size, 10_000)  # an empty figure of this size is 8 kB

    def test_bad_input_is_one_line(self):
        for text in ["", "{", "[]", "{}", '{"frames": []}', '{"frames": [1]}', '{"frames": [{"passes": {}}]}', '{"frames": [{"altitude_m": 1, "passes": 2}]}']:
            done, size = self.run_on(text)
            self.assertEqual((done.returncode, size), (1, 0), text)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)

    def test_unwritable(self):
        done, _ = self.run_on(json.dumps({"frames": rows(3)}), "no/such/folder.png")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)


if __name__ == "__main__":
    unittest.main()
