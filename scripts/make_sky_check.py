#!/usr/bin/python3
"""Writes what the check of the sky looks at: scenes and rays under benchmarks/sky, and groups.json that says which go together.

The rays are low-discrepancy points (Roberts 2018: powers of the generalised golden ratio) and the named cases in which published
methods are worst. Run it after a change here, then `make truth`; `--check` says whether the files in the repository are what it writes.
"""

import copy
import json
import math

from globe import cross, dot, write_or_check
from make_scenes import ATMOSPHERE, RADIUS_M

TOP_M = ATMOSPHERE["top_m"]
COLUMNS = "altitude_m,sun_zenith_deg,view_zenith_deg,relative_azimuth_deg,max_distance_m"
TINY_M = 100.0  # the least radius that must work
TINY = TINY_M / RADIUS_M  # all lengths of the tiny planet are these times the Earth's


# --- scenes -----------------------------------------------------------------------------------------------------------------------

def scene(name, about, albedo=0.0, change=None, radius_m=RADIUS_M, top_m=TOP_M):
    """A planet and its air under a sun without size, as in the published comparisons."""
    air = copy.deepcopy(ATMOSPHERE)
    air["top_m"] = top_m
    for layer in air["layers"]:
        if change:
            change(layer)
    return {"name": f"{name}: {about}"[:200], "planet": {"radius_m": radius_m, "albedo": [albedo] * 3}, "atmosphere": air,
            "sun": {"irradiance": [1.0, 1.0, 1.0], "angular_radius_rad": 0.0, "latitude_deg": 45.0, "longitude_deg": 0.0}}


def times(factor):
    def change(layer):
        for key in ("scattering_per_m", "absorption_per_m"):
            layer[key] = [float(f"{factor * x:.12g}") for x in layer[key]]
    return change


def with_g(g):
    def change(layer):
        if "g" in layer["phase"]:
            layer["phase"]["g"] = g
    return change


def scaled(layer):
    """The same optical depths on a planet that is smaller by TINY: it has the same sky."""
    times(1 / TINY)(layer)
    for key in ("scale_height_m", "peak_m", "half_width_m"):
        if key in layer["profile"]:
            layer["profile"][key] *= TINY


def conservative(layer):
    layer["absorption_per_m"] = [0.0] * 3


def both(*changes):
    def change(layer):
        for c in changes:
            c(layer)
    return change


def scenes():
    strange = {"g0": ("g = 0", with_g(0.0), {}), "g99": ("g = 0.99", with_g(0.99), {}), "x100": ("medium times 100", times(100), {}),
               "zero": ("all coefficients zero", times(0), {}),
               "tiny": ("radius 0.1 km and all lengths with it", scaled, {"radius_m": TINY_M, "top_m": TOP_M * TINY}),
               "pebble": ("radius 0.1 km under the Earth's air", None, {"radius_m": TINY_M})}
    out = {"field": scene("field", "the medium of the published comparisons, black ground"),
           "field-albedo": scene("field-albedo", "the same, ground albedo 0.3", 0.3),
           "field-x10": scene("field-x10", "the same times 10, black ground", change=times(10)),
           "furnace-field": scene("furnace-field", "nothing absorbs", 1.0, conservative)}
    for name, (about, change, size) in strange.items():
        out[name] = scene(name, f"{about}, ground albedo 0.3", 0.3, change, **size)
        out["furnace-" + name] = scene("furnace-" + name, f"{about}, nothing absorbs", 1.0,
                                       both(change, conservative) if change else conservative, **size)
    return out


# --- rays -------------------------------------------------------------------------------------------------------------------------

def points(count, dimensions):
    """Roberts' sequence: point i is (1/2 + i a^-1, 1/2 + i a^-2, ...) modulo 1, where a^(d+1) = a + 1."""
    a = 2.0
    for _ in range(64):
        a = (1 + a) ** (1 / (dimensions + 1))
    return [[(0.5 + (i + 1) * a ** -(j + 1)) % 1.0 for j in range(dimensions)] for i in range(count)]


