#!/usr/bin/python3
"""check_window.py --build BUILD --out FOLDER [--json FILE] [--only GROUPS] [--quick]: what is promised of the window, in a real one on a
display of its own (Xvfb), with synthetic keys, mouse and drops.

Each line is value, limit, pass or fail; exit 1 if any fails, 77 if Xvfb or xdotool are missing. All lines go to FOLDER/check-window.json, or
to --json; pictures of every panel to FOLDER. --quick: a minute or two, without what depends on the machine's speed.
"""

import argparse
import glob
import json
import math
import os
import random
import shutil
import subprocess
import sys
import time

from check_window_recording import recording
from window_driver import Screen, Window, missing, write_png

PANELS = {"Camera": "1", "Scene": "2", "Quality": "3", "Exposure": "4", "Time": "5", "Profiler": "6", "Memory": "7", "Left out": "8", "Log": "9",
          "Debug": "0", "Flight": "f", "Results": "b"}
SMALL = ["--budget", "128MiB", "--depth", "11"]  # a tree that a slow machine has soon
KEYS = ["w", "a", "s", "d", "q", "e", "space", "z", "x", "h", "m", "r", "Tab", "Home", "Escape", "Left", "Up", "F12", "ctrl+z", "ctrl+shift+z",
        "1", "2", "3", "4", "5", "6", "7", "8", "9", "0", "f", "b"]


class Check:
    def __init__(self, options):
        self.build, self.out = os.path.abspath(options.build), os.path.abspath(options.out)
        self.welkin, self.quick = os.path.join(self.build, "welkin"), options.quick
        self.group, self.lines = "", []
        shutil.rmtree(self.out, ignore_errors=True)
        os.makedirs(self.out)
        self.screen = Screen()

    def line(self, name, value, limit, ok):
        self.lines.append({"group": self.group, "name": name, "value": value, "limit": limit, "pass": bool(ok)})
        text = f"{value:.3g}" if isinstance(value, float) else f"{value}"
        print(f"{'pass' if ok else 'FAIL'}  {name}: {text} ({limit})", flush=True)

    def window(self, *arguments, **more):
        return Window(self.build, self.screen, self.out, *arguments, **more)

    def end(self, window, name):
        """What every window must have kept, and a clean end."""
        state = window.fresh() or window.state() or {}
        self.line(f"{name}: messages of the GL", state.get("gl_messages"), "0", state.get("gl_messages") == 0)
        self.line(f"{name}: pixels not a number", state.get("nan_pixels"), "0", state.get("nan_pixels") == 0)
        status = window.close()
        self.line(f"{name}: exit status", status, "0", status == 0)


def differs(a, b):
    return float((abs(a.astype(int) - b.astype(int)).max(axis=2) > 24).mean())


def start(c):
    w = c.window()
    state = w.state() or {}
    first = state.get("first_picture_s", -1)
    c.line("first picture, s", first, "at most 2; 15 on a busy machine" if c.quick else "at most 2", 0 < first <= (15 if c.quick else 2))
    c.line("the window is there", w.id is not None, "found by its title", w.id is not None)
    pixels = w.capture(os.path.join(c.out, "start.png"))
    c.line("spread of the picture's values", float(pixels[:700, :880].std()), "over 10", pixels[:700, :880].std() > 10)
    c.end(w, "start")


