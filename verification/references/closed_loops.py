"""Mechanisms of one degree of freedom in closed loops: all angles and their derivatives over one of them in closed form,
then one equation of motion, M(x) x'' = Q - M'(x)/2 x'^2, without constraints."""

import cmath
import math

from mpmath import mp, mpf

from initial_value import DIGITS, along, at, cos, outputs, root, sin


def turn(angle):
    return cmath.exp(1j * angle) if isinstance(angle, float) else mp.expj(angle)


def arg(z):
    return cmath.phase(z) if isinstance(z, complex) else mp.arg(z)


def acos(x):
    return math.acos(x) if isinstance(x, float) else mp.acos(x)


def pair(a, x, b, y, first, second):
    """First and second derivatives of x and y from a e^{ix} + b e^{iy} = K, where K' = first, K'' = second."""
    p, q = 1j * a * turn(x), 1j * b * turn(y)
    d = p.real * q.imag - p.imag * q.real

    def solve(k):
        return (k.real * q.imag - k.imag * q.real) / d, (p.real * k.imag - p.imag * k.real) / d

    dx, dy = solve(first)
    ddx, ddy = solve(second + a * turn(x) * dx * dx + b * turn(y) * dy * dy)
    return dx, dy, ddx, ddy


SQUEEZER = {
    "m": ["0.04325", "0.00365", "0.02373", "0.00706", "0.07050", "0.00706", "0.05498"],
    "I": ["2.194e-6", "4.410e-7", "5.255e-6", "5.667e-7", "1.169e-5", "5.667e-7", "1.912e-5"],
    "A": ["-0.06934", "-0.00227"], "B": ["-0.03635", "0.03273"], "C": ["0.014", "0.072"],
    "c0": "4530", "l0": "0.07785", "mom": "0.033", "d": "0.028", "da": "0.0115", "e": "0.02", "ea": "0.01421", "rr": "0.007",
    "ra": "0.00092", "ss": "0.035", "sa": "0.01874", "sb": "0.01043", "sc": "0.018", "sd": "0.02", "ta": "0.02308",
    "tb": "0.00916", "u": "0.04", "ua": "0.01228", "ub": "0.00449", "zf": "0.02", "zt": "0.04", "fa": "0.01421",
}


