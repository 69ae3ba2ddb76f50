"""Integration of ordinary differential equations to any number of digits: Gragg's midpoint rule, extrapolated [Hairer,
Norsett, Wanner, Solving Ordinary Differential Equations I, section II.9], over whatever numbers the right-hand side
is given. Knows no mechanics."""

from fractions import Fraction


def midpoint(slope, t, y, step, count):
    """Gragg's smoothed modified midpoint rule with `count` (even) substeps over `step`."""
    h = step / count
    before = y
    rate = slope(t, y)
    now = [a + h * b for a, b in zip(y, rate)]
    twice = 2 * h
    for index in range(1, count):
        rate = slope(t + index * h, now)
        before, now = now, [a + twice * b for a, b in zip(before, rate)]
    rate = slope(t + step, now)
    return [(a + b + h * c) / 2 for a, b, c in zip(now, before, rate)]


class Extrapolation:
    """The method with a number of columns (order 2 * columns) and a tolerance per step, over `scale` of the values."""

    def __init__(self, slope, tolerance, columns=12, scale=None):
        self.slope, self.tolerance, self.columns, self.scale = slope, tolerance, columns, scale
        self.counts = [2 * (row + 1) for row in range(columns)]
        self.weights = {}
        for row in range(columns):
            for column in range(1, row + 1):
                ratio = Fraction(self.counts[row], self.counts[row - column]) ** 2 - 1
                self.weights[row, column] = (ratio.denominator, ratio.numerator)
        self.evaluations = 0
        self.step = None

    def attempt(self, t, y, step):
        """The values after one step, and how much the last column changed them."""
        last = None
        for row, count in enumerate(self.counts):
            line = [midpoint(self.slope, t, y, step, count)]
            for column in range(1, row + 1):
                up, down = self.weights[row, column]
                fine, coarse = line[column - 1], last[column - 1]
                line.append([a + (a - b) * up / down for a, b in zip(fine, coarse)])
            last = line
        self.evaluations += sum(self.counts) + len(self.counts)
        scale = self.scale or [1] * len(y)
        error = max(abs(a - b) / c for a, b, c in zip(last[-1], last[-2], scale))
        return last[-1], error

    def run(self, start, y, end, first):
        """The values at `end`, from `y` at `start`; `first` is the size of the first step tried."""
        t, y = start, list(y)
        step = self.step if self.step is not None else first
        forward = end > start
        step = abs(step)
        while t != end:
            left = abs(end - t)
            cut = step >= left
            size = left if cut else (left / 2 if step > left / 2 else step)
            signed = size if forward else -size
            new, error = self.attempt(t, y, signed)
            exponent = 1.0 / (2 * self.columns - 1)
            factor = 3.0 if error == 0 else 0.8 * float(self.tolerance / error) ** exponent
            if error <= self.tolerance:
                t = end if cut else t + signed
                y = new
                if not cut or factor < 1:
                    step = size * min(3.0, max(0.2, factor))
            else:
                step = size * max(0.1, min(0.7, factor))
        self.step = step
        return y
