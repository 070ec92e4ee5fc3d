#!/usr/bin/python3
"""plot_timings.py TIMINGS.json [-o PICTURE.png]: pass times along a flight, with the altitude on a second axis.

Reads what `welkin fly --json` writes: rows under "frames" with frame, altitude_m and passes {name: {wall_ms, cpu_ms}}.
Without matplotlib it says so in one line and exits 0: the picture is a by-product.
"""

import argparse
import json
import math
import statistics
import sys

# Colours that people with the common colour deficiencies can tell apart (Okabe and Ito 2008), the costliest pass first.
COLOURS = ["#0072b2", "#e69f00", "#009e73", "#d55e00", "#cc79a7", "#56b4e9", "#f0e442", "#999999"]
WINDOW = 9  # frames of the running median: single late frames of a shared machine are not the shape of the curve


def fail(path, message):
    sys.exit(f"plot_timings: {path}: {message}")


def load(path):
    try:
        with open(path, encoding="utf-8") as f:
            data = json.load(f)
    except (OSError, ValueError) as e:
        fail(path, f"expected the timings of a flight: {e}")
    rows = data.get("frames") if isinstance(data, dict) else None
    if not isinstance(rows, list) or not rows:
        fail(path, "/frames: expected a list of at least one row")
    for i, row in enumerate(rows):
        if not isinstance(row, dict) or not isinstance(row.setdefault("passes", {}), dict) or "altitude_m" not in row:
            fail(path, f"/frames/{i}: expected frame, altitude_m and passes")
    return data, rows


def running_median(values, window=WINDOW):
    half = window // 2
    return [statistics.median(values[max(0, i - half):i + half + 1]) for i in range(len(values))]


def series(rows, clock):
    """{pass: [ms of every frame]}, the pass with the largest sum first; what would be the ninth and later become 'others'."""
    names = sorted({name for row in rows for name in row["passes"]})
    times = {n: [float(row["passes"].get(n, {}).get(clock, 0.0)) for row in rows] for n in names}
    order = sorted(names, key=lambda n: -sum(times[n]))
    kept, rest = order[:len(COLOURS) - 1], order[len(COLOURS) - 1:]
    result = {n: times[n] for n in kept}
    if len(rest) == 1:
        result[rest[0]] = times[rest[0]]
    elif rest:
        result["others"] = [sum(times[n][i] for n in rest) for i in range(len(rows))]
    return result


def altitude_label(metres):
    return f"{metres / 1000:,.0f} km" if metres >= 1000 else f"{metres:g} m"


def plot(data, rows, output):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    context = data.get("context", {})
    # CPU milliseconds (all cores added) are what software drawing costs; a GPU has only its own clock.
    clock = "cpu_ms" if context.get("software") else "wall_ms"
    times = series(rows, clock)
    frames = [row.get("frame", i) for i, row in enumerate(rows)]

    plt.rcParams.update({"font.size": 10, "axes.spines.top": False})
    figure, (upper, lower) = plt.subplots(2, 1, figsize=(11, 7.5), sharex=True, height_ratios=[3, 2], layout="constrained")

    smooth = {n: running_median(t) for n, t in times.items()}
    for (name, t), colour in zip(smooth.items(), COLOURS):
        upper.plot(frames, t, color=colour, linewidth=1.6, label=f"{name}  {statistics.median(times[name]):.2f} ms")
    top = max((max(t) for t in smooth.values()), default=1.0)
    upper.set_ylim(0, (top or 1.0) * 1.08)
    upper.set_ylabel("time of a pass, ms")
    upper.grid(axis="y", color="#dddddd", linewidth=0.6)
    upper.legend(title="pass, median", loc="upper left", bbox_to_anchor=(1.13, 1.0), frameon=False)

    lower.stackplot(frames, *smooth.values(), colors=COLOURS, linewidth=0)
    lower.set_ylim(0, None)
    lower.set_xlim(frames[0], frames[-1] if len(frames) > 1 else frames[0] + 1)
    lower.set_ylabel("all passes, ms")
    lower.set_xlabel("frame")
    lower.set_axisbelow(True)
    lower.grid(axis="y", color="#dddddd", linewidth=0.6)

    altitudes = [max(float(row["altitude_m"]), 0.1) for row in rows]
    for axis in (upper, lower):
        second = axis.twinx()
        second.plot(frames, altitudes, color="#444444", linewidth=1.2, linestyle=(0, (4, 3)))
        second.set_yscale("log")
        second.yaxis.set_major_locator(LogLocator(base=10, numticks=12))
        second.yaxis.set_major_formatter(FuncFormatter(lambda v, _: altitude_label(v)))
        second.yaxis.set_minor_formatter(NullFormatter())
        second.set_ylabel("altitude (dashed)", color="#444444")
        second.tick_params(axis="y", colors="#444444")
        if max(altitudes) < 1.05 * min(altitudes):  # a level flight
            middle = math.sqrt(max(altitudes) * min(altitudes))
            second.set_ylim(middle / 2, middle * 2)

    settings = context.get("settings", {})
    size = f"{settings['width']}×{settings['height']}" if "width" in settings and "height" in settings else ""
    what = [str(context.get("gl_renderer", "")), size,
            "CPU time, all cores added" if clock == "cpu_ms" else "wall time", f"running median of {WINDOW} frames"]
    figure.suptitle("Pass times along the flight", x=0.01, ha="left", fontweight="bold")
    upper.set_title(" · ".join(w for w in what if w), loc="left", fontsize=8.5, color="#555555")
    figure.savefig(output, dpi=130)


def main():
    parser = argparse.ArgumentParser(description="Pass times along a flight, from the timings of `welkin fly --json`.")
    parser.add_argument("timings")
    parser.add_argument("-o", "--output", default="passes.png")
    options = parser.parse_args()
    data, rows = load(options.timings)
    try:
        plot(data, rows, options.output)
    except ImportError:
        print("plot_timings: matplotlib is not installed: no plot", file=sys.stderr)
        return
    except OSError as e:
        fail(options.output, f"cannot write: {e.strerror}")
    print(f"{options.output}")


if __name__ == "__main__":
    main()
