"""Places, directions and files that the generators of scenes and paths share. Standard library only.

Planet frame: metres, right-handed, +Z the north pole, longitude 0 on +X. Headings are degrees clockwise from north,
pitch is positive upwards. A view looks along its -Z with +X right and +Y up.
"""

import json
import math
import os
import sys

RADIUS_M = 6_360_000.0  # of the planet in the scenes: the sphere of the published sky comparisons
REPOSITORY = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def combine(a, u, b, v):
    """a u + b v"""
    return [a * x + b * y for x, y in zip(u, v)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def up_at(latitude_deg, longitude_deg):
    """Unit vector straight up, planet frame."""
    lat, lon = math.radians(latitude_deg), math.radians(longitude_deg)
    return [math.cos(lat) * math.cos(lon), math.cos(lat) * math.sin(lon), math.sin(lat)]


def heading_vector(latitude_deg, longitude_deg, heading_deg):
    """Unit horizontal vector towards a heading."""
    lat, lon, heading = math.radians(latitude_deg), math.radians(longitude_deg), math.radians(heading_deg)
    north = [-math.sin(lat) * math.cos(lon), -math.sin(lat) * math.sin(lon), math.cos(lat)]
    east = [-math.sin(lon), math.cos(lon), 0.0]
    return combine(math.cos(heading), north, math.sin(heading), east)


def latitude_longitude_deg(direction):
    return math.degrees(math.asin(max(-1.0, min(1.0, direction[2])))), math.degrees(math.atan2(direction[1], direction[0]))


def travel(up, forward, angle_rad):
    """A point `up` and its unit horizontal direction `forward`, moved along their great circle by an angle."""
    c, s = math.cos(angle_rad), math.sin(angle_rad)
    return combine(c, up, s, forward), combine(-s, up, c, forward)


def subsolar_deg(latitude_deg, longitude_deg, azimuth_deg, elevation_deg):
    """Latitude and longitude of the point under the sun that stands at this azimuth and elevation here."""
    point, _ = travel(up_at(latitude_deg, longitude_deg), heading_vector(latitude_deg, longitude_deg, azimuth_deg),
                      math.radians(90.0 - elevation_deg))
    return latitude_longitude_deg(point)


def orientation_xyzw(up, horizontal, pitch_deg):
    """Quaternion (planet from view) that looks along the unit vector `horizontal`, pitched up by `pitch_deg`."""
    p = math.radians(pitch_deg)
    look = combine(math.cos(p), horizontal, math.sin(p), up)
    back = [-x for x in look]
    view_up = combine(math.cos(p), up, -math.sin(p), horizontal)
    right = cross(view_up, back)
    m = [[right[i], view_up[i], back[i]] for i in range(3)]  # columns: right, up, back
    # The largest of the four squares first, so that nothing cancels (Shepperd 1978).
    squares = [1 + m[0][0] - m[1][1] - m[2][2], 1 - m[0][0] + m[1][1] - m[2][2], 1 - m[0][0] - m[1][1] + m[2][2],
               1 + m[0][0] + m[1][1] + m[2][2]]
    k = squares.index(max(squares))
    q = [0.0] * 4
    if k == 3:
        q = [m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1], squares[3]]
    else:
        i, j, l = k, (k + 1) % 3, (k + 2) % 3
        q[i], q[j], q[l], q[3] = squares[k], m[j][i] + m[i][j], m[l][i] + m[i][l], m[l][j] - m[j][l]
    n = math.sqrt(dot(q, q))
    return [x / n for x in q]


def horizon_dip_deg(altitude_m):
    """How far the sea horizon lies below the horizontal."""
    return math.degrees(math.acos(RADIUS_M / (RADIUS_M + altitude_m)))


def nearly_equal(a, b):
    """Same structure; numbers may differ by the last digits that mathematical libraries disagree on."""
    if isinstance(a, dict) and isinstance(b, dict):
        return list(a) == list(b) and all(nearly_equal(a[k], b[k]) for k in a)
    if isinstance(a, list) and isinstance(b, list):
        return len(a) == len(b) and all(nearly_equal(x, y) for x, y in zip(a, b))
    if isinstance(a, (int, float)) and isinstance(b, (int, float)) and not isinstance(a, bool):
        return abs(a - b) <= 1e-9 * max(1.0, abs(a), abs(b))
    return a == b


def parsed(name, text):
    """What a JSON file says, or the cells of a CSV file: numbers where they are numbers."""
    if not name.endswith(".csv"):
        return json.loads(text)

    def cell(word):
        try:
            return float(word)
        except ValueError:
            return word
    return [[cell(word) for word in line.split(",")] for line in text.splitlines()]


def write_or_check(files):
    """Writes {path below the repository: text}; with --check only compares what is there and exits 1 on a difference."""
    check = sys.argv[1:] == ["--check"]
    if sys.argv[1:] and not check:
        sys.exit(f"usage: {sys.argv[0]} [--check]")
    stale = []
    for name, text in files.items():
        path = os.path.join(REPOSITORY, name)
        if check:
            try:
                with open(path, encoding="utf-8") as f:
                    same = nearly_equal(parsed(name, f.read()), parsed(name, text))
            except (OSError, ValueError):
                same = False
            if not same:
                stale.append(name)
            continue
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path + ".new", "w", encoding="utf-8") as f:
            f.write(text)
        os.replace(path + ".new", path)
    if stale:
        sys.exit(f"not what {os.path.basename(sys.argv[0])} writes: {', '.join(stale)}")
    print(f"{len(files)} files {'are current' if check else 'written'}")
