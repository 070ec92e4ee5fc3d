"""Planets other than the Earth of the pictures: their media, their sun and their views (docs/scenes.md names the sources).

In all of them the sun stands over latitude 0, longitude 0, so a place on the equator at longitude L has it 90 - L degrees high, in
the west: it is afternoon there. Lists of three are values at 680, 550 and 440 nm.
"""

import math

BOLTZMANN = 1.380649e-23  # J/K
ASTRONOMICAL_UNIT_M = 1.495978707e11
SUN_RADIUS_M = 6.957e8  # nominal, IAU 2015


def rayleigh_per_m(cross_section_m2, pressure_pa, temperature_k):
    """Scattering at the ground: cross section times molecules per volume (ideal gas)."""
    n = pressure_pa / (BOLTZMANN * temperature_k)
    return [float(f"{s * n:.4g}") for s in cross_section_m2]


def layer(name, profile, scattering, absorption, phase, g=None):
    return {"name": name, "profile": profile, "scattering_per_m": scattering, "absorption_per_m": absorption,
            "phase": {"type": phase} if g is None else {"type": phase, "g": g}}


def exponential(scale_height_m):
    return {"type": "exponential", "scale_height_m": float(scale_height_m)}


def tent(peak_m, half_width_m):
    return {"type": "tent", "peak_m": float(peak_m), "half_width_m": float(half_width_m)}


NOTHING = [0.0, 0.0, 0.0]


def particles(name, profile, extinction, albedo, share, g):
    """Particles of this extinction and single-scattering albedo; `share` of each colour's light goes with this layer's g."""
    scattering = [float(f"{e * s * a:.4g}") for e, s, a in zip(extinction, share, albedo)]
    absorption = [float(f"{e * s * (1 - a):.4g}") for e, s, a in zip(extinction, share, albedo)]
    return layer(name, profile, scattering, absorption, "henyey-greenstein", g)


def sun(distance_au, day_s, irradiance=(1.0, 1.0, 1.0)):
    """Sunlight in units of that at the Earth's mean distance; day_s: from noon to noon."""
    return {"irradiance": [float(f"{e / distance_au**2:.6g}") for e in irradiance],
            "angular_radius_rad": float(f"{math.asin(SUN_RADIUS_M / (distance_au * ASTRONOMICAL_UNIT_M)):.6g}"),
            "latitude_deg": 0.0, "longitude_deg": 0.0, "day_s": day_s}


def at(longitude_deg, altitude_m, heading_deg, pitch_deg, fov_deg=58.0, latitude_deg=0.0, **more):
    return {"latitude_deg": float(latitude_deg), "longitude_deg": float(longitude_deg), "altitude_m": float(altitude_m),
            "heading_deg": float(heading_deg), "pitch_deg": float(pitch_deg), "roll_deg": 0.0, "fov_deg": float(fov_deg), **more}


def ground(sun_elevation_deg, heading_deg, pitch_deg, fov_deg=58.0, **more):
    """On the equator at eye height, the sun in the west (heading 270)."""
    return at(90.0 - sun_elevation_deg, 2.0, heading_deg, pitch_deg, fov_deg, **more)


def horizon_dip_deg(radius_m, altitude_m):
    return math.degrees(math.acos(radius_m / (radius_m + altitude_m)))


def from_space(radius_m, orbit_m, glow_m):
    """Views that every planet has. glow_m: how high over the ground the limb view looks."""
    dip = horizon_dip_deg(radius_m, orbit_m)
    return {
        "space": at(52.0, 3.2 * radius_m, 0.0, -90.0, fov_deg=34.0, latitude_deg=14.0),
        "limb": at(58.0, orbit_m, 70.0, -round(horizon_dip_deg(radius_m + glow_m, orbit_m - glow_m), 2), fov_deg=24.0),
        "terminator": at(84.0, 2 * orbit_m, 320.0, -round(horizon_dip_deg(radius_m, 2 * orbit_m) + 9.0, 2), fov_deg=50.0),
        "orbit": at(30.0, orbit_m, 60.0, -round(dip + 8.0, 2), fov_deg=58.0),
    }


# The medium that comparisons of sky models share (Hillaire 2020, table 1), without clouds.
def clear_earth(atmosphere):
    radius_m = 6_360_000.0
    return {"name": "Earth without clouds", "planet": {"radius_m": radius_m, "albedo": [0.06, 0.07, 0.10]}, "atmosphere": atmosphere,
            "sun": sun(1.0, 86_400.0), "output": {"exposure_ev": "auto", "auto_exposure": {"max_ev": 7.0}},
            "views": {**from_space(radius_m, 400_000.0, 20_000.0),
                      "ground": ground(40.0, 335.0, 14.0),
                      "sunset": ground(1.5, 270.0, 11.0),
                      "twilight": ground(-5.0, 270.0, 12.0),
                      "belt-of-venus": ground(-2.0, 90.0, 9.0, fov_deg=40.0)}}


