#!/usr/bin/python3
"""check_sky.py --build BUILD --out FOLDER [--json FILE] [--only GROUPS] [--methods METHODS] [--quick]: what the clear sky promises.

Each line is value, limit, the best published value, pass or fail; exit 1 if any fails. The truth is tests/truth/sky (make_truth.py), the
rays are benchmarks/sky/rays, the limits stand in benchmarks/sky/groups.json. The error of a ray at a wavelength is |L - truth| over
max(truth, 1 % of the brightest of its group); lines give its root mean square. All lines go to FOLDER/check-sky.json, or to --json,
with the error of every ray and the named cases worst first. --quick: fewer rays and scenes, limits 1.5 times as wide.
"""

import datetime
import json
import math
import os
import statistics
import subprocess
import sys

import checks
import make_truth
import sky
import sky_furnace

METHODS = ["tables-4d", "tables-2d"]
STRANGE = ["g0", "g99", "x100", "zero", "tiny", "pebble"]
QUICK = ["single-twilight", "sky-75-albedo", "sky-85-90-albedo", "sky-92-96-albedo", "space", "segments-85-90"]
QUICK_STRANGE = {"tables-4d": ["zero"], "tables-2d": ["x100", "zero"]}  # what takes no time
QUICK_WIDER = 1.5  # a few rays have a less certain root mean square than all of them
NIGHT = 1e-6  # of the brightest limb or disc by day; the reference finds below 1e-9, all orders, where the sun is at 120 degrees
CREATED = 1e-3  # energy of a furnace over 1
LOST = {"tables-4d": 0.01, "tables-2d": 0.015}  # of it, as the light of limb and disc may err; media that are not promised may lose more
QUADRATURE = 5e-3  # error of the furnace's quadrature beyond which it proves nothing: ten times what it is
COST_RUNS = 5
WALL_S = {"tables-4d": (15, "3 s wanted"), "tables-2d": (0.06, None)}


class Check(checks.Check):
    def __init__(self, options):
        super().__init__(options)
        self.methods = options.methods.split(",")

    def probe(self, method, scene, rays, orders, name):
        """Rows, or None after a failing line."""
        rows = sky.probe(self.welkin, scene, rays, method, os.path.join(self.out, f"{method}-{name}"), orders)
        if isinstance(rows, str):
            self.line(f"{method}: probe of {name} runs", rows, "exit 0", False)
            return None
        return rows

    def picked(self, group):
        """Numbers of the rays that are looked at: all, or the named ones and every third."""
        named = cases()[group["rays"]]
        return [i for i in range(len(sky.rays_of(group))) if not self.quick or i % 3 == 0 or str(i) in named]

    def groups_of(self, method, wanted):
        return [g for g in sky.groups() if method in g["limits"] and g["name"] in wanted]

    def answer(self, method, wanted):
        """Probes all groups of a method, one run of the program for each scene and number of orders: {name: rows or None}."""
        together = {}
        for g in self.groups_of(method, wanted):
            together.setdefault((g["scene"], g["orders"]), []).append(g)
        out = {}
        for (scene, orders), members in together.items():
            rays = [sky.rays_of(g)[i] for g in members for i in self.picked(g)]
            rows = self.probe(method, scene, rays, orders, f"{scene}-{orders or 'all'}")
            for g in members:
                n = len(self.picked(g))
                out[g["name"]] = rows[:n] if rows else None
                rows = rows[n:] if rows else None
        return out


def cases():
    with open(os.path.join(sky.FOLDER, "groups.json"), encoding="utf-8") as f:
        return json.load(f)["cases"]


def truth_of(group, index):
    return sky.read_rows(sky.truth_file(group)) if make_truth.is_current(group, index) else None


def angles(row):
    return [float(row[c]) if row.get(c) else None for c in sky.ANGLES]


