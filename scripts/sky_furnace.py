"""Energy of a planet where nothing absorbs: what leaves its air, over what the sun sends in. It is 1; more than that was created.

Every straight line through the shell is either one that ends on the ground or one that passes at a distance b > R from the centre.
Over all lines, radiance times their measure is the power that leaves (R radius, T top, per unit of solar irradiance):

    ground   2 pi R^2  int dmu_s  int mu dmu  int dphi  L         mu, mu_s: cosines of line and sun there
    limb     2 pi  int b db  int sin(theta) dtheta  int dpsi  L   theta: line of sight to sun, psi: around the line, 0 away from the planet
    direct   2 pi  int b transmittance(b) db                      the beam that passes without meeting anything

and the sun sends pi T^2. Each integral is a Gauss rule over panels: coarse and fine, and their difference is the error of the
quadrature. Observers stand at the very top of the shell. Standard library only.
"""

import math

import sky
from make_sky_check import from_outside

# Panels of each variable and points a panel, (coarse, fine). Below mu_s = -0.3 (107 degrees) the ground is black; leaving that out
# can only lose energy. Angles in degrees; heights over the shell's; a peak of g = 0.99 is half a degree wide.
MU_SUN = ([-0.3, -0.05, 0.0, 0.2, 1.0], (2, 3))
MU = ([0.0, 0.15, 1.0], (2, 3))
PHI = ([0, 60, 180], (2, 3))
HEIGHT = ([0.0, 0.06, 0.2, 0.5, 1.0], (2, 3))
THETA = ([0, 1, 4, 15, 45, 90, 180], (2, 3))
PSI = ([0, 90, 180], (2, 3))


def gauss(n):
    """Nodes and weights on [0, 1], by Newton's method on the Legendre polynomial."""
    out = []
    for i in range(n):
        x = math.cos(math.pi * (i + 0.75) / (n + 0.5))
        for _ in range(100):
            p, q = 1.0, 0.0
            for k in range(n):
                p, q = ((2 * k + 1) * x * p - k * q) / (k + 1), p
            slope = n * (x * p - q) / (x * x - 1)
            x -= p / slope
        out.append(((1 - x) / 2, 1 / ((1 - x * x) * slope * slope)))
    return out


def rule(panels, fine):
    edges, counts = panels
    points = gauss(counts[fine])
    return [(a + (b - a) * x, (b - a) * w) for a, b in zip(edges, edges[1:]) for x, w in points]


def ray_row(observer):
    return dict(zip(sky.ANGLES, ["" if x is None else f"{x:.12g}" for x in observer["ray"]]))


def rays(radius_m, top_m, fine):
    """[(ray, weight of its radiance, weight of its transmittance)] whose sum is 1 in a furnace."""
    whole, out = math.pi * (radius_m + top_m) ** 2, []
    for mu_s, w1 in rule(MU_SUN, fine):
        for mu, w2 in rule(MU, fine):
            for phi, w3 in rule(PHI, fine):
                observer = from_outside(top_m, 0, 180 - math.degrees(math.acos(mu)), math.degrees(math.acos(mu_s)), phi, radius_m=radius_m)
                weight = 2 * math.pi * radius_m**2 * w1 * mu * w2 * 2 * math.radians(w3)
                out.append((ray_row(observer), weight / whole, 0.0))
    for height, w1 in rule(HEIGHT, fine):
        b, direct = radius_m + height * top_m, 2 * math.pi * (radius_m + height * top_m) * top_m * w1
        for theta, w2 in rule(THETA, fine):
            t = math.radians(theta)
            for psi, w3 in rule(PSI, fine):
                p = math.radians(psi)
                sun = math.degrees(math.acos(math.sin(t) * math.cos(p)))
                azimuth = math.degrees(math.atan2(math.sin(t) * math.sin(p), math.cos(t)))
                observer = from_outside(top_m, b - radius_m, 90, sun, azimuth, radius_m=radius_m)
                weight = 2 * math.pi * b * top_m * w1 * math.sin(t) * math.radians(w2) * 2 * math.radians(w3)
                out.append((ray_row(observer), weight / whole, direct / whole))
                direct = 0.0
    return out


def energy(design, rows):
    """What leaves, over what comes in, at each wavelength."""
    total = [0.0] * 3
    for (_, radiance, transmittance), row in zip(design, rows):
        for i, (light, clear) in enumerate(zip(sky.values(row, sky.RADIANCE), sky.values(row, sky.TRANSMITTANCE))):
            total[i] += radiance * light + transmittance * clear
    return total
