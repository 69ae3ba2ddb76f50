"""Tune an absorber: stiffness and damping that calm a mass after a blow, by SciPy with gradients along the steps.

The mass of 10 kg on its spring is struck; an absorber of 0.5 kg hangs on it. What is made small is the root mean square of the
mass's displacement over 4 s. `model.gradient` gives the derivatives from one run with its neighbours, so that each
iteration costs about one evaluation, however many numbers are tuned.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.optimize import OptimizeResult, minimize

import lissom
from lissom.entries import PointMass, analyses, outputs, springs

PATHS = ["springs.absorber.stiffness", "springs.absorber.damping"]


def build() -> lissom.Model:
    """Two masses in a row, on springs along x."""
    model = lissom.Model("A mass with an absorber", name="absorber")
    model.point_masses["mass"] = PointMass(mass=10, position=[0, 0, 0], velocity=[1, 0, 0])
    model.point_masses["damper"] = PointMass(mass=0.5, position=[1, 0, 0])
    model.springs["ground"] = springs.Point(base="ground", at_base=[-1, 0, 0], tip="mass", stiffness=4000, damping=2)
    model.springs["absorber"] = springs.Point(base="mass", tip="damper", stiffness=100, damping=1)
    model.outputs["mass"] = outputs.Position(of="mass")
    model.analysis = analyses.Dynamics(end=4, step=2e-3, scheme="generalized-alpha")
    return model


def tune(show: bool = True) -> tuple[OptimizeResult, list[float]]:
    """The best numbers, by their logarithms so that they stay positive, and the measure after every iteration."""
    model = build()
    course: list[float] = []

    def measure(logarithms: Any) -> tuple[float, Any]:
        numbers = np.exp(logarithms)
        gradient = model.replace(dict(zip(PATHS, numbers))).gradient("mass.x@rms", PATHS)
        # In millimetres; by the logarithm: times the number.
        return 1e3 * gradient.value, 1e3 * gradient.derivatives * numbers

    def note(intermediate_result: OptimizeResult) -> None:
        course.append(float(intermediate_result.fun))
        if show:
            print(f"iteration {len(course):2}: {course[-1]:.6f} mm")

    start = np.log([100.0, 1.0])
    course.append(measure(start)[0])
    found = minimize(measure, start, jac=True, method="BFGS", callback=note, options={"gtol": 1e-5})
    return found, course


if __name__ == "__main__":
    best, values = tune()
    stiffness, damping = np.exp(best.x)
    print(f"{values[0]:.4f} mm → {best.fun:.4f} mm with {stiffness:.3f} N/m and {damping:.4f} N s/m, {best.nfev} gradients")