def measured(group, picked, rows, truth):
    """The errors of a group as the JSON has them, in percent."""
    floor = sky.floors(truth, sky.keys_of(group, truth))
    errors = sky.errors(rows, [truth[i] for i in picked], [floor[i] for i in picked])
    every = [e for line in errors for e in line]
    named = cases()[group["rays"]]
    worst = sorted(((max(line), i) for line, i in zip(errors, picked) if str(i) in named), reverse=True)
    noise = [s / max(t, f) for i in picked for s, t, f in zip(sky.values(truth[i], sky.STANDARD_ERROR), sky.values(truth[i], sky.RADIANCE), floor[i])
             if max(t, f) > 0] if group["orders"] != 1 else [0.0]
    finite = [[100 * e if math.isfinite(e) else None for e in line] for line in errors]
    return {"rms": 100 * sky.rms(every), "median": 100 * statistics.median(every), "max": 100 * max(every), "rays_looked_at": len(picked),
            "rms_by_wavelength": {str(w): rounded(100 * sky.rms(e[k] for e in errors)) for k, w in enumerate(sky.WAVELENGTHS)},
            "rms_of_truth": rounded(100 * sky.rms(noise)),
            "named_cases": [{"case": named[str(i)], "max": rounded(100 * e)} for e, i in worst],
            "columns": ["altitude_m", "sun_zenith_deg", "view_zenith_deg", "relative_azimuth_deg", "max_distance_m", "error_680", "error_550", "error_440"],
            "rays": [[None if x is None else rounded(x, 7) for x in angles(truth[i]) + line] for i, line in zip(picked, finite)]}


def rounded(x, digits=4):
    return float(f"{x:.{digits}g}") if math.isfinite(x) else None


def check_transmittance(c, method, group, rows, truth):
    picked = c.picked(group)
    differences = [max(abs(a - b) if math.isfinite(a) else math.inf for a, b in zip(sky.values(row, sky.TRANSMITTANCE), sky.values(truth[i], sky.TRANSMITTANCE)))
                   for row, i in zip(rows, picked)]
    named = cases()[group["rays"]]
    c.at_most(f"{method}: transmittance, {group['part']}, largest difference", max(differences), group["limits"][method], published=group["published"][method])
    worst = sorted(((d, i) for d, i in zip(differences, picked) if str(i) in named), reverse=True)
    c.details[method][group["name"]] = {"max_difference": rounded(max(differences)), "rays_looked_at": len(picked),
                                        "named_cases": [{"case": named[str(i)], "difference": rounded(d)} for d, i in worst]}


def check_accuracy(c):
    index = make_truth.load_index()
    for method in c.methods:
        c.details[method] = {}
        wanted = [*QUICK, "transmittance"] if c.quick else [g["name"] for g in sky.groups()]
        answers = c.answer(method, wanted)
        for group in c.groups_of(method, wanted):
            name, wider = f"{method}: {group['quantity']}, {group['part']}", QUICK_WIDER if c.quick else 1
            truth, rows = truth_of(group, index), answers[group["name"]]
            if truth is None or rows is None:
                why = "no probe" if truth else "no truth of these rays: make truth"
                c.line(name, why, f"at most {group['limits'][method]:g}", False, group["published"][method])
                continue
            if group["quantity"] == "transmittance":
                check_transmittance(c, method, group, rows, truth)
                continue
            result = measured(group, c.picked(group), rows, truth)
            c.at_most(f"{name}, rms %", result["rms"], group["limits"][method] * wider, published=group["published"][method])
            if method in group.get("max_percent", {}):
                c.at_most(f"{name}, max %", result["max"], group["max_percent"][method] * wider, published=group["published"][method])
            for key in ("rms", "median", "max"):
                result[key] = rounded(result[key])
            c.details[method][group["name"]] = result


def check_night(c):
    """Where the sun is at 120 degrees the shadow covers the shell."""
    index = make_truth.load_index()
    space = next(g for g in sky.groups() if g["name"] == "space")
    truth = truth_of(space, index)
    rays = sky.rays_of({"rays": "night"})
    for method in c.methods:
        for orders in [1, None]:
            name = f"{method}: night limb, sun at 120 deg, {'single' if orders else 'all orders'}, share of the brightest by day"
            rows = c.probe(method, "field-albedo", rays, orders, f"night-{orders or 'all'}")
            if truth is None or rows is None:
                c.line(name, "no probe" if truth else "no truth of space: make truth", f"at most {NIGHT:g}", False, "+2000 %")
                continue
            day = [max(column) for column in zip(*(sky.values(row, sky.RADIANCE) for row in truth))]
            shares = [max((abs(v) / d if math.isfinite(v) else math.inf) for v, d in zip(sky.values(row, sky.RADIANCE), day)) for row in rows]
            c.at_most(name, max(shares), NIGHT, published="+2000 %")


