"""The group "recording" of check_window.py: a flight recorded, edited, replayed, measured, compared and filmed in the window."""

import glob
import hashlib
import json
import math
import os
import shutil
import subprocess
import time

from window_driver import PATIENCE_S

SMALL = ["--budget", "128MiB", "--depth", "11"]
STOPPED_CPU_S = 8  # it takes 2 to 3 on the machine of docs/window.md


def rgba(path):
    from matplotlib import image  # reads eight bits as n / 255
    import numpy as np
    pixels = np.rint(image.imread(path)[..., :3] * 255).astype(np.uint8)
    return np.dstack([pixels, np.full(pixels.shape[:2], 255, np.uint8)])


def near_view(a, b, most=1e-12):
    def near(p, q):
        return all(abs(x - y) <= most * max(math.hypot(*p), 1) for x, y in zip(p, q))
    return near(a["position_m"], b["position_m"]) and near(a["orientation_xyzw"], b["orientation_xyzw"])


def recording(c):
    """Records, edits, replays, measures and compares a flight; the panel needs a larger window than the pictures."""
    import numpy as np
    size = "320x180"
    w = c.window(*SMALL, size=size)
    w.key("r")
    w.wait_for(lambda s: s["flight"]["mode"] == "recording")
    long_s = 1.1 if c.quick else 4.5
    w.hold("w", lambda s: s["flight"]["at_s"] > long_s)
    w.key("r")
    said = w.wait_for(lambda s: s["message"].startswith("wrote the path"))
    paths = [p for p in glob.glob(os.path.join(w.shots, "welkin-path*.json")) if not p.endswith(".scene.json")]
    c.line("a recorded flight is written", len(paths), "1", said is not None and len(paths) == 1)
    if not paths:
        return c.end(w, "recording")
    with open(paths[0], encoding="utf-8") as f:
        path = json.load(f)
    frames = len(path["frames"])
    fewest = 30 if c.quick else 100
    c.line("frames recorded", frames, f"at least {fewest}, as many as on the tape", frames >= fewest and said["flight"]["frames"] == frames)

    w.resize(1280, 800)
    w.wait_for(lambda s: s["window"] == [1280, 800])
    w.open_only("Flight")
    w.capture(os.path.join(c.out, "flight.png"))
    w.press("Replay exactly")
    w.wait_for(lambda s: s["flight"]["running"] == "exact replay")
    w.key("Tab")
    w.resize(*(int(n) for n in size.split("x")))
    shown = (w.wait_for(lambda s: s["flight"]["running"] == "" and not s["sidebar"], 2 * PATIENCE_S) or w.state())["flight"]["shown"]
    folder = os.path.join(c.out, "fly")
    done = subprocess.run([c.welkin, "fly", paths[0], "--every", "1", "--quiet", "--out", folder], capture_output=True, check=False)
    c.line("welkin fly replays it: exit status", done.returncode, "0", done.returncode == 0)
    views = sum(near_view(a["view"], b) for a, b in zip(shown, path["frames"]))
    c.line(f"views of {frames} frames replayed in the window", views, "all as recorded, to 1e-12", views == frames == len(shown))
    pictures = {n: rgba(os.path.join(folder, f"frame-{n:05}.png")) for n in range(frames)}
    equal = sum(hashlib.sha256(pictures[s["frame"]].tobytes()).hexdigest() == s["sha256"] for s in shown)
    c.line("pictures replayed in the window against those of welkin fly", equal, "all equal to the byte", equal == frames)
    last = pictures[frames - 1]
    rows = last.shape[0] - 95  # above the status line and the message

    def furthest(pixels):
        return int(np.abs(pixels[:rows, :last.shape[1]].astype(int) - last[:rows, :, :3].astype(int)).max())

    worst = furthest(w.capture(os.path.join(c.out, "replayed.png"), lambda pixels: furthest(pixels) == 0))
    c.line("the last one on the screen, greatest difference", worst, "0 of 255", worst == 0)

    w.key("Tab")
    w.resize(1280, 800)
    w.wait_for(lambda s: s["window"] == [1280, 800] and s["sidebar"])
    w.fresh()  # the bar has its place then
    x0, y0, x1, y1 = w.field("flight bar")
    w.drag(x0 + 6, y1 - 6, x0 + 0.25 * (x1 - x0), y1 - 6)
    w.wait_for(lambda s: s["flight"]["in"] > 0)
    w.drag(x1 - 6, y1 - 6, x0 + 0.6 * (x1 - x0), y1 - 6)
    near = w.wait_for(lambda s: abs(s["flight"]["in"] / frames - 0.25) < 0.06 and abs(s["flight"]["out"] / frames - 0.6) < 0.06)
    cut = (near or w.state())["flight"]
    c.line("in and out points after drags", [cut["in"], cut["out"]], "near 25 % and 60 %", near is not None)
    w.move(640, 600)
    w.frames(3)
    w.capture(os.path.join(c.out, "flight-cut.png"))
    reset = w.until(lambda: w.click(x0 + 0.25 * (x1 - x0), y1 - 6, times=2), lambda s: s["flight"]["in"] == 0)
    c.line("in point after a double click", w.state()["flight"]["in"], "0", reset is not None)
    w.press("Undo edit")
    cut = (w.wait_for(lambda s: s["flight"]["in"] > 0) or w.state())["flight"]
    c.line("and after undo", cut["in"], "not 0", cut["in"] > 0)
    w.press("Keep only this")
    kept = w.wait_for(lambda s: s["flight"]["frames"] == cut["out"] - cut["in"] + 1)
    c.line("frames after the cut", w.state()["flight"]["frames"], f"{cut['out'] - cut['in'] + 1}", kept is not None)
    w.press("Undo edit")
    back = w.wait_for(lambda s: s["flight"]["frames"] == frames)
    w.press("Redo edit")
    again = w.wait_for(lambda s: s["flight"]["frames"] < frames)
    c.line("the cut undone and done again", w.state()["flight"]["frames"], "all frames, then those kept", back is not None and again is not None)
    w.press("Save path")
    w.wait_for(lambda s: "welkin-path-2.json" in s["message"])
    second = os.path.join(w.shots, "welkin-path-2.json")
    with open(second, encoding="utf-8") as f:
        part = json.load(f)
    c.line("the path that was cut", len(part["frames"]), "frames of the first one, to the bit",
           part["frames"] == path["frames"][cut["in"]:cut["out"] + 1])

    w.press("Benchmark")
    w.wait_for(lambda s: s["flight"]["running"] == "benchmark" and s["flight"]["progress"] > 0)
    begun, begun_cpu_s = time.time(), w.cpu_s()
    w.press("Stop")
    ended = w.wait_for(lambda s: s["flight"]["running"] == "") is not None
    took, used = time.time() - begun, w.cpu_s() - begun_cpu_s
    ended &= not glob.glob(os.path.join(w.shots, "*-result*.json"))
    if c.quick:  # beside other programs the clock says little
        c.line("a benchmark that is stopped ends, s of the processors", used, f"at most {STOPPED_CPU_S}; no file", ended and used <= STOPPED_CPU_S)
    else:
        c.line("a benchmark that is stopped ends, s", took, "at most 3; no file", ended and took <= 3)
    for n in (1,) if c.quick else (1, 2):
        w.open_only("Flight")
        w.press("Benchmark")
        w.wait_for(lambda s, n=n: len(s["flight"]["results"]) == n, 2 * PATIENCE_S)
    results = w.state()["flight"]["results"]
    wanted = 1 if c.quick else 2
    c.line("benchmarks in the panel", len(results), f"{wanted}, beside the path",
           len(results) == wanted and all(os.path.dirname(r) == w.shots for r in results))
    good = 0
    for file in results:
        with open(file, encoding="utf-8") as f:
            got = json.load(f)
        good += len(got["frames"]) == len(part["frames"]) and got["nan_pixels"] == 0 and got["holes"] == 0 and not got["stopped"]
    c.line("results with every frame, no NaN, no hole", good, f"{len(results)}", good == wanted)
    w.open_only("Results")
    w.capture(os.path.join(c.out, "results.png"))
    foreign = os.path.join(folder, "timings.json")
    w.drop(foreign)
    dropped = w.wait_for(lambda s: len(s["flight"]["results"]) == wanted + 1)
    c.line("results with a dropped one", len(w.state()["flight"]["results"]), f"{wanted + 1}, the last two side by side",
           dropped is not None and [dropped["flight"]["a"], dropped["flight"]["b"]] == [wanted - 1, wanted])
    w.frames(3)
    w.capture(os.path.join(c.out, "results-dropped.png"))
    done = subprocess.run([c.welkin, "compare", results[-1], foreign], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    compared = done.returncode == 0 and "B / A" in done.stdout
    c.line("welkin compare of the two: exit status", done.returncode, "0, with B / A", compared)
    if shutil.which("ffmpeg") and not c.quick:
        w.open_only("Flight")
        w.press("Video")
        w.wait_for(lambda s: s["message"].startswith("wrote the video"), 2 * PATIENCE_S)
        film = os.path.join(w.shots, "welkin-path-2.mp4")
        size = os.path.getsize(film) if os.path.exists(film) else 0
        c.line("a video, bytes", size, "over 1000", size > 1000)
    w.key("r")
    w.wait_for(lambda s: s["flight"]["mode"] == "recording")
    w.drop(paths[0])
    said = w.wait_for(lambda s: "has ended" in s["message"])
    c.line("a path dropped while one is recorded", said["flight"]["mode"] if said else "none", "a message, and recording goes on",
           said is not None and said["flight"]["mode"] == "recording")
    w.key("r")
    w.wait_for(lambda s: s["message"].startswith("wrote the path"))
    c.end(w, "recording")
