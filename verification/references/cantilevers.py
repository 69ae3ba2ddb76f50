"""Cantilevers under dead loads at the tip, in space: the root moment is the unknown, the moment at the tip the condition."""

from mpmath import mp, mpf

import rod
from shooting import Pass, solve, solve_doubles

PRINCETON_LENGTH = "0.508"


def cantilever(length, stiffness, force, moment=(0, 0, 0), curvature=rod.straight, root=(1, 0, 0, 0), extra=None):
    """The shooting problem; outputs are the tip's place and its rotation matrix by rows. `extra` is the slope of a
    further variable that the curvature is given by, as function of it alone, starting from 0."""
    soft = rod.compliance(stiffness)
    soft_floats = rod.as_floats(soft)
    size = max(1.0, max(abs(float(f)) for f in force) * float(length), max(abs(float(m)) for m in moment))

    def problem(x, run):
        digits = run.tolerance is not None
        number = run.number
        loads = [number(f) for f in force]
        base = rod.slope(soft if digits else soft_floats, loads, curvature)
        slope = base
        if extra is not None:
            def slope(s, y):
                along = rod.slope(soft if digits else soft_floats, loads, lambda _: curvature(y[10]))
                return along(s, y[:10]) + [extra(y[10])]
        start = [0, 0, 0] + [number(v) for v in root] + [v * number(size) for v in x]
        if extra is not None:
            start.append(0)
        y = run(slope, 0, start, length)
        q = y[3:7]
        residual = [(a - number(b)) / number(size) for a, b in zip(y[7:10], moment)]
        return residual, y[:3] + [value for row in rod.matrix(q) for value in row]

    return problem


def follow(make, factors, start=(0.0, 0.0, 0.0)):
    """Solutions for growing loads, each in many digits, guesses carried on from load to load."""
    floats = Pass()
    x, before, results = list(start), None, {}
    for factor, wanted in factors:
        problem = make(factor)
        guess = [2 * a - b for a, b in zip(x, before)] if before else list(x)
        before = x
        x, _ = solve_doubles(lambda v: problem(v, floats)[0], guess)
        if wanted:
            outputs, errors, _ = solve(problem, x)
            results[factor] = (outputs, errors)
    return results


def ramp(wanted, between=4):
    """Load factors on the way to those wanted, from zero."""
    steps, last = [], mpf(0)
    for value in wanted:
        steps += [(last + (value - last) * k / between, k == between) for k in range(1, between + 1)]
        steps[-1] = (value, True)
        last = value
    return steps


def tip(outputs, errors, reference=None):
    """Displacement (or place) with errors."""
    place = [a - b for a, b in zip(outputs[:3], reference or [0, 0, 0])]
    return list(zip(place, errors[:3]))


def bend_45(rows):
    """Bathe and Bolourchi 1979: an arc of 45 degrees, radius 100, section 1 x 1, E = 1e7, no Poisson's ratio."""
    mp.dps = 34
    bending = mpf(10) ** 7 / 12
    shears = {"main": mpf(10) ** 7 * 5 / 12, "simo": mpf(10) ** 7 / 2, "torsion": mpf(10) ** 7 / 2}
    names = {
        "main": "GA = 5/6 G A, tip position at P = 300, 450, 600",
        "simo": "Simo and Vu-Quoc, GA = G A, tip position at P = 300, 450, 600",
        "torsion": "Simo and Vu-Quoc, GJ of Saint-Venant, tip position at P = 300, 450, 600",
    }
    for variant, shear in shears.items():
        twist = mpf(702885) if variant == "torsion" else bending
        stiffness = [mpf(10) ** 7, shear, shear, twist, bending, bending]
        bend = (0, 0, mpf(1) / 100)
        length = 25 * mp.pi

        def make(P):
            return cantilever(length, stiffness, (0, 0, P), curvature=lambda s: bend)

        loads = [mpf(300), mpf(450), mpf(600)]
        found = follow(make, ramp(loads))
        rows.add("bend-45", names[variant], [pair for P in loads for pair in tip(*found[P])])


