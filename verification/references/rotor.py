"""Blade element momentum of a rotor in axial wind: one equation for the angle of the flow at each radius, by bisection (Ning 2014)."""

from bisect import bisect_right
from math import acos, atan2, cos, exp, pi, sin
from pathlib import Path

CASE = Path(__file__).parent.parent / "rotor-nrel-5mw"
BLADES, DENSITY, HUB, LENGTH = 3, 1.225, 1.5, 61.5
# Ends of the zones of the blade [m from its root], whose middles have the published chords [m] and twists [deg], and the aerofoil of each.
ENDS = [2.7333, 5.4667, 8.2, *(8.2 + 4.1 * k for k in range(1, 12)), 56.0333, 58.7667, 61.5]
MIDDLES = [1.3666, 4.1, 6.8333, 10.25, 14.35, 18.45, 22.55, 26.65, 30.75, 34.85, 38.95, 43.05, 47.15, 51.25, 54.6666, 57.4, 60.1334]
CHORDS = [3.542, 3.854, 4.167, 4.557, 4.652, 4.458, 4.249, 4.007, 3.748, 3.502, 3.256, 3.010, 2.764, 2.518, 2.313, 2.086, 1.419]
TWISTS = [13.308, 13.308, 13.308, 13.308, 11.480, 10.162, 9.011, 7.795, 6.544, 5.361, 4.188, 3.125, 2.319, 1.526, 0.863, 0.370, 0.106]
FOILS = [0, 0, 1, 2, 3, 3, 4, 5, 5, 6, 6, 7, 7, 7, 7, 7, 7]


def between(xs, ys, x):
    """Linear interpolation, constant beyond the ends."""
    if x <= xs[0]:
        return ys[0]
    if x >= xs[-1]:
        return ys[-1]
    k = bisect_right(xs, x) - 1
    return ys[k] + (ys[k + 1] - ys[k]) * (x - xs[k]) / (xs[k + 1] - xs[k])


def polars():
    """Angles of attack [deg], lift and drag of each aerofoil."""
    lines = [line.split() for line in (CASE / "aerofoils.dat").read_text().splitlines() if line[0] != "!"]
    found, row = [], 2
    for _ in range(int(lines[1][0])):
        count = int(lines[row][1])
        table = [[float(word) for word in line[:3]] for line in lines[row + 1 : row + 1 + count]]
        found.append(list(zip(*table)))
        row += 1 + count
    return found


def induction(load, loss):
    """Axial induction at which the momentum of the annulus balances load = c_n sigma/(4 F sin^2), with Buhl's parabola above 0.4."""
    def lack(a):
        momentum = 4 * a * loss * (1 - a) if a <= 0.4 else 8 / 9 + (4 * loss - 40 / 9) * a + (50 / 9 - 4 * loss) * a * a
        return 4 * loss * load * (1 - a) ** 2 - momentum

    if load < 0:
        return load / (1 + load)
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if lack(middle) > 0 else (low, middle)
    return (low + high) / 2


def station(z, wind, omega, pitch, tables):
    """Forces per length along the axis and along the motion [N/m]."""
    radius, zone = HUB + z, min(bisect_right(ENDS, z), len(FOILS) - 1)
    chord = between(MIDDLES, CHORDS, z)
    angle, (alphas, lifts, drags) = between(MIDDLES, TWISTS, z) + pitch, tables[FOILS[zone]]
    solidity = BLADES * chord / (2 * pi * radius)

    def state(phi):
        alpha = phi * 180 / pi - angle
        lift, drag = between(alphas, lifts, alpha), between(alphas, drags, alpha)
        normal, along = lift * cos(phi) + drag * sin(phi), lift * sin(phi) - drag * cos(phi)
        exponent = BLADES / (2 * sin(phi))
        loss = (2 / pi) ** 2 * acos(exp(-exponent * (LENGTH - z) / radius)) * acos(exp(-exponent * z / HUB))
        a = induction(solidity * normal / (4 * loss * sin(phi) ** 2), loss)
        swirl = solidity * along / (4 * loss * sin(phi) * cos(phi))
        # tan phi = V (1 - a)/(omega r (1 + a')) with a' = swirl/(1 - swirl)
        through, around = wind * (1 - a), omega * radius / (1 - swirl)
        return normal, along, through, around

    def lack(phi):
        _, _, through, around = state(phi)
        return phi - atan2(through, around)

    low, high = 1e-4, pi / 2 - 1e-4
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if lack(middle) < 0 else (low, middle)
    normal, along, through, around = state((low + high) / 2)
    pressure = DENSITY / 2 * chord * (through**2 + around**2)
    return normal * pressure, along * pressure


def totals(wind, speed, pitch, count, tables):
    """Thrust [kN] and power [kW] from the middles of `count` parts of the blade; the speed in turns per minute."""
    omega, width = speed * pi / 30, LENGTH / count
    thrust = moment = 0
    for k in range(count):
        z = (k + 0.5) * width
        normal, along = station(z, wind, omega, pitch, tables)
        thrust += BLADES * width * normal
        moment += BLADES * width * along * (HUB + z)
    return thrust / 1e3, moment * omega / 1e3


def rotor(rows):
    """Thrust and power of the NREL 5 MW rotor without cone and tilt."""
    tables = polars()
    for wind, speed, pitch in [(8, 9.156, 0), (11.4, 12.1, 0), (15, 12.1, 10.45), (25, 12.1, 23.469)]:
        coarse, fine = (totals(wind, speed, pitch, count, tables) for count in (600, 1200))
        for words, first, second in zip(["thrust [kN]", "power [kW]"], coarse, fine):
            rows.add("rotor-nrel-5mw", f"{words} at {wind} m/s without cone and tilt", [(second, abs(first - second))])


PROGRAMS = [rotor]
