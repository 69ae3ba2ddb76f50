"""Rods in the plane: elastica by elliptic integrals, frames and arches by shooting with shear and extension."""

import math

from mpmath import ellipe, ellipf, ellipk, findroot, mp, mpf

from extrapolation import Extrapolation
from shooting import DIGITS, Pass, solve, solve_doubles


def elastica_tip(load):
    """Shortening, deflection and angle of the inextensible cantilever under a dead transverse load P L^2/EI, by elliptic
    integrals [Bisshopp and Drucker 1945]."""
    root = mp.sqrt(load)

    def length(p):
        return ellipk(p**2) - ellipf(mp.asin(1 / (p * mp.sqrt(2))), p**2) - root

    # The modulus lies between 1/sqrt 2 (no load) and 1.
    low, high = mp.sqrt(mpf(1) / 2), mpf(1)
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if length(middle) < 0 else (low, middle)
    p = findroot(length, (low, high), solver="secant", tol=mpf(10) ** (-2 * mp.dps + 8))
    start = mp.asin(1 / (p * mp.sqrt(2)))
    angle = mp.asin(2 * p**2 - 1)
    rise = 1 - 2 * (ellipe(p**2) - ellipe(start, p**2)) / root
    reach = mp.sqrt(2 * mp.sin(angle) / load)
    return [reach - 1, rise, angle]


def with_more_digits(function, *arguments):
    """Values, with their change from 30 digits to 45."""
    mp.dps = 30
    coarse = function(*arguments)
    mp.dps = 45
    fine = function(*arguments)
    mp.dps = DIGITS
    return [(+a, abs(a - b) + abs(a) * mpf(10) ** -30) for a, b in zip(fine, coarse)]


def elastica_dead(rows):
    """The inextensible cantilever under a dead tip load, by elliptic integrals."""
    loads = [entry[0] for entry in rows.row("elastica-dead", LOADS_22)["entries"]][::3]
    found = {load: with_more_digits(lambda: elastica_tip(mpf(repr(load)))) for load in loads}
    rows.add("elastica-dead", LOADS_22, [pair for load in loads for pair in found[load]])
    rows.table("elastica-dead", "tip.csv", [1, 2, 3], found)
    one = with_more_digits(lambda: elastica_tip(mpf(1)))
    one = [(-one[0][0], one[0][1]), *one[1:]]
    rows.add("slenderness", "tip displacement and angle at P L^2/EI = 1", one)
    rows.add("slenderness", "tip displacement and angle, a single four-node element", one)


LOADS_22 = "shortening, deflection and angle at the tip, 22 loads"


def follower_tip(load, tolerance):
    """The inextensible cantilever whose tip load P L^2/EI turns with the tip: an initial value problem from the tip."""

    def slope(s, y):
        # From the tip backwards, in the tip's axes, the load pointing along 2: angle, moment, place.
        angle, moment, _, _ = y
        return [-moment, load * mp.cos(angle), -mp.cos(angle), -mp.sin(angle)]

    angle, _, x, y = Extrapolation(slope, tolerance).run(mpf(0), [mpf(0)] * 4, mpf(1), mpf(1) / 20)
    # The root's axes turn by `angle` against the tip's; the tip seen from the root.
    c, s = mp.cos(angle), mp.sin(angle)
    return [c * -x + s * -y, -s * -x + c * -y, abs(angle)]


def elastica_follower(rows):
    """The same under a load that follows the tip: an initial value problem from the tip backwards."""
    mp.dps = DIGITS
    name = "tip position and angle, 6 loads"
    loads = sorted({entry[0] for entry in rows.row("elastica-follower", name)["entries"]})
    found = {}
    for load in loads + [37.1457142857143]:
        loose, tight = (follower_tip(mpf(repr(load)), mpf(10) ** -power) for power in (20, 24))
        found[load] = [(a, abs(a - b) + abs(a) * mpf(10) ** -24) for a, b in zip(tight, loose)]
    places = [pair for load in loads for pair in found[load][:2]]
    rows.add("elastica-follower", name, places + [found[load][2] for load in loads])
    rows.add("elastica-follower", "tip position at 37.1457", found[37.1457142857143][:2])


def slope(soft, horizontal, vertical, bend, weight=0):
    """The plane rod over (x, y, angle, moment): compliances along, across and in bending, the force it carries, its
    curvature when unstressed, and a weight per length."""

    def rate(s, y):
        _, _, angle, moment = y
        c, sn = (math.cos(angle), math.sin(angle)) if isinstance(angle, float) else (mp.cos(angle), mp.sin(angle))
        up = vertical + weight * s if weight else vertical
        along = 1 + soft[0] * (horizontal * c + up * sn)
        across = soft[1] * (-horizontal * sn + up * c)
        x, rise = along * c - across * sn, along * sn + across * c
        return [x, rise, soft[2] * moment + bend, horizontal * rise - up * x]

    return rate


def path(problem_at, guess, first, wanted, between):
    """A shooting problem followed over its parameter, carried on from value to value."""
    floats = Pass()
    x, before = list(guess), None
    results, at = {}, first
    for value in wanted:
        for step in range(1, between + 1):
            parameter = at + (value - at) * step / between
            problem = problem_at(parameter)
            start = [2 * a - b for a, b in zip(x, before)] if before else list(x)
            before = x
            x, _ = solve_doubles(lambda v: problem(v, floats)[0], start)
        results[value] = list(x)
        at, before = value, None
    return results


