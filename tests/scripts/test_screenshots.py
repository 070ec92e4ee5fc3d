"""Every picture in screenshots/ restores its view: drawn again small, it looks as the golden beside it did.

Needs the Earth's pictures in data/ (`make data`), whose checksums the screenshots carry; without them the tests are skipped and say so.
WELKIN_UPDATE_GOLDENS=1 rewrites the goldens.
"""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
GOLDEN = ROOT / "tests" / "image" / "screenshots"
WELKIN = os.environ.get("WELKIN", str(ROOT / "build" / "welkin"))
# A small budget keeps a picture at two or three seconds.
SMALL = ["--size", "160x90", "--budget", "64MiB", "--quiet"]
# Software GL is not bit-equal across processors, and one pixel of a cloud's edge may fall to either side: RMSE of 0-255.
LIMIT_RMSE_255 = 2.0


@unittest.skipUnless((ROOT / "data" / "clouds.png").exists(), "data/clouds.png is missing: run `make data`")
class Screenshots(unittest.TestCase):
    def test_each_restores_its_view(self):
        shots = sorted((ROOT / "screenshots").glob("*.png"))
        self.assertGreaterEqual(len(shots), 15, "eight views and the zoom series")
        for shot in shots:
            with self.subTest(shot=shot.name), tempfile.TemporaryDirectory() as folder:
                update = os.environ.get("WELKIN_UPDATE_GOLDENS")
                golden = GOLDEN / shot.name
                out = golden if update else pathlib.Path(folder) / shot.name
                subprocess.run([WELKIN, "render", str(shot), "-o", str(out), *SMALL], check=True, capture_output=True, text=True)
                if update:
                    continue
                report = pathlib.Path(folder) / "report.json"
                subprocess.run([WELKIN, "compare", str(golden), str(out), "--json", str(report)], check=True, capture_output=True, text=True)
                self.assertLessEqual(json.loads(report.read_text())["rmse_255"], LIMIT_RMSE_255)


if __name__ == "__main__":
    unittest.main()