def between(u, low, high):
    return low + (high - low) * u


def ray(altitude_m, sun, view, azimuth, distance_m=None, case=None):
    return {"ray": [altitude_m, sun, view, azimuth, distance_m], "case": case}


def angle_deg(a, b):
    c = cross(a, b)
    return math.degrees(math.atan2(math.sqrt(dot(c, c)), dot(a, b)))


def from_outside(observer_m, at_m, view_there, sun_there, azimuth_there, case=None, radius_m=RADIUS_M):
    """The ray of an observer above, given where it is lowest or meets the ground: altitude, view, sun and azimuth there."""
    rp, ro = radius_m + at_m, radius_m + observer_m
    v, x, f = math.radians(view_there), math.radians(sun_there), math.radians(azimuth_there)
    look = [math.sin(v), 0.0, math.cos(v)]
    sun = [math.sin(x) * math.cos(f), math.sin(x) * math.sin(f), math.cos(x)]
    b = -rp * look[2]  # observer = point - d * look
    d = -b + math.sqrt((ro - rp) * (ro + rp) + b * b)
    up = [(p - d * l) / ro for p, l in zip([0.0, 0.0, rp], look)]
    flat_look = [l - dot(look, up) * u for l, u in zip(look, up)]
    flat_sun = [s - dot(sun, up) * u for s, u in zip(sun, up)]
    both_flat = math.sqrt(dot(flat_look, flat_look) * dot(flat_sun, flat_sun))
    azimuth = angle_deg(flat_look, flat_sun) if both_flat > 1e-12 else 0.0
    return ray(observer_m, angle_deg(up, sun), angle_deg(up, look), azimuth, case=case)


def to_ground_m(altitude_m, view):
    """Distance to the ground, None past the horizon."""
    r, c = RADIUS_M + altitude_m, math.cos(math.radians(view))
    q = RADIUS_M**2 - r * r * (1 - c * c)
    return -r * c - math.sqrt(q) if q >= 0 and c < 0 else None


def sky(count, low, high):
    """Looks in all directions from 0 to 60 km, most from below 8 km; those from below 1 km look up."""
    out = []
    for a, b, c, d in points(count, 4):
        altitude = 60e3 * d**3
        if b < 0.25 and altitude >= 1e3:
            view = 90 + 90 * (b / 0.25) ** 2
        else:
            view = 90 * math.sqrt((b - 0.25) / 0.75 if b >= 0.25 else b / 0.25)
        out.append(ray(round(altitude), between(a, low, high), view, 180 * c))
    return out


def named_sky(suns):
    """The named cases, at sun zenith angles of the group's range, one each in turn."""
    cases, n = [], len(suns)

    def add(altitude_m, view, azimuth, case, sun=None):
        cases.append(ray(altitude_m, suns[len(cases) % n] if sun is None else sun, view, azimuth, case=case))
    add(1, 89.5, 0, "view 89.5 deg from 1 m, towards the sun")
    add(0, 89.5, 60, "view 89.5 deg from 0 m")
    add(1, 91, 30, "view 91 deg from 1 m")
    add(0, 91, 150, "view 91 deg from 0 m")
    add(5e3, 91, 20, "view 91 deg from 5 km")
    add(1, 89.5, 180, "view 89.5 deg from 1 m, away from the sun")
    add(-10, 60, 45, "camera 10 m below the ground")
    add(TOP_M, 97, 0, "from the very top, to the limb below the sun")
    add(TOP_M, 120, 90, "from the very top, down")
    sun = suns[0]
    height = 1 if sun <= 90 else 60e3
    add(height, sun, 0, "view along the sun", sun)
    add(20e3, 180 - sun, 180, "view against the sun", sun)
    add(0, 0, 0, "zenith from 0 m")
    if 90 in suns:
        add(0, 85, 0, "sun at 90 deg, from 0 m", 90)
        add(1, 89.5, 0, "sun at 90 deg, view 89.5 deg, from 1 m", 90)
        add(10e3, 91, 0, "sun at 90 deg, view 91 deg, from 10 km", 90)
        add(1, 70, 180, "sun at 90 deg behind, from 1 m", 90)
    return cases