def fly(c):
    w = c.window(*SMALL, size="640x360")
    seconds = 2 if c.quick else 5
    before = w.fresh()
    latency = before["latency_frames"]
    w.hold("w", seconds)
    after = w.fresh()
    latency = [b - a for a, b in zip(latency, after["latency_frames"])]
    share = sum(latency[:2]) / max(sum(latency), 1)
    c.line("share of pictures shown within 2 frames of their input", share, "at least 0.98" if not c.quick else "at least 0.5 on a busy machine",
           share >= (0.5 if c.quick else 0.98))
    c.line(f"altitude after {seconds} s forward, looking down 25 degrees, m", after["altitude_m"], f"below {before['altitude_m']:.0f}",
           after["altitude_m"] < 0.99 * before["altitude_m"])
    w.hold("e", seconds)
    up = w.fresh()
    c.line(f"altitude after {seconds} s upwards, m", up["altitude_m"], "higher", up["altitude_m"] > 1.01 * after["altitude_m"])
    turned = w.fresh()
    w.drag(200, 150, 330, 150)
    looked = w.fresh()
    change = math.dist(turned["view"]["orientation_xyzw"], looked["view"]["orientation_xyzw"])
    c.line("turn by a drag of 130 pixels", change, "over 0.05", change > 0.05)
    moved = w.fresh()
    w.drag(200, 250, 260, 260, button=3)
    orbit = w.fresh()
    way = math.dist(moved["view"]["position_m"], orbit["view"]["position_m"])
    c.line("way of an orbit drag, m", way, "over 1000, altitude kept", way > 1000 and abs(orbit["altitude_m"] / moved["altitude_m"] - 1) < 1e-3)
    w.move(200, 150)
    w.xdotool("click", "4")
    c.line("speed after a notch of the wheel", w.fresh()["speed_factor"], "1.25", abs(w.fresh()["speed_factor"] - 1.25) < 1e-9)
    w.key("Home")
    home = w.wait_for(lambda s: math.dist(s["view"]["position_m"], before["view"]["position_m"]) < 1, 60)
    c.line("Home brings one back", home is not None, "to the first view", home is not None)
    state = w.wait_for(lambda s: s["frame_rate"] >= 20, 20)
    rate = (state or w.state())["frame_rate"]
    if not c.quick:
        c.line("frames a second at 640x360", rate, "over 20", rate >= 20)
    c.end(w, "fly")


def panels(c):
    w = c.window(*SMALL)
    w.wait_for(lambda s: s["pictures"] > 20, 30)
    for name, key in PANELS.items():
        for open_panel in (w.fresh() or {}).get("panels", []):
            w.key(PANELS[open_panel])
        w.wait_for(lambda s: not s["panels"], 10)
        time.sleep(0.5)
        before = w.capture()
        w.key(key)
        state = w.wait_for(lambda s, name=name: s["panels"] == [name], 20)
        time.sleep(0.7)
        after = w.capture(os.path.join(c.out, f"panel-{name.lower().replace(' ', '-')}.png"))
        share = differs(before[:, 910:], after[:, 910:])
        c.line(f"panel {name}", share, "opens, over 0.3 % of the bar changes", state is not None and share > 0.003)
    w.key("b", "h")
    c.line("H shows the keys", w.wait_for(lambda s: s["help"], 10) is not None, "shown", w.state()["help"])
    time.sleep(0.5)
    w.capture(os.path.join(c.out, "keys.png"))
    w.key("h", "3")
    fields = (w.wait_for(lambda s: "step" in s["fields"] and not s["help"], 10) or {}).get("fields", {})
    if "step" not in fields:
        c.line("fields of the quality panel", len(fields), "step among them", False)
        return c.end(w, "panels")
    x0, y0, x1, y1 = fields["step"]
    first = w.state()["quality"]["step"]
    w.drag((x0 + x1) / 2, (y0 + y1) / 2, x0 + 0.3 * (x1 - x0), (y0 + y1) / 2)
    dragged = w.fresh()["quality"]["step"]
    c.line("step after a drag", dragged, f"below {first:g}", dragged < first)
    w.key("ctrl+z")
    undone = w.fresh()["quality"]["step"]
    c.line("step after undo", undone, f"{first:g}", undone == first)
    w.key("ctrl+shift+z")
    reset = None
    for _ in range(5):  # frames of a busy machine may miss a short press
        w.click((x0 + x1) / 2 - 60, (y0 + y1) / 2, times=2)
        reset = w.wait_for(lambda s: s["quality"]["step"] == first, 2)
        if reset:
            break
    c.line("step after a double click", w.state()["quality"]["step"], f"{first:g}", reset is not None)
    x0, y0, x1, y1 = fields["skip empty space"]
    w.click(x0 + 9, (y0 + y1) / 2)
    c.line("skip empty space after a click", w.fresh()["quality"]["skip_empty"], "off", not w.state()["quality"]["skip_empty"])
    x0, y0, x1, y1 = fields["step rule"]
    rule = w.state()["quality"]["step_rule"]
    chosen = rule
    for _ in range(3):
        w.click((x0 + x1) / 2 - 60, (y0 + y1) / 2)
        w.fresh()
        w.click((x0 + x1) / 2 - 60, y1 + 14)
        chosen = w.fresh()["quality"]["step_rule"]
        if chosen != rule:
            break
    c.line("step rule after a choice", chosen, f"not {rule}", chosen != rule)
    c.end(w, "panels")