class Squeezer:
    """Andrews' mechanism over the angle of its crank; lengths, masses and signs as in the Test Set for IVP Solvers."""

    def __init__(self, number):
        self.p = {name: [number(v) for v in value] if isinstance(value, list) else number(value)
                  for name, value in SQUEEZER.items()}
        self.number = number
        p = self.p
        make = complex if number is float else mp.mpc
        self.A, self.B = make(*p["A"]), make(*p["B"])

    def angles(self, beta):
        """All seven over the crank's, with first and second derivatives."""
        p = self.p
        quarter = math.pi / 2 if isinstance(beta, float) else mp.pi / 2
        crank = p["rr"] * turn(beta)
        z = crank - self.B
        size = abs(z)
        gamma = arg(z) - quarter + acos((p["d"] ** 2 - size**2 - p["ss"] ** 2) / (2 * p["ss"] * size))
        coupler = arg(z + 1j * p["ss"] * turn(gamma))
        # d e^{i coupler} - i ss e^{i gamma} = rr e^{i beta} - B
        down, ddown = 1j * crank, -crank
        dc, dg, ddc, ddg = pair(p["d"], coupler, -1j * p["ss"], gamma, down, ddown)
        F = crank - p["d"] * turn(coupler)
        bar = p["d"] * turn(coupler)
        dF, ddF = 1j * crank - 1j * bar * dc, -crank + bar * dc * dc - 1j * bar * ddc
        z = F - self.A
        size = abs(z)
        delta = arg(z) + acos((size**2 + p["zt"] ** 2 - p["e"] ** 2) / (2 * size * p["zt"]))
        both = arg((p["zt"] * turn(delta) - z) / 1j)
        dd, db, ddd, ddb = pair(p["zt"], delta, -1j * p["e"], both, dF, ddF)
        epsilon = arg(z) - quarter + acos((p["zf"] ** 2 - size**2 - p["u"] ** 2) / (2 * p["u"] * size))
        sum_ = arg(z + 1j * p["u"] * turn(epsilon))
        ds, de, dds, dde = pair(p["zf"], sum_, -1j * p["u"], epsilon, dF, ddF)
        # theta goes with the crank; its own part stays within a turn.
        twice = 4 * quarter
        gamma = wrapped(gamma, twice)
        epsilon = wrapped(epsilon, twice)
        sum_ = wrapped(sum_, twice)
        q = [beta, coupler - beta, gamma, both - delta, delta, sum_ - epsilon, epsilon]
        one = self.number(1)
        first = [one, dc - 1, dg, db - dd, dd, ds - de, de]
        second = [0 * one, ddc, ddg, ddb - ddd, ddd, dds - dde, dde]
        return q, first, second

    def masses(self, q):
        p, m, I = self.p, self.p["m"], self.p["I"]
        _, th, _, ph, _, om, _ = q
        M = [[0] * 7 for _ in range(7)]
        e, z = p["e"] - p["ea"], p["zf"] - p["fa"]
        M[0][0] = (m[0] * p["ra"] ** 2 + m[1] * (p["rr"] ** 2 - 2 * p["da"] * p["rr"] * cos(th) + p["da"] ** 2) + I[0] + I[1])
        M[1][0] = M[0][1] = m[1] * (p["da"] ** 2 - p["da"] * p["rr"] * cos(th)) + I[1]
        M[1][1] = m[1] * p["da"] ** 2 + I[1]
        M[2][2] = m[2] * (p["sa"] ** 2 + p["sb"] ** 2) + I[2]
        M[3][3] = m[3] * e**2 + I[3]
        M[4][3] = M[3][4] = m[3] * (e**2 + p["zt"] * e * sin(ph)) + I[3]
        M[4][4] = (m[3] * (p["zt"] ** 2 + 2 * p["zt"] * e * sin(ph) + e**2) + m[4] * (p["ta"] ** 2 + p["tb"] ** 2) + I[3] + I[4])
        M[5][5] = m[5] * z**2 + I[5]
        M[6][5] = M[5][6] = m[5] * (z**2 - p["u"] * z * sin(om)) + I[5]
        M[6][6] = (m[5] * (z**2 - 2 * p["u"] * z * sin(om) + p["u"] ** 2) + m[6] * (p["ua"] ** 2 + p["ub"] ** 2) + I[5] + I[6])
        return M

    def forces(self, q, v):
        p, m = self.p, self.p["m"]
        _, th, ga, ph, _, om, _ = q
        db, dt, _, dp, dd, do, de = v
        xd = p["sd"] * cos(ga) + p["sc"] * sin(ga) + p["B"][0]
        yd = p["sd"] * sin(ga) - p["sc"] * cos(ga) + p["B"][1]
        length = root((xd - p["C"][0]) ** 2 + (yd - p["C"][1]) ** 2)
        pull = -p["c0"] * (length - p["l0"]) / length
        fx, fy = pull * (xd - p["C"][0]), pull * (yd - p["C"][1])
        e, z = p["e"] - p["ea"], p["zf"] - p["fa"]
        return [
            p["mom"] - m[1] * p["da"] * p["rr"] * dt * (dt + 2 * db) * sin(th),
            m[1] * p["da"] * p["rr"] * db * db * sin(th),
            fx * (p["sc"] * cos(ga) - p["sd"] * sin(ga)) + fy * (p["sd"] * cos(ga) + p["sc"] * sin(ga)),
            m[3] * p["zt"] * e * dd * dd * cos(ph),
            -m[3] * p["zt"] * e * dp * (dp + 2 * dd) * cos(ph),
            -m[5] * p["u"] * z * de * de * cos(om),
            m[5] * p["u"] * z * do * (do + 2 * de) * cos(om),
        ]

    def slope(self, y):
        q, first, second = self.angles(y[0])
        rate = y[1]
        M = self.masses(q)
        f = self.forces(q, [v * rate for v in first])
        push = [sum(row[k] * second[k] for k in range(7) if row[k] != 0) * rate * rate for row in M]
        pull = [sum(row[k] * first[k] for k in range(7) if row[k] != 0) for row in M]
        inertia = sum(a * b for a, b in zip(first, pull))
        return [rate, sum(a * (b - c) for a, b, c in zip(first, f, push)) / inertia]