def space(count):
    """Half at the limb, half at the disc, the sun at most 90 degrees from the zenith of the lowest point."""
    observers = [TOP_M, 400e3, 2000e3, 36000e3]
    out = [from_outside(400e3, 100, 90, 45, 60, "limb with tangent height 0.1 km, from 400 km"),
           from_outside(TOP_M, 100, 90, 80, 10, "limb with tangent height 0.1 km, from the top, sun at 80 deg there"),
           from_outside(36000e3, 100, 90, 90, 90, "limb with tangent height 0.1 km, from 36000 km, sun at 90 deg there"),
           from_outside(400e3, 10e3, 90, 90, 0, "limb at 10 km against the sun that sets there"),
           from_outside(400e3, 30e3, 90, 20, 180, "limb at 30 km"),
           from_outside(2000e3, 0, 180, 0, 0, "straight down, sun behind the camera"),
           from_outside(400e3, 0, 120, 60, 180, "view against the sun"),
           from_outside(400e3, 0, 91, 70, 20, "ground 1 degree below its horizon"),
           from_outside(36000e3, 0, 150, 90, 45, "disc at the terminator")]
    assert len(out) < count
    for i, (a, b, c, d) in enumerate(points(count - len(out), 4)):
        observer = observers[int(4 * d)]
        if i % 2:
            out.append(from_outside(observer, 100 * 800 ** (a * 0.999), 90, 90 * b, 180 * c))
        else:
            out.append(from_outside(observer, 0, 180 - 88.5 * math.sqrt(a), 90 * b, 180 * c))
    return out


def segments(count, low, high):
    """1 to 100 km of air from 0 to 20 km altitude, most looks near the horizon, none down to the ground."""
    lengths = [1e3, 3e3, 10e3, 30e3, 100e3]
    out = [ray(1, (low + high) / 2, 89.5, 10, 10e3, "10 km at 89.5 deg from 1 m"), ray(0, high, 89.5, 90, 30e3, "30 km at 89.5 deg from 0 m"),
           ray(1, high, 89.99, 0, 1e3, "1 km at the horizon, towards the sun"), ray(1000, low, 90.5, 180, 100e3, "100 km past the horizon, away from the sun"),
           ray(-10, high, 85, 30, 3e3, "from 10 m below the ground")]
    i = 0
    for a, b, c, d in points(8 * count, 4):
        if len(out) == count:
            break
        altitude, distance = round(20e3 * d**2), lengths[i % 5]
        view = 90 + math.copysign(90 * abs(2 * b - 1) ** 3, 2 * b - 1)
        ground = to_ground_m(altitude, view)
        if ground is None or ground > 1.05 * distance:
            out.append(ray(altitude, between(a, low, high), view, 180 * c, distance))
            i += 1
    assert len(out) == count
    return out


def transmittance(count):
    """Whole rays and segments of 0.1 to 1000 km from every altitude in every direction."""
    out = [ray(0, 30, 89.5, 0, case="89.5 deg from 0 m"), ray(1, 30, 89.5, 0, case="89.5 deg from 1 m"), ray(1, 30, 90, 0, case="horizontal from 1 m"),
           ray(1, 30, 91, 0, case="91 deg from 1 m"), ray(0, 30, 0, 0, case="zenith from 0 m"), ray(TOP_M, 30, 180, 0, case="down from the very top"),
           ray(TOP_M, 30, 85, 0, case="up from the very top"), ray(-10, 30, 45, 0, case="camera 10 m below the ground"),
           from_outside(TOP_M, 100, 90, 30, 0, "limb with tangent height 0.1 km, from the top"),
           from_outside(400e3, 100, 90, 30, 0, "limb with tangent height 0.1 km, from 400 km"),
           from_outside(400e3, 25e3, 90, 30, 0, "limb at 25 km"), ray(30e3, 30, 94, 0, 1000e3, "1000 km through the limb")]
    for a, b, c, d in points(count - len(out), 4):
        view = 90 + math.copysign(90 * abs(2 * b - 1) ** 2, 2 * b - 1)
        out.append(ray(round(TOP_M * a**2), 30, view, 0, None if d < 0.4 else round(100 * 10 ** (4 * c))))
    return out


