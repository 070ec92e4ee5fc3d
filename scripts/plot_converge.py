#!/usr/bin/python3
"""plot_converge.py REPORT.json [-o PICTURE.png ...]: error against time and against step, as `welkin converge --json` measured them.

Left: RMSE against the time of a frame, the front of what no other setting beats as a band. Right: RMSE against the step, with the observed
order of each line. Without matplotlib it says so in one line and exits 0: the picture is a by-product.
"""

import argparse
import json
import sys

# Okabe and Ito (2008): colours that people with the common colour deficiencies can tell apart; then markers tell them apart as well.
COLOURS = ["#d55e00", "#e69f00", "#999933", "#009e73", "#56b4e9", "#0072b2", "#cc79a7", "#7b4fd0", "#666666", "#000000"]
MARKERS = "os^vD*Pp<>"


def fail(path, message):
    sys.exit(f"plot_converge: {path}: {message}")


def load(path):
    try:
        with open(path, encoding="utf-8") as f:
            report = json.load(f)
        rows = [{"name": s["name"], "series": s["series"], "step": float(s["step"]), "time_ms": float(s["time_ms"]),
                 "rmse": float(s["error"]["rmse_255"])} for s in report["settings"]]
        if not rows:
            raise ValueError("no settings")
        report["context"]["settings"]["width"], report["truth"]["tolerance"], report["pareto"], report["orders"]
    except (OSError, ValueError, KeyError, TypeError) as e:
        fail(path, f"expected the JSON of welkin converge: {e!r}".replace("\n", " "))
    return report, rows


def lines(rows):
    """{series: its rows, in the order of the report}"""
    out = {}
    for row in rows:
        for name in row["series"]:
            out.setdefault(name, []).append(row)
    return out


def plot(report, rows, outputs):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    plt.rcParams.update({"font.size": 10, "axes.spines.top": False, "axes.spines.right": False, "svg.hashsalt": "welkin"})
    figure, (left, right) = plt.subplots(1, 2, figsize=(12, 6.2), sharey=True)
    figure.subplots_adjust(left=0.065, right=0.985, top=0.87, bottom=0.25, wspace=0.06)
    orders = {o["series"]: o["observed_order"] for o in report["orders"]}
    tolerance = report["truth"]["tolerance"]
    by_name = {row["name"]: row for row in rows}
    front = [by_name[name] for name in report["pareto"] if name in by_name and by_name[name]["rmse"] > 0]
    left.plot([r["time_ms"] for r in front], [r["rmse"] for r in front], color="#c6d2e2", linewidth=10, alpha=0.8, solid_joinstyle="round",
              solid_capstyle="round", zorder=1, label="no setting is faster and nearer")
    for i, (name, points) in enumerate(lines(rows).items()):
        style = {"color": COLOURS[i % len(COLOURS)], "marker": MARKERS[i % len(MARKERS)], "markersize": 6.5, "linewidth": 1.7,
                 "linestyle": "-" if i < len(COLOURS) else "--", "zorder": 3}
        points = [p for p in points if p["rmse"] > 0]
        label = f"{name} (order {orders[name]:.2f})" if name in orders else name
        left.plot([p["time_ms"] for p in points], [p["rmse"] for p in points], label=label, **style)
        if len({p["step"] for p in points}) > 1:
            right.plot([p["step"] for p in points], [p["rmse"] for p in points], **style)
    for axis in (left, right):
        axis.set_xscale("log")
        axis.set_yscale("log")
        for scale in (axis.xaxis, axis.yaxis):
            scale.set_major_locator(LogLocator(subs=(1, 2, 5)))
            scale.set_minor_formatter(NullFormatter())
            scale.set_major_formatter(FuncFormatter(lambda v, _: f"{v:g}"))
        axis.grid(color="#e3e5e8", linewidth=0.7)
        axis.set_axisbelow(True)
    low, high = left.get_ylim()
    if tolerance > low:
        for axis in (left, right):
            axis.axhspan(low, tolerance, color="#eef0f2", zorder=0)
        right.annotate("below the truth's own tolerance", (0.99, tolerance), xycoords=("axes fraction", "data"), xytext=(0, -3),
                       textcoords="offset points", ha="right", va="top", fontsize=8.5, color="#5b636e")
    steps = [r["step"] for r in rows]
    if min(steps) < max(steps):  # guides through the upper left
        x = [min(steps), (min(steps) * max(steps)) ** 0.5]
        for order in (1, 2):
            y = [high * 0.7 * (x[0] / x[1]) ** order, high * 0.7]
            right.plot(x, y, color="#5b636e", linewidth=0.9, linestyle=(0, (2, 4)), zorder=2)
            right.annotate(f"order {order}", (x[0], y[0]), xytext=(0, -4), textcoords="offset points", ha="left", va="top", fontsize=8.5,
                           color="#5b636e")
    left.set_ylim(low, high)
    context = report["context"]
    left.set_xlabel("time of a frame, ms")
    left.set_ylabel("RMSE, 0–255")
    left.set_title("Error against time", loc="left", fontsize=10.5)
    right.set_xlabel("step")
    right.set_title("Error against step", loc="left", fontsize=10.5)
    size = context["settings"]
    figure.suptitle(f"View {context.get('view', '')}, {size['width']}×{size['height']}: what a setting costs and how far it is from the truth",
                    x=0.01, ha="left", fontweight="bold")
    figure.legend(*left.get_legend_handles_labels(), loc="lower left", bbox_to_anchor=(0.05, 0.0), ncols=3, frameon=False, fontsize=9)
    figure.text(0.99, 0.93, f"{context.get('gl_renderer', '')}\n{context.get('time_ms', '')}", ha="right", va="center", fontsize=7.8, color="#555555")
    for output in outputs:
        figure.savefig(output, dpi=150, metadata={"Date": None} if output.endswith(".svg") else None)


def main():
    parser = argparse.ArgumentParser(description="Error against time and against step, from the JSON of welkin converge.")
    parser.add_argument("report")
    parser.add_argument("-o", "--output", nargs="+", default=["converge.png"])
    options = parser.parse_args()
    report, rows = load(options.report)
    try:
        plot(report, rows, options.output)
    except ImportError:
        print("plot_converge: matplotlib is not installed: no plot", file=sys.stderr)
        return
    except OSError as e:
        fail(options.output[0], f"cannot write: {e.strerror}")
    print(" ".join(options.output))


if __name__ == "__main__":
    main()
