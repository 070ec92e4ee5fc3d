#!/usr/bin/python3
"""make_truth.py --build BUILD [--only GROUPS] [--threads N] [--force]: the truth of the sky, tests/truth/sky/*.csv.

Each group of benchmarks/sky/groups.json is answered by `welkin probe --method reference`: single scattering by quadrature, all orders
by path tracing until the standard error of every ray is a fifth of the least limit that the group is held to. truth.json remembers of
what (SHA-256 of scene, rays, orders, version of the method) and what came out (SHA-256 of the file); what has not changed is not redone.
"""

import argparse
import datetime
import hashlib
import json
import math
import os
import subprocess
import sys
import tempfile
import time

import sky

METHOD_VERSION = 1  # raise it when the reference's answers change on purpose
SHARE = 1 / 5  # standard error over limit
FIRST_PATHS = 9216  # the least that the reference takes
LEAST_RELATIVE_ERROR = 1e-4  # so that the number of paths decides
INDEX = os.path.join(sky.TRUTH, "truth.json")


def load_index():
    try:
        with open(INDEX, encoding="utf-8") as f:
            return json.load(f)
    except OSError:
        return {"files": {}}


def file_hash(path):
    with open(path, "rb") as f:
        return hashlib.sha256(f.read()).hexdigest()


def origin(group):
    """What the truth of a group was made of."""
    return {"method_version": METHOD_VERSION, "physics": sky.physics_hash(group["scene"], sky.rays_of(group), group["orders"]),
            **({"standard_error_percent": group["truth_percent"] * SHARE} if "truth_percent" in group else {})}


def is_current(group, index):
    entry, path = index["files"].get(group["name"]), sky.truth_file(group)
    return bool(entry) and entry["origin"] == origin(group) and os.path.exists(path) and file_hash(path) == entry["content"]


def allowed(group, rows):
    """Standard errors that are small enough, per ray and wavelength."""
    floor = sky.floors(rows, sky.keys_of(group, rows))
    return [[group["truth_percent"] / 100 * SHARE * max(value, least) for value, least in zip(sky.values(row, sky.RADIANCE), f)]
            for row, f in zip(rows, floor)]


def reference(welkin, group, rays, out, options):
    rows = sky.probe(welkin, group["scene"], rays, "reference", out, group["orders"], options)
    if isinstance(rows, str):
        raise RuntimeError(rows)
    return rows


def all_orders(welkin, group, rays, out, threads, seed=1):
    """A few paths for each ray say what matters; each ray then gets as many as it needs, and more if that was not enough.

    Paths and not a relative error are asked for: the reference keeps that at each wavelength, also where one is too dim to matter.
    """
    def trace(which, count):
        options = ["--relative-error", LEAST_RELATIVE_ERROR, "--max-paths", count, "--seed", seed, *threads]
        return dict(zip(which, reference(welkin, group, [rays[i] for i in which], out, options)))

    everything = range(len(rays))
    paths = {i: FIRST_PATHS for i in everything}
    rows = trace(list(everything), FIRST_PATHS)
    for _ in range(8):
        limits = allowed(group, [rows[i] for i in everything])
        levels = {}
        for i in everything:
            excess = max((e / limit for limit, e in zip(limits[i], sky.values(rows[i], sky.STANDARD_ERROR)) if limit > 0), default=0.0)
            if excess > 1:
                # Rays of similar need go together: a level is a power of the root of 2.
                paths[i] = int(2 ** (math.ceil(2 * math.log2(paths[i] * max(1.1 * excess**2, 1.3))) / 2))
                levels.setdefault(paths[i], []).append(i)
        if not levels:
            return [rows[i] for i in everything]
        for count, which in sorted(levels.items()):
            rows |= trace(which, count)
    raise RuntimeError(f"{sum(map(len, levels.values()))} rays do not reach their standard error")


def commit():
    done = subprocess.run(["git", "rev-parse", "--short", "HEAD"], capture_output=True, text=True, cwd=sky.REPOSITORY, check=False)
    return done.stdout.strip()


def make(welkin, group, threads):
    rays, begin = sky.rays_of(group), time.time()
    with tempfile.TemporaryDirectory() as out:
        rows = reference(welkin, group, rays, out, threads) if group["orders"] == 1 else all_orders(welkin, group, rays, out, threads)
    if not all(math.isfinite(x) for row in rows for x in sky.values(row, sky.RADIANCE + sky.TRANSMITTANCE)):
        raise RuntimeError("values that are not finite")
    path = sky.truth_file(group)
    columns = sky.ANGLES + sky.RADIANCE + sky.TRANSMITTANCE + (sky.STANDARD_ERROR if group["orders"] != 1 else [])
    sky.write_rows(path, rows, columns)
    return {"scene": group["scene"], "rays": group["rays"], "orders": group["orders"] or "all", "origin": origin(group), "content": file_hash(path),
            "seconds": round(time.time() - begin, 1), "date": datetime.date.today().isoformat(), "commit": commit()}


def main():
    parser = argparse.ArgumentParser(description="The truth of the sky, for tests and for check_sky.py.")
    parser.add_argument("--build", default="build")
    parser.add_argument("--only", help="comma-separated names of groups")
    parser.add_argument("--threads", type=int)
    parser.add_argument("--force", action="store_true", help="also what has not changed")
    options = parser.parse_args()
    groups = sky.groups()
    names = options.only.split(",") if options.only else [g["name"] for g in groups]
    if not set(names) <= {g["name"] for g in groups}:
        parser.error(f"--only: expected some of {', '.join(g['name'] for g in groups)}")
    welkin = os.path.join(os.path.abspath(options.build), "welkin")
    threads = ["--threads", options.threads] if options.threads else []
    failed = 0
    for group in groups:
        index = load_index()
        if group["name"] not in names or (not options.force and is_current(group, index)):
            continue
        try:
            entry = make(welkin, group, threads)
        except RuntimeError as e:
            print(f"make_truth: {group['name']}: {e}", file=sys.stderr)
            failed += 1
            continue
        index["files"] = dict(sorted({**index["files"], group["name"]: entry}.items()))
        with open(INDEX + ".new", "w", encoding="utf-8") as f:
            json.dump(index, f, indent=1)
            f.write("\n")
        os.replace(INDEX + ".new", INDEX)
        print(f"{group['name']}: {len(sky.rays_of(group))} rays, {entry['seconds']:g} s", flush=True)
    index = load_index()
    current = sum(is_current(g, index) for g in groups)
    print(f"{current} of {len(groups)} groups have their truth; {os.path.relpath(sky.TRUTH, sky.REPOSITORY)}")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
