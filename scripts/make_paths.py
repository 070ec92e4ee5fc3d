#!/usr/bin/python3
"""Writes the recorded flights: orbit to ground, the two moving benchmark poses, and an afternoon over the clouds. `--check` compares only.

The descent is smooth in the logarithm of the altitude: the rate of sinking eases in and out and slows down between the
high and the low clouds; the ground speed is a fixed part of the altitude, so a frame never moves by more than a few
percent of it.
"""

import json
import math

import make_scenes
from globe import (RADIUS_M, combine, heading_vector, horizon_dip_deg, orientation_xyzw, travel, up_at, write_or_check)

TIME_STEP_S = 0.04
SIZE = [320, 180]
FOV_DEG = 58.0
FRAMES = 660
TOP_M, END_M = 1_000_000.0, 2.0
BETWEEN_LAYERS_M = 7_500.0  # below the cirrus, above the low clouds
GLIDE = 1.1                 # metres forward for a metre of sinking away from the slow part
SPEED_FLOOR_M = 2.0        # altitude below which the ground speed no longer shrinks


def smoother(x):
    """0 to 1 with zero first and second derivatives at both ends."""
    x = max(0.0, min(1.0, x))
    return x * x * x * (x * (6 * x - 15) + 10)


def descent():
    """Altitude and distance to the end, in metres, of every frame: integrates d ln(h)/dn backwards from the end."""
    steps = 50  # a frame; the sum is then within 1e-4 of the integral

    def ease(u):  # 0..1 along the flight
        return smoother(u / 0.10) * smoother((1 - u) / 0.12) + 0.02

    def rate(log_h):  # of sinking, relative: half of it between the layers
        return 1.0 - 0.5 * math.exp(-((log_h - math.log(BETWEEN_LAYERS_M)) / 0.45) ** 2)

    def fly(scale, record=None):
        log_h = math.log(END_M)
        away_m = 0.0
        for i in range((FRAMES - 1) * steps, -1, -1):
            u = i / ((FRAMES - 1) * steps)
            if record is not None and i % steps == 0:
                record.append((math.exp(log_h), away_m))
            if i:
                step = scale * ease(u) / steps
                away_m += GLIDE * step * (math.exp(log_h) + SPEED_FLOOR_M)
                log_h += step * rate(log_h)
        return log_h

    low, high = 0.0, 1.0  # relative rate a frame; bisect until the flight starts at the top
    for _ in range(60):
        middle = 0.5 * (low + high)
        if fly(middle) < math.log(TOP_M):
            low = middle
        else:
            high = middle
    record = []
    fly(high, record)
    return record[::-1]


def frame(up, horizontal, altitude_m, pitch_deg, n):
    position = [round((RADIUS_M + altitude_m) * x, 4) for x in up]
    return {"position_m": position, "orientation_xyzw": [round(x, 12) for x in orientation_xyzw(up, horizontal, pitch_deg)],
            "fov_deg": FOV_DEG, "time_s": round(n * TIME_STEP_S, 6)}


def orbit_to_ground():
    end = make_scenes.SITE["latitude_deg"], make_scenes.SITE["longitude_deg"]
    end_up, end_forward = up_at(*end), heading_vector(*end, make_scenes.HEADING_DEG)
    frames = []
    for n, (altitude_m, away_m) in enumerate(descent()):
        up, forward = travel(end_up, end_forward, -away_m / RADIUS_M)
        u = n / (FRAMES - 1)
        # A slow look to the side on the way, back to the track at the end.
        turn = math.radians(14.0 * math.sin(2 * math.pi * smoother(u)))
        side = [up[1] * forward[2] - up[2] * forward[1], up[2] * forward[0] - up[0] * forward[2],
                up[0] * forward[1] - up[1] * forward[0]]
        horizontal = combine(math.cos(turn), forward, math.sin(turn), side)
        # From a little under the limb to a little over the horizon.
        pitch_deg = -horizon_dip_deg(altitude_m) - 9.0 * (1 - smoother((u - 0.2) / 0.8)) + 4.0 * smoother((u - 0.7) / 0.3)
        frames.append(frame(up, horizontal, altitude_m, pitch_deg, n))
    return frames


def moving(pose, metres_a_frame, count=48):
    """The pose, then straight ahead over the ground at constant altitude."""
    up0 = up_at(pose["latitude_deg"], pose["longitude_deg"])
    forward0 = heading_vector(pose["latitude_deg"], pose["longitude_deg"], pose["heading_deg"])
    frames = []
    for n in range(count):
        up, forward = travel(up0, forward0, n * metres_a_frame / (RADIUS_M + pose["altitude_m"]))
        frames.append(frame(up, forward, pose["altitude_m"], pose["pitch_deg"], n))
    return frames


def afternoon(view, seconds_a_frame=50.0, count=300):
    """The camera stands and the scene's time runs, 1250 times as fast as the frames, until the sun has set."""
    frames = moving(view, 0.0, count)
    for n, f in enumerate(frames):
        f["time_s"] = n * seconds_a_frame
    return frames


def path_text(scene, frames, warm_up):
    """JSON with a frame a line."""
    head = json.dumps({"scene": scene, "size": SIZE, "time_step_s": TIME_STEP_S, "warm_up": warm_up})[:-1]
    lines = ",\n".join(json.dumps(f, separators=(",", ":")) for f in frames)
    return f"{head}, \"frames\": [\n{lines}\n]}}\n"


if __name__ == "__main__":
    write_or_check({
        "benchmarks/orbit-to-ground.json": path_text("orbit-to-ground.scene.json", orbit_to_ground(), 30),
        # as fast as the thesis program flies by default at these altitudes
        "benchmarks/moving-orbit.json": path_text("poses/orbit.json", moving(make_scenes.POSES["orbit"], 7000.0), 30),
        "benchmarks/day.json": path_text("day.scene.json", afternoon(make_scenes.EARTH_VIEWS["orbit"]), 30),
        "benchmarks/moving-near.json": path_text("poses/near.json", moving(make_scenes.POSES["near"], 100.0), 30),
    })