def limit(problem_at, guess, first, near, spread=0.05, points=7):
    """The largest load on a path around `near`: through points at Chebyshev's places, in many digits; its error from
    leaving two of them out."""
    found = path(problem_at, guess, first, [near], 24)
    x = found[near]
    mp.dps = DIGITS
    places, loads = [], []
    for k in range(points):
        place = near + spread * math.cos(math.pi * (2 * k + 1) / (2 * points))
        outputs, _, x = solve(problem_at(place), x)
        places.append(mpf(place))
        loads.append(outputs[0])

    def top(places, loads):
        count = len(places)
        inverse = mp.matrix([[(p - mpf(near)) ** k for k in range(count)] for p in places]) ** -1
        c = [sum(inverse[k, j] * loads[j] for j in range(count)) for k in range(count)]
        d = findroot(lambda d: sum(k * c[k] * d ** (k - 1) for k in range(1, count)), mpf(0))
        return sum(c[k] * d**k for k in range(count)), d + mpf(near)

    all_points, fewer = top(places, loads), top(places[1:-1], loads[1:-1])
    return all_points[0], abs(all_points[0] - fewer[0]), all_points[1]


def lee(rows):
    """Lee's frame: column and beam of 120, hinged at the ends, the load 24 from the corner."""
    mp.dps = DIGITS
    names = {
        mpf(5) / 6: ("displacement under the load, d and u, GA = 5/6 G A", "first limit load, GA = 5/6 G A"),
        mpf(1): ("displacement under the load, d and u, GA = G A", "first limit load, GA = G A"),
    }
    for shear, (path_name, limit_name) in names.items():
        E, A, I = mpf(7200000), mpf(6), mpf(2)
        soft = [1 / (E * A), 1 / (shear * E / mpf("2.6") * A), 1 / (E * I)]
        unit = E * I / 120**2

        def problem_at(down):
            def problem(x, run):
                number = run.number
                law = [number(v) for v in soft]
                H, V, P = (v * number(unit) for v in x[1:])
                zero = number(0)
                y = run(slope(law, H, V, zero), 0, [zero, zero, x[0] + number(mp.pi) / 2, zero], 120)
                corner = [y[0], y[1], y[2] - number(mp.pi) / 2, y[3]]
                loaded = run(slope(law, H, V, zero), 0, corner, 24)
                y = run(slope(law, H, V + P, zero), 24, loaded, 120)
                residual = [(y[0] - 120) / 120, (y[1] - 120) / 120, y[3] / number(E * I / 120),
                            (120 - loaded[1] - number(down)) / 120]
                return residual, [P, loaded[0] - 24]

            return problem

        wanted = [10.0, 20.0, 30.0, 40.0]
        found = path(problem_at, [0.0, 0.0, 0.0, 0.0], 0.0, wanted, 6)
        exact = {d: solve(problem_at(d), found[d]) for d in wanted}
        rows.note("Lee's loads at d = 10 ... 40: " + ", ".join(mp.nstr(exact[d][0][0], 16) for d in wanted))
        pairs = [(mpf(d), mpf(0)) for d in wanted]
        pairs += [(exact[d][0][1], exact[d][1][1]) for d in wanted]
        rows.add("lee-frame", path_name, pairs)
        load, error, _ = limit(problem_at, found[40.0], 40.0, 48.7542)
        rows.add("lee-frame", limit_name, [(load, error)])


def arch(rows):
    """The deep arch of DaDeppo and Schmidt: clamped on the left, hinged on the right, a load at the apex."""
    mp.dps = DIGITS
    radius, half = mpf(100), mpf("107.5") * mp.pi / 180
    soft = [mpf(10) ** -8, mpf(10) ** -8, mpf(10) ** -6]
    start = [-radius * mp.sin(half), radius * mp.cos(half), half]
    length = radius * half

    def problem_at(down):
        def problem(x, run):
            number = run.number
            law = [number(v) for v in soft]
            H, V, P = (v * 100 for v in x[:3])
            bend = -1 / number(radius)
            y = run(slope(law, H, V, bend), 0, [number(v) for v in start] + [x[3] * 10000], length)
            apex = y
            y = run(slope(law, H, V + P, bend), length, y, 2 * length)
            residual = [(y[0] + number(start[0])) / 100, (y[1] - number(start[1])) / 100, y[3] / 10000,
                        (number(radius) - apex[1] - number(down)) / 100]
            return residual, [P]

        return problem

    load, error, at = limit(problem_at, [0.0, 0.0, 0.0, 0.0], 0.0, 113.7307, spread=0.2)
    rows.note(f"apex deflection at the limit {mp.nstr(at, 12)}")
    rows.add("deep-arch", "limit load", [(load, error)])


def shaft(rows):
    """The rotating shaft at its start: sag under its weight and the disk's, ends held against turning, one sliding."""
    mp.dps = DIGITS
    outer, inner, rho, g = mpf("0.05"), mpf("0.045"), mpf(7800), mpf("9.81")
    weight = rho * mp.pi * (outer**2 - inner**2) * g
    disk = mpf("70.573") * g
    soft = [1 / mpf("313.4e6"), 1 / mpf("60.5e6"), 1 / mpf("354.5e3")]

    def problem(x, run):
        number = run.number
        law, w, D = [number(v) for v in soft], number(weight), number(disk)
        zero = number(0)
        # Forces of the part behind on the part before: the shear grows by what hangs between.
        V, M = x[0] * 1000, x[1] * 1000
        y = run(slope(law, zero, V, zero, w), 0, [zero, zero, zero, M], 3)
        middle = y
        y = run(slope(law, zero, V + D, zero, w), 3, y, 6)
        return [y[1], y[2]], [middle[1], middle[0] - 3]

    outputs, errors, _ = solve(problem, [0.0, 0.0])
    rows.add("rotating-shaft", "sag at the start", [(outputs[0], errors[0])])
    rows.add("rotating-shaft", "axial displacement at the start", [(outputs[1], errors[1])])


PROGRAMS = [elastica_dead, elastica_follower, lee, arch, shaft]