def bend_quadratic(rows):
    """The parabola through three points of that arc, as BeamDyn and Kynema have it."""
    mp.dps = 34
    a, b = mpf("0.05505072026374205"), mpf("-0.006636390885821629")
    end = mpf("70.7107")

    def rise(x):
        return a + 2 * b * x

    def rate(x):
        return 1 / (1 + rise(x) ** 2) ** mpf(0.5)

    def bend(x):
        return (0, 0, 2 * b * rate(x) ** 3)

    length = mp.quad(lambda x: mp.sqrt(1 + rise(x) ** 2), [0, end])
    half = mp.atan(a) / 2
    root = (mp.cos(half), 0, 0, mp.sin(half))
    stiffness = [mpf(10) ** 7, mpf(4166670), mpf(4166670), mpf(833300), mpf(833300), mpf(833300)]

    def make(P):
        return cantilever(length, stiffness, (0, 0, P), curvature=bend, root=root, extra=rate)

    found = follow(make, ramp([mpf(600)]))
    rows.add("bend-quadratic", "tip displacement", tip(*found[mpf(600)], [end, a * end + b * end**2, 0]))


def composite(rows):
    """Wang et al. 2017: bending and torsion coupled by the section."""
    mp.dps = 34
    k = lambda text: mpf(text) * 1000
    stiffness = [[k("1368.17"), 0, 0, 0, 0, 0], [0, k("88.56"), 0, 0, 0, 0], [0, 0, k("38.78"), 0, 0, 0],
                 [0, 0, 0, k("16.96"), k("17.61"), k("-0.351")], [0, 0, 0, k("17.61"), k("59.12"), k("-0.370")],
                 [0, 0, 0, k("-0.351"), k("-0.370"), k("141.47")]]
    make = lambda P: cantilever(10, stiffness, (0, 0, P))
    outputs, errors = follow(make, ramp([mpf(150)]))[mpf(150)]
    rows.add("composite-beam", "tip displacement", tip(outputs, errors, [10, 0, 0]))
    rows.add("composite-beam", "tip rotation matrix", list(zip(outputs[3:], errors[3:])))


def twisted(rows):
    """Wang et al. 2017: a strip that turns by 90 degrees from root to tip."""
    mp.dps = 34
    stiffness = [mpf(v) for v in ("2.5e10", "8260416700", "8260416700", "141872656", "520833000", "130208333")]
    turn = (mp.pi / 20, 0, 0)
    P = mpf(-4000000)
    make = lambda P: cantilever(10, stiffness, (0, 0, P), curvature=lambda s: turn)
    rows.add("twisted-beam", "tip displacement", tip(*follow(make, ramp([P]))[P], [10, 0, 0]))


def helix(rows):
    """Ibrahimbegovic 1997: ten turns."""
    mp.dps = 34
    stiffness = [mpf(10000)] * 3 + [mpf(100)] * 3
    make = lambda f: cantilever(10, stiffness, (0, 0, 50 * f), (0, 0, 200 * mp.pi * f))
    factors = [mpf(k) / 20 for k in range(1, 21)]
    found = follow(make, ramp(factors, 10))
    rows.add("helix", "tip position, 20 loads", [pair for f in factors for pair in tip(*found[f])])
    rows.table("helix", "tip.csv", [1, 2, 3], {float(f): tip(*found[f]) for f in factors})


def oblique(rows):
    """Nachbagauer et al. 2013: twisted and bent by an end moment."""
    mp.dps = 34
    stiffness = [mpf(v) for v in ("16560000000", "5306206153.846154", "5070544615.384617", "61229538.46153848",
                                  "220800000", "55200000")]
    f = mpf(1)
    make = lambda f: cantilever(2, stiffness, (0, 0, 0), (500000 * f, 2000000 * f, 0))
    found = tip(*follow(make, ramp([f]))[f], [2, 0, 0])
    rows.add("oblique-moment", "tip displacement", found)
    rows.add("oblique-moment", "axial and lateral displacement alone", found[:2])