def night(count):
    """Limb and air where the sun is at 120 degrees: below the edge of the shadow, 984 km up, there is only shadow."""
    out = [from_outside(400e3, 100, 90, 120, 0, "night limb, tangent height 0.1 km"), from_outside(400e3, 20e3, 90, 120, 0, "night limb, towards the sun"),
           from_outside(TOP_M, 60e3, 90, 120, 90, "night limb from the top"), from_outside(36000e3, 10e3, 90, 120, 180, "night limb, away from the sun"),
           ray(0, 120, 0, 0, case="midnight zenith"), ray(1, 120, 89.5, 0, case="midnight horizon"), from_outside(2000e3, 0, 150, 120, 90, "night disc")]
    for i, (a, b, c, d) in enumerate(points(count - len(out), 4)):
        if i % 3:
            out.append(from_outside([TOP_M, 400e3, 2000e3, 36000e3][int(4 * d)], 100 * 800 ** (a * 0.999), 90, 120, 180 * c))
        else:
            out.append(ray(round(60e3 * d**3), 120, 180 * b, 180 * c))
    return out


def robust(count):
    """Everything at once, for what must be finite and not negative."""
    out = named_sky([30, 89, 90, 95]) + space(13)[:9] + night(8)[:4] + segments(6, 10, 89)[:5]
    out += [ray(TOP_M, 30, 60, 0, case="up from the very top: nothing there"), ray(500e3, 30, 20, 0, case="from space, past the planet"),
            ray(0, 0, 180, 0, case="down from 0 m"), ray(0, 180, 0, 0, case="sun straight below"), ray(1e-3, 90, 90, 0, case="all at the horizon"),
            ray(50e3, 90, 97.16, 0, case="near the horizon from 50 km")]
    for a, b, c, d in points(count - len(out), 4):
        out.append(ray(round(120e3 * d**2), 180 * a, 180 * b, 180 * c, None if c < 0.7 else 10 ** (6 * d)))
    return out


def shrunk(rays):
    return [{"ray": [r["ray"][0] * TINY, *r["ray"][1:4], r["ray"][4] * TINY if r["ray"][4] is not None else None], "case": r["case"]} for r in rays]


def ray_files():
    out = {"transmittance": transmittance(200),
           "single-day": named_sky([30, 60, 85, 90]) + sky(288, 0, 90),
           "single-twilight": named_sky([92, 94, 96]) + sky(188, 92, 96),
           "sky-75": named_sky([30, 55, 74]) + sky(52, 0, 75),
           "sky-85-90": named_sky([88, 86, 90]) + sky(48, 85, 90),
           "sky-92-96": named_sky([92, 94, 96]) + sky(52, 92, 96),
           "space": space(64), "space-single": space(200),
           "segments-75": segments(60, 0, 75), "segments-85-90": segments(60, 85, 90),
           "night": night(40), "robust": robust(120)}
    out["robust-tiny"] = shrunk(out["robust"])
    out["sky-75-tiny"] = shrunk(out["sky-75"])
    return out


# --- groups: which rays with which scene, and the limits ---------------------------------------------------------------------------