def changes(c):
    """Whatever is changed, the window goes on; a renderer is made beside it."""
    w = c.window(*SMALL)
    w.wait_for(lambda s: s["pictures"] > 20, 60)
    w.key("1", "3")
    made = 0
    presets = ["medium"] if c.quick else ["medium", "high", "ultra", "as loaded"]  # other budgets than the one it began with
    for preset in presets:
        fields = (w.wait_for(lambda s, p=preset: p in s["fields"], 10) or {"fields": {}})["fields"]
        if preset not in fields:
            continue
        x0, y0, x1, y1 = fields[preset]
        before = w.fresh()
        w.click((x0 + x1) / 2, (y0 + y1) / 2)
        began = w.wait_for(lambda s, n=before["made"]: s["loading"] or s["made"] > n, 10)
        during = w.wait_for(lambda s, n=before["made"]: s["made"] > n, 60)
        after = w.wait_for(lambda s: not s["loading"], 60)
        done = began is not None and after is not None and during is not None
        made += done
        if not done:
            print(f"      {preset}: nothing was made")
    c.line(f"renderers made for {len(presets)} presets", made, f"{len(presets)}", made == len(presets))
    if not c.quick:  # once both painters have had the larger budget, as much again each time
        memory = []
        for _ in range(4):
            for preset in ("medium", "as loaded"):
                before = w.fresh()
                x0, y0, x1, y1 = before["fields"][preset]
                w.click((x0 + x1) / 2, (y0 + y1) / 2)
                w.wait_for(lambda s, n=before["made"]: s["made"] > n, 60)
                time.sleep(2.5)  # the old one ends beside the window
            memory.append(w.memory_mib())
        c.line("memory after the fourth change there and back over that after the third", memory[3] / memory[2], "below 1.05", memory[3] < 1.05 * memory[2])
    fields = w.fresh()["fields"]
    for label in ("skip empty space", "reprojection", "skip empty space", "reprojection"):
        x0, y0, _, y1 = fields[label]
        w.click(x0 + 9, (y0 + y1) / 2)
        time.sleep(0.3)
    for label in ("step", "spread", "detail", "budget", "depth"):
        x0, y0, x1, y1 = fields[label]
        w.drag(x0 + 0.5 * (x1 - x0), (y0 + y1) / 2, x0 + 0.4 * (x1 - x0), (y0 + y1) / 2)
        time.sleep(0.5)
    w.wait_for(lambda s: not s["loading"], 60)
    w.resize(1000, 700)
    w.wait_for(lambda s: s["window"] == [1000, 700], 10)
    time.sleep(1)
    state = w.fresh()
    most = 400 if c.quick else 100
    c.line("longest frame while presets, fields and the size are changed, ms", state["worst_frame_ms"], f"at most {most}",
           state["worst_frame_ms"] <= most)
    print("      " + ", ".join(f"{k} {v:.1f}" for k, v in state["worst_frame"].items()))
    c.end(w, "changes")


DEBUG_VIEWS = {"steps": "steps", "level of detail": "detail", "occupancy": "occupancy", "history": "history", "density": "density",
               "light": "light", "air only": "air", "NaN": "nan"}


def fixed_size(w):
    """The picture keeps the size that it has: by itself it grows at rest, and two pictures of one view would differ. The panel Quality is left open."""
    w.key(PANELS["Camera"], PANELS["Quality"])
    for _ in range(5):  # frames of a busy machine may miss a short press
        state = w.wait_for(lambda s: "picture's size by itself" in s["fields"], 20) or w.state()
        if not state["scale_automatic"]:
            return
        x0, y0, _, y1 = state["fields"]["picture's size by itself"]
        w.click(x0 + (y1 - y0) / 2, (y0 + y1) / 2)
        if w.wait_for(lambda s: not s["scale_automatic"], 5):
            return