def deep(rows):
    """Nachbagauer et al. 2011: a cantilever that shears."""
    mp.dps = 34
    stiffness = [mpf(10350000000), mpf(10350000000) / mpf("3.06"), mpf(10350000000) / mpf("3.06"), mpf(10) ** 9,
                 mpf(8625000), mpf(215625000)]
    make = lambda P: cantilever(2, stiffness, (0, P, 0))
    small, large = mpf(62500), mpf(62500000)
    found = follow(make, ramp([small, large], 8))
    at = {P: tip(*found[P], [2, 0, 0]) for P in (small, large)}
    rows.add("shear-cantilever", "u1, u2 at 62.5 MN", at[large][:2])
    rows.add("shear-cantilever", "u2 at 62.5 kN", [at[small][1]])
    rows.add("shear-cantilever", "u1 at 62.5 kN", [at[small][0]])


def princeton(rows):
    """Dowell and Traybar 1975, section of Bauchau et al. 2016."""
    mp.dps = 34
    stiffness = [mpf(v) for v in ("2841910", "640131", "903881", "3.10338", "36.2794", "2.42873")]
    loads = [mpf(v) for v in ("4.448", "8.896", "13.345")]
    fields = {"u1": [], "u2": [], "u3": [], "twist": []}
    by_angle = []
    for degrees in range(0, 91, 5):
        angle = mpf(degrees) * mp.pi / 180
        make = lambda P: cantilever(mpf(PRINCETON_LENGTH), stiffness, (0, P * mp.sin(angle), P * mp.cos(angle)))
        by_angle.append(follow(make, ramp(loads, 2)))
    for P in loads:
        for found in by_angle:
            outputs, errors = found[P]
            for name, pair in zip(("u1", "u2", "u3"), tip(outputs, errors, [mpf(PRINCETON_LENGTH), 0, 0])):
                fields[name].append(pair)
            fields["twist"].append((outputs[3:], errors[3:]))
    for name in ("u1", "u2", "u3"):
        rows.add("princeton-beam", name, fields[name])
    rows.add("princeton-beam", "twist", [twist(R, e) for R, e in fields["twist"]])


def twist(R, errors):
    """What the benchmark calls twist, from the tip's rotation matrix by rows: see the formula in the case."""
    return mp.atan2(-R[5], R[8]), sum(errors)


def princeton_2(rows):
    """Obrezkov et al. 2022: 12.3777 x 3.2024 mm, E = 71.7 GPa, nu = 0.31."""
    mp.dps = 34
    stiffness = [mpf(v) for v in ("2842069.4426160003", "1084759.3292427482", "1084759.3292427482", "2.9257440677494264",
                                  "2.4288718041122013", "36.285519395400414")]
    loads = [mpf("8.896"), mpf("13.345")]
    fields = [[], [], []]
    by_angle = []
    for degrees in range(0, 91, 15):
        angle = mpf(degrees) * mp.pi / 180
        make = lambda P: cantilever(mpf(PRINCETON_LENGTH), stiffness, (0, -P * mp.cos(angle), P * mp.sin(angle)))
        by_angle.append(follow(make, ramp(loads, 2)))
    for P in loads:
        for found in by_angle:
            for values, pair in zip(fields, tip(*found[P], [mpf(PRINCETON_LENGTH), 0, 0])):
                values.append(pair)
    for name, values in zip(("u1", "u2", "u3"), fields):
        rows.add("princeton-beam-2", name, values)


PROGRAMS = [bend_45, bend_quadratic, composite, twisted, helix, oblique, deep, princeton, princeton_2]