def scene_of(name):
    with open(sky.scene_file(name), encoding="utf-8") as f:
        return json.load(f)


def check_robust(c):
    for method in c.methods:
        for scene in QUICK_STRANGE[method] if c.quick else STRANGE:
            rays = sky.rays_of({"rays": "robust-tiny" if scene == "tiny" else "robust"})
            for orders in [None] if c.quick else [1, None]:
                rows = c.probe(method, scene, rays, orders, f"robust-{scene}-{orders or 'all'}")
                if rows is None:
                    continue
                numbers = [x for row in rows for x in sky.values(row, sky.RADIANCE) + sky.values(row, sky.TRANSMITTANCE)]
                c.at_most(f"{method}: {scene}, {'single' if orders else 'all orders'}: values not finite or negative, of {len(numbers)}",
                          sum(not (math.isfinite(x) and x >= 0) for x in numbers), 0)
                c.at_most(f"{method}: {scene}, {'single' if orders else 'all orders'}: transmittances over 1",
                          sum(x > 1 for row in rows for x in sky.values(row, sky.TRANSMITTANCE)), 0)
                if scene == "zero":
                    check_empty(c, method, rays, rows, orders)


def check_empty(c, method, rays, rows, orders):
    """Without air the sky is black and the ground is its albedo times the sun's cosine over pi: seen from above, both are known."""
    radius = scene_of("zero")["planet"]["radius_m"]
    worst = 0.0
    for ray, row in zip(rays, rows):
        h, sun, view, azimuth, distance = angles(ray)
        r, d = radius + max(h, 0.0), math.radians
        c_view = math.cos(d(view))
        q = radius**2 - (r * math.sin(d(view))) ** 2
        truth = 0.0
        if h > 0 and c_view < 0 and q > 0:
            t = h * (2 * radius + h) / (-r * c_view + math.sqrt(q))
            if distance is None or distance >= t:
                point = [t * math.sin(d(view)), 0.0, r + t * c_view]
                light = [math.sin(d(sun)) * math.cos(d(azimuth)), 0.0, math.cos(d(sun))]
                truth = 0.3 / math.pi * max(0.0, (point[0] * light[0] + point[2] * light[2]) / radius)
        elif h <= 0 and c_view < 0:
            continue  # on the ground, looking into it: either answer is right
        worst = max(worst, *(abs(x - truth) for x in sky.values(row, sky.RADIANCE)))
    c.at_most(f"{method}: zero, {'single' if orders else 'all orders'}: radiance against the closed form, largest difference", worst, 1e-5)


def check_furnace(c):
    """Nothing absorbs and the ground is white: all that comes in leaves, and no more."""
    for method in c.methods:
        for scene in ["field"] if c.quick else ["field", *STRANGE]:
            data = scene_of("furnace-" + scene)
            found = []
            for fine in [0, 1]:
                design = sky_furnace.rays(data["planet"]["radius_m"], data["atmosphere"]["top_m"], fine)
                rows = c.probe(method, "furnace-" + scene, [ray for ray, _, _ in design], None, f"furnace-{scene}")
                if rows is None:
                    break
                found.append(sky_furnace.energy(design, rows))
            if len(found) < 2:
                continue
            excess = [(fine - 1 - abs(fine - coarse), fine, coarse) for coarse, fine in zip(*found)]
            worst = max(excess, key=lambda e: e[0] if math.isfinite(e[0]) else math.inf)
            c.line(f"{method}: furnace {scene}: energy that leaves, over what comes in", worst[1],
                   f"at most 1 + {CREATED:g} + {abs(worst[1] - worst[2]):.2g} of the quadrature, which is at most {QUADRATURE:g}",
                   worst[0] <= CREATED and abs(worst[1] - worst[2]) <= QUADRATURE, digits=6)
            if scene == "field":
                c.line(f"{method}: furnace {scene}: least energy that leaves, over what comes in", min(found[1]), f"at least 1 - {LOST[method]:g}",
                       min(found[1]) >= 1 - LOST[method], digits=6)
            c.details.setdefault("furnace", {}).setdefault(method, {})[scene] = {"coarse": [rounded(x, 6) for x in found[0]], "fine": [rounded(x, 6) for x in found[1]]}