def wrapped(angle, turn_):
    """An angle between minus and plus half a turn."""
    half = turn_ / 2
    while angle > half:
        angle -= turn_
    while angle < -half:
        angle += turn_
    return angle


def andrews(rows):
    """Andrews' squeezing mechanism: the test set's start to 0.03 s, and the IFToMM library's to 0.05 s."""
    mp.dps = DIGITS
    exact, rough = Squeezer(mpf), Squeezer(float)
    slope = lambda t, y: (rough if isinstance(t, float) else exact).slope(y)
    start = {"andrews-squeezer": mpf("-0.0617138900142764496358948458001"), "andrews-squeezer-a03": mpf("-0.0620")}
    check = exact.angles(start["andrews-squeezer"])[0]
    known = ["0", "0.455279819163070380255912382449", "0.222668390165885884674473185609",
             "0.487364979543842550225598953530", "-0.222668390165885884674473185609", "1.23054744454982119249735015568"]
    rows.note(f"angles at the start less the test set's: {mp.nstr(max(abs(a - mpf(b)) for a, b in zip(check[1:], known)), 2)}")
    for case, end in (("andrews-squeezer", "0.03"), ("andrews-squeezer-a03", "0.05")):
        found = at(slope, [start[case], mpf(0)], [mpf(end)], "1e-4", scale=[1, 1000])
        q = outputs(found, lambda y: exact.angles(y[0])[0])[mpf(end)]
        v = outputs(found, lambda y: [w * y[1] for w in exact.angles(y[0])[1]])[mpf(end)]
        rows.add(case, f"seven angles at {end} s" + (" [rad]" if case.endswith("a03") else ""), q)
        if case == "andrews-squeezer":
            rows.add(case, "seven angular velocities at 0.03 s", v)
            for name, value in zip(("beta", "theta", "gamma", "phi", "delta", "omega", "epsilon"), q):
                rows.add(case, f"{name} at 0.03 s", [value])
            rows.refinement(case, "step, Radau IIA", q)
            rows.add("andrews-squeezer-fine", "seven angles at 0.03 s [rad]", q)
        curve = along(slope, [start[case], 0], rows.instants(case, "angles.csv"), lambda y: rough.angles(y[0])[0], error=1e-9)
        rows.table(case, "angles.csv", [1, 2, 3, 4, 5, 6, 7], curve)


class Jet:
    """A value with its first and second derivative."""

    __slots__ = ("v", "d", "s")

    def __init__(self, v, d=0, s=0):
        self.v, self.d, self.s = v, d, s

    def __add__(self, o):
        return Jet(self.v + o.v, self.d + o.d, self.s + o.s)

    def __sub__(self, o):
        return Jet(self.v - o.v, self.d - o.d, self.s - o.s)

    def __mul__(self, o):
        return Jet(self.v * o.v, self.d * o.v + self.v * o.d, self.s * o.v + 2 * self.d * o.d + self.v * o.s)


