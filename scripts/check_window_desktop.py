"""The group "desktop" of check_window.py: what a desktop does with the window: minimised, maximised, full screen, another size of the monitor,
letters of twice the size. With a real window manager (jwm), on displays of its own."""

import os
import shutil
import subprocess
import time

from window_driver import PATIENCE_S, Screen, Window

SMALL = ["--budget", "64MiB", "--depth", "8"]
MAXIMISE = "F5"  # of the window manager
SETTINGS = f'<?xml version="1.0"?><JWM><FocusModel>click</FocusModel><Key key="{MAXIMISE}">maximize</Key></JWM>'
MODE = ["1024x768", "63.50", "1024", "1072", "1176", "1328", "768", "771", "775", "798"]  # VESA's


class Desktop(Screen):
    def __init__(self, width=1280, height=800, resources=None):
        # Resources stay when xrdb ends. Not for other windows: GLFW 3.3 ends in an assertion where a manager left its marks and is gone.
        super().__init__(width, height, ["-noreset"])
        self.environment = dict(os.environ, DISPLAY=self.display)
        settings = os.path.join(self.folder, "jwmrc")
        with open(settings, "w", encoding="utf-8") as f:
            f.write(SETTINGS)
        if resources:
            subprocess.run(["xrdb", "-nocpp", "-merge", "-"], input=resources, text=True, env=self.environment, check=True)
        self.manager = subprocess.Popen(["jwm", "-f", settings], env=self.environment, stderr=subprocess.DEVNULL)
        end = time.time() + PATIENCE_S
        while "window id" not in self.asked("xprop", "-root", "_NET_SUPPORTING_WM_CHECK") and time.time() < end:
            time.sleep(0.05)

    def asked(self, *command):
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, check=False).stdout

    def close(self):
        self.manager.terminate()
        self.manager.wait()
        super().close()


def drawn(c, w, name, holds, says, picture):
    """A line: the window has that size, with a picture that was drawn since."""
    before = w.state()["pictures"]
    state = w.wait_for(lambda s: holds(s["window"]) and s["pictures"] > before + 1)
    pixels = w.capture(os.path.join(c.out, picture))
    size = (state or w.state())["window"]
    spread = float(pixels[:size[1], :size[0] // 2].std()) if state else 0
    c.line(name, size, f"{says}, and a new picture", state is not None and spread > 10)
    return state


def manners(c, screen):
    w = Window(c.build, screen, c.out, *SMALL, size="640x360")
    asked = [640, 360]
    w.xdotool("windowminimize", "--sync", w.id)
    gone = w.wait_for(lambda s: s["window"] == [0, 0])
    c.line("minimised", gone is not None, "no pixels", gone is not None)
    w.fresh()  # a picture that was being drawn is there
    before, used, begun = w.fresh(), w.cpu_s(), time.time()
    time.sleep(2)
    after, share = w.fresh(), (w.cpu_s() - used) / (time.time() - begun)
    c.line("pictures drawn while it is minimised", after["pictures"] - before["pictures"], "0", after["pictures"] == before["pictures"])
    c.line("share of a processor while it is minimised", share, "below 0.1", share < 0.1)  # 33 looks a second for events; the worker rests
    w.xdotool("windowactivate", "--sync", w.id)
    drawn(c, w, "back from there", lambda size: size == asked, "640x360", "desktop-back.png")

    def large(size):  # but for the manager's frame
        return 1240 <= size[0] <= 1280 and 740 <= size[1] < 800

    w.key(MAXIMISE)
    maximised = drawn(c, w, "maximised", large, "the screen but for its frame", "desktop-maximised.png")
    w.key("F11")
    drawn(c, w, "full screen", lambda size: size == [1280, 800], "1280x800", "desktop-full.png")
    w.key("F11")
    drawn(c, w, "and back", lambda size: maximised and size == maximised["window"], "as it was maximised", "desktop-full-back.png")
    w.key(MAXIMISE)
    drawn(c, w, "no longer maximised", lambda size: size == asked, "640x360", "desktop-normal.png")
    w.key("F11")
    w.wait_for(lambda s: s["window"] == [1280, 800])
    screen.asked("xrandr", "--newmode", *MODE)
    screen.asked("xrandr", "--addmode", "screen", MODE[0])
    screen.asked("xrandr", "--output", "screen", "--mode", MODE[0])
    drawn(c, w, "full screen on a monitor that becomes smaller", lambda size: size == [1024, 768], "1024x768", "desktop-small.png")
    screen.asked("xrandr", "--output", "screen", "--mode", "1280x800")
    w.wait_for(lambda s: s["window"] == [1280, 800], 3)  # it may stay as it is
    w.key("F11")
    drawn(c, w, "back in a window", lambda size: size == asked, "640x360", "desktop-end.png")
    c.end(w, "desktop")


def letters(c, resources, name):
    """A window of 640x400 in units of a monitor of scale 1: its size and the height of a field, both in pixels; a click on a field."""
    screen = Desktop(1400, 900, resources=resources)
    try:
        w = Window(c.build, screen, c.out, *SMALL, size="640x400")
        w.open_only("Quality")
        x0, y0, x1, y1 = w.field("skip empty space")
        off = w.until(lambda: w.click(x0 + (y1 - y0) / 2, (y0 + y1) / 2), lambda s: not s["quality"]["skip_empty"])
        c.line(f"{name}: a click hits the field", off is not None, "skip empty space is off", off is not None)
        w.frames(20)
        w.capture(os.path.join(c.out, f"desktop-{name.replace(' ', '-')}.png"))
        state = w.state()
        picture = [round(n / state["scale"]) for n in state["picture"]]
        c.end(w, name)
        return state["window"], picture, y1 - y0
    finally:
        screen.close()


def desktop(c):
    lacking = [tool for tool in ("jwm", "xrandr", "xrdb", "xprop") if not shutil.which(tool)]
    if lacking:
        print(f"      desktop is left out: {', '.join(lacking)} is missing (Debian: jwm, x11-xserver-utils, x11-utils)")
        return
    screen = Desktop()
    try:
        manners(c, screen)
    finally:
        screen.close()
    size, _, height = letters(c, None, "scale 1")
    large, picture, tall = letters(c, "Xft.dpi: 192\n", "scale 2")
    c.line("scale 2: the window's pixels", large, f"twice {size}", large == [2 * n for n in size])
    near = all(abs(p - n) <= 2 / 0.25 for p, n in zip(picture, large))  # at a quarter of the size a pixel is four
    c.line("scale 2: the picture's pixels at its share of the window", picture, "the window's", near)
    c.line("scale 2: height of a field over that at scale 1", tall / height, "1.9 to 2.1", 1.9 <= tall / height <= 2.1)