# Dust of optical depth 0.6 with the gas's own scale height. Half of what a large particle takes out of a beam goes into a forward
# peak by diffraction, the narrower the shorter the wave: in the blue more of the light stays near the sun, which makes its sunset
# blue. One g holds for all colours of a layer, so the dust is two layers: the peak, which has more of the blue, and the wide rest.
def mars():
    radius_m, height_m, depth = 3_389_500.0, 11_100.0, 0.6
    extinction, albedo = [depth / height_m] * 3, [0.97, 0.87, 0.72]
    peak = [0.26, 0.50, 0.88]
    layers = [
        layer("carbon dioxide", exponential(height_m), rayleigh_per_m([4.65e-31, 1.086e-30, 2.65e-30], 636.0, 210.0), NOTHING, "rayleigh"),
        particles("dust, forward peak", exponential(height_m), extinction, albedo, peak, 0.90),
        particles("dust, the rest", exponential(height_m), extinction, albedo, [1 - p for p in peak], 0.45),
    ]
    return {"name": "Mars", "planet": {"radius_m": radius_m, "albedo": [0.30, 0.15, 0.06]},
            "atmosphere": {"top_m": 120_000.0, "layers": layers}, "sun": sun(1.5237, 88_775.244), "output": {"exposure_ev": "auto"},
            "views": {**from_space(radius_m, 300_000.0, 25_000.0),
                      "ground": ground(35.0, 330.0, 12.0),
                      "sunset": ground(4.0, 270.0, 9.0, fov_deg=50.0),
                      "twilight": ground(-4.0, 270.0, 12.0)}}


# The haze's optical depth above 80 km follows the probe's fit 1.012e7 (wavelength in nm)^-2.339. A tent around 80 km has it there as an
# exponential of 65 km would from 80 km up, and the right amount below; a fifth of it is in the exponential that reaches on upwards.
def titan():
    radius_m = 2_575_000.0
    above = [1.012e7 * nm**-2.339 for nm in (680.0, 550.0, 440.0)]
    albedo = [0.96, 0.90, 0.70]
    main = [0.8 * t / 65_000.0 for t in above]
    high = [0.2 * t / (65_000.0 * math.exp(-80.0 / 65.0)) for t in above]
    layers = [
        layer("nitrogen", exponential(20_600.0), rayleigh_per_m([1.90e-31, 4.50e-31, 1.13e-30], 146_700.0, 93.7), NOTHING, "rayleigh"),
        particles("haze", tent(80_000.0, 130_000.0), main, albedo, [1.0] * 3, 0.65),
        particles("high haze", exponential(65_000.0), high, albedo, [1.0] * 3, 0.65),
        particles("detached haze", tent(510_000.0, 25_000.0), [0.6e-7, 0.9e-7, 1.4e-7], [0.98, 0.97, 0.95], [1.0] * 3, 0.5),
    ]
    return {"name": "Titan", "planet": {"radius_m": radius_m, "albedo": [0.17, 0.13, 0.07]},
            "atmosphere": {"top_m": 600_000.0, "layers": layers}, "sun": sun(9.5826, 1_379_690.0), "output": {"exposure_ev": "auto", "auto_exposure": {"max_ev": 12.0}},
            "views": {**from_space(radius_m, 1_500_000.0, 250_000.0),
                      "ground": ground(40.0, 330.0, 12.0),
                      "sunset": ground(3.0, 270.0, 14.0),
                      "twilight": ground(-8.0, 270.0, 14.0)}}


# The fictional planet of Sakmary 2022, table 5.4: Rayleigh scattering with little blue, a dense haze that absorbs least of the blue,
# the Earth's ozone; clouds thicker than ours.
def purple(atmosphere):
    radius_m = 6_360_000.0
    scattering, extinction = [4.6e-5, 4.7e-5, 5.7e-5], [8.2e-5, 7.1e-5, 5.8e-5]
    layers = [
        layer("rayleigh", exponential(18_416.0), [1.49e-4, 1.42e-4, 5.1e-5], NOTHING, "rayleigh"),
        layer("mie", exponential(13_143.0), scattering, [float(f"{e - s:.4g}") for e, s in zip(extinction, scattering)], "cornette-shanks", 0.8),
        atmosphere["layers"][2],
    ]
    clouds = {"type": "layers", "layers": [
        {"name": "deck", "base_m": 5_700.0, "top_m": 8_000.0, "base_fade_m": 300.0, "top_fade_m": 1_000.0, "extinction_per_m": 0.15,
         "cover_gain": 1.1, "cell_m": 12_000.0, "gain": 0.55, "billow": 0.7,
         "softness": 0.2, "taper": 0.3, "top_follows_cover": 0.5}]}
    return {"name": "The purple planet", "planet": {"radius_m": radius_m, "albedo": [0.14, 0.08, 0.12]},
            "atmosphere": {"top_m": 150_000.0, "layers": layers}, "sun": sun(1.0, 86_400.0), "clouds": {"sources": [clouds]},
            "quality": {"budget": "256MiB", "depth": 14, "detail": 30.0, "seed": 5}, "output": {"exposure_ev": "auto"},
            "views": {**from_space(radius_m, 500_000.0, 40_000.0),
                      "ground": ground(40.0, 330.0, 14.0),
                      "sunset": ground(6.0, 270.0, 12.0),
                      "twilight": ground(-4.0, 270.0, 12.0)}}


# No air: sky tables and aerial perspective are left out, and the night side is black.
def moon():
    radius_m = 1_737_400.0
    return {"name": "Moon", "planet": {"radius_m": radius_m, "albedo": [0.13, 0.11, 0.09]}, "sun": sun(1.0, 2_551_443.0),
            "output": {"exposure_ev": "auto"},
            "views": {**from_space(radius_m, 100_000.0, 0.0),
                      "ground": ground(30.0, 330.0, 2.0),
                      "sunset": ground(0.6, 270.0, 2.0)}}


def files(atmosphere):
    """{path below the repository: scene}; `atmosphere` is the Earth's."""
    return {"scenes/clear-earth.json": clear_earth(atmosphere), "scenes/mars.json": mars(), "scenes/titan.json": titan(),
            "scenes/purple.json": purple(atmosphere), "scenes/moon.json": moon()}