class Bricard:
    """Five rods of 1 m and 1 kg, six hinges along Y Z X Y Z X. The loop closes where alternate angles a and b obey
    (1 + cos a)(1 + cos b) = 1: sin(a/2) = sqrt(3)/2 sin x, tan(b/2) = sqrt(3) cos x."""

    def __init__(self, number):
        self.number = number
        self.three = root(number(3))
        axial, across = number(1) / 600, number("1.01" if number is mpf else 1.01) / 12
        # Moments of inertia as integrals over the squares along each axis of the rod's section.
        self.length, self.side = across - axial / 2, axial / 2

    def half_angles(self, x):
        """Sine and cosine of a and b with two derivatives over x, turned so that the start has none."""
        s, c = sin(x), cos(x)
        r = self.three
        half = Jet(r / 2 * s, r / 2 * c, -r / 2 * s)
        other = self.root(Jet(self.number(1)) - half * half)
        tangent = Jet(r * c, -r * s, -r * c)
        both = self.inverse(Jet(self.number(1)) + tangent * tangent)
        two = Jet(self.number(2))
        one = Jet(self.number(1))
        return (two * half * other, one - two * half * half), (two * tangent * both, two * both - one)

    @staticmethod
    def root(j):
        v = root(j.v)
        d = j.d / (2 * v)
        return Jet(v, d, (j.s / 2 - d * d) / v)

    @staticmethod
    def inverse(j):
        v = 1 / j.v
        return Jet(v, -j.d * v * v, (2 * j.d * j.d * v - j.s) * v * v)

    def rods(self, x):
        """Of each rod: its start and its axes (by columns), as jets."""
        (sa, ca), (sb, cb) = self.half_angles(x)
        # The angles at the start are minus a quarter: measured from there, sin(a + quarter) = cos a, cos = -sin a.
        odd, even = (ca, Jet(0) - sa), (cb, Jet(0) - sb)
        one, zero = Jet(self.number(1)), Jet(self.number(0))
        R = [[one, zero, zero], [zero, one, zero], [zero, zero, one]]
        place = [zero, zero, zero]
        found = []
        for axis, (s, c), along_ in ((1, odd, (0, 1)), (2, even, (1, -1)), (0, odd, (2, 1)), (1, even, (0, -1)), (2, odd, (1, 1))):
            i, j = (axis + 1) % 3, (axis + 2) % 3
            R = [list(row) for row in R]
            for row in R:
                row[i], row[j] = row[i] * c + row[j] * s, row[j] * c - row[i] * s
            column, sign = along_
            step = [row[column] * Jet(self.number(sign)) for row in R]
            found.append((place, R, column, step))
            place = [a + b for a, b in zip(place, step)]
        return found, place

    def slope(self, y):
        x, rate = y
        g = self.number("9.81" if self.number is mpf else 9.81)
        found, _ = self.rods(x)
        inertia, change, push = 0, 0, 0
        for place, R, column, step in found:
            for k in range(3):
                d, s = place[k].d + step[k].d / 2, place[k].s + step[k].s / 2
                inertia += d * d
                change += d * s
                if k == 1:
                    push -= g * d
                for axis in range(3):
                    e = self.length if axis == column else self.side
                    jet = R[k][axis]
                    inertia += e * jet.d * jet.d
                    change += e * jet.d * jet.s
        return [rate, (push - change * rate * rate) / inertia]

    def corner(self, x):
        found, _ = self.rods(x)
        return [jet.v for jet in found[2][0]]


def bricard(rows):
    """The rectangular Bricard mechanism of the IFToMM library, A04."""
    mp.dps = DIGITS
    exact, rough = Bricard(mpf), Bricard(float)
    slope = lambda t, y: (rough if isinstance(t, float) else exact).slope(y)
    # a = b = -90 degrees.
    start = -mp.asin(mp.sqrt(mpf(2) / 3))
    start = -mp.pi + -start
    _, end = exact.rods(start)
    gap = max(abs(jet.v - w) for jet, w in zip(end, (0, 0, 1)))
    wide = max(abs(jet.v - w) for jet, w in zip(exact.rods(mpf("0.3"))[1], (0, 0, 1)))
    rows.note(f"the loop closes to {mp.nstr(gap, 2)} at the start, to {mp.nstr(wide, 2)} elsewhere")
    found = outputs(at(slope, [start, mpf(0)], [1, 10], "0.05"), lambda y: exact.corner(y[0]))
    rows.add("bricard", "P3 at 1 s", found[1])
    rows.add("bricard", "P3 at 10 s", found[10])
    rows.refinement("bricard", "step, Radau IIA, at 1 s", found[1])
    curve = along(slope, [start, 0], rows.instants("bricard", "P3.csv"), lambda y: rough.corner(y[0]), error=1e-9)
    rows.table("bricard", "P3.csv", [1, 2, 3], curve)


PROGRAMS = [andrews, bricard]