def debug(c):
    """Each view of the debug panel is chosen with the mouse; then the picture again."""
    w = c.window(*SMALL)
    fixed_size(w)
    w.wait_for(lambda s: s["settled"] and s["pictures"] > 20, 60)
    w.key(PANELS["Quality"], PANELS["Debug"])
    w.wait_for(lambda s: s["panels"] == ["Debug"] and "steps" in s["fields"], 20)

    def choose(label, view):
        for _ in range(5):  # frames of a busy machine may miss a short press
            x0, y0, x1, y1 = (w.fresh() or w.state())["fields"][label]
            w.click(x0 + (y1 - y0) / 2, (y0 + y1) / 2)
            if w.wait_for(lambda s: s["debug"]["view"] == view, 5):
                return w.fresh()
        return w.state()

    w.move(300, 300)
    time.sleep(1)
    picture = w.capture()[:700, :880]
    for label, view in DEBUG_VIEWS.items():
        state = choose(label, view)
        w.move(300, 300)
        time.sleep(0.7)
        share = differs(picture, w.capture(os.path.join(c.out, f"debug-{view}.png"))[:700, :880])
        n = state["debug"]
        c.line(f"debug view {view}: share of the picture that it changes", share, "over 0.01", n["view"] == view and share > 0.01)
        reach = f"{n['minimum']:.3g} to {n['maximum']:.3g}" if n["view"] == view else "none"
        c.line(f"debug view {view}: values", reach, "of some pixels at least", n["view"] == view and n["pixels"] > 0 and n["not_a_number"] == 0)
    choose("picture", "none")
    w.move(300, 300)
    time.sleep(1)
    share = differs(picture, w.capture()[:700, :880])
    c.line("the picture again: share that differs", share, "below 0.01", share < 0.01)
    state = w.fresh()
    if not c.quick:
        c.line("longest frame while views are chosen, ms", state["worst_frame_ms"], "at most 100", state["worst_frame_ms"] <= 100)
    print("      " + ", ".join(f"{k} {v:.1f}" for k, v in state["worst_frame"].items()))
    c.end(w, "debug")


def same_view(a, b):
    def near(p, q):
        return all(abs(x - y) <= 1e-9 * max(math.hypot(*p), 1e-300) for x, y in zip(p, q))
    return near(a["position_m"], b["position_m"]) and near(a["orientation_xyzw"], b["orientation_xyzw"]) and near([a["fov_deg"]], [b["fov_deg"]])


