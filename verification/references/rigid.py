"""Motions of rigid bodies in minimal coordinates, without constraints: pendulums, tops, governors."""

from mpmath import mp, mpf

import rod
from initial_value import DIGITS, along, at, cos, outputs, root, sin

G = mpf("9.81")


def pendulum(rows):
    """IFToMM A01: a point mass of 1 kg at 1 m, released horizontally."""
    mp.dps = DIGITS
    slope = lambda t, y: [y[1], -G * sin(y[0])] if not isinstance(t, float) else [y[1], -9.81 * sin(y[0])]
    # The angle from straight down; the bob starts at (-1, 0).
    start = [-mp.pi / 2, mpf(0)]
    place = lambda y: [sin(y[0]), -cos(y[0])]
    found = at(slope, start, [10], "0.05")
    case = "pendulum"
    rows.add(case, "place at 10 s", outputs(found, place)[10])
    speed = lambda y: [y[1] * cos(y[0]), y[1] * sin(y[0])]
    rows.add(case, "velocity at 10 s", outputs(found, speed)[10])
    tension = lambda y: [y[1] ** 2 + G * cos(y[0])]
    rows.add(case, "tension of the rod at 10 s", outputs(found, tension)[10])
    # Closed form: the angle from Jacobi's functions, released from a quarter turn, modulus sin(pi/4).
    m = mpf(1) / 2
    u = mp.ellipk(m) - mp.sqrt(G) * 10
    angle = -2 * mp.asin(mp.sqrt(m) * mp.ellipfun("sn", u, m=m))
    rows.note(f"closed form less integration: {mp.nstr(mp.sin(angle) - outputs(found, place)[10][0][0], 2)}")
    rows.table(case, "place.csv", [1, 2], along(slope, start, rows.instants(case, "place.csv"), place))


def double_pendulum(rows):
    """Two masses of 1 kg on rods of 1 m, released horizontally."""
    mp.dps = DIGITS

    def slope(t, y):
        a, b, u, v = y
        g = 9.81 if isinstance(a, float) else G
        s, c = sin(a - b), cos(a - b)
        # [2 c; c 1] (u', v') = (-v^2 s - 2 g sin a, u^2 s - g sin b)
        p, q = -v * v * s - 2 * g * sin(a), u * u * s - g * sin(b)
        d = 2 - c * c
        return [u, v, (p - c * q) / d, (2 * q - c * p) / d]

    start = [mp.pi / 2, mp.pi / 2, mpf(0), mpf(0)]
    place = lambda y: [sin(y[0]), -cos(y[0]), sin(y[0]) + sin(y[1]), -cos(y[0]) - cos(y[1])]
    found = outputs(at(slope, start, [5], "0.05"), place)[5]
    rows.add("double-pendulum", "both masses at 5 s", found)
    rows.refinement("double-pendulum", "step, Radau IIA", found)
    rows.add("double-pendulum-fine", "both masses at 5 s", found)
    instants = rows.instants("double-pendulum", "positions.csv")
    curve = along(slope, start, instants, place, error=1e-9)
    rows.table("double-pendulum", "positions.csv", [1, 2, 3, 4], curve)


def four_bars(rows):
    """IFToMM A02: N windows of rods of 1 m and 1 kg, on the branch of parallel uprights."""
    mp.dps = DIGITS
    for windows in (1, 2, 40):
        ratio = G * (mpf(windows + 1) / 2 + windows) / (mpf(windows + 1) / 3 + windows)
        slope = lambda t, y: [y[1], -(float(ratio) if isinstance(t, float) else ratio) * cos(y[0])]
        start = [mp.pi / 2, mpf(-1)]
        place = lambda y: [cos(y[0]), sin(y[0])]
        case = f"four-bar-n{windows}"
        found = outputs(at(slope, start, [10], "0.05"), place)[10]
        rows.add(case, "B at 10 s", found)
        energy = (mpf(windows + 1) / 3 + windows) / 2 + G * (mpf(windows + 1) / 2 + windows)
        rows.add(case, "energy kept", [(energy, energy * mpf(10) ** -30)])
        rows.table(case, "B.csv", [1, 2], along(slope, start, rows.instants(case, "B.csv"), place))