def check_cost(c):
    """The least of a few runs: what else the machine does only adds."""
    file, found = os.path.join(c.out, "tables.json"), {}
    for _ in range(COST_RUNS):
        try:
            done = subprocess.run([c.welkin, "info", "--tables", "--json", file], capture_output=True, text=True, cwd=sky.REPOSITORY, check=False)
            with open(file, encoding="utf-8") as f:
                data = json.load(f)
        except (OSError, ValueError) as e:
            c.line("cost of the tables: welkin info --tables --json", getattr(e, "strerror", None) or str(e), "exit 0", False)
            break
        if done.returncode:
            c.line("cost of the tables: welkin info --tables --json", (done.stderr.strip().splitlines() or ["exit 1"])[-1], "exit 0", False)
            break
        for row in data.get("tables", []):
            found.setdefault(row["model"], []).append(row)
    c.details["tables"] = [{**rows[0], "wall_s": [rounded(r["wall_s"]) for r in rows]} for rows in found.values()]
    for method in c.methods:
        if method in WALL_S:
            limit, note = WALL_S[method]
            rows = found.get(method)
            name = f"{method}: tables made, s, least of {COST_RUNS}" + (f", {rows[0]['bytes'] / 2**20:.1f} MiB" if rows else "")
            least = min(r["wall_s"] for r in rows) if rows else None
            c.line(name, least if rows else "not measured", f"at most {limit:g}{f'; {note}' if note else ''}", bool(rows) and least <= limit)


GROUPS = {"accuracy": check_accuracy, "night": check_night, "robust": check_robust, "furnace": check_furnace, "cost": check_cost}


def context(c):
    """Date, build, machine and OpenGL as `welkin info --json` names them."""
    file = os.path.join(c.out, "info.json")
    try:
        subprocess.run([c.welkin, "info", "--json", file, "--quiet"], capture_output=True, check=False)
        with open(file, encoding="utf-8") as f:
            data = json.load(f)
    except (OSError, ValueError):
        return {}
    return {"date": datetime.date.today().isoformat(), **{k: data[k] for k in ("version", "build", "cpu", "cpus") if k in data},
            **{"gl_" + k: data.get("gl", {}).get(k) for k in ("renderer", "version")}, "software": data.get("gl", {}).get("software")}


def main():
    options, only = checks.options_of("check-sky", "What the clear sky promises, line by line.", GROUPS, "fewer rays and scenes",
                                      lambda parser: parser.add_argument("--methods", default=",".join(METHODS), help="comma-separated: %(default)s"))
    wanted = only or [g for g in GROUPS if not options.quick or g in ("accuracy", "robust")]
    c = Check(options)
    c.run_groups(GROUPS, wanted)
    report = {"context": context(c), "groups": wanted, "quick": options.quick, "failed": c.failed(), "lines": c.lines, "details": c.details}
    return c.write(options.json, report, compact)


def compact(data, depth=0):
    """JSON with one ray, line or named case a row."""
    if isinstance(data, dict) and depth < 4 and data:
        inner = ",\n".join(" " * (depth + 1) + json.dumps(k) + ": " + compact(v, depth + 1).lstrip() for k, v in data.items())
        return "{\n" + inner + "\n" + " " * depth + "}" + ("\n" if depth == 0 else "")
    if isinstance(data, list) and any(isinstance(x, (dict, list)) for x in data):
        return "[\n" + ",\n".join(" " * (depth + 1) + json.dumps(x, ensure_ascii=False) for x in data) + "\n" + " " * depth + "]"
    return json.dumps(data, ensure_ascii=False)


if __name__ == "__main__":
    sys.exit(main())
