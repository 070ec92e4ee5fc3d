"""What all checks share (scripts/checks.py): lines, report, exit status."""

import contextlib
import io
import json
import os
import pathlib
import sys
import tempfile
import types
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
import checks  # noqa: E402


class Checks(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.check = checks.Check(types.SimpleNamespace(build="build", out=self.folder.name, quick=True))
        self.file = os.path.join(self.folder.name, "reports", "check.json")

    def run_groups(self, *lines):
        """Exit status, what is printed, and the report of one group that writes these lines."""
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            self.check.run_groups({"first": lambda c: [c.at_most(*line) for line in lines]}, ["first"])
            status = self.check.write(self.file, {"failed": self.check.failed(), "lines": self.check.lines})
        with open(self.file, encoding="utf-8") as f:
            return status, said.getvalue().splitlines(), json.load(f)

    def test_all_hold(self):
        status, said, report = self.run_groups(("error", 0.12345, 0.2), ("holes", 0, 0))
        self.assertEqual(status, 0)
        self.assertEqual(said[:2], ["pass  error: 0.123 (at most 0.2)", "pass  holes: 0 (at most 0)"])
        self.assertTrue(said[2].startswith("2 of 2 lines hold; "))
        self.assertEqual(report["failed"], 0)
        self.assertEqual(report["lines"][0], {"group": "first", "name": "error", "value": 0.12345, "limit": "at most 0.2", "pass": True})
        self.assertEqual(os.listdir(os.path.dirname(self.file)), ["check.json"], "no temporary is left")

    def test_one_fails(self):
        status, said, report = self.run_groups(("error", 0.3, 0.2), ("holes", 0, 0))
        self.assertEqual((status, report["failed"]), (1, 1))
        self.assertEqual(said[0], "FAIL  error: 0.3 (at most 0.2)")

    def test_what_was_not_measured_or_is_no_number_fails(self):
        status, said, report = self.run_groups(("error", None, 0.2), ("error", float("nan"), 0.2))
        self.assertEqual((status, report["failed"]), (1, 2))
        self.assertEqual(said[:2], ["FAIL  error: not measured (at most 0.2)", "FAIL  error: not finite (at most 0.2)"])

    def test_nothing_shown_is_a_failure(self):
        self.assertEqual(self.run_groups()[0], 1)


if __name__ == "__main__":
    unittest.main()