def bad_files(c, shot):
    folder = os.path.join(c.out, "bad")
    os.makedirs(folder, exist_ok=True)

    def made(name, data):
        path = os.path.join(folder, name)
        with open(path, "wb") as f:
            f.write(data)
        return path

    with open(shot, "rb") as f:
        whole = f.read()
    import numpy as np
    foreign = os.path.join(folder, "foreign.png")
    write_png(foreign, np.zeros((8, 8, 3), np.uint8))
    flipped = bytearray(whole)
    flipped[whole.index(b"welkin:view") + 20] ^= 255
    return [made("empty.png", b""), made("half.png", whole[:len(whole) // 2]), made("flipped.png", bytes(flipped)), foreign, folder,
            made("no scene.json", b"[]"), made("broken.json", b'{"planet": {'), made("wrong.json", b'{"planet": {"radius_m": -1}, "views": {}}'),
            made("words.txt", b"not a picture"), os.path.join(folder, "not there.png")]


def drops(c):
    w = c.window(*SMALL, size="640x360")
    w.wait_for(lambda s: s["pictures"] > 20, 60)
    w.key("F12")
    said = w.wait_for(lambda s: s["message"].startswith("wrote "), 30)
    shots = glob.glob(os.path.join(w.shots, "*.png"))
    c.line("F12 writes a picture", len(shots), "1", said is not None and len(shots) == 1)
    if not shots:
        return c.end(w, "drops")
    taken = w.fresh()["view"]
    w.key("F12")
    w.wait_for(lambda s: len(glob.glob(os.path.join(w.shots, "*.png"))) == 2, 30)
    c.line("a second one beside it", len(glob.glob(os.path.join(w.shots, "*.png"))), "2", len(glob.glob(os.path.join(w.shots, "*.png"))) == 2)
    w.hold("e", 1.5)
    away = w.fresh()["view"]
    c.line("flown away", not same_view(taken, away), "another view", not same_view(taken, away))
    dropped = w.drop(shots[0])
    back = w.wait_for(lambda s: same_view(taken, s["view"]) and s["message"].startswith("restored"), 60)
    c.line("a dropped picture brings the camera back", back is not None, "to 1e-9", dropped == 0 and back is not None)
    w.wait_for(lambda s: not s["loading"], 60)  # its notes come with the renderer, and would be shown over what is said of the next file
    files = bad_files(c, shots[0])
    alright = 0
    for file in files:
        before = w.fresh()
        name = os.path.basename(file)
        said = len(w.logged())
        w.drop(file)
        # The log keeps what the window may have shown for less time than there is between two looks.
        after = w.wait_for(lambda s, n=name, b=said: any(n in line and "reading" not in line for line in w.logged()[b:]), 20) and w.fresh()
        kept = after is not None and same_view(before["view"], after["view"])
        alright += kept
        if not kept:
            print(f"      {name}: {(w.state() or {}).get('message')}")
    c.line(f"{len(files)} bad files: a message, and nothing else changes", alright, f"{len(files)}", alright == len(files))
    c.end(w, "drops")


def resizes(c):
    w = c.window(*SMALL, size="640x360")
    times = 12 if c.quick else 50
    dice = random.Random(5)
    for _ in range(times):
        size = [dice.randint(200, 1280), dice.randint(150, 800)]
        w.resize(*size)
        time.sleep(0.1)
    state = w.wait_for(lambda s: s["window"] == size, 20)
    c.line(f"the window after {times} changes of size", state is not None, f"{size[0]}x{size[1]}", state is not None)
    w.resize(1, 1)
    time.sleep(0.5)
    w.xdotool("windowunmap", w.id)
    time.sleep(0.5)
    w.xdotool("windowmap", w.id)
    w.resize(640, 360)
    state = w.wait_for(lambda s: s["window"] == [640, 360], 20)
    c.line("after 1 x 1 pixels and being taken from the screen", state is not None, "640x360", state is not None)
    w.find()
    c.end(w, "resizes")


def closes(c):
    for delay in (0.0, 0.3, 1.2):
        w = c.window(wait=False)
        begun = time.time()
        while not w.find() and time.time() - begun < 20:
            time.sleep(0.05)
        time.sleep(delay)
        begun = time.time()
        status = w.close(60)
        c.line(f"closed {delay} s after it opened: exit status", status, "0", status == 0)
    w = c.window()
    w.hold("w", 0.5)
    begun = time.time()
    status = w.close(60)
    took = time.time() - begun
    c.line("closed while the worker is busy: exit status", status, "0", status == 0)
    c.line("closed while the worker is busy: s", took, "at most 10", took <= 10)
    w = c.window(*SMALL, size="640x360")
    w.key("shift+F12")
    time.sleep(1)
    status = w.close(90)
    c.line("closed while a converged picture is made: exit status", status, "0", status == 0)


def refuses(c):
    def run(name, environment):
        done = subprocess.run([c.welkin, "view", "-q"], env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=60)
        said = done.stderr.strip()
        c.line(name, said or "nothing", "exit 1, one line, a hint at welkin render",
               done.returncode == 1 and len(said.splitlines()) == 1 and "welkin render" in said)

    without = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
    run("no display", without)
    run("no OpenGL 4.5", dict(os.environ, DISPLAY=c.screen.display, MESA_GL_VERSION_OVERRIDE="3.3"))


def places(c):
    """The window comes back where it lay, and onto the screen if that is elsewhere now."""
    config = os.path.join(c.out, "places")
    kept = os.path.join(config, "welkin", "settings.json")

    def settings(change=None):
        if change is not None:
            os.makedirs(os.path.dirname(kept), exist_ok=True)
            with open(kept, "w", encoding="utf-8") as f:
                json.dump({"version": 1, "window": change}, f)
        with open(kept, encoding="utf-8") as f:
            return json.load(f)["window"]

    def opened():
        w = c.window(*SMALL, size=None, config=config)
        text = w.xdotool("getwindowgeometry", "--shell", w.id or "0")
        place = dict(line.split("=") for line in text.split() if "=" in line)
        return w, [int(place.get(k, -1)) for k in ("X", "Y", "WIDTH", "HEIGHT")]

    settings({"width": 640, "height": 360, "position": [5000, -4000]})
    w, place = opened()
    c.line("a window kept beside every monitor: x, y, width, height", place, "640x360 on the screen of 1280x800",
           place[2:] == [640, 360] and 0 <= place[0] <= 640 and 0 <= place[1] <= 440)
    w.xdotool("windowmove", "--sync", w.id, "200", "150")
    w.resize(600, 400)
    w.wait_for(lambda s: s["window"] == [600, 400], 10)
    w.close()
    now = settings()
    c.line("what is kept after it was moved", [*now["position"], now["width"], now["height"]], "[200, 150, 600, 400]",
           now["position"] == [200, 150] and [now["width"], now["height"]] == [600, 400] and not now["maximized"])
    w, place = opened()
    c.line("the next window", place, "there", place == [200, 150, 600, 400])
    w.close()
    manager = subprocess.Popen([os.path.join(c.build, "tests", "maximiser")], env=dict(os.environ, DISPLAY=c.screen.display), stdout=subprocess.PIPE)
    manager.stdout.readline()
    settings(dict(now, maximized=True))
    w, place = opened()
    c.line("a window that was maximised", place, "covers the screen", place == [0, 0, 1280, 800])
    w.close()
    manager.terminate()
    manager.wait()
    again = settings()
    c.line("what is kept of it", [again["maximized"], *again["position"], again["width"], again["height"]], "maximised, and where it lay before",
           again == dict(now, maximized=True))


def converged(c):
    if c.quick:
        return
    w = c.window(*SMALL, size="320x180")
    w.wait_for(lambda s: s["pictures"] > 20, 60)
    w.key("shift+F12")
    said = w.wait_for(lambda s: "converged" in s["message"] and s["message"].startswith("wrote"), 300)
    c.line("Shift F12 writes a converged picture", said is not None, "PNG and EXR", said is not None and len(glob.glob(os.path.join(w.shots, "*.exr"))) == 1)
    c.end(w, "converged")
    shots = [p[:-4] + ".png" for p in glob.glob(os.path.join(w.shots, "*.exr"))]
    if shots:
        again = os.path.join(c.out, "again.png")
        subprocess.run([c.welkin, "render", shots[0], "-o", again, "--quiet"], check=False)
        report = os.path.join(c.out, "compare.json")
        subprocess.run([c.welkin, "compare", shots[0], again, "--json", report], stdout=subprocess.DEVNULL, check=False)
        with open(report, encoding="utf-8") as f:
            got = json.load(f)
        worst = got.get("max_255", got.get("error", {}).get("max_255"))
        c.line("welkin render draws it again: greatest difference, 0-255", worst, "at most 2", worst is not None and worst <= 2)


def monkey(c):
    seconds, seed = (30, 1) if c.quick else (600, 1)
    w = c.window(*SMALL, size="960x600")
    dice = random.Random(seed)
    end = time.time() + seconds
    memory = []
    while time.time() < end and w.alive():
        act = dice.random()
        x, y = dice.randint(0, 959), dice.randint(0, 599)
        if act < 0.45:
            w.key(dice.choice(KEYS))
        elif act < 0.7:
            w.drag(x, y, dice.randint(0, 959), dice.randint(0, 599), button=dice.choice([1, 3]), steps=3)
        elif act < 0.85:
            w.click(x, y, times=dice.choice([1, 2]))
        elif act < 0.95:
            w.move(x, y)
            w.xdotool("click", dice.choice(["4", "5"]))
        else:
            w.resize(dice.randint(100, 1280), dice.randint(100, 800))
        if w.alive():
            memory.append(w.memory_mib())
    w.key("Escape")  # a benchmark that it began
    state = w.wait_for(lambda s: s["flight"]["running"] == "", 30)
    c.line("a flight that it began is stopped by Escape", state is not None, "stopped", state is not None)
    if w.alive():
        memory.append(w.memory_mib())
    c.line(f"alive after {seconds} s of random input (seed {seed})", w.alive(), "alive", w.alive())
    if memory:
        # A second renderer may be there, of a benchmark or of a change, and a second context keeps its programs: a budget each at most.
        limit = 1.2 * memory[len(memory) // 2] + 2 * (w.state() or {}).get("bytes_budget", 0) / 2**20
        c.line("memory in the end, MiB", memory[-1], f"below {limit:.0f}: 1.2 times that in the middle and two budgets", memory[-1] < limit)
    w.capture(os.path.join(c.out, "monkey.png"))
    c.end(w, "monkey")


GROUPS = {f.__name__: f for f in (start, fly, panels, debug, changes, drops, resizes, closes, refuses, recording, places, converged, monkey)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True)
    parser.add_argument("--out", required=True)
    parser.add_argument("--json")
    parser.add_argument("--only", help="groups, by comma: " + ", ".join(GROUPS))
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    only = options.only.split(",") if options.only else list(GROUPS)
    unknown = [g for g in only if g not in GROUPS]
    if unknown:
        parser.error(f"no group {', '.join(unknown)}")
    lacks = missing()
    if lacks:
        print(f"skipped: {', '.join(lacks)} is missing (Debian: xvfb, xdotool)")
        return 77
    c = Check(options)
    try:
        for group in only:
            c.group = group
            GROUPS[group](c)
    finally:
        c.screen.close()
    path = options.json or os.path.join(c.out, "check-window.json")
    with open(path, "w", encoding="utf-8") as f:
        json.dump({"quick": options.quick, "lines": c.lines}, f, indent=1)
        f.write("\n")
    failed = [x["name"] for x in c.lines if not x["pass"]]
    print(f"{len(c.lines) - len(failed)} of {len(c.lines)} hold; {path}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
