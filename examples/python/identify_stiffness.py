"""Identify stiffness and damping of a spring from a noisy measurement, by least squares, with their uncertainty.

The measurement is synthetic: the pendulum of the examples with a spring of known values, and noise on its position.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import least_squares

import lissom

EXAMPLES = Path(__file__).resolve().parents[1]
PATHS = ["springs.spring.stiffness", "springs.spring.damping"]
TRUE = np.array([12.5, 0.35])
NOISE = 2e-3


def measure(model: lissom.Model) -> Any:
    """What the sensor says: the place of the bob with noise, always the same."""
    clean = model.replace(dict(zip(PATHS, TRUE))).run()["bob.x"]
    return clean + NOISE * np.random.default_rng(1).standard_normal(len(clean))


def identify(show: bool = True) -> tuple[Any, Any, list[float]]:
    """Numbers, their standard deviations, and half the sum of squares after every iteration."""
    model = lissom.load(EXAMPLES / "pendulum.toml", **{"analysis.end": 3, "springs.spring.damping": 0.1})
    measured = measure(model)
    course: list[float] = []

    def misses(numbers: Any) -> Any:
        return (model.replace(dict(zip(PATHS, numbers))).run()["bob.x"] - measured) / NOISE

    def note(intermediate_result: Any) -> None:
        course.append(float(intermediate_result.cost))
        if show:
            print(f"iteration {len(course):2}: {course[-1]:.4f} at {intermediate_result.x}")

    found = least_squares(misses, [10.0, 0.1], x_scale=[10.0, 0.1], diff_step=1e-5, callback=note)
    deviations = np.sqrt(np.diag(np.linalg.inv(found.jac.T @ found.jac)))
    return found.x, deviations, course


if __name__ == "__main__":
    numbers, deviations, _ = identify()
    for path, number, deviation, true in zip(PATHS, numbers, deviations, TRUE):
        print(f"{path} = {number:.4f} ± {deviation:.4f}, in truth {true}")
