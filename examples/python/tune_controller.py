"""Tune a controller by Optuna, without gradients: gains of a PD law with which an arm reaches its target soon, with little torque.

A horizontal arm of 1 m starts at rest and is to stand at 1 rad. The measure is the mean square of the error over 2 s and a hundredth
of that of the torque. Gains enter the model file as parameters; a trial is one run. A trial whose run fails counts as pruned: Optuna
reports it and ignores its measure.
"""

from __future__ import annotations

import numpy as np
import optuna

import lissom

MODEL = """
lissom = 1
title = "An arm with a PD controller"

[parameters]
stiffness = 5
damping = 1

[bodies.arm]
mass = 1
inertia = [1e-3, "1/12", "1/12"]
position = [0.5, 0, 0]

[joints.hinge]
kind = "revolute"
base = "ground"
tip = "arm"
at = [0, 0, 0]
axis = [0, 0, 1]

[signals]
torque = "stiffness*(1 - hinge.angle) - damping*hinge.rate"

[loads.motor]
kind = "joint_torque"
joint = "hinge"
torque = "torque"

[outputs.hinge]
kind = "relative"
of = "hinge"

[outputs.torque]
kind = "signal"
of = "torque"

[analysis]
kind = "dynamics"
end = 2
step = 5e-3
"""

#: Where gains are sought, evenly in their logarithms.
RANGES = {"stiffness": (0.1, 100.0), "damping": (0.01, 10.0)}
#: What a square of torque counts beside a square of error [rad²/(N m)²].
EFFORT = 0.01


def measure(model: lissom.Model, gains: dict[str, float]) -> float:
    """Mean square of error and torque over the run, by the trapezoidal rule."""
    result = model.replace({f"parameters.{name}": value for name, value in gains.items()}).run()
    squares = (1 - result["hinge.angle"]) ** 2 + EFFORT * result["torque.value"] ** 2
    return float(np.sum(0.5 * np.diff(result.time) * (squares[1:] + squares[:-1])) / result.time[-1])


def tune(
    trials: int = 120, show: bool = True, overrides: dict[str, float] | None = None
) -> tuple[optuna.Study, list[float]]:
    """The study, and the best measure after every trial; infinite until one has completed."""
    model = lissom.loads(MODEL, "arm.toml", **(overrides or {}))

    def objective(trial: optuna.Trial) -> float:
        gains = {name: trial.suggest_float(name, *ends, log=True) for name, ends in RANGES.items()}
        try:
            return measure(model, gains)
        except lissom.SolutionError as error:
            trial.set_user_attr("diagnosis", str(error))
            raise optuna.TrialPruned(str(error)) from error

    optuna.logging.set_verbosity(optuna.logging.WARNING)
    study = optuna.create_study(sampler=optuna.samplers.TPESampler(seed=1, multivariate=True))
    course: list[float] = []

    def note(study: optuna.Study, trial: optuna.trial.FrozenTrial) -> None:
        solved = [other.value for other in study.trials if other.state.name == "COMPLETE" and other.value is not None]
        course.append(min(solved, default=np.inf))
        if show and len(course) % 20 == 0:
            print(f"after {len(course):3} trials: {course[-1]:.6f}")

    study.optimize(objective, n_trials=trials, callbacks=[note])
    return study, course


if __name__ == "__main__":
    study, course = tune()
    gains = ", ".join(f"{name} {value:.3f}" for name, value in study.best_params.items())
    print(f"{course[0]:.4f} → {study.best_value:.4f} with {gains}")
