"""Environment of Gymnasium: a robot on four legs, which starts in a crouch and is rewarded for standing upright.

Each leg has a hip and a knee, which servos turn towards the angles that the actions select. The feet touch the floor with friction.
Needs `pip install lissom[gym]`. `learn_to_stand.py` finds a policy for it.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

import lissom
from lissom.entries import Body, Contact, Ground, analyses, joints, loads, outputs
from lissom.gym import Env, VectorEnv

Array = npt.NDArray[np.float64]

LINK, FOOT = 0.2, 0.025  # length of thigh and shank, radius of a foot [m]
BEND = 1.2  # angle of the thighs in the crouch [rad]
STIFFNESS, DAMPING = 40.0, 4.0  # of the servos [N m/rad, N m s/rad]
HEIGHT = 0.36  # of a trunk that stands [m]
STANDING = (-0.75, 0.857)  # actions of hip and knee: thighs at 0.6 rad, knees at -1.2 rad
LEGS = {"front_left": (1, 1), "front_right": (1, -1), "rear_left": (-1, 1), "rear_right": (-1, -1)}
JOINTS = [f"{leg}_{joint}" for leg in LEGS for joint in ("hip", "knee")]
#: Angles of hip and knee at the actions -1 and 1 [rad]; at 0 they are those of the crouch.
RANGES = {"hip": (BEND - 0.8, BEND + 0.8), "knee": (-2 * BEND - 1.4, -2 * BEND + 1.4)}
OBSERVATIONS = (
    ["trunk.z", "attitude.alpha", "attitude.beta", "attitude.gamma"]
    + [f"{of}.{letter}{k}" for of, letter in (("velocity", "v"), ("spin", "w")) for k in (1, 2, 3)]
    + [f"{joint}.{of}" for of in ("angle", "rate") for joint in JOINTS]
)


def build() -> lissom.Model:
    """A trunk of 8 kg with four legs of 0.8 kg, in a crouch on the floor."""
    model = lissom.Model("A robot on four legs", name="quadruped", gravity=[0, 0, -9.81])
    model.ground = Ground(shape={"kind": "plane"})
    hip_height = 2 * LINK * np.cos(BEND) + FOOT
    trunk = {"kind": "box", "sides": [0.5, 0.2, 0.1]}
    model.bodies["trunk"] = Body(mass=8, inertia=trunk, shape=trunk, position=[0, 0, hip_height])
    for leg, (front, left) in LEGS.items():
        x, y = 0.2 * front, 0.13 * left
        knee_x, knee_z = x - LINK * np.sin(BEND), hip_height - LINK * np.cos(BEND)
        thigh, shank, hip, knee, foot = (f"{leg}_{part}" for part in ("thigh", "shank", "hip", "knee", "foot"))
        rod = {"kind": "capsule", "radius": 0.015, "length": LINK, "touches": False}
        ball = {"kind": "sphere", "radius": FOOT, "position": [0, 0, -LINK / 2]}
        model.bodies[thigh] = Body(
            mass=0.5,
            inertia=[2e-3, 2e-3, 2e-4],
            shape=rod,
            position=[(x + knee_x) / 2, y, (hip_height + knee_z) / 2],
            rotation=[0, BEND, 0],
        )
        model.bodies[shank] = Body(
            mass=0.3,
            inertia=[1e-3, 1e-3, 1e-4],
            shape=[rod, ball],
            position=[(x + knee_x) / 2, y, (knee_z + FOOT) / 2],
            rotation=[0, -BEND, 0],
        )
        model.joints[hip] = joints.Revolute(base="trunk", tip=thigh, at=[x, y, hip_height], axis=[0, 1, 0], angle=BEND)
        model.joints[knee] = joints.Revolute(base=thigh, tip=shank, at=[knee_x, y, knee_z], axis=[0, 1, 0], angle=-2 * BEND)
        for joint, (low, high) in zip((hip, knee), RANGES.values()):
            model.inputs[f"{joint}_action"] = 0
            target = f"({(low + high) / 2} + {(high - low) / 2}*{joint}_action)"
            model.loads[joint] = loads.JointTorque(
                joint=joint, torque=f"{STIFFNESS}*({target} - {joint}.angle) - {DAMPING}*{joint}.rate"
            )
            model.outputs[joint] = outputs.Relative(of=joint)
        model.contacts[foot] = Contact(base="ground", tip=shank, stiffness=3e4, dissipation=1, friction=0.8)
        model.outputs[foot] = outputs.ContactForce(of=foot)
    model.outputs["trunk"] = outputs.Position(of="trunk")
    model.outputs["attitude"] = outputs.CardanAngles(of="trunk")
    model.outputs["velocity"] = outputs.Velocity(of="trunk")
    model.outputs["spin"] = outputs.AngularVelocity(of="trunk")
    # Contacts of this scheme cost the same at every step, whatever touches.
    model.analysis = analyses.Dynamics(scheme="backward-euler", step=4e-3, end=10)
    return model


def upright(observation: Array) -> Array:
    """Cosine of the angle between the trunk's vertical axis and the vertical."""
    return np.asarray(np.cos(observation[..., 1]) * np.cos(observation[..., 2]))


def reward(observation: Array, action: Array) -> Array:
    """1 if the trunk stands upright at its height, with small corrections for fast motion and large actions."""
    stands = np.exp(-(((observation[..., 0] - HEIGHT) / 0.1) ** 2)) * np.maximum(upright(observation), 0)
    moves = (observation[..., 4:10] ** 2).sum(axis=-1)
    return np.asarray(stands - 0.01 * moves)


def falls(observation: Array) -> Array:
    """Whether the trunk is near the floor, or tilted by more than 60°."""
    return np.asarray((observation[..., 0] < 0.1) | (upright(observation) < 0.5))


def start(rng: np.random.Generator) -> tuple[Array, Array]:
    """A crouch slightly above the floor, tilted and bent at random."""
    tilt = np.array([1.0, *rng.uniform(-0.03, 0.03, 3)])
    trunk = [0, 0, 2 * LINK * np.cos(BEND) + FOOT + 0.05, *tilt / np.linalg.norm(tilt)]
    bent = np.tile([BEND, -2 * BEND], len(LEGS)) + rng.uniform(-0.1, 0.1, len(JOINTS))
    return np.concatenate([trunk, bent]), rng.uniform(-0.1, 0.1, 6 + len(JOINTS))


TASK: dict[str, Any] = dict(
    actions={f"{joint}_action": (-1.0, 1.0) for joint in JOINTS},
    observations=OBSERVATIONS,
    period=0.02,
    steps=100,
    reward=reward,
    terminated=falls,
    start=start,
    failure=-1.0,
)
#: Pictures show the robot where it starts.
PICTURE: dict[str, Any] = dict(size=(320, 240), view="oblique", center=(0, 0, 0.2), extent=0.9)


def environment(render_mode: str | None = None) -> Env:
    return Env(build(), render_mode=render_mode, picture=PICTURE, **TASK)


def environments(count: int) -> VectorEnv:
    return VectorEnv(build(), count, picture=PICTURE, **TASK)


if __name__ == "__main__":
    env = environment("rgb_array")
    for name, action in (("crouching", (0.0, 0.0)), ("standing", STANDING)):
        env.reset(seed=0)
        total, ended = 0.0, False
        while not ended:
            observation, gain, terminated, truncated, _ = env.step(np.tile(action, len(LEGS)))
            total, ended = total + gain, terminated or truncated
        print(f"{name}: return {total:.1f}, height {observation[0]:.3f} m, picture of {env.render().shape}")
