"""The group "day" of check_window.py: the scene's time runs and stops in the window."""

import glob
import math
import os

SMALL = ["--budget", "64MiB", "--depth", "8"]  # all there soon, for it is waited for


def differs(a, b):
    return float((abs(a.astype(int) - b.astype(int)).max(axis=2) > 24).mean())


def day(c):
    """The sun goes west over clouds that are there, their light follows, and a pause makes it exact; a picture brings its time back."""
    w = c.window(*SMALL, size="960x540")
    w.open_only("Time")
    w.wait_for(lambda s: s["settled"])
    made = w.state()["made"]
    before = w.capture()[:500, :560]
    x0, y0, x1, y1 = w.field("speed")
    w.drag((x0 + x1) / 2, (y0 + y1) / 2, x1 - 12, (y0 + y1) / 2)  # thousands of times as fast
    running = w.until(lambda: w.press("Play"), lambda s: s["playing"])
    c.line("Play: the scene's time runs", running is not None, "runs", running is not None)
    behind = w.wait_for(lambda s: s["light_stale_deg"] > 0)
    c.line("light of clouds behind the sun while it moves, degrees", behind["light_stale_deg"] if behind else "none", "told", behind is not None)
    w.wait_for(lambda s: s["time_s"] > 5400)
    stopped = w.until(lambda: w.press("Pause"), lambda s: not s["playing"])
    c.line("Pause: it stands still", stopped is not None, "stands", stopped is not None)
    exact = w.wait_for(lambda s: s["light_stale_deg"] == 0 and s["settled"])
    c.line("then all light is of the sun as it stands", exact is not None, "0 degrees behind", exact is not None)
    share = differs(before, w.capture(os.path.join(c.out, "day.png"))[:500, :560])
    c.line("share of the picture that the time changed", share, "over 0.05", share > 0.05)
    state = w.fresh()
    c.line("new renderers for it", state["made"] - made, "0", state["made"] == made)
    w.key("F12")
    said = w.wait_for(lambda s: s["message"].startswith("wrote "))
    shots = glob.glob(os.path.join(w.shots, "*.png"))
    then_s = w.fresh()["time_s"]
    w.press("To 0 s")
    w.wait_for(lambda s: s["time_s"] == 0)
    back = said and shots and w.drop(shots[-1]) == 0 and w.wait_for(lambda s: s["time_s"] != 0)
    c.line("a dropped picture brings its time back, s", back["time_s"] if back else "not", f"{then_s:g} to 1e-9",
           back and math.isclose(back["time_s"], then_s, rel_tol=1e-9))
    if not c.quick:
        c.line("longest frame while the sun moves, ms", state["worst_frame_ms"], "at most 100", state["worst_frame_ms"] <= 100)
    c.end(w, "day")
