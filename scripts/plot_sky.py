#!/usr/bin/python3
"""plot_sky.py [CHECK.json] [-o PICTURE.png ...]: error of the sky against the sun's elevation, beside published methods.

Reads what check_sky.py writes (benchmarks/results/check-sky.json) and benchmarks/sky/published.json. Left: the sky seen from inside,
all orders, albedo 0 and 0.3, by elevation of the sun. Right: the same measure for what else a camera sees. Without matplotlib it says
so in one line and exits 0: the picture is a by-product.
"""

import argparse
import json
import math
import os
import sys

REPOSITORY = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
# Okabe and Ito (2008): colours that people with the common colour deficiencies can tell apart.
OURS = {"tables-4d": ("#0072b2", "o", "Welkin, tables-4d"), "tables-2d": ("#d55e00", "s", "Welkin, tables-2d")}
THEIRS = {"Bruneton 2017, 4 orders": ("#009e73", "D", "Bruneton 2017, 4 orders"),
          "half-float tables of a web port": ("#7fcdaa", "d", "the same, half-float tables of a web port"),
          "Hillaire 2020, 128 steps": ("#777777", "^", "Hillaire 2020, 128 steps"),
          "Hillaire 2020, 4-14 steps": ("#b0b0b0", "v", "Hillaire 2020, 4–14 steps")}
PUBLISHED_ABOUT = {"sky-75": (15, 90), "sky-85-90": (0, 5), "sky-92-96": (-6, -2)}  # elevations, degrees
BINS = [(-6, -4), (-4, -2), (0, 2.5), (2.5, 5), (15, 40), (40, 60), (60, 90)]  # of elevation: what the groups of all orders cover
SIDE = [("limb and\ndisc from\nspace", "space", "limb-75"), ("1–100 km\nof air,\nsun ≥ 15°", "segments-75", None),
        ("1–100 km\nof air,\nsun 0–5°", "segments-85-90", "segments-85-90"), ("medium\n× 10,\nsun ≥ 15°", "x10-75", "sky-75"),
        ("medium\n× 10,\nsun 0–5°", "x10-85-90", "sky-85-90")]


def fail(path, message):
    sys.exit(f"plot_sky: {path}: {message}")


def load(path, what):
    try:
        with open(path, encoding="utf-8") as f:
            data = json.load(f)
    except (OSError, ValueError) as e:
        fail(path, f"expected {what}: {e}")
    if not isinstance(data, dict):
        fail(path, f"expected {what}")
    return data


def rms(numbers):
    return math.sqrt(sum(x * x for x in numbers) / len(numbers))


def sky_rays(details):
    """[(elevation of the sun, three errors in percent)] of the groups of all orders seen from inside."""
    out = []
    for name in ["sky-75", "sky-85-90", "sky-92-96"]:
        for suffix in ["", "-albedo"]:
            for row in details.get(name + suffix, {}).get("rays", []):
                if None not in row[5:]:
                    out.append((90 - row[1], row[5:]))
    return out


def bins(rays):
    """[(low, high, rms)] of every bin with at least four rays."""
    out = []
    for low, high in BINS:
        members = [errors for elevation, errors in rays if low - 1e-6 <= elevation <= high + 1e-6]
        if len(members) >= 4:
            out.append((low, high, rms([x for e in members for x in e])))
    return out


def scale(elevation):
    """Elevations near the horizon get more room, and those below it more still."""
    return math.sqrt(elevation) if elevation >= 0 else -1.7 * math.sqrt(-elevation)