def heavy_top(rows):
    """Geradin and Cardona: 15 kg, 150 rad/s, held at a point 1 m from its centre of mass."""
    mp.dps = DIGITS
    mass = mpf(15)
    spin_inertia, inertia = mpf("0.46875"), mpf("0.234375") + 15

    def slope(t, y):
        g, m, Js, J = (9.81, 15.0, 0.46875, 15.234375) if isinstance(t, float) else (G, mass, spin_inertia, inertia)
        q, w = y[:4], y[4:]
        R = rod.matrix(q)
        # Weight in the body's axes, at (0, 1, 0).
        down = [-m * g * R[2][k] for k in range(3)]
        torque = [down[2], 0, -down[0]]
        L = [J * w[0], Js * w[1], J * w[2]]
        gyro = rod.cross(w, L)
        turn = rod.product(q, [0, *w])
        return [v / 2 for v in turn] + [(torque[0] - gyro[0]) / J, (torque[1] - gyro[1]) / Js, (torque[2] - gyro[2]) / J]

    start = [mpf(1), mpf(0), mpf(0), mpf(0), mpf(0), mpf(150), mpf("-4.61538")]
    scale = [1, 1, 1, 1, 100, 100, 100]
    place = lambda y: [row[1] for row in rod.matrix(y[:4])]

    def turned(y, v):
        return [sum(row[k] * v[k] for k in range(3)) for row in rod.matrix(y[:4])]

    def reaction(y):
        w, dw = y[4:], slope(mpf(0), y)[4:]
        arm = [0, 1, 0]
        a = [p + q for p, q in zip(rod.cross(dw, arm), rod.cross(w, rod.cross(w, arm)))]
        force = [mass * v for v in turned(y, a)]
        force[2] += mass * G
        return [abs(v) for v in force]

    found = at(slope, start, [2], "0.005", scale=scale)
    case = "heavy-top"
    rows.add(case, "centre of mass at 2 s", outputs(found, place)[2])
    rows.add(case, "angular velocity at 2 s", outputs(found, lambda y: turned(y, y[4:]))[2])
    rows.add(case, "reaction at the pivot at 2 s", outputs(found, reaction)[2])
    energy = (spin_inertia * 150**2 + inertia * mpf("4.61538") ** 2) / 2
    rows.add(case, "energy kept", [(energy, energy * mpf(10) ** -30)])
    rows.refinement(case, "step, Radau IIA", outputs(found, place)[2])
    curve = along(slope, start, rows.instants(case, "center.csv"), place, error=1e-9)
    rows.table(case, "center.csv", [1, 2, 3], curve)


def car_axis(rows):
    """Test Set for IVP Solvers: index-1 form, the two multipliers from the second derivatives of the constraints."""
    mp.dps = DIGITS

    def forces(t, y):
        """Accelerations and multipliers."""
        number = float if isinstance(t, float) else mpf
        K = number(mpf("5e-4"))
        xl, yl, xr, yr, ul, vl, ur, vr = y
        small, fast, L0 = number(mpf("0.1")), 10, number(mpf("0.5"))
        yb = small * sin(fast * t)
        dyb = small * fast * cos(fast * t)
        ddyb = -fast * fast * yb
        xb = root(1 - yb * yb)
        dxb = -yb * dyb / xb
        ddxb = -(dyb * dyb + yb * ddyb + dxb * dxb) / xb
        left, right = root(xl * xl + yl * yl), root((xr - xb) ** 2 + (yr - yb) ** 2)
        f = [(L0 - left) * xl / left, (L0 - left) * yl / left - K,
             (L0 - right) * (xr - xb) / right, (L0 - right) * (yr - yb) / right - K]
        dx, dy = xl - xr, yl - yr
        G1, G2 = [xb, yb, 0, 0], [2 * dx, 2 * dy, -2 * dx, -2 * dy]
        # Second derivatives without accelerations.
        h1 = ddxb * xl + ddyb * yl + 2 * (dxb * ul + dyb * vl)
        h2 = 2 * ((ul - ur) ** 2 + (vl - vr) ** 2)
        dot = lambda a, b: sum(p * q for p, q in zip(a, b))
        a11, a12, a22 = dot(G1, G1), dot(G1, G2), dot(G2, G2)
        b1, b2 = -(dot(G1, f) + K * h1), -(dot(G2, f) + K * h2)
        d = a11 * a22 - a12 * a12
        l1, l2 = (b1 * a22 - b2 * a12) / d, (a11 * b2 - a12 * b1) / d
        return [(f[k] + l1 * G1[k] + l2 * G2[k]) / K for k in range(4)], [l1, l2]

    slope = lambda t, y: list(y[4:]) + forces(t, y)[0]
    half = mpf("0.5")
    start = [mpf(0), half, mpf(1), half, -half, mpf(0), -half, mpf(0)]
    found = at(slope, start, [3], "0.01")
    case = "car-axis"
    state = outputs(found, lambda y: y)[3]
    rows.add(case, "places of both ends at 3 s", state[:4])
    rows.add(case, "velocities of both ends at 3 s", state[4:])
    multipliers = outputs(found, lambda y: forces(mpf(3), y)[1])[3]
    rows.add(case, "both multipliers at 3 s, generalised alpha", multipliers)
    rows.refinement(case, "step, Radau IIA, places", state[:4])
    rows.refinement(case, "step, Radau IIA, velocities", state[4:])
    instants = rows.instants(case, "trajectory.csv")
    rows.table(case, "trajectory.csv", [1, 2, 3, 4], along(slope, start, instants, lambda y: y[:4], error=1e-9))