def group(name, quantity, part, rays, scene_name, orders=None, **more):
    """`limits`: rms in percent by method; `max_percent`: the same for the worst ray and wavelength; `published`: the best of its kind, percent.
    `truth_percent`: what the truth's standard error must be a fifth of, the least limit."""
    return {"name": name, "quantity": quantity, "part": part, "rays": rays, "scene": scene_name, "orders": orders, **more}


def groups():
    def of(best, fast):
        return {"tables-4d": best, "tables-2d": fast}
    sky_rows = [("75", "sun up to 75 deg", of(1, 3.3), of("2.3", "2.4")), ("85-90", "sun at 85-90 deg", of(1, 4), of("1.6", "5.8")),
                ("92-96", "sun at 92-96 deg", of(4, 15), of("6.5", "29"))]
    out = [group("transmittance", "transmittance", "any altitude, zenith, segment", "transmittance", "field", 1,
                 limits={"tables-4d": 5e-4}, published={"tables-4d": "3e-3"}),
           group("single-day", "single scattering", "sun up to 90 deg", "single-day", "field", 1, limits={"tables-4d": 0.3},
                 max_percent={"tables-4d": 2}, published={"tables-4d": "1.2-3, max 13-22"}),
           group("single-twilight", "single scattering", "sun at 92-96 deg", "single-twilight", "field", 1, limits={"tables-4d": 1.5},
                 published={"tables-4d": "6.5-8"})]
    for suffix, scene_name, about in [("", "field", "albedo 0"), ("-albedo", "field-albedo", "albedo 0.3")]:
        for key, part, limits, published in sky_rows:
            out.append(group(f"sky-{key}{suffix}", f"sky, {about}", part, f"sky-{key}", scene_name, limits=limits, published=published))
    out += [group("space-single", "limb and disc from space, single", "sun up to 90 deg", "space-single", "field", 1, limits={"tables-4d": 1},
                  published={"tables-4d": "1.4-2.4"}),
            group("space", "limb and disc from space, albedo 0.3", "sun up to 90 deg", "space", "field-albedo",
                  limits=of(1, 1.5), published=of("1.4-2.4", "2.4"))]
    for orders, suffix, scene_name, about in [(1, "-single", "field", "single"), (None, "", "field-albedo", "albedo 0.3")]:
        for key, part, limits, published in [("75", "sun up to 75 deg", of(1, 3), "2.8"), ("85-90", "sun at 85-90 deg", of(3, 6), "12")]:
            limits = {"tables-4d": limits["tables-4d"]} if orders else limits
            out.append(group(f"segments-{key}{suffix}", f"segments of 1-100 km, {about}", part, f"segments-{key}", scene_name, orders,
                             limits=limits, published=of(published, published), by_length=True))
    out += [group("x10-75", "medium x 10, albedo 0", "sun up to 75 deg", "sky-75", "field-x10", limits=of(5, 8), published=of("16", "16")),
            group("x10-85-90", "medium x 10, albedo 0", "sun at 85-90 deg", "sky-85-90", "field-x10",
                  limits=of(5, 17), published=of("34", "34"))]
    for g in out:
        if g["orders"] != 1:
            g["truth_percent"] = min(g["limits"].values())
    return out


def csv_text(rays):
    def cell(x):
        return "" if x is None else "0" if abs(x) < 1e-10 else f"{x:.12g}"
    return "\n".join([COLUMNS, *(",".join(map(cell, r["ray"])) for r in rays)]) + "\n"


def files():
    rays = ray_files()
    out = {f"benchmarks/sky/{name}.json": json.dumps(content, indent=2) + "\n" for name, content in scenes().items()}
    out |= {f"benchmarks/sky/rays/{name}.csv": csv_text(rows) for name, rows in rays.items()}
    cases = {name: {str(i): r["case"] for i, r in enumerate(rows) if r["case"]} for name, rows in rays.items()}
    out["benchmarks/sky/groups.json"] = json.dumps({"groups": groups(), "cases": cases}, indent=1) + "\n"
    return out


if __name__ == "__main__":
    write_or_check(files())
