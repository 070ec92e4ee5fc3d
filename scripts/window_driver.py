"""A display of its own (Xvfb) with the window in it: keys, mouse, drops, what it says about itself, and what it looks like."""

import json
import os
import shutil
import struct
import subprocess
import tempfile
import time
import zlib

import numpy as np

TOOLS = ["Xvfb", "xdotool"]


def missing():
    return [tool for tool in TOOLS if not shutil.which(tool)]


class Screen:
    """An X server without a monitor; its picture lies in a file that anybody can read."""

    def __init__(self, width=1280, height=800):
        self.folder = tempfile.mkdtemp(prefix="welkin-screen-")
        read, write = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", f"{width}x{height}x24", "-fbdir", self.folder, "-nolisten", "tcp"],
                                       pass_fds=[write], stderr=subprocess.DEVNULL)
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
        f.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", width, height, 8, 2, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(rows, 6)) + chunk(b"IEND", b""))


class Window:
    def __init__(self, build, screen, out, *arguments, size="1280x800", wait=True, config=None):
        self.build, self.screen, self.shots = build, screen, os.path.join(out, "shots")
        self.state_file = os.path.join(out, "state.json")
        if os.path.exists(self.state_file):
            os.remove(self.state_file)
        os.makedirs(self.shots, exist_ok=True)
        self.environment = dict(os.environ, DISPLAY=screen.display, XDG_CONFIG_HOME=config or os.path.join(out, "config"))
        self.log = open(os.path.join(out, "log.txt"), "w", encoding="utf-8")
        self.process = subprocess.Popen([os.path.join(build, "welkin"), "view", *arguments, *(["--size", size] if size else []), "--state", self.state_file, "--shots", self.shots],
                                        env=self.environment, stdout=self.log, stderr=self.log)
        self.id = None
        if wait:
            self.wait_for(lambda s: s["pictures"] > 0, 60)
            self.find()

    def find(self):
        found = self.xdotool("search", "--sync", "--onlyvisible", "--pid", str(self.process.pid), "--name", "Welkin").split()
        self.id = found[-1] if found else None
        if self.id:
            self.xdotool("windowfocus", "--sync", self.id)
        return self.id

    def xdotool(self, *arguments):
        return subprocess.run(["xdotool", *arguments], env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, timeout=30).stdout

    def alive(self):
        return self.process.poll() is None

    def state(self):
        try:
            with open(self.state_file, encoding="utf-8") as f:
                return json.load(f)
        except (OSError, ValueError):
            return None

    def fresh(self, timeout=20):
        """The state as written after now."""
        before = (self.state() or {}).get("frames", -1)
        return self.wait_for(lambda s: s["frames"] > before, timeout)

    def wait_for(self, holds, timeout):
        end = time.time() + timeout
        while time.time() < end and self.alive():
            state = self.state()
            if state and holds(state):
                return state
            time.sleep(0.05)
        return None

    def key(self, *keys):
        self.xdotool("key", "--delay", "60", *keys)

    def hold(self, key, seconds):
        self.xdotool("keydown", key)
        time.sleep(seconds)
        self.xdotool("keyup", key)

    def move(self, x, y):
        self.xdotool("mousemove", "--window", self.id, str(int(x)), str(int(y)))

    def click(self, x, y, button=1, times=1):
        self.move(x, y)
        time.sleep(0.15)
        self.xdotool(*(["mousedown", str(button), "sleep", "0.07", "mouseup", str(button), "sleep", "0.07"] * times))  # frames see each

    def drag(self, x0, y0, x1, y1, button=1, steps=8):
        self.move(x0, y0)
        time.sleep(0.1)
        self.xdotool("mousedown", str(button))
        time.sleep(0.2)  # a slow frame still sees where it began
        for i in range(1, steps + 1):
            self.move(x0 + (x1 - x0) * i / steps, y0 + (y1 - y0) * i / steps)
            time.sleep(0.06)
        self.xdotool("mouseup", str(button))
        time.sleep(0.2)

    def drop(self, *files):
        return subprocess.run([os.path.join(self.build, "tests", "xdnd_source"), self.id, *files], env=self.environment, stderr=subprocess.DEVNULL, timeout=30).returncode

    def logged(self):
        with open(self.log.name, encoding="utf-8", errors="replace") as f:
            return f.read().splitlines()

    def resize(self, width, height):
        self.xdotool("windowsize", self.id, str(width), str(height))

    def memory_mib(self):
        with open(f"/proc/{self.process.pid}/status", encoding="utf-8") as f:
            return next(int(line.split()[1]) for line in f if line.startswith("VmRSS")) / 1024

    def capture(self, path=None):
        pixels = self.screen.pixels()
        if path:
            write_png(path, pixels)
        return pixels

    def close(self, timeout=60):
        """Exit status, or None if it had to be killed."""
        if self.alive() and self.id:
            self.key("ctrl+q")
        return self.ended(timeout)

    def ended(self, timeout=60):
        try:
            return self.process.wait(timeout)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
            return None
        finally:
            self.log.close()
