"""The group "recording" of check_window.py: a flight recorded, edited, replayed, measured, compared and filmed in the window."""

import glob
import hashlib
import json
import math
import os
import shutil
import subprocess
import time

SMALL = ["--budget", "128MiB", "--depth", "11"]
NUMBERED = ["Camera", "Scene", "Quality", "Exposure", "Time", "Profiler", "Memory", "Left out", "Log"]
KEYS = {"Flight": "f", "Results": "b"}


def press(w, field, tries=3):
    """Clicks a field of a panel, once it is where it says."""
    for _ in range(tries):
        place = (w.wait_for(lambda s: field in s["fields"], 10) or {"fields": {}})["fields"].get(field)
        if place:
            w.click((place[0] + place[2]) / 2 if place[2] - place[0] < 200 else place[0] + 20, (place[1] + place[3]) / 2)
            return True
    return False


def only_panel(w, name):
    for _ in range(5):
        state = w.fresh()
        if state["panels"] == [name]:
            return True
        for other in state["panels"]:
            if other != name:
                w.key(KEYS.get(other, str(1 + NUMBERED.index(other)) if other in NUMBERED else "0"))
        if name not in state["panels"]:
            w.key(KEYS[name])
    return False


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
    w.wait_for(lambda s: s["pictures"] > 20, 60)
    w.key("r")
    w.hold("w", 1.5 if c.quick else 4.5)
    w.key("r")
    said = w.wait_for(lambda s: s["message"].startswith("wrote the path"), 20)
    paths = [p for p in glob.glob(os.path.join(w.shots, "welkin-path*.json")) if not p.endswith(".scene.json")]
    c.line("a recorded flight is written", len(paths), "1", said is not None and len(paths) == 1)
    if not paths:
        return c.end(w, "recording")
    with open(paths[0], encoding="utf-8") as f:
        path = json.load(f)
    frames = len(path["frames"])
    fewest = 30 if c.quick else 100
    c.line("frames recorded", frames, f"at least {fewest}, as many as on the tape", frames >= fewest and w.fresh()["flight"]["frames"] == frames)

    w.resize(1280, 800)
    w.wait_for(lambda s: s["window"] == [1280, 800], 20)
    only_panel(w, "Flight")
    w.capture(os.path.join(c.out, "flight.png"))
    press(w, "Replay exactly")
    w.wait_for(lambda s: s["flight"]["running"] == "exact replay", 20)
    w.key("Tab")
    w.resize(*(int(n) for n in size.split("x")))
    w.wait_for(lambda s: s["flight"]["running"] == "", 240)
    time.sleep(1)
    seen = w.capture(os.path.join(c.out, "replayed.png"))
    shown = w.fresh()["flight"]["shown"]
    folder = os.path.join(c.out, "fly")
    done = subprocess.run([c.welkin, "fly", paths[0], "--every", "1", "--quiet", "--out", folder], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    c.line("welkin fly replays it: exit status", done.returncode, "0", done.returncode == 0)
    views = sum(near_view(a["view"], b) for a, b in zip(shown, path["frames"]))
    c.line(f"views of {frames} frames replayed in the window", views, "all as recorded, to 1e-12", views == frames == len(shown))
    pictures = {n: rgba(os.path.join(folder, f"frame-{n:05}.png")) for n in range(frames)}
    equal = sum(hashlib.sha256(pictures[s["frame"]].tobytes()).hexdigest() == s["sha256"] for s in shown)
    c.line("pictures replayed in the window against those of welkin fly", equal, "all equal to the byte", equal == frames)
    last = pictures[frames - 1]
    rows = last.shape[0] - 95  # above the status line and the message
    worst = int(np.abs(seen[:rows, :last.shape[1]].astype(int) - last[:rows, :, :3].astype(int)).max())
    c.line("the last one on the screen, greatest difference", worst, "0 of 255", worst == 0)

    w.key("Tab")
    w.resize(1280, 800)
    w.wait_for(lambda s: s["window"] == [1280, 800] and s["sidebar"], 20)
    time.sleep(0.5)
    x0, y0, x1, y1 = w.fresh()["fields"]["flight bar"]
    w.drag(x0 + 6, y1 - 6, x0 + 0.25 * (x1 - x0), y1 - 6)
    w.drag(x1 - 6, y1 - 6, x0 + 0.6 * (x1 - x0), y1 - 6)
    cut = w.fresh()["flight"]
    c.line("in and out points after drags", [cut["in"], cut["out"]], "near 25 % and 60 %",
           abs(cut["in"] / frames - 0.25) < 0.06 and abs(cut["out"] / frames - 0.6) < 0.06)
    w.move(640, 600)
    time.sleep(0.4)
    w.capture(os.path.join(c.out, "flight-cut.png"))
    reset = None
    for _ in range(5):  # frames of a busy machine may miss a short press
        w.click(x0 + 0.25 * (x1 - x0), y1 - 6, times=2)
        reset = w.wait_for(lambda s: s["flight"]["in"] == 0, 2)
        if reset:
            break
    c.line("in point after a double click", w.state()["flight"]["in"], "0", reset is not None)
    press(w, "Undo edit")
    cut = w.fresh()["flight"]
    c.line("and after undo", cut["in"], "not 0", cut["in"] > 0)
    press(w, "Keep only this")
    kept = w.wait_for(lambda s: s["flight"]["frames"] == cut["out"] - cut["in"] + 1, 10)
    c.line("frames after the cut", w.state()["flight"]["frames"], f"{cut['out'] - cut['in'] + 1}", kept is not None)
    press(w, "Undo edit")
    back = w.wait_for(lambda s: s["flight"]["frames"] == frames, 10)
    press(w, "Redo edit")
    again = w.wait_for(lambda s: s["flight"]["frames"] < frames, 10)
    c.line("the cut undone and done again", w.state()["flight"]["frames"], "all frames, then those kept", back is not None and again is not None)
    press(w, "Save path")
    w.wait_for(lambda s: "welkin-path-2.json" in s["message"], 10)
    second = os.path.join(w.shots, "welkin-path-2.json")
    with open(second, encoding="utf-8") as f:
        part = json.load(f)
    c.line("the path that was cut", len(part["frames"]), "frames of the first one, to the bit", part["frames"] == path["frames"][cut["in"]:cut["out"] + 1])

    press(w, "Benchmark")
    w.wait_for(lambda s: s["flight"]["running"] == "benchmark", 20)
    time.sleep(1.5)
    begun = time.time()
    press(w, "Stop")
    ended = w.wait_for(lambda s: s["flight"]["running"] == "", 20)
    took = time.time() - begun
    c.line("a benchmark that is stopped ends, s", took, "within 3; 15 on a busy machine; no file", ended is not None and took < (15 if c.quick else 3)
           and not glob.glob(os.path.join(w.shots, "*-result*.json")))
    for n in (1,) if c.quick else (1, 2):
        only_panel(w, "Flight")
        press(w, "Benchmark")
        w.wait_for(lambda s, n=n: len(s["flight"]["results"]) == n, 200)
    results = (w.fresh() or {})["flight"]["results"]
    wanted = 1 if c.quick else 2
    c.line("benchmarks in the panel", len(results), f"{wanted}, beside the path", len(results) == wanted and all(os.path.dirname(r) == w.shots for r in results))
    good = 0
    for file in results:
        with open(file, encoding="utf-8") as f:
            got = json.load(f)
        good += len(got["frames"]) == len(part["frames"]) and got["nan_pixels"] == 0 and got["holes"] == 0 and not got["stopped"]
    c.line("results with every frame, no NaN, no hole", good, f"{len(results)}", good == wanted)
    only_panel(w, "Results")
    time.sleep(0.7)
    w.capture(os.path.join(c.out, "results.png"))
    foreign = os.path.join(folder, "timings.json")
    w.drop(foreign)
    dropped = w.wait_for(lambda s: len(s["flight"]["results"]) == wanted + 1, 20)
    c.line("results with a dropped one", len(w.state()["flight"]["results"]), f"{wanted + 1}, the last two side by side",
           dropped is not None and [dropped["flight"]["a"], dropped["flight"]["b"]] == [wanted - 1, wanted])
    w.fresh()
    time.sleep(0.7)
    w.capture(os.path.join(c.out, "results-dropped.png"))
    done = subprocess.run([c.welkin, "compare", results[-1], foreign], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    c.line("welkin compare of the two: exit status", done.returncode, "0, with B / A", done.returncode == 0 and "B / A" in done.stdout)
    if shutil.which("ffmpeg") and not c.quick:
        only_panel(w, "Flight")
        press(w, "Video")
        w.wait_for(lambda s: s["message"].startswith("wrote the video"), 200)
        film = os.path.join(w.shots, "welkin-path-2.mp4")
        c.line("a video, bytes", os.path.getsize(film) if os.path.exists(film) else 0, "over 1000", os.path.exists(film) and os.path.getsize(film) > 1000)
    w.key("r")
    w.wait_for(lambda s: s["flight"]["mode"] == "recording", 10)
    w.drop(paths[0])
    said = w.wait_for(lambda s: "has ended" in s["message"], 20)
    c.line("a path dropped while one is recorded", said["flight"]["mode"] if said else "none", "a message, and recording goes on",
           said is not None and said["flight"]["mode"] == "recording")
    w.key("r")
    w.wait_for(lambda s: s["message"].startswith("wrote the path"), 20)
    c.end(w, "recording")