def plot(check, published, outputs):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.ticker import FuncFormatter

    plt.rcParams.update({"font.size": 10, "axes.spines.top": False, "axes.spines.right": False, "svg.hashsalt": "welkin"})
    figure, (left, right) = plt.subplots(1, 2, figsize=(12, 6.2), sharey=True, width_ratios=[3, 2.3])
    figure.subplots_adjust(left=0.075, right=0.99, top=0.88, bottom=0.225, wspace=0.05)
    columns, handles = published["columns"], {label: None for _, _, label in OURS.values()}
    methods = {m["name"]: m for m in published["methods"]}

    for name, (colour, marker, label) in THEIRS.items():
        for column, (low, high) in PUBLISHED_ABOUT.items():
            value = methods[name]["errors"][columns.index(column)][1]
            x = [scale(low), scale(high)]
            handles[label], = left.plot(x, [value] * 2, color=colour, linewidth=2.2, linestyle=(0, (4, 1.5)), marker=marker, markersize=5, label=label)
    for method, (colour, marker, label) in OURS.items():
        rays = sky_rays(check["details"].get(method, {}))
        left.plot([scale(e) for e, _ in rays], [rms(errors) for _, errors in rays], color=colour, marker=".", markersize=4, alpha=0.3, linestyle="none",
                  markeredgewidth=0)
        for piece in pieces(bins(rays)):
            x = [scale((low + high) / 2) for low, high, *_ in piece]
            handles[label], = left.plot(x, [p[2] for p in piece], color=colour, linewidth=2.4, marker=marker, markersize=6.5, label=label, zorder=5)
    ticks = [-6, -4, -2, 0, 2, 5, 15, 30, 60, 90]
    left.set_xticks([scale(t) for t in ticks], [f"{t}°".replace("-", "−") for t in ticks])
    left.axvline(0, color="#555555", linewidth=0.8)
    left.annotate("sun on the horizon", (0, 1), xycoords=("data", "axes fraction"), xytext=(3, -2), textcoords="offset points", va="top", fontsize=8.5,
                  color="#555555", rotation=90)
    left.set_xlabel("elevation of the sun")
    left.set_ylabel("error of the radiance, root mean square, %")
    left.set_title("The sky seen from inside, all orders", loc="left", fontsize=10.5)

    for i, (_, group, column) in enumerate(SIDE):
        shown = []
        for name, (colour, marker, _) in THEIRS.items():
            source = "Hillaire 2020, medium x 10" if group.startswith("x10") and name == "Hillaire 2020, 128 steps" else name
            if group.startswith("x10") and source == name:
                continue
            errors = methods[source]["errors"][columns.index(column)] if column else None
            if errors:
                shown.append((errors[1], colour, marker, 7, {}))
        for method, (colour, marker, _) in OURS.items():
            value = check["details"].get(method, {}).get(group, {}).get("rms")
            if value:
                shown.append((value, colour, marker, 8.5, {"zorder": 5}))
        if shown:
            right.plot([i, i], [min(s[0] for s in shown), max(s[0] for s in shown)], color="#dddddd", linewidth=5, zorder=0, solid_capstyle="round")
        for value, colour, marker, size, more in shown:
            right.plot([i], [value], color=colour, marker=marker, markersize=size, linestyle="none", **more)
    right.set_xticks(range(len(SIDE)), [s[0] for s in SIDE], fontsize=8.5)
    right.set_xlim(-0.5, len(SIDE) - 0.5)
    right.set_title("What else a camera sees", loc="left", fontsize=10.5)

    for axis in (left, right):
        axis.set_yscale("log")
        axis.set_ylim(0.03, 100)
        axis.set_axisbelow(True)
        axis.grid(axis="y", which="major", color="#cccccc", linewidth=0.7)
        axis.grid(axis="y", which="minor", color="#eeeeee", linewidth=0.5)
        axis.yaxis.set_major_formatter(FuncFormatter(lambda v, _: f"{v:g} %"))
        axis.tick_params(axis="y", which="both", length=0)
    figure.suptitle("Error of the sky against the truth", x=0.01, ha="left", fontweight="bold")
    figure.legend(handles=[h for h in handles.values() if h], loc="lower left", bbox_to_anchor=(0.06, 0.0), ncols=3, frameon=False, fontsize=9.5)
    figure.text(0.995, 0.012, "Line: all rays of a bin, at 680, 550 and 440 nm.\nDot: one ray. Published: measured beside an exact\n"
                "solution of the same medium, over the elevations\nthat a line spans; medium × 10: Hillaire 2020.", ha="right", fontsize=7.8, color="#555555")
    for output in outputs:
        figure.savefig(output, dpi=150, metadata={"Date": None} if output.endswith(".svg") else None)


def pieces(points):
    """Neighbouring bins, so that no line crosses a gap."""
    out = []
    for p in points:
        if out and out[-1][-1][1] == p[0]:
            out[-1].append(p)
        else:
            out.append([p])
    return out


def main():
    parser = argparse.ArgumentParser(description="Error of the sky against the sun's elevation, beside published methods.")
    parser.add_argument("check", nargs="?", default=os.path.join(REPOSITORY, "benchmarks/results/check-sky.json"))
    parser.add_argument("-o", "--output", nargs="+", default=["sky-error.png"])
    options = parser.parse_args()
    check = load(options.check, "the lines of check_sky.py")
    if not isinstance(check.get("details"), dict) or not any(m in check["details"] for m in OURS):
        fail(options.check, f"/details: expected {' or '.join(OURS)}")
    published = load(os.path.join(REPOSITORY, "benchmarks/sky/published.json"), "the published errors")
    try:
        plot(check, published, options.output)
    except ImportError:
        print("plot_sky: matplotlib is not installed: no plot", file=sys.stderr)
        return
    except OSError as e:
        fail(options.output[0], f"cannot write: {e.strerror}")
    print(" ".join(options.output))


if __name__ == "__main__":
    main()
