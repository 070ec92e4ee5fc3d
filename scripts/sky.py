"""What the check of the sky shares: its groups of rays, their files, the error of a ray. Standard library only."""

import csv
import hashlib
import json
import math
import os
import subprocess

REPOSITORY = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
FOLDER = os.path.join(REPOSITORY, "benchmarks", "sky")
TRUTH = os.path.join(REPOSITORY, "tests", "truth", "sky")
WAVELENGTHS = (680, 550, 440)  # nm
ANGLES = ["altitude_m", "sun_zenith_deg", "view_zenith_deg", "relative_azimuth_deg", "max_distance_m"]
RADIANCE = [f"radiance_{w}" for w in WAVELENGTHS]
TRANSMITTANCE = [f"transmittance_{w}" for w in WAVELENGTHS]
STANDARD_ERROR = [f"standard_error_{w}" for w in WAVELENGTHS]
FLOOR = 0.01  # of the brightest ray of the group: an error of what nobody sees beside it counts as a share of this


def groups():
    """The list of benchmarks/sky/groups.json."""
    with open(os.path.join(FOLDER, "groups.json"), encoding="utf-8") as f:
        return json.load(f)["groups"]


def scene_file(scene):
    return os.path.join(FOLDER, scene + ".json")


def truth_file(group):
    return os.path.join(TRUTH, group["name"] + ".csv")


def rays_of(group):
    return read_rows(os.path.join(FOLDER, "rays", group["rays"] + ".csv"))


def read_rows(path):
    with open(path, encoding="utf-8", newline="") as f:
        return list(csv.DictReader(f))


def write_rows(path, rows, columns):
    os.makedirs(os.path.dirname(os.path.abspath(path)), exist_ok=True)
    with open(path + ".new", "w", encoding="utf-8", newline="") as f:
        writer = csv.DictWriter(f, columns, extrasaction="ignore", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    os.replace(path + ".new", path)


def values(row, columns):
    """Three numbers; NaN where the file has none."""
    def number(text):
        try:
            return float(text)
        except (TypeError, ValueError):
            return math.nan
    return [number(row.get(c)) for c in columns]


def physics_hash(scene, rays, orders):
    """SHA-256 of all that the truth of a group depends on, bar the method: the medium, the ground, the rays and the orders."""
    with open(scene_file(scene), encoding="utf-8") as f:
        data = json.load(f)
    data = {"planet": data.get("planet"), "atmosphere": data.get("atmosphere"), "sun": data.get("sun", {}).get("angular_radius_rad"),
            "rays": [[float(r[c]) if r.get(c) else None for c in ANGLES] for r in rays], "orders": orders}
    return hashlib.sha256(json.dumps(data, sort_keys=True).encode()).hexdigest()


def probe(welkin, scene, rays, method, out, orders=None, options=()):
    """Rows that `welkin probe` gives for these rays, or a line of text that says why not."""
    os.makedirs(out, exist_ok=True)
    source, result = os.path.join(out, "rays.csv"), os.path.join(out, "probe.csv")
    write_rows(source, rays, ANGLES)
    if os.path.exists(result):
        os.remove(result)
    command = [welkin, "probe", scene_file(scene) if not scene.endswith(".json") else scene, "--rays", source, "-o", result,
               "--method", method, "--quiet", *(["--orders", str(orders)] if orders else []), *map(str, options)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, cwd=REPOSITORY, check=False,
                              env={**os.environ, "WELKIN_CACHE": ""})  # light kept on disk by an older program would be measured
    except OSError as e:
        return f"{welkin}: {e.strerror}"
    if done.returncode:
        return (done.stderr.strip().splitlines() or [f"exit {done.returncode}"])[-1].replace(REPOSITORY + os.sep, "")
    try:
        rows = read_rows(result)
    except OSError as e:
        return f"no output: {e.strerror}"
    if len(rows) != len(rays):
        return f"{len(rays)} rays given, {len(rows)} answered"
    return rows


def floors(truth, keys):
    """Per ray and wavelength the least radiance that its error is a share of: `FLOOR` of the brightest with the same key."""
    brightest = {}
    for row, key in zip(truth, keys):
        old = brightest.get(key, [0.0] * 3)
        brightest[key] = [max(a, b) for a, b in zip(old, values(row, RADIANCE))]
    return [[FLOOR * b for b in brightest[key]] for key in keys]


def keys_of(group, rays):
    """Segments of one length are a group of their own: a short one is dim beside a long one, and is seen without it."""
    return [r.get("max_distance_m") or "" for r in rays] if group.get("by_length") else [""] * len(rays)


def errors(rows, truth, floor):
    """Per ray and wavelength |L - truth| / max(truth, floor); 0 where both are nothing."""
    out = []
    for row, right, least in zip(rows, truth, floor):
        line = []
        for value, t, f in zip(values(row, RADIANCE), values(right, RADIANCE), least):
            scale = max(t, f)
            difference = abs(value - t)
            line.append(difference / scale if scale > 0 else (0.0 if difference == 0 else math.inf))
        out.append(line)
    return out


def rms(numbers):
    numbers = list(numbers)
    if not numbers or not all(math.isfinite(x) for x in numbers):
        return math.inf
    return math.sqrt(math.fsum(x * x for x in numbers) / len(numbers))
