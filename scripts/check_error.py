#!/usr/bin/python3
"""check_error.py --build BUILD --out FOLDER [--json FILE] [--only GROUPS] [--quick]: what is promised of error against run time.

Each line is value, limit, pass or fail; exit 1 if any fails. All lines go to FOLDER/check-error.json, or to --json. --quick: what takes
seconds. The cover picture (make data) is needed for near and tolerance.
"""

import glob
import json
import os
import statistics
import subprocess
import sys

import checks

ASKED = [0.5, 1, 2, 4]
NEAR_RMSE = 0.0061  # of 0-1: what the thesis program reaches there with its default step
THESIS = ["--integrator", "rectangle", "--step-rule", "node", "--step", "0.2", "--march-empty"]
LEAST_RAYS = 1_000_000
LEAST_SAVED = 0.05
ORDERS = {"rectangle": 1, "trapezoid": 2, "simpson": 4}


class Check(checks.Check):
    def report(self, name, *arguments, exits=(0,)):
        """The JSON of a command, or None after a failing line."""
        path = os.path.join(self.out, name + ".json")
        if os.path.exists(path):
            os.remove(path)
        done = subprocess.run([self.welkin, *arguments, "--json", path, "--quiet"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode not in exits or not os.path.exists(path):
            self.line(f"welkin {' '.join(arguments)}", (done.stdout.strip().splitlines() or ["no output"])[-1], "exit 0", False)
            return None
        with open(path, encoding="utf-8") as f:
            return json.load(f)


def order(c):
    got = c.report("orders", "stress", "--orders")
    for o in got["orders"] if got else []:
        c.line(f"order of {o['integrator']} on {o['line']} lines", o["observed"], f"promised {o['promised']:g}", o["ok"])
    if got:
        missing = [name for name in ORDERS if not any(o["integrator"] == name and o["promised"] == ORDERS[name] for o in got["orders"])]
        c.line("orders promised and not measured", ", ".join(missing) or "none", "none", not missing)


def near(c):
    ours = c.report("near", "bench", "benchmarks/poses/near.json", "--frames", "3", "--no-cold-start")
    thesis = c.report("near-thesis", "bench", "benchmarks/poses/near.json", "--frames", "3", "--no-cold-start", *THESIS)
    if not ours or not thesis:
        return
    samples = [d["full"]["samples_per_ray"] for d in (ours, thesis)]
    c.details["near"] = {"samples_per_ray": samples[0], "thesis_samples_per_ray": samples[1], "rmse": ours["quality"]["rmse_vs_fine_step"],
                         "thesis_rmse": thesis["quality"]["rmse_vs_fine_step"]}
    c.line("near: RMSE of the default (0-1)", ours["quality"]["rmse_vs_fine_step"], f"at most {NEAR_RMSE}",
           ours["quality"]["rmse_vs_fine_step"] <= NEAR_RMSE)
    c.line("near: samples over those of the thesis' way", samples[0] / samples[1], "at most 0.2", samples[0] <= 0.2 * samples[1])


def tolerance(c):
    got = c.report("tolerance", "converge", "benchmarks/error/views.json", "--tolerance", ",".join(f"{a:g}" for a in ASKED), "--size", "160x90", "--repeat", "3")
    if not got:
        return
    views = got["views"]
    choices = [(v["view"], ch) for v in views for ch in v["choices"]]
    held = [v for v in views if v["view"].startswith("held")]
    c.details["tolerance"] = [{k: x for k, x in v.items() if k != "candidates"} for v in views]
    c.line("views", len(views), "at least 40", len(views) >= 40)
    c.line("views that no constant was chosen on", len(held), "at least 8", len(held) >= 8)
    for name, some in (("", choices), (", held-out views", [x for x in choices if x[0].startswith("held")])):
        kept = sum(ch["reached_rmse_255"] <= ch["asked"] for _, ch in some) / len(some)
        worst = max(ch["reached_rmse_255"] / ch["asked"] for _, ch in some)
        c.line(f"reached at most what was asked{name}", kept, "at least 0.95 of the views", kept >= 0.95)
        c.line(f"greatest reached over asked{name}", worst, "at most 2", worst <= 2)
    timed = [(v, ch) for v, ch in choices if "cheapest" in ch and "time_ms" in ch]
    near_cheapest = sum(ch["time_ms"] <= 1.5 * ch["cheapest"]["time_ms"] for _, ch in timed) / max(len(timed), 1)
    c.line("time at most 1.5 of the cheapest candidate's that keeps it", near_cheapest, "at least 0.8 of the views", near_cheapest >= 0.8)
    time = {a: {v: ch["time_ms"] for v, ch in timed if ch["asked"] == a} for a in ASKED}
    both = [v for v in time[4] if v in time[0.5]]
    ratios = [time[4][v] / time[0.5][v] for v in both]
    c.line("time at 4 over time at 0.5, all views together", sum(time[4][v] for v in both) / max(sum(time[0.5][v] for v in both), 1e-9),
           "at most 0.4", both and sum(time[4][v] for v in both) <= 0.4 * sum(time[0.5][v] for v in both))
    c.details["time ratio, median of views"] = statistics.median(ratios) if ratios else None


def stress(c):
    got = c.report("stress", "stress", *(["--quick"] if c.quick else []), exits=(0, 1))
    if not got:
        return
    rays = got["rays"]
    c.line("stress: rays", rays, f"at least {LEAST_RAYS}", c.quick or rays >= LEAST_RAYS)
    for what in ("nan", "inf", "negative"):
        n = sum(i[what] for i in got["integrators"].values())
        c.line(f"stress: {what}", n, "0", n == 0)
    c.line("stress: failing cells that nothing predicts", got["mispredicted"], "0", got["mispredicted"] == 0)
    c.line("stress: failing cells of the default", got["failing_of_default"], "0", got["failing_of_default"] == 0)
    failing = {name: i["failing"] for name, i in got["integrators"].items()}
    explicit = sum(failing.get(name, 0) for name in ("rectangle", "trapezoid", "simpson", "simpson-3/8"))
    c.line("stress: failing cells of the explicit rules, all predicted", explicit, "at least 1: else the matrix is too kind", explicit > 0)
    c.details["stress"] = {k: got[k] for k in got if k != "cells"}


def broken(c):
    done = subprocess.run([os.path.join(c.build, "tests", "unit_measure"), "--gtest_filter=Broken*:*Broken*"], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True)
    passed = done.stdout.count("[       OK ]")
    c.line("tests that wrong answers fail", passed, "all, at least 3", done.returncode == 0 and passed >= 3)


def left_out(c):
    for path in sorted(glob.glob("benchmarks/left-out/*.json")):
        reason = os.path.basename(path)[:-len(".json")]
        if reason == "nothing":
            continue
        got = c.report(f"left-out-{reason}", "plan", path, "--measure", "--reason", reason, "--turns", "2", "--frames", "6")
        if not got:
            continue
        for row in got["measured"]:
            c.details.setdefault("left out", {})[row["name"]] = row
            most = row["saved"]["most"]
            c.line(f"{row['name']}: saved most", most, f"at least {LEAST_SAVED:g} of start, frame or memory", most >= LEAST_SAVED)
            c.line(f"{row['name']}: difference of the pictures", row["max_difference_255"], "at most 1 of 255", row["max_difference_255"] <= 1)


GROUPS = {"order": order, "broken": broken, "near": near, "stress": stress, "left-out": left_out, "tolerance": tolerance}
QUICK = ["order", "broken"]


def main():
    options, only = checks.options_of("check-error", "What is promised of error against run time, line by line.", GROUPS,
                                      f"by default only {', '.join(QUICK)}; fewer rays")
    wanted = only or (QUICK if options.quick else list(GROUPS))
    c = Check(options)
    c.run_groups(GROUPS, wanted)
    return c.write(options.json,
                   {"groups": wanted, "quick": options.quick, "failed": c.failed(), "lines": c.lines, "details": c.details})


if __name__ == "__main__":
    sys.exit(main())
