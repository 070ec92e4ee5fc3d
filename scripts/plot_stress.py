#!/usr/bin/env python3
"""Draws docs/figures/stress.png from the JSON of `welkin stress --json`: where each integrator stays in bounds and how far it is off.

    scripts/plot_stress.py stress.json -o docs/figures/stress.png
"""
import argparse
import json
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LogNorm

STEP = "optical depth per step"
SHORT = {"optical depth per step behind a jump by a million": "jump by a million", "density, of the Earth's clouds": "density, Earth's clouds",
         "zenith angle of the sun, degrees": "sun's zenith angle, deg", "optical depth of the air, straight up": "optical depth of the air",
         "mean cosine of the air's phase function": "g of the air's phase function", "height of the tangent point, m": "grazing: tangent height, m",
         "place of the camera": "place of the camera (13)", "time of a frame, s": "time of a frame, s"}


def worst(cells):
    """Greatest error of the cells that have one, else None; whether any fails; whether all that fail were predicted."""
    errors = [c["relative_error"] if c["relative_error"] is not None else None for c in cells]
    known = [e for e in errors if e is not None]
    failing = [c for c in cells if not c["ok"]]
    return (max(known) if known else None), bool(failing), all(c["predicted_fail"] for c in failing)


def text_of(value):
    """Short; nothing for what lies between two powers of ten."""
    if value > 0 and abs(math.log10(value) % 1 - 0.5) < 1e-3:
        return ""
    if value <= 0 or 0.01 <= value < 1e4:
        return f"{value:g}"
    return f"$10^{{{round(math.log10(value))}}}$"


def heat(axes, values, rows, names, norm, title):
    """One cell a value and row: colour is the error, a cross fails, a dot was predicted to."""
    grid = np.full((len(rows), len(values)), np.nan)
    for j, row in enumerate(rows):
        for i, v in enumerate(values):
            error, fails, _ = worst(row.get(v, []))
            if error is not None:
                grid[j, i] = max(error, norm.vmin)
            if fails:
                axes.plot(i, j, "x", color="white", ms=5, mew=1.2)
            elif any(c["predicted_fail"] for c in row.get(v, [])):
                axes.plot(i, j, ".", color="white", ms=3)
    image = axes.imshow(grid, norm=norm, cmap="turbo", aspect="auto")
    axes.set_facecolor("0.75")
    axes.set_yticks(range(len(rows)), names)
    decades = [i for i, v in enumerate(values) if abs(math.log10(v) - round(math.log10(v))) < 1e-3]
    axes.set_xticks(decades, [text_of(values[i]) for i in decades])
    axes.set_title(title, loc="left", fontsize=10)
    return image


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("json")
    parser.add_argument("-o", "--output", required=True)
    args = parser.parse_args()
    with open(args.json, encoding="utf-8") as file:
        report = json.load(file)
    cells, default = report["cells"], report["default_integrator"]
    names = list(report["integrators"])
    norm = LogNorm(1e-7, 10)

    strips = {}
    for c in cells:
        if c["integrator"] == default and c["axis"] not in (STEP, "random layers"):
            strips.setdefault((c["group"], c["axis"]), {}).setdefault(c["value"], []).append(c)
    figure, (top, bottom) = plt.subplots(2, 1, figsize=(11, 4.2 + 0.27 * len(strips)), height_ratios=[7, 1.15 * len(strips)], layout="constrained")

    values = sorted({c["value"] for c in cells if c["axis"] == STEP})
    rows = []
    for name in names:
        row = {}
        for c in cells:
            if c["axis"] == STEP and c["integrator"] == name:
                row.setdefault(c["value"], []).append(c)
        rows.append(row)
    image = heat(top, values, rows, names, norm, "Lines of 64 segments by optical depth per step, worst of 6 media.  Cross: fails.  Dot: predicted to fail, did not.")

    height = len(strips)
    for j, ((group, axis), row) in enumerate(strips.items()):
        for i, v in enumerate(sorted(row)):
            error, fails, _ = worst(row[v])
            colour = "0.75" if error is None else image.cmap(norm(min(max(error, norm.vmin), norm.vmax)))
            bottom.add_patch(plt.Rectangle((i - 0.5, j - 0.5), 1, 1, fc=colour, ec="white", lw=0.5))
            dark = error is None or 3e-4 < error < 0.3
            bottom.text(i, j, text_of(v), ha="center", va="center", fontsize=6.5, color="black" if dark else "white")
            if fails:
                bottom.plot(i, j, "x", color="white", ms=9, mew=2)
    bottom.set_xlim(-0.5, max(len(row) for row in strips.values()) - 0.5)
    bottom.set_ylim(height - 0.5, -0.5)
    bottom.set_yticks(range(height), [f"{SHORT.get(axis, axis)} ({group})" for group, axis in strips], fontsize=8)
    bottom.set_xticks([])
    bottom.set_title(f"The default, {default}, on every other axis.  Grey: no truth, bounds kept.", loc="left", fontsize=10)
    for spine in bottom.spines.values():
        spine.set_visible(False)
    figure.colorbar(image, ax=[top, bottom], label="greatest error, of the most that could be shown", fraction=0.03, extend="both")
    figure.savefig(args.output, dpi=110)


if __name__ == "__main__":
    main()
