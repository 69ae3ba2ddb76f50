"""Closed forms and power series: vibrations of beams, buckling of columns, arcs."""

from mpmath import findroot, mp, mpf

from planar import with_more_digits
from shooting import DIGITS


def euler(rows):
    """Euler's column with extension and shear, P (1 - P/EA + P/GA) = pi^2 EI/(4 L^2)."""
    def load(EA, GA):
        # The lower root of P^2 (1/GA - 1/EA) + P = pi^2/4.
        a, b = 1 / mpf(GA) - 1 / mpf(EA), mp.pi**2 / 4
        return b if a == 0 else (mp.sqrt(1 + 4 * a * b) - 1) / (2 * a)

    one = with_more_digits(lambda: [load(100, 30) / mpf("2.33")])
    rows.add("euler-column", "critical load over 2.33, EA = 100, GA = 30", one)
    two = with_more_digits(lambda: [load(10**9, 10**9) / mpf("2.46")])
    rows.add("euler-column", "critical load over 2.46, EA = GA = 1e9", two)


def timoshenko(rows):
    """First frequency of a Timoshenko cantilever, steel, 0.1 x 0.1 x 1 m, shear coefficient 5/6."""
    def frequency():
        E, rho, side = mpf(210) * 10**9, mpf(7850), mpf(1) / 10
        A, I = side**2, side**4 / 12
        EI, GA = E * I, E / mpf("2.6") * A * 5 / 6

        def determinant(w):
            # w', turn', moment', shear' = S (w, turn, moment, shear)
            S = mp.matrix([[0, 1, 0, 1 / GA], [0, 0, 1 / EI, 0], [0, -rho * I * w**2, 0, -1], [-rho * A * w**2, 0, 0, 0]])
            T = mp.expm(S)
            return T[2, 2] * T[3, 3] - T[2, 3] * T[3, 2]

        return [findroot(determinant, (mpf("520.8"), mpf("520.9")), solver="secant", tol=mpf(10) ** (16 - mp.dps))]

    rows.add("beam-frequency", "first bending frequency [rad/s]", with_more_digits(frequency))


def whirl(rows):
    """Whirl of a pinned Timoshenko shaft in axes at rest: roots of a quartic, forward and backward."""
    def frequencies():
        E, rho, d = mpf(210) * 10**9, mpf(7800), mpf(1) / 10
        A, I = mp.pi * d**2 / 4, mp.pi * d**4 / 64
        GA, k = mpf(9) / 10 * E / mpf("2.6") * A, mp.pi
        found = []
        for omega in (1000, 5000):
            # (rho A w^2 - GA k^2)(rho I w^2 - 2 rho I omega w - EI k^2 - GA) - (GA k)^2 = 0
            a, b, c = rho * A, -GA * k**2, rho * I
            p, q = -2 * rho * I * omega, -E * I * k**2 - GA
            roots = mp.polyroots([a * c, a * p, a * q + b * c, b * p, b * q - (GA * k) ** 2], maxsteps=200, extraprec=200)
            roots = sorted(roots, key=lambda z: abs(z))
            lowest = [mp.re(z) for z in roots[:2]]
            found += [max(lowest), -min(lowest)]
        return found

    values = with_more_digits(frequencies)
    names = [f"first whirl frequency, {sense} at {speed} rad/s [rad/s]" for speed in (1000, 5000)
             for sense in ("forward", "backward")]
    for name, value in zip(names, values):
        rows.add("rotor-whirl", name, [value])


def flap(rows):
    """Flap of a turning Euler-Bernoulli beam by power series [Wright et al. 1982], 6 rad/s, EI = m = L = 1."""
    def frequency():
        speed, terms = mpf(6), 120

        def determinant(w):
            # EI v'''' - (T v')' - w^2 v = 0, T = speed^2 (1 - s^2)/2; clamped: v = v' = 0.
            sides = []
            for a2, a3 in ((1, 0), (0, 1)):
                a = [mpf(0)] * (terms + 4)
                a[2], a[3] = mpf(a2), mpf(a3)
                half = speed**2 / 2
                for n in range(terms):
                    # (T v')' = half ((n+2)(n+1) a[n+2] - (n+1) n a[n]) s^n
                    right = half * (n + 2) * (n + 1) * a[n + 2] - half * (n + 1) * n * a[n] + w**2 * a[n]
                    a[n + 4] = right / ((n + 4) * (n + 3) * (n + 2) * (n + 1))
                sides.append((sum(n * (n - 1) * a[n] for n in range(len(a))),
                              sum(n * (n - 1) * (n - 2) * a[n] for n in range(len(a)))))
            return sides[0][0] * sides[1][1] - sides[0][1] * sides[1][0]

        return [findroot(determinant, (mpf("7.36"), mpf("7.37")), solver="secant", tol=mpf(10) ** (12 - mp.dps))]

    rows.add("rotating-beam-flap", "first flap frequency at eta = 6, no hub", with_more_digits(frequency))


def roll_up(rows):
    """A uniform moment bends a straight beam to an arc."""
    row = rows.row("roll-up", "tip position")
    length = mpf(10)

    def places():
        found = []
        for instant, formula, _ in row["entries"]:
            angle = 2 * mp.pi * mpf(instant)
            radius = length / angle
            found.append(radius * mp.sin(angle) if formula.endswith("x") else radius * (1 - mp.cos(angle)))
        return found

    mp.dps = DIGITS
    rows.add("roll-up", "tip position", [(value, mpf(10) ** -30) for value in places()])


def extension(rows):
    """A rod that turns steadily: L (tan k/k - 1), k = omega L sqrt(m/EA)."""
    def value():
        k = 6 * 10 * mp.sqrt(mpf("1.2") / mpf("2.8e7"))
        return [10 * (mp.tan(k) / k - 1)]

    rows.add("spin-up", "mean extension of the steady turn against the rotating rod", with_more_digits(value))


PROGRAMS = [euler, timoshenko, whirl, flap, roll_up, extension]
