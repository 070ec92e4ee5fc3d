#!/usr/bin/python3
"""check_orbit.py --build BUILD --out FOLDER [--only WORDS]: what the flight from orbit to ground promises, line by line.

Each line is value, limit, pass or fail. Exit 1 if any fails. The numbers go to FOLDER/check-orbit.json, with machine and commit;
a full run is committed as benchmarks/results/check-orbit.json.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys

REPOSITORY = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
GROUPS = ["path", "still", "moving", "determinism", "budgets", "speed", "left-out"]


class Check:
    def __init__(self, options):
        self.welkin = os.path.abspath(os.path.join(options.build, "welkin"))
        self.out = os.path.abspath(options.out)
        self.lines, self.context = [], {}
        os.makedirs(self.out, exist_ok=True)

    def line(self, name, value, limit, ok):
        self.lines.append({"name": name, "value": value, "limit": limit, "pass": bool(ok)})
        print(f"{'pass' if ok else 'FAIL'}  {name}: {value:.4g}" if isinstance(value, float) else
              f"{'pass' if ok else 'FAIL'}  {name}: {value}", f"({limit})", flush=True)

    def at_most(self, name, value, limit):
        self.line(name, float(value), f"at most {limit:g}", value <= limit)

    def run(self, *arguments, **environment):
        return subprocess.run([self.welkin, *map(str, arguments)], capture_output=True, text=True, cwd=REPOSITORY, check=False,
                              env={**os.environ, **environment})

    def fly(self, path, name, *options, **environment):
        """The timings of a flight, or None after a failing line."""
        folder = os.path.join(self.out, name)
        done = self.run("fly", path, "--out", folder, "--json", f"{folder}/timings.json", "--quiet", *options, **environment)
        if done.returncode:
            self.line(f"{name} runs", done.stderr.strip() or f"exit {done.returncode}", "exit 0", False)
            return None
        with open(f"{folder}/timings.json", encoding="utf-8") as f:
            data = json.load(f)
        self.context = self.context or data.get("context", {})
        return data

    def still(self, pose, count, warm_up=0, scene=None):
        """A path that stays at the one view of a scene, by default the scene of a benchmark pose."""
        scene = os.path.join(REPOSITORY, scene or f"benchmarks/poses/{pose}.json")
        with open(scene, encoding="utf-8") as f:
            view = json.load(f)["views"][pose]
        sys.path.insert(0, os.path.join(REPOSITORY, "scripts"))
        from globe import heading_vector, up_at
        from make_paths import frame
        place = view["latitude_deg"], view["longitude_deg"]
        frames = [frame(up_at(*place), heading_vector(*place, view["heading_deg"]), view["altitude_m"], view["pitch_deg"], n)
                  for n in range(count)]
        path = os.path.join(self.out, f"still-{os.path.basename(scene)[:-5]}-{count}.json")
        with open(path, "w", encoding="utf-8") as f:
            json.dump({"scene": scene, "size": [320, 180], "time_step_s": 0.04,
                       "warm_up": warm_up, "frames": frames}, f)
        return path

    def sound(self, name, data):
        self.at_most(f"{name}: nan_pixels", data["nan_pixels"], 0)
        self.at_most(f"{name}: rays that met a hole", data["holes"], 0)
        self.at_most(f"{name}: GL debug messages", data["gl_debug_messages"], 0)
        over = sum(row["bytes"] > data["residency"]["budget"] for row in data["frames"])
        self.at_most(f"{name}: frames over the budget", over, 0)


def check_path(c):
    with open(os.path.join(REPOSITORY, "benchmarks/orbit-to-ground.json"), encoding="utf-8") as f:
        count = len(json.load(f)["frames"])
    listed = [round((i + 1) * (count - 1) / 12) for i in range(12)]
    data = c.fly("benchmarks/orbit-to-ground.json", "orbit-to-ground", "--quality-frames", ",".join(map(str, listed)), "--pop", ":")
    if not data:
        return
    c.sound("path", data)
    quality = data["quality"]["rmse_255"]
    c.at_most("path: RMSE (0-255) against render, median of 12 frames", quality["median"], 4)
    c.at_most("path: RMSE (0-255) against render, largest", quality["max"], 8)
    c.at_most("path: pop, p99.9 of |difference| (0-255), largest", max(row["p999_255"] for row in data["pop"]["frames"]), 4)


def check_still(c):
    for pose in ["orbit", "near", "ground"]:
        # 16 frames march every pixel once; the warm-up lets the tree settle first.
        data = c.fly(c.still(pose, 17, 400), f"still-{pose}", "--every", 0, "--quality-frames", 16)
        if data:
            share = data["quality"]["frames"][0]["share_over_1"]
            c.at_most(f"still {pose}: pixels over 1/255 from the full march after 16 frames", share, 0.001)
    data = c.fly(c.still("near", 100, 400), "static-near", "--every", 0)
    if data:
        c.at_most("static scene: bricks generated in 100 frames", data["counters"]["bricks_generated"], 0)
        c.at_most("static scene: bricks lit in 100 frames", data["counters"]["bricks_lit"], 0)


def check_moving(c):
    for pose, limit in [("orbit", 0.015), ("near", 0.005)]:
        data = c.fly(f"benchmarks/moving-{pose}.json", f"moving-{pose}", "--every", 0, "--quality-frames", "16,24,32,40,47")
        if data:
            c.sound(f"moving {pose}", data)
            worst = max(row["rmse_255"] for row in data["quality"]["frames"]) / 255
            c.at_most(f"moving {pose}: RMSE (0-1) against the full march", worst, limit)


def idat(path):
    """The compressed pixels of a PNG: the picture without what is written about it."""
    with open(path, "rb") as f:
        data = f.read()
    at, pixels = 8, b""
    while at < len(data):
        size = int.from_bytes(data[at:at + 4], "big")
        if data[at + 4:at + 8] == b"IDAT":
            pixels += data[at + 8:at + 8 + size]
        at += 12 + size
    return pixels


def check_determinism(c):
    for part in ["0:40", "320:360"]:
        runs = [("plain", [], {}), ("again", [], {}), ("delays", ["--worker-jitter", 7], {}),
                ("one-thread", [], {"LP_NUM_THREADS": "1"}), ("two-threads", [], {"LP_NUM_THREADS": "2"})]
        pictures = {}
        for name, options, environment in runs:
            folder = f"same-{part.replace(':', '-')}-{name}"
            if c.fly("benchmarks/orbit-to-ground.json", folder, "--frames", part, "--every", 1, *options, **environment) is None:
                return
            frames = sorted(n for n in os.listdir(os.path.join(c.out, folder)) if n.startswith("frame"))
            pictures[name] = [idat(os.path.join(c.out, folder, n)) for n in frames]
        for name, _, _ in runs[1:]:
            different = sum(a != b for a, b in zip(pictures["plain"], pictures[name])) + abs(len(pictures["plain"]) - len(pictures[name]))
            c.at_most(f"frames {part}, {name}: pictures that differ", different, 0)
        c.line(f"frames {part}: pictures compared", len(pictures["plain"]), "40", len(pictures["plain"]) == 40)


def check_budgets(c):
    for budget in ["64MiB", "512MiB", "4GiB"]:
        data = c.fly("benchmarks/orbit-to-ground.json", f"budget-{budget}", "--budget", budget, "--frames", "250:350", "--every", 0)
        if data:
            c.sound(f"budget {budget}", data)
    done = c.run("fly", "benchmarks/orbit-to-ground.json", "--out", os.path.join(c.out, "budget-none"), "--budget", "1MiB", "--quiet")
    c.line("below the least budget: one line that names it, exit 1", done.stderr.strip(), "names MiB",
           done.returncode == 1 and len(done.stderr.strip().splitlines()) == 1 and "MiB" in done.stderr)


def check_speed(c):
    # A tenth of what the thesis program needs (CPU ms, march of one pixel in 16; the whole frame is promised for near).
    for pose, march_ms in [("space", 0.195), ("orbit", 0.4), ("near", 6.0), ("ground", 3.5)]:
        data = c.fly(c.still(pose, 30, 400), f"speed-{pose}", "--every", 0)
        if data:
            c.at_most(f"{pose}: march of one pixel in 16, CPU ms, median of 30", data["passes"]["march"]["cpu_ms"]["median_ms"], march_ms)
            c.at_most(f"{pose}: whole frame one in 16, CPU ms, median of 30",
                      statistics.median(sum(p["cpu_ms"] for p in row["passes"].values()) for row in data["frames"]), 25)


def check_left_out(c):
    def cost(name):
        data = c.fly(c.still("orbit", 30, 200, f"benchmarks/left-out/{name}.json"), f"left-out-{name}", "--every", 0)
        if data is None:
            return None
        median_ms = statistics.median(sum(p["cpu_ms"] for p in row["passes"].values()) for row in data["frames"])
        return data["left_out"], median_ms, data["residency"]["bytes"]

    whole = cost("nothing")
    for name in ["no-clouds", "no-atmosphere", "no-sun"]:
        part = cost(name)
        if whole and part:
            saved = max(1 - part[1] / whole[1], 1 - part[2] / whole[2])
            c.line(f"left out, {name}: share of time or memory saved", saved, "at least 0.05, with a reason", saved >= 0.05 and part[0])


def main():
    parser = argparse.ArgumentParser(description="What the flight from orbit to ground promises, line by line.")
    parser.add_argument("--build", default="build")
    parser.add_argument("--out", default="out/check-orbit")
    parser.add_argument("--only", help=f"comma-separated: {', '.join(GROUPS)}")
    options = parser.parse_args()
    wanted = options.only.split(",") if options.only else GROUPS
    if not set(wanted) <= set(GROUPS):
        parser.error(f"--only: expected some of {', '.join(GROUPS)}")
    c = Check(options)
    for group in wanted:
        {"path": check_path, "still": check_still, "moving": check_moving, "determinism": check_determinism, "budgets": check_budgets,
         "speed": check_speed, "left-out": check_left_out}[group](c)
    report = os.path.join(c.out, "check-orbit.json")
    with open(report + ".new", "w", encoding="utf-8") as f:
        json.dump({"context": c.context, "lines": c.lines}, f, indent=1)
    os.replace(report + ".new", report)
    failed = sum(not line["pass"] for line in c.lines)
    print(f"{len(c.lines) - failed} of {len(c.lines)} lines hold; {report}")
    sys.exit(1 if failed or not c.lines else 0)


if __name__ == "__main__":
    main()
