"""Vector environment of Gymnasium: arms of two joints that reach for a position, under gravity, from random starts.

A policy of computed torques, from the equations of motion of one simulation, against random torques. Needs `pip install lissom[gym]`.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

import lissom
from lissom.entries import Body, analyses, joints, loads, outputs
from lissom.gym import VectorEnv

Array = npt.NDArray[np.float64]

TARGET = np.array([0.8, -0.5])
ANGLES, RATES = ["shoulder.angle", "elbow.angle"], ["shoulder.rate", "elbow.rate"]


def build() -> lissom.Model:
    """Two bars of 1 m in a vertical plane, with a motor at each joint."""
    model = lissom.Model("A reaching arm", name="arm", gravity=[0, -9.81, 0])
    for name, base, x in (("shoulder", "ground", 0.0), ("elbow", "shoulder_bar", 1.0)):
        bar = f"{name}_bar"
        model.bodies[bar] = Body(mass=1, inertia=[1e-3, 1 / 12, 1 / 12], position=[x + 0.5, 0, 0])
        model.joints[name] = joints.Revolute(base=base, tip=bar, at=[x, 0, 0], axis=[0, 0, 1])
        model.inputs[f"{name}_motor"] = 0
        model.loads[name] = loads.JointTorque(joint=name, torque=f"{name}_motor")
        model.outputs[name] = outputs.Relative(of=name)
    model.analysis = analyses.Dynamics(end=100, step=5e-3)
    return model


def reward(observation: Array, action: Array) -> Array:
    return np.asarray(-np.abs(observation[..., :2] - TARGET).sum(axis=-1))


def start(rng: np.random.Generator) -> tuple[Array, Array]:
    return rng.uniform(-1, 1, 2), rng.uniform(-0.5, 0.5, 2)


def environments(count: int) -> VectorEnv:
    motors = {"shoulder_motor": (-60.0, 60.0), "elbow_motor": (-60.0, 60.0)}
    return VectorEnv(
        build(), count, actions=motors, observations=ANGLES + RATES, period=0.01, steps=150, reward=reward, start=start
    )


class ComputedTorques:
    """Accelerates the joints such that they approach the target like critically damped oscillators of 6 rad/s."""

    def __init__(self) -> None:
        self.sim = build().simulation()
        self.sim.coordinates(ANGLES)

    def __call__(self, observations: Array) -> Array:
        return np.array([self.torques(*np.split(own, 2)) for own in observations])

    def torques(self, q: Array, v: Array) -> Array:
        self.sim.reset(q, v)
        return self.sim.inverse_dynamics(36 * (TARGET - q) - 12 * v)


def episode(policy: str, count: int = 8, steps: int = 150) -> tuple[float, float]:
    """Mean reward per step, and the mean distance from the target in the end [rad]."""
    envs = environments(count)
    computed, rng = ComputedTorques(), np.random.default_rng(1)
    observations, _ = envs.reset(seed=0)
    total = 0.0
    for _ in range(steps):
        actions = computed(observations) if policy == "computed" else rng.uniform(-60, 60, (count, 2))
        observations, rewards, terminations, _, _ = envs.step(actions)
        assert not terminations.any()
        total += float(rewards.mean())
    return total / steps, float(-reward(observations, actions).mean())


if __name__ == "__main__":
    for policy in ("random", "computed"):
        mean, distance = episode(policy)
        print(f"{policy} torques: reward {mean:.3f} per step, {distance:.4f} rad from the target in the end")
