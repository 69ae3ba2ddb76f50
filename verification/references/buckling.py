"""Loads at which a plane equilibrium of a rod in space yields sideways: roots of the determinant of the lateral moments
at the free end over those at the root, about the bent state."""

from mpmath import mp, mpf

import rod
from shooting import DIGITS, LOOSE, TIGHT, Pass, solve_doubles

# Sideways moments change sign with the perturbation and others do not, so that its square alone is lost.
NUDGE = mpf(10) ** -20


def ends(legs, force, moment, run, soft):
    """The moment at the free end of legs in a row, each a length and the quaternion that turns into its axes."""
    number = run.number
    loads = [number(f) for f in force]
    slope = rod.slope(soft, loads, rod.straight)
    y = [number(0)] * 3 + [number(1), number(0), number(0), number(0)] + list(moment)
    for length, turn in legs:
        y = y[:3] + rod.product(y[3:7], [number(v) for v in turn]) + y[7:]
        y = run(slope, 0, y, length)
    return y[7:10]


def critical(legs, stiffness, force_at, plane, near):
    """The critical load near `near`: `plane` is the index of the moment that bends in the plane."""
    mp.dps = DIGITS + 12
    soft = rod.compliance(stiffness)
    soft_floats = rod.as_floats(soft)
    sideways = [index for index in range(3) if index != plane]
    floats = Pass()
    state = {"guess": 0.0}

    def inside(load):
        """The root's moment in the plane, in doubles, with its slope."""
        unit = abs(float(near)) * float(legs[0][0])

        def residual(x):
            moment = [0.0, 0.0, 0.0]
            moment[plane] = x[0] * unit
            return [ends(legs, force_at(load), moment, floats, soft_floats)[plane] / unit]

        x, slope = solve_doubles(residual, [state["guess"]])
        state["guess"] = x[0]
        return mpf(x[0]) * mpf(unit), float(slope[0][0])

    def determinant(load, run):
        at, slope = inside(load)
        for _ in range(6):
            moment = [mpf(0)] * 3
            moment[plane] = at
            left = ends(legs, force_at(load), moment, run, soft)[plane]
            at -= left / mpf(slope)
            if abs(left) < abs(at) * run.tolerance:
                break
        rows = []
        for index in sideways:
            moment = [mpf(0)] * 3
            moment[plane], moment[index] = at, NUDGE
            end = ends(legs, force_at(load), moment, run, soft)
            rows.append([end[k] / NUDGE for k in sideways])
        return rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0]

    found = []
    for tolerance in (LOOSE * mpf(10) ** -12, TIGHT * mpf(10) ** -12):
        run = Pass(tolerance)
        a, b = (mpf(near), mpf(near) * (1 + mpf(10) ** -4)) if not found else (found[0] * (1 + mpf(10) ** -9), found[0])
        fa, fb = determinant(a, run), determinant(b, run)
        for _ in range(12):
            if fa == fb:
                break
            c = b - fb * (b - a) / (fb - fa)
            a, fa, b = b, fb, c
            if abs(b - a) < abs(b) * mpf(10) ** -17:
                break
            fb = determinant(b, run)
        found.append(b)
    return found[1], abs(found[1] - found[0]) + abs(found[1]) * mpf(10) ** -20


NONE = (1, 0, 0, 0)


def lateral(rows):
    """A cantilever strip under a dead tip load in its stiff direction."""
    mp.dps = DIGITS
    down = lambda load: (0, 0, load)
    stiffness = [mpf(v) for v in ("73e6", "5.025e6", "5.025e6", "877.2", "60830", "608.3")]
    load, error = critical([(1, NONE)], stiffness, down, 1, mpf(2970))
    rows.add("lateral-buckling", "critical load over 2968 N, strip of the crank benchmark of 2016",
             [(load / 2968, error / 2968)])
    thin = [mpf(v) for v in ("18250000", "5849358.974358975", "5849358.974358975", "14.39307892628205", "15208.33333",
                             "9.505208333")]
    load, error = critical([(1, NONE)], thin, down, 1, mpf("46.95"))
    rows.add("lateral-buckling", "critical load over 46.9 N, strip 100 x 2.5 mm of the tip crank",
             [(load / mpf("46.9"), error / mpf("46.9"))])


def right_angle(rows):
    """Argyris' frame: two strips of 240 x 30 x 0.6, pushed at the end in both directions, two torsion constants."""
    mp.dps = DIGITS
    E, nu, width, thick = mpf(71240), mpf("0.31"), mpf(30), mpf("0.6")
    G = E / (2 * (1 + nu))
    shear = G * width * thick * 5 / 6
    half = mp.sqrt(mpf(1) / 2)
    legs = [(240, NONE), (240, (half, 0, 0, -half))]
    cases = [("plus", "2.16", "1.087"), ("minus", "2.16", "-0.6802"), ("plus-series", "2.132784", "1.084"),
             ("minus-series", "2.132784", "-0.6787")]
    for name, torsion, unit in cases:
        mp.dps = DIGITS
        stiffness = [E * width * thick, shear, shear, G * mpf(torsion), E * width * thick**3 / 12,
                     E * thick * width**3 / 12]
        load, error = critical(legs, stiffness, lambda load: (load, 0, 0), 2, mpf(unit))
        rows.add("right-angle-frame", f"critical load {name}", [(load / mpf(unit), error / abs(mpf(unit)))])


PROGRAMS = [lateral, right_angle]
