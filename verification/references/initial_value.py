"""Motions: in many digits at a few instants, with the error from two tolerances; in double precision at all the instants
of a reference curve."""

import math

from mpmath import mp, mpf
from scipy.integrate import solve_ivp

from extrapolation import Extrapolation

DIGITS = 34


def sin(x):
    return math.sin(x) if isinstance(x, float) else mp.sin(x)


def cos(x):
    return math.cos(x) if isinstance(x, float) else mp.cos(x)


def root(x):
    return math.sqrt(x) if isinstance(x, float) else mp.sqrt(x)


def at(slope, start, instants, first, tolerances=(18, 21), scale=None, columns=12):
    """The state at `instants` (ascending, from 0) in many digits: instant -> (values of both tolerances)."""
    found = {}
    for power in tolerances:
        method = Extrapolation(slope, mpf(10) ** -power, columns, scale)
        t, y = mpf(0), list(start)
        for instant in instants:
            y = method.run(t, y, mpf(instant), mpf(first))
            t = mpf(instant)
            found.setdefault(instant, []).append(y)
    return found


def outputs(found, formula):
    """Values of `formula` over the state with their changes from one tolerance to the next."""
    result = {}
    for instant, (loose, tight) in found.items():
        pairs = zip(formula(tight), formula(loose))
        result[instant] = [(a, abs(a - b) + abs(a) * mpf(10) ** -28) for a, b in pairs]
    return result


def along(slope, start, instants, formula, method="DOP853", tolerance=1e-13, error=1e-10):
    """A curve in double precision; `error` is what is to be expected of it."""
    start = [float(v) for v in start]
    run = solve_ivp(lambda t, y: slope(t, y.tolist()), (0.0, max(instants)), start, method=method,
                    t_eval=sorted(instants), rtol=tolerance, atol=tolerance)
    if not run.success:
        raise ArithmeticError(run.message)
    return {t: [(mpf(v), mpf(error)) for v in formula(y)] for t, y in zip(run.t.tolist(), run.y.T.tolist())}