def governor(rows):
    """IFToMM A05: slider, rods' angle, and the shaft's speed from its angular momentum; stiff springs and dampers."""
    mp.dps = 28
    exact = {
        "rod": mpf("0.3"), "ball": mpf(5), "slider": mpf(3), "g": G, "k": mpf(800000), "c": mpf(40000), "arm": mpf("0.05"),
        "half": mpf("0.5"), "one": mpf(1),
    }
    rough = {name: float(value) for name, value in exact.items()}

    def inertia(p):
        m = p["rod"] + p["ball"]
        center = (p["half"] * p["rod"] + p["ball"]) / m
        axial = p["rod"] * 2 / (12 * 10000 * p["one"])
        own = p["rod"] * (1 + p["one"] / 10000) / 12 + p["rod"] * (center - p["half"]) ** 2 + p["ball"] * (1 - center) ** 2
        fixed = p["rod"] * 2 / (12 * 10000 * p["one"]) + p["slider"] * 2 / (600 * p["one"]) / 2
        return m, center, axial, own, fixed

    kept = {True: inertia(rough), False: inertia(exact)}
    # The slider is a cube of 0.1 m.
    assert abs(kept[False][4] - mpf("0.005") - mpf("0.3") * 2 / 120000) < mpf(10) ** -20

    def about_z(p, angle, kind):
        m, center, axial, own, fixed = kept[kind]
        s, c = sin(angle), cos(angle)
        out = p["arm"] + center * c
        value = fixed + 2 * (axial * s * s + own * c * c + m * out * out)
        change = 2 * (2 * (axial - own) * s * c - 2 * m * out * center * s)
        return value, change

    for name, file, omega in (("fast", "fast.csv", 2 * mp.pi), ("slow", "slow.csv", mpf("0.32") * mp.pi)):
        momentum = about_z(exact, mp.pi / 6, False)[0] * omega

        def slope(t, y):
            kind = isinstance(t, float)
            p = rough if kind else exact
            m, center, axial, own, fixed = kept[kind]
            s, angle, ds, dangle = y
            sn, c = sin(angle), cos(angle)
            half = p["half"]
            across, up = half * c, 1 - half * sn - s
            length = root(across * across + up * up)
            by_angle = (-across * half * sn - up * half * c) / length
            by_slider = -up / length
            force = p["k"] * (length - half) + p["c"] * (by_angle * dangle + by_slider * ds)
            about, change = about_z(p, angle, kind)
            w = (float(momentum) if kind else momentum) / about
            swing = 2 * (own + m * center * center)
            return [ds, dangle, -p["g"] - 2 * force * by_slider / p["slider"],
                    (change * w * w / 2 + 2 * m * p["g"] * center * c - 2 * force * by_angle) / swing]

        start = [exact["half"], mp.pi / 6, mpf(0), mpf(0)]
        row = lambda y: [y[1], y[0], (float(momentum) if isinstance(y[0], float) else momentum)
                         / about_z(rough if isinstance(y[0], float) else exact, y[1], isinstance(y[0], float))[0]]
        if name == "fast":
            found = outputs(at(slope, start, [1, 10], "1e-4", (15, 17), columns=8), row)
            pairs = []
            for instant in (1, 10):
                angle, s, w = found[instant]
                pairs += [s, angle, angle, w]
            title = "slider, rods and speed at 1 s and 10 s, 2 pi rad/s"
            rows.add("flyball-governor", title, pairs)
            rows.refinement("flyball-governor", "step, Radau IIA, at 1 s", [found[1][1], found[1][0]])
        instants = rows.instants("flyball-governor", file)
        curve = along(slope, start, instants, row, "Radau", 1e-12, 1e-8)
        rows.table("flyball-governor", file, [1, 2, 3], curve)


PROGRAMS = [pendulum, double_pendulum, four_bars, heavy_top, car_axis, governor]
