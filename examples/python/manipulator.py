"""Environment of Gymnasium: an arm with three motors that is to hold its tip at a target, which differs in every episode.

The target and an unknown payload at the tip are inputs of the model; an episode draws them at random, and the model is not read again.
Needs `pip install lissom[gym]`.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

import lissom
from lissom.entries import Body, analyses, joints, loads, outputs
from lissom.gym import Env, VectorEnv

Array = npt.NDArray[np.float64]

LIFT, LENGTH = 0.3, 0.4  # height of the shoulder, length of upper arm and forearm [m]
JOINTS = ["turn", "shoulder", "elbow"]
TARGET = ["target_x", "target_y", "target_z"]
OBSERVATIONS = [f"{joint}.{of}" for of in ("angle", "rate") for joint in JOINTS] + ["tip.x", "tip.y", "tip.z"] + TARGET


def build() -> lissom.Model:
    """A turning column, an upper arm and a forearm, which point along x at first."""
    model = lissom.Model("A manipulator", name="manipulator", gravity=[0, 0, -9.81])
    for name in (*(f"{joint}_motor" for joint in JOINTS), *TARGET, "payload"):
        model.inputs[name] = 0
    model.bodies["column"] = Body(
        mass=2,
        inertia={"kind": "cylinder", "radius": 0.05, "length": LIFT},
        axes=[[0, 1, 0], [0, 0, 1]],
        position=[0, 0, LIFT / 2],
    )
    model.joints["turn"] = joints.Revolute(base="ground", tip="column", at=[0, 0, 0], axis=[0, 0, 1])
    for joint, base, link, start in (("shoulder", "column", "upper_arm", 0.0), ("elbow", "upper_arm", "forearm", LENGTH)):
        box = {"kind": "box", "sides": [LENGTH, 0.05, 0.05]}
        model.bodies[link] = Body(mass=1, inertia=box, shape=box, position=[start + LENGTH / 2, 0, LIFT])
        model.joints[joint] = joints.Revolute(base=base, tip=link, at=[start, 0, LIFT], axis=[0, -1, 0])
    for joint in JOINTS:
        model.loads[joint] = loads.JointTorque(joint=joint, torque=f"{joint}_motor - 0.2*{joint}.rate")
        model.outputs[joint] = outputs.Relative(of=joint)
    tip = [2 * LENGTH, 0, LIFT]
    model.loads["payload"] = loads.Force(on="forearm", at=tip, vector=[0, 0, -9.81], scale="payload")
    model.outputs["tip"] = outputs.Position(of="forearm", point=tip)
    model.analysis = analyses.Dynamics(end=10, step=5e-3)
    return model


def distance(observation: Array) -> Array:
    """Distance of the tip from the target [m]."""
    return np.asarray(np.linalg.norm(observation[..., 6:9] - observation[..., 9:12], axis=-1))


def start(rng: np.random.Generator) -> tuple[Array, Array]:
    return rng.uniform([-1, 0.2, -1], [1, 0.8, -0.2]), rng.uniform(-0.2, 0.2, len(JOINTS))


def episode_inputs(rng: np.random.Generator) -> dict[str, float]:
    """A target in front of the arm, which it can reach, and a payload of up to 0.5 kg."""
    bearing, reach, height = rng.uniform([-1, 0.3, 0.2], [1, 0.6, 0.6])
    target = reach * np.cos(bearing), reach * np.sin(bearing), height
    return {**dict(zip(TARGET, target)), "payload": rng.uniform(0, 0.5)}


TASK: dict[str, Any] = dict(
    actions={f"{joint}_motor": (-limit, limit) for joint, limit in zip(JOINTS, (10.0, 25.0, 12.0))},
    observations=OBSERVATIONS,
    period=0.02,
    steps=150,
    reward=lambda observation, action: -distance(observation) - 1e-4 * (action**2).sum(axis=-1),
    start=start,
    episode_inputs=episode_inputs,
    failure=-10.0,
)
PICTURE: dict[str, Any] = dict(size=(320, 240), view="oblique", center=(0.2, 0, 0.3), extent=1.6)


def environment(render_mode: str | None = None) -> Env:
    return Env(build(), render_mode=render_mode, picture=PICTURE, **TASK)


def environments(count: int) -> VectorEnv:
    return VectorEnv(build(), count, picture=PICTURE, **TASK)


class Transposed:
    """A policy by hand: torques of a spring and a damper between tip and target, with gravity compensated for an arm without payload."""

    def __init__(self) -> None:
        self.sim = build().simulation()

    def __call__(self, observation: Array) -> Array:
        q, v, tip, target = np.split(observation, 4)
        self.sim.reset(q, np.zeros(len(JOINTS)))
        jacobian = self.sim.jacobian("tip")
        return self.sim.bias() + jacobian.T @ (100 * (target - tip) - 20 * jacobian @ v)


if __name__ == "__main__":
    env, policy = environment(), Transposed()
    for name in ("no torques", "spring and damper"):
        observation, _ = env.reset(seed=0)
        first, total, ended = float(distance(observation)), 0.0, False
        while not ended:
            action = np.zeros(len(JOINTS)) if name == "no torques" else policy(observation)
            observation, gain, terminated, truncated, _ = env.step(action)
            total, ended = total + gain, terminated or truncated
        last = float(distance(observation))
        print(f"{name}: return {total:.1f}, distance {first:.3f} m at first, {last:.3f} m in the end, payload {env.sim['payload']:.2f} kg")
