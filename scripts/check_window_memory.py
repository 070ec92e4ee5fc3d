"""The group "memory" of check_window.py: what the window needed for a larger budget, it gives back."""

import time

MIB = 2**20
SLACK_MIB = 300  # programs of passes and debug views as software translates them, canvases, what heaps keep: 50 to 190 were seen
MIRROR = 1.25  # of a budget in bytes of the process: the CPU's mirror of the tree is a quarter at most
PATIENCE_S = 60  # a renderer ends beside the window, after the picture that it is drawing


def budget_mib(state):
    return max(state["bytes_budget"], state["quality"]["budget_bytes"]) / MIB


def explained_mib(first_mib, first, now):
    """What a window may take that took so much in its first state; less than that and one more renderer of half a gigabyte."""
    return first_mib + MIRROR * max(0, budget_mib(now) - budget_mib(first)) + SLACK_MIB


def given_back(c, name, w, first_mib, first):
    """A line: memory comes down to what the budget of the moment explains."""
    end = time.time() + PATIENCE_S
    while True:
        state = w.fresh()
        if not state:
            return
        memory, limit = w.memory_mib(), explained_mib(first_mib, first, state)
        if (memory < limit and not state["loading"]) or time.time() > end:
            break
    c.line(name, memory, f"below {limit:.0f}: {first_mib:.0f} at the start, {SLACK_MIB}, and a budget of {budget_mib(state):.0f}",
           memory < limit and not state["loading"])


def memory(c):
    """There and back, with a debug view shown: its pass is the last one that the driver was given the tree for."""
    w = c.window("--budget", "64MiB", "--depth", "8", size="960x540")
    first = w.fresh()
    first_mib = w.memory_mib()
    w.open_only("Debug")
    x0, y0, _, y1 = w.field("steps")
    w.until(lambda: w.click(x0 + (y1 - y0) / 2, (y0 + y1) / 2), lambda s: s["debug"]["view"] == "steps")
    w.open_only("Quality")
    for preset in ("high", "as loaded"):
        made = w.state()["made"]
        x0, y0, x1, y1 = w.field(preset)
        w.until(lambda x=(x0 + x1) / 2, y=(y0 + y1) / 2: w.click(x, y), lambda s, n=made: s["loading"] or s["made"] > n)
        w.wait_for(lambda s, n=made: s["made"] > n and not s["loading"])
        if preset == "high":
            state = w.wait_for(lambda s: s["bytes_budget"] >= 1000 * MIB)
            c.line("budget after the preset high, MiB", (state or w.state())["bytes_budget"] / MIB, "1024", state is not None)
            c.line("memory then, MiB", w.memory_mib(), "over 1000", w.memory_mib() > 1000)
    given_back(c, "memory once it is as it was loaded, MiB", w, first_mib, first)
    c.end(w, "memory")
