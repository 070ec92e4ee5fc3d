"""A display of its own (Xvfb) with the window in it: keys, mouse, drops, what it says about itself, and what it looks like."""

import json
import math
import os
import shutil
import struct
import subprocess
import tempfile
import time
import zlib

import numpy as np

TOOLS = ["Xvfb", "xdotool"]
PANELS = {"Camera": "1", "Scene": "2", "Quality": "3", "Exposure": "4", "Time": "5", "Profiler": "6", "Memory": "7", "Left out": "8", "Log": "9",
          "Debug": "0", "Flight": "f", "Results": "b"}  # and their keys
PATIENCE_S = 120  # for what must come: a busy machine only takes longer, and nothing is promised by it


def missing():
    return [tool for tool in TOOLS if not shutil.which(tool)]


class Screen:
    """An X server without a monitor; its picture lies in a file that anybody can read."""

    def __init__(self, width=1280, height=800, more=()):
        self.folder = tempfile.mkdtemp(prefix="welkin-screen-")
        read, write = os.pipe()
        command = ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{width}x{height}x24", "-fbdir", self.folder, "-nolisten", "tcp", *more]
        self.server = subprocess.Popen(command, pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as pipe:
            self.display = ":" + pipe.readline().strip()

    def pixels(self):
        """Height x width x RGB. The file is an X window dump: 25 big-endian words, colours, rows of BGRX."""
        with open(os.path.join(self.folder, "Xvfb_screen0"), "rb") as f:
            data = f.read()
        head = struct.unpack(">25I", data[:100])
        size, width, height, row, colours = head[0], head[4], head[5], head[12], head[19]
        start = size + colours * 12
        rows = np.frombuffer(data, np.uint8, row * height, start).reshape(height, row // 4, 4)
        return rows[:, :width, 2::-1].copy()

    def close(self):
        self.server.terminate()
        self.server.wait()
        shutil.rmtree(self.folder, ignore_errors=True)


def write_png(path, pixels):
    height, width, _ = pixels.shape
    rows = b"".join(b"\0" + pixels[y].tobytes() for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    with open(path, "wb") as f:
        f.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", width, height, 8, 2, 0, 0, 0))
                + chunk(b"IDAT", zlib.compress(rows, 1)) + chunk(b"IEND", b""))


class Window:
    def __init__(self, build, screen, out, *arguments, size="1280x800", wait=True, config=None):
        self.build, self.screen = build, screen
        self.shots = tempfile.mkdtemp(prefix="shots-", dir=out)  # of no other window
        self.state_file = os.path.join(out, "state.json")
        if os.path.exists(self.state_file):
            os.remove(self.state_file)
        self.environment = dict(os.environ, DISPLAY=screen.display, XDG_CONFIG_HOME=config or os.path.join(out, "config"))
        self.log = open(os.path.join(out, "log.txt"), "w", encoding="utf-8")
        command = [os.path.join(build, "welkin"), "view", *arguments, *(["--size", size] if size else []), "--state", self.state_file,
                   "--shots", self.shots]
        self.process = subprocess.Popen(command, env=self.environment, stdout=self.log, stderr=self.log)
        self.id, self.last, self.frame_s = None, None, 0.03
        if wait:
            self.wait_for(lambda s: s["pictures"] > 0)
            self.find()

    def find(self):
        found = self.xdotool("search", "--sync", "--onlyvisible", "--pid", str(self.process.pid), "--name", "Welkin").split()
        self.id = found[-1] if found else None
        if self.id:
            self.xdotool("windowfocus", "--sync", self.id)
        return self.id

    def xdotool(self, *arguments):
        """What it printed; nothing if it waits in vain, as for a window that ended."""
        try:
            return subprocess.run(["xdotool", *arguments], env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                                  timeout=PATIENCE_S).stdout
        except subprocess.TimeoutExpired:
            return ""

    def alive(self):
        return self.process.poll() is None

    def state(self):
        """What the window wrote last (docs/window.md: every half second); None before it did. Keeps the time that a frame takes."""
        try:
            with open(self.state_file, encoding="utf-8") as f:
                state = json.load(f)
        except (OSError, ValueError):
            return None
        if self.last and state["frames"] > self.last["frames"]:
            self.frame_s = (state["seconds"] - self.last["seconds"]) / (state["frames"] - self.last["frames"])
        self.last = state
        return state

    def wait_for(self, holds, timeout=PATIENCE_S):
        """The first state for which it holds, or None."""
        end = time.time() + timeout
        while time.time() < end and self.alive():
            state = self.state()
            if state and holds(state):
                return state
            time.sleep(0.03)
        return None

    def fresh(self):
        """The state as written after now, of a frame that may have begun before."""
        before = (self.state() or {}).get("frames", -1)
        return self.wait_for(lambda s: s["frames"] > before)

    def still(self):
        """The state once the camera is as good as at rest: between two that follow each other it moves by 1e-4 of its altitude at most."""
        state = self.fresh()
        while state:
            after = self.wait_for(lambda s, n=state["frames"]: s["frames"] > n)
            if not after or math.dist(after["view"]["position_m"], state["view"]["position_m"]) < 1e-4 * after["altitude_m"]:
                return after
            state = after
        return None

    def frames(self, count):
        """Waits until about so many frames were drawn: a click or a drag that all lies within one is not seen."""
        self.state()
        time.sleep(max(0.02, 1.5 * count * self.frame_s))

    def until(self, act, holds, tries=5):
        """Acts until it shows: a frame of a busy machine may miss a short press."""
        for _ in range(tries):
            act()
            state = self.wait_for(holds, 5 + 20 * self.frame_s)
            if state:
                return state
        return None

    def field(self, name):
        """x0, y0, x1, y1 of a field of the panels, once it is there."""
        state = self.wait_for(lambda s: name in s["fields"])
        return state["fields"][name] if state else None

    def press(self, name):
        """Clicks a button of the panels; whether it is there."""
        place = self.field(name)
        if place:
            x0, y0, x1, y1 = place
            self.click((x0 + x1) / 2 if x1 - x0 < 200 else x0 + 20, (y0 + y1) / 2)
        return place is not None

    def open_only(self, *names):
        """Of the panels, open these and no others; the state then."""
        state = self.state()
        if state:
            self.key(*(key for name, key in PANELS.items() if (name in names) != (name in state["panels"])))
        state = self.wait_for(lambda s: sorted(s["panels"]) == sorted(names))
        self.frames(3)  # fields have their places then
        return state

    def key(self, *keys):
        if keys:
            self.xdotool("key", "--delay", "60", *keys)

    def hold(self, key, holds):
        """Until it holds; the state then, or None."""
        self.xdotool("keydown", key)
        state = self.wait_for(holds)
        self.xdotool("keyup", key)
        return state

    def move(self, x, y):
        self.xdotool("mousemove", "--window", self.id or "0", str(int(x)), str(int(y)))

    def click(self, x, y, button=1, times=1):
        self.move(x, y)
        self.frames(2)
        pause = f"{min(max(0.03, 1.2 * self.frame_s), 0.09):.3f}"  # frames see each, and two are still a double click (0.4 s)
        self.xdotool(*(["mousedown", str(button), "sleep", pause, "mouseup", str(button), "sleep", pause] * times))

    def drag(self, x0, y0, x1, y1, button=1, steps=4):
        self.move(x0, y0)
        self.frames(2)
        self.xdotool("mousedown", str(button))
        self.frames(3)  # it is seen where it began
        for i in range(1, steps + 1):
            self.move(x0 + (x1 - x0) * i / steps, y0 + (y1 - y0) * i / steps)
            self.frames(1)
        self.frames(2)  # and where it ended
        self.xdotool("mouseup", str(button))
        self.frames(3)

    def drop(self, *files):
        source = [os.path.join(self.build, "tests", "xdnd_source"), self.id or "0", *files]
        return subprocess.run(source, env=self.environment, stderr=subprocess.DEVNULL, check=False).returncode

    def logged(self):
        with open(self.log.name, encoding="utf-8", errors="replace") as f:
            return f.read().splitlines()

    def resize(self, width, height):
        self.xdotool("windowsize", self.id, str(width), str(height))

    def memory_mib(self):
        with open(f"/proc/{self.process.pid}/status", encoding="utf-8") as f:
            return next(int(line.split()[1]) for line in f if line.startswith("VmRSS")) / 1024

    def cpu_s(self):
        """Processor time that it has used: what else the machine does adds little to it."""
        with open(f"/proc/{self.process.pid}/stat", encoding="utf-8") as f:
            words = f.read().rsplit(")", 1)[1].split()
        return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")

    def capture(self, path=None, until=None):
        """The screen's pixels, once `until` holds of them (or after a while)."""
        end = time.time() + PATIENCE_S
        pixels = self.screen.pixels()
        while until and not until(pixels) and time.time() < end and self.alive():
            time.sleep(0.05)
            pixels = self.screen.pixels()
        if path:
            write_png(path, pixels)
        return pixels

    def close(self, timeout=PATIENCE_S):
        """Exit status, or None if it had to be killed."""
        if self.alive() and self.id:
            self.key("ctrl+q")
        return self.ended(timeout)

    def ended(self, timeout=PATIENCE_S):
        try:
            return self.process.wait(timeout)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
            return None
        finally:
            self.log.close()
