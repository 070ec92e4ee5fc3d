#!/usr/bin/env python3
"""Draws docs/figures/debug-views.png: every debug view of one view of the Earth, each with its legend.

    scripts/plot_debug.py --build build --folder out/debug -o docs/figures/debug-views.png

Pictures and their numbers are left in the folder; --again draws the figure of what is there.
"""
import argparse
import json
import os
import subprocess

import matplotlib

matplotlib.use("Agg")
import matplotlib.image
import matplotlib.pyplot as plt
from globe import REPOSITORY, RADIUS_M, combine, heading_vector, orientation_xyzw, travel, up_at
from matplotlib.colors import LinearSegmentedColormap, LogNorm, Normalize
from matplotlib.patches import Patch

SCENE, VIEW, SIZE = os.path.join(REPOSITORY, "scenes", "earth.json"), "layers", "480x270"
TITLES = {"none": "the picture", "steps": "steps: samples of a ray", "detail": "detail: level of the octree",
          "occupancy": "occupancy: share of the way in cloud", "history": "history: in flight, 50 m a frame",
          "density": "density: greatest extinction, 1/m", "light": "light: share of the sun's that arrives",
          "air": "air: without clouds", "nan": "nan: pixels not a number or negative"}
FRAMES, STEP_M = 12, 50.0


def write_path(path):
    """A flight to the right and forward through the view; its last frames are past the warm-up."""
    with open(SCENE, encoding="utf-8") as f:
        v = json.load(f)["views"][VIEW]
    place = v["latitude_deg"], v["longitude_deg"]
    up, ahead = up_at(*place), heading_vector(*place, v["heading_deg"])
    way = heading_vector(*place, v["heading_deg"] + 60)
    frames = []
    for i in range(FRAMES):
        here, _ = travel(up, way, (i - FRAMES + 1) * STEP_M / RADIUS_M)
        frames.append({"position_m": combine(RADIUS_M + v["altitude_m"], here, 0, here),
                       "orientation_xyzw": orientation_xyzw(up, ahead, v["pitch_deg"]), "fov_deg": v["fov_deg"], "time_s": i / 30})
    with open(path, "w", encoding="utf-8") as f:
        json.dump({"scene": os.path.relpath(SCENE, os.path.dirname(path)), "size": [480, 270], "time_step_s": 1 / 30, "warm_up": 20,
                   "frames": frames}, f)


def draw(welkin, folder):
    os.makedirs(folder, exist_ok=True)
    for view in TITLES:
        picture, report = (os.path.join(folder, f"{view}.{end}") for end in ("png", "json"))
        if view == "history":
            path = os.path.join(folder, "path.json")
            write_path(path)
            subprocess.run([welkin, "fly", path, "--debug", view, "--every", str(FRAMES), "--out", folder, "--json", report, "--quiet"],
                           check=True, stdout=subprocess.DEVNULL)
            os.replace(os.path.join(folder, f"frame-{FRAMES - 1:05d}.png"), picture)
        else:
            subprocess.run([welkin, "render", SCENE, "--view", VIEW, "--size", SIZE, "--debug", view, "-o", picture, "--json", report, "--quiet"],
                           check=True)


def legend(axes, shown):
    if "scale" in shown:
        s = shown["scale"]
        norm = (LogNorm if s["logarithmic"] else Normalize)(s["low"], s["high"])
        colours = LinearSegmentedColormap.from_list("welkin", s["colours"])
        bar = plt.colorbar(matplotlib.cm.ScalarMappable(norm, colours), cax=axes.inset_axes([0.03, 0.65, 0.94, 0.35]), orientation="horizontal")
        if s["logarithmic"] and s["high"] <= 1000 * s["low"]:
            ticks = [s["low"] * 4**i for i in range(5)]
            bar.set_ticks(ticks, labels=[f"{t:g}" for t in ticks])
            bar.ax.minorticks_off()
        elif not shown["unit"]:
            bar.set_ticks([0, 0.25, 0.5, 0.75, 1], labels=["0 %", "25 %", "50 %", "75 %", "100 %"])
        bar.outline.set_visible(False)
        bar.ax.plot([shown["mean"]], [0.5], "o", color="white", markeredgecolor="black", markersize=5, clip_on=False)
        bar.ax.tick_params(labelsize=8, length=2)
        return
    kinds = [(k["name"], k["colour"]) for k in shown.get("kinds", [])]
    if shown["view"] == "nan":
        kinds = [("not a number or negative: none here", "#ff00ff")]
    elif shown["without"]:
        kinds.append(("none on the ray", shown["colour_without"]))
    if kinds:
        axes.legend(handles=[Patch(color=colour, label=name) for name, colour in kinds], loc="upper left", bbox_to_anchor=(0, 1.2),
                    ncol=max(3, (len(kinds) + 1) // 2), fontsize=8, frameon=False, handlelength=1, columnspacing=1.2)


def figure(folder, output):
    plot, grid = plt.subplots(6, 3, figsize=(15, 11.2), height_ratios=[1, 0.2] * 3)
    for i, (view, title) in enumerate(TITLES.items()):
        axes, below = grid[i // 3 * 2][i % 3], grid[i // 3 * 2 + 1][i % 3]
        axes.imshow(matplotlib.image.imread(os.path.join(folder, f"{view}.png")), interpolation="none")
        axes.set_title(title, fontsize=11, loc="left")
        axes.set_axis_off()
        below.set_axis_off()
        if view != "none":
            with open(os.path.join(folder, f"{view}.json"), encoding="utf-8") as f:
                legend(below, json.load(f)["debug"])
    plot.subplots_adjust(left=0.01, right=0.99, top=0.97, bottom=0.0, wspace=0.03, hspace=0.06)
    plot.savefig(output, dpi=90, metadata={"Software": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default="build")
    parser.add_argument("--folder", default="out/debug")
    parser.add_argument("-o", "--output", default="docs/figures/debug-views.png")
    parser.add_argument("--again", action="store_true")
    options = parser.parse_args()
    if not options.again:
        draw(os.path.join(options.build, "welkin"), options.folder)
    figure(options.folder, options.output)


if __name__ == "__main__":
    main()
