"""Two-point problems by shooting: Newton in double precision first, then corrected in many digits with the Jacobian of
double precision, which gains some ten digits per turn."""

import numpy
from mpmath import mp, mpf
from scipy.integrate import solve_ivp

from extrapolation import Extrapolation

DIGITS = 34
LOOSE, TIGHT = mpf(10) ** -19, mpf(10) ** -23


def in_doubles(slope, start, y, end, tolerance=1e-13):
    """The values at `end` in double precision."""
    run = solve_ivp(lambda t, y: slope(t, y.tolist()), (start, end), y, method="DOP853", rtol=tolerance, atol=tolerance)
    if not run.success:
        raise ArithmeticError(run.message)
    return run.y[:, -1].tolist()


def in_digits(slope, start, y, end, tolerance):
    """The values at `end` in many digits."""
    return Extrapolation(slope, tolerance).run(mpf(start), [mpf(v) for v in y], mpf(end), mpf(end - start) / 4)


class Pass:
    """How a problem integrates: `floats`, or with a tolerance in many digits."""

    def __init__(self, tolerance=None):
        self.tolerance = tolerance

    def number(self, value):
        return float(value) if self.tolerance is None else mpf(value)

    def __call__(self, slope, start, y, end):
        if self.tolerance is None:
            return in_doubles(slope, float(start), [float(v) for v in y], float(end))
        return in_digits(slope, start, y, end, self.tolerance)


def jacobian(function, x, step=1e-6):
    columns = []
    for index in range(len(x)):
        size = step * max(1.0, abs(x[index]))
        ahead, behind = list(x), list(x)
        ahead[index] += size
        behind[index] -= size
        columns.append((numpy.array(function(ahead)) - numpy.array(function(behind))) / (2 * size))
    return numpy.array(columns).T


def solve_doubles(residual, x, tolerance=1e-9, turns=40):
    """Newton in double precision, damped; the solution and its Jacobian. Rows of the residual ought to be of size 1."""
    x = [float(v) for v in x]
    for _ in range(turns):
        value = numpy.array(residual(x))
        slope = jacobian(residual, x)
        change = numpy.linalg.solve(slope, -value)
        part = 1.0
        while part > 1e-4:
            trial = [a + part * b for a, b in zip(x, change)]
            try:
                if numpy.linalg.norm(residual(trial)) < (1 - part / 4) * numpy.linalg.norm(value) + 1e-11:
                    break
            except ArithmeticError:
                pass
            part /= 2
        x = trial
        if numpy.linalg.norm(change) <= tolerance * (1 + numpy.linalg.norm(x)):
            return x, slope
    raise ArithmeticError("shooting: no convergence in double precision")


def solve_digits(problem, x, slope):
    """The outputs of `problem(x, run) -> (residual, outputs)` in many digits from a solution in doubles: outputs, and
    their changes from a looser tolerance to a tighter one, which bound the errors from above."""
    inverse = numpy.linalg.inv(slope)
    found = []
    x = [mpf(v) for v in x]
    for tolerance in (LOOSE, TIGHT):
        run = Pass(tolerance)
        previous = None
        for _ in range(12):
            residual, outputs = problem(x, run)
            size = max(abs(v) for v in residual)
            if previous is not None and size > previous / 100:
                break
            previous = size
            change = [-sum(mpf(inverse[i, j]) * residual[j] for j in range(len(residual))) for i in range(len(x))]
            x = [a + b for a, b in zip(x, change)]
            if size < tolerance:
                break
        found.append(outputs)
    loose, tight = found
    return tight, [abs(a - b) + abs(b) * TIGHT for a, b in zip(loose, tight)], x


def solve(problem, guess):
    """`problem(x, run) -> (residual, outputs)` from a guess."""
    mp.dps = DIGITS
    floats = Pass()
    x, slope = solve_doubles(lambda x: problem(x, floats)[0], guess)
    outputs, errors, x = solve_digits(problem, x, slope)
    return outputs, errors, [float(v) for v in x]
