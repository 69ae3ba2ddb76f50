"""The flexible four-bar with a misaligned revolute, quasi-static: three rods in a loop without loads, so that the force
is the same everywhere, and eight unknowns: force and moment at the driven end, and the angles of two hinges."""

import math

from mpmath import mp, mpf

import rod
from shooting import DIGITS, Pass, solve, solve_doubles


def about(axis, angle, number):
    half = angle / 2
    c, s = (math.cos(half), math.sin(half)) if isinstance(half, float) else (mp.cos(half), mp.sin(half))
    return [c] + [number(v) * s for v in axis]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def turned(q, v):
    return [sum(row[k] * v[k] for k in range(3)) for row in rod.matrix(q)]


def misaligned(rows):
    """Bauchau et al. 2016: bars of 0.12, 0.24 and 0.12 m, hinge C off by 5 degrees."""
    mp.dps = DIGITS
    stiff = rod.compliance([mpf(v) for v in ("52992000", "16880300", "16880300", "733.488", "1130.5", "1130.5")])
    slim = rod.compliance([mpf(v) for v in ("13248000", "4220080", "4220080", "45.843", "70.656", "70.656")])
    floats = {id(stiff): rod.as_floats(stiff), id(slim): rod.as_floats(slim)}
    off = 5 * mp.pi / 180
    axis_b, axis_c = [0, 1, 0], [mp.sin(off), -mp.cos(off), 0]
    force_unit, moment_unit = mpf(1000), mpf(100)

    def problem_at(drive):
        def problem(x, run):
            number = run.number
            laws = {True: [floats[id(stiff)], floats[id(slim)]], False: [stiff, slim]}[run.tolerance is None]
            n = [v * number(force_unit) for v in x[:3]]
            m = [v * number(moment_unit) for v in x[3:6]]
            half = number(mp.sqrt(mpf(1) / 2))

            def bar(law, place, turn, axes, moment, length):
                # `turn` of the bar from its first place, `axes` what its own axes were then.
                q = rod.product(turn, axes)
                y = run(rod.slope(law, n, rod.straight), 0, place + q + moment, length)
                back = [axes[0]] + [-v for v in axes[1:]]
                return y[:3], rod.product(y[3:7], back), y[7:10]

            zero, one = number(0), number(1)
            # Axis 1 of the crank along z: about y by -90 degrees; of the rocker along -z.
            up, along, down = [half, zero, -half, zero], [one, zero, zero, zero], [half, zero, half, zero]
            place, turn, m = bar(laws[0], [zero] * 3, about(axis_b, number(drive), number), up, m, number(mpf("0.12")))
            hinge_b = dot(m, turned(turn, [number(v) for v in axis_b]))
            turn = rod.product(turn, about(axis_b, x[6], number))
            place, turn, m = bar(laws[0], place, turn, along, m, number(mpf("0.24")))
            corner = place
            hinge_c = dot(m, turned(turn, [number(v) for v in axis_c]))
            turn = rod.product(turn, about(axis_c, x[7], number))
            place, turn, m = bar(laws[1], place, turn, down, m, number(mpf("0.12")))
            axis_d = turned(turn, [zero, one, zero])
            unit = number(moment_unit)
            residual = [(place[0] - number(mpf("0.24"))) * 10, place[1] * 10, place[2] * 10, axis_d[0], axis_d[2],
                        m[1] / unit, hinge_b / unit, hinge_c / unit]
            # The rocker's end turns about y alone.
            side = turned(turn, [one, zero, zero])
            angle = math.atan2(-side[2], side[0]) if isinstance(side[0], float) else mp.atan2(-side[2], side[0])
            return residual, [corner[0] - number(mpf("0.24")), corner[1], corner[2] - number(mpf("0.12")), angle]

        return problem

    x, before = [0.0] * 8, None
    found = {}
    run = Pass()
    name = "displacement of C up to 90 degrees"
    held = rows.row("misaligned-four-bar", name)["entries"][::3]
    for index in range(19):
        instant = held[index][0]
        # Fine steps where the bars come into one line.
        between = 5 if index < 17 else 40
        for part in range(1, between + 1):
            if index == 0:
                drive = 0.0
            else:
                drive = held[index - 1][0] + (instant - held[index - 1][0]) * part / between
            problem = problem_at(drive)
            guess = [2 * a - b for a, b in zip(x, before)] if before else list(x)
            before = x
            x, _ = solve_doubles(lambda v: problem(v, run)[0], guess)
        # A case holds the drive's angle to 14 digits; what it means is a multiple of five degrees.
        outputs, errors, _ = solve(problem_at(5 * index * mp.pi / 180), x)
        found[instant] = list(zip(outputs, errors))
        before = None
    rows.add("misaligned-four-bar", name, [pair for t in found for pair in found[t][:3]])
    rows.add("misaligned-four-bar", "out-of-plane displacement of C up to 90 degrees", [found[t][1] for t in found])
    rows.add("misaligned-four-bar", "rotation at D up to 90 degrees", [found[t][3] for t in found])
    rows.table("misaligned-four-bar", "C.csv", [1, 2, 3], {t: found[t][:3] for t in found})
    rows.refinement("misaligned-four-bar", "mesh, 4-node elements, quarter turn", found[held[-1][0]][:3])


PROGRAMS = [misaligned]
