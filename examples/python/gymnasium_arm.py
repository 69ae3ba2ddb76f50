"""An environment of Gymnasium: swing an arm under gravity up with a motor that is too weak to lift it at once.

Every episode begins with `restore`, which costs far less than a new simulation. The simulation is that of the command line: same
steps, same results.
"""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
import numpy.typing as npt

import lissom
from lissom.entries import Body, analyses, joints, loads, outputs

Observation = npt.NDArray[np.float64]


def build() -> lissom.Model:
    """A bar of 1 m that hangs from a hinge with a motor."""
    model = lissom.Model("An arm to be swung up", name="arm", gravity=[0, -9.81, 0])
    model.bodies["bar"] = Body(mass=1, inertia=[1e-3, 1 / 12, 1 / 12], position=[0.5, 0, 0])
    model.joints["hinge"] = joints.Revolute(base="ground", tip="bar", at=[0, 0, 0], axis=[0, 0, 1])
    model.inputs["motor"] = 0
    model.loads["motor"] = loads.JointTorque(joint="hinge", torque="motor")
    model.outputs["hinge"] = outputs.Relative(of="hinge")
    model.analysis = analyses.Dynamics(end=10, step=5e-3)
    return model


class ArmEnv(gymnasium.Env[Observation, Observation]):
    """Observation: cosine and sine of the angle from hanging, rate [rad/s]. Action: torque over 2 N m. A step is 50 ms long."""

    metadata = {"render_modes": []}
    PERIOD = 0.05
    TORQUE = 2.0
    STEPS = 200

    def __init__(self) -> None:
        self.observation_space = gymnasium.spaces.Box(-np.inf, np.inf, (3,), np.float64)
        self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (1,), np.float64)
        self.sim = build().simulation()
        self.start = self.sim.snapshot()
        self.steps = 0

    def _observation(self) -> Observation:
        # The bar begins along x, a quarter turn from hanging.
        angle = self.sim["hinge.angle"] + np.pi / 2
        return np.array([np.cos(angle), np.sin(angle), self.sim["hinge.rate"]])

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Observation, dict[str, Any]]:
        super().reset(seed=seed)
        self.sim.restore(self.start)
        self.sim.set("motor", float(self.np_random.uniform(-0.1, 0.1)))
        self.steps = 0
        return self._observation(), {}

    def step(self, action: Observation) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        self.sim.set("motor", self.TORQUE * float(np.clip(action[0], -1, 1)))
        self.steps += 1
        try:
            self.sim.step_to(self.steps * self.PERIOD)
        except lissom.SolutionError as error:
            # The episode ends with a failure, which differs from a regular end.
            return self._observation(), -100.0, True, False, {"error": str(error)}
        observation = self._observation()
        reward = -observation[0] - 0.01 * observation[2] ** 2
        return observation, float(reward), False, self.steps >= self.STEPS, {}


def swing_up(observation: Observation) -> Observation:
    """A policy by hand: push the way it moves."""
    return np.array([1.0 if observation[2] >= 0 else -1.0])


if __name__ == "__main__":
    env = ArmEnv()
    observation, _ = env.reset(seed=0)
    highest, total = -1.0, 0.0
    ended = False
    while not ended:
        observation, reward, terminated, truncated, _ = env.step(swing_up(observation))
        total, highest, ended = total + reward, max(highest, -observation[0]), terminated or truncated
    print(f"reward {total:.2f}, height {highest:+.3f} (from -1 to 1)")
