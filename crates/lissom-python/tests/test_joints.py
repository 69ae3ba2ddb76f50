"""Starts with given joint coordinates, and equations of motion in them."""

from __future__ import annotations

import copy
import pickle
from typing import Any

import numpy as np
import pytest

import lissom
from lissom import entries
from lissom.entries import Body


def arm(joints: int) -> lissom.Model:
    """An arm whose joints turn about the vertical and across in turn, with a torque at each."""
    model = lissom.Model("An arm", gravity=[0, 0, -9.81])
    for i in range(joints):
        model.inputs[f"u{i}"] = 0
        model.bodies[f"link{i}"] = Body(mass=2 - 0.2 * i, inertia=[0.02, 0.03, 0.01], position=[0.05, 0.02, 0.3 * i + 0.15])
        base, axis = f"link{i - 1}" if i else "ground", [0, 1, 0] if i % 2 else [0, 0, 1]
        model.joints[f"j{i}"] = entries.joints.Revolute(base=base, tip=f"link{i}", at=[0, 0, 0.3 * i], axis=axis)
        model.loads[f"motor{i}"] = entries.loads.JointTorque(joint=f"j{i}", torque=f"u{i}")
        model.outputs[f"q{i}"] = entries.outputs.Relative(of=f"j{i}")
    model.outputs["tip"] = entries.outputs.Position(of=f"link{joints - 1}")
    model.outputs["speed"] = entries.outputs.Velocity(of=f"link{joints - 1}")
    model.analysis = entries.analyses.Dynamics(end=2, step=2e-3)
    return model


def columns(joints: int, what: str) -> list[str]:
    return [f"q{i}.{what}" for i in range(joints)]


#: A parallelogram with cranks of 1 m, 2 m apart.
FOUR_BAR = """
lissom = 1
[bodies.crank]
mass = 1
inertia = [0.1, 0.1, 0.1]
position = [0, 0, 0.5]
[bodies.coupler]
mass = 1
inertia = [0.1, 0.1, 0.1]
position = [1, 0, 1]
[bodies.rocker]
mass = 1
inertia = [0.1, 0.1, 0.1]
position = [2, 0, 0.5]
[joints]
a = { kind = "revolute", base = "ground", tip = "crank", at = [0, 0, 0], axis = [0, 1, 0] }
b = { kind = "revolute", base = "crank", tip = "coupler", at = [0, 0, 1], axis = [0, 1, 0] }
c = { kind = "spherical", base = "coupler", tip = "rocker", at = [2, 0, 1] }
d = { kind = "revolute", base = "ground", tip = "rocker", at = [2, 0, 0], axis = [0, 1, 0] }
[outputs]
crank = { kind = "relative", of = "a" }
rocker = { kind = "relative", of = "d" }
[analysis]
kind = "dynamics"
end = 1
step = 1e-2
"""


def test_an_arm_starts_with_given_angles_and_rates() -> None:
    model = arm(7)
    sim = model.simulation()
    assert sim.coordinates() == [f"j{i}.angle" for i in range(7)]
    rng = np.random.default_rng(1)
    q, v = rng.uniform(-2, 2, 7), rng.uniform(-1, 1, 7)
    sim.step_to(0.1)
    sim.reset(q, v)
    assert sim.time == 0 and np.allclose(sim[columns(7, "angle")], q, rtol=0, atol=1e-12)
    assert np.allclose(sim[columns(7, "rate")], v, rtol=0, atol=1e-12) and sim.warnings == []
    # The velocity of the tip is that of its position after a short time.
    before, speed = sim[["tip.x", "tip.y", "tip.z"]], sim[["speed.v1", "speed.v2", "speed.v3"]]
    sim.step_to(1e-6)
    assert np.allclose((sim[["tip.x", "tip.y", "tip.z"]] - before) / 1e-6, speed, rtol=0, atol=1e-4)
    # By name; what is not named stays where it was drawn, at rest.
    sim.reset({"j3.angle": 0.5}, {"j1.angle": 2.0})
    assert np.allclose(sim[columns(7, "angle")], [0, 0, 0, 0.5, 0, 0, 0], rtol=0, atol=1e-12)
    assert np.allclose(sim[columns(7, "rate")], [0, 2, 0, 0, 0, 0, 0], rtol=0, atol=1e-12)
    sim.set("u0", 1.0)
    sim.reset()
    fresh = model.simulation()
    assert sim.values().tobytes() == fresh.values().tobytes() and sim["u0"] == 0
    sim.step()
    fresh.step()
    assert sim.values().tobytes() == fresh.values().tobytes()


#: Joints and inputs whose order in the file is neither alphabetical nor that of their loads.
UNSORTED = """
lissom = 1
[inputs]
u_shoulder = 0
u_elbow = 0
[bodies.upper]
mass = 2
inertia = [0.02, 0.02, 0.02]
position = [0, 0, 0.2]
[bodies.fore]
mass = 1
inertia = [0.01, 0.01, 0.01]
position = [0, 0, 0.6]
[joints]
shoulder = { kind = "revolute", base = "ground", tip = "upper", at = [0, 0, 0], axis = [0, 1, 0] }
elbow = { kind = "revolute", base = "upper", tip = "fore", at = [0, 0, 0.4], axis = [0, 1, 0] }
[loads]
bend = { kind = "joint_torque", joint = "elbow", torque = "u_elbow" }
lift = { kind = "joint_torque", joint = "shoulder", torque = "u_shoulder" }
[outputs]
elbow = { kind = "relative", of = "elbow" }
shoulder = { kind = "relative", of = "shoulder" }
[analysis]
kind = "dynamics"
end = 1
step = 1e-3
"""


def test_arrays_have_the_order_of_the_file() -> None:
    model = lissom.loads(UNSORTED)
    sim, batch = model.simulation(), model.simulations(2)
    assert sim.coordinates() == batch.coordinates() == ["shoulder.angle", "elbow.angle"]
    assert sim.inputs == batch.inputs == ["u_shoulder", "u_elbow"]
    # Without actuators as well, where all joints are coordinates.
    passive = lissom.loads("".join(line for line in UNSORTED.splitlines(keepends=True) if "torque" not in line))
    assert passive.simulation().coordinates() == ["shoulder.angle", "elbow.angle"]
    sim.reset([0.3, -0.7], [1, 2])
    batch.reset([0, 1], [0.3, -0.7], [1, 2])
    assert np.allclose(sim[["shoulder.angle", "elbow.angle"]], [0.3, -0.7], rtol=0, atol=1e-12)
    assert np.allclose(batch[["shoulder.rate", "elbow.rate"]], [1, 2], rtol=0, atol=1e-12)
    # The torques of an array in the order of the coordinates reach their joints.
    torques = sim.inverse_dynamics([3, -4])
    sim.set(sim.inputs, torques)
    batch.set(torques)
    assert batch["u_shoulder"].tolist() == [torques[0]] * 2 and batch["u_elbow"].tolist() == [torques[1]] * 2
    sim.step_to(1e-5)
    batch.step_to(1e-5)
    assert np.allclose(sim.joint_state()[1], [1 + 3e-5, 2 - 4e-5], rtol=0, atol=1e-8)
    assert np.array_equal(batch[["shoulder.rate", "elbow.rate"]], [sim[["shoulder.rate", "elbow.rate"]]] * 2)


def test_a_start_that_is_refused_changes_nothing() -> None:
    sim = arm(3).simulation()
    sim.step_to(0.1)
    before = sim.values()
    wrong: list[tuple[str, Any, Any]] = [
        ("shape", [1.0, 2.0], None),
        ("shape", None, np.zeros((3, 3))),
        ("j0.angle, j1.angle", {"j4.angle": 1.0}, None),
        ("j0.angle, j1.angle", None, {"j4.angle": 1.0}),
        ("cannot be NaN", [0.0, np.nan, 0.0], None),
    ]
    for words, q, v in wrong:
        with pytest.raises(ValueError, match=words):
            sim.reset(q, v)
    assert sim.time == 0.1 and np.array_equal(sim.values(), before)
    with pytest.raises(ValueError, match="3 degrees of freedom, but 2"):
        sim.coordinates(["j0.angle", "j1.angle"])
    assert sim.coordinates(["j2.angle", "j0.angle", "j1.angle"])[0] == "j2.angle"
    sim.reset([1.0, 2.0, 3.0])
    assert np.allclose(sim[columns(3, "angle")], [2, 3, 1], rtol=0, atol=1e-12)


def test_loops_close() -> None:
    """The rocker of a parallelogram is parallel to its crank."""
    sim = lissom.loads(FOUR_BAR).simulation()
    with pytest.raises(ValueError, match="1 degrees of freedom") as caught:
        sim.coordinates()
    assert caught.value.code == "no-joint-coordinates"  # type: ignore[attr-defined]
    assert sim.coordinates(["a.angle"]) == ["a.angle"]
    sim.reset([0.7], [2.0])
    assert np.allclose(sim[["crank.angle", "rocker.angle"]], 0.7, rtol=0, atol=1e-9)
    assert np.allclose(sim[["crank.rate", "rocker.rate"]], 2, rtol=0, atol=1e-9)
    before = sim.values()
    with pytest.raises(lissom.SolutionError, match="do not close") as open_joint:
        sim.reset({"a.angle": 0.7, "d.angle": 0.1})
    assert open_joint.value.code == "joints-do-not-close" and np.array_equal(sim.values(), before)


def test_snapshots_know_where_a_simulation_began() -> None:
    model = arm(4)
    sim, other = model.simulation(), model.simulation()
    sim.reset([0.5, 1.0, -1.0, 2.0], {"j1.angle": 3.0})
    sim.step_to(0.05)
    kept = sim.snapshot()
    sim.step_to(0.1)
    other.restore(kept)
    other.step_to(0.1)
    assert other.values().tobytes() == sim.values().tobytes()
    sim.reset()
    sim.restore(kept)
    sim.step_to(0.1)
    assert other.values().tobytes() == sim.values().tobytes()


def test_simulations_are_pickled() -> None:
    sim = arm(3).simulation()
    sim.coordinates(["j2.angle", "j0.angle", "j1.angle"])
    sim.reset([0.5, 1.0, -1.0])
    sim.set("u1", 2.0)
    sim.step_to(0.05)
    for again in (pickle.loads(pickle.dumps(sim)), copy.deepcopy(sim)):
        assert again is not sim and again.time == 0.05 and again["u1"] == 2.0 and again.coordinates() == sim.coordinates()
        later = copy.copy(sim)
        later.step_to(0.1)
        again.step_to(0.1)
        assert again.values().tobytes() == later.values().tobytes() and sim.time == 0.05


def test_a_batch_starts_with_given_angles() -> None:
    model = arm(3)
    batch, sim = model.simulations(4), model.simulation()
    q = np.random.default_rng(2).uniform(-1, 1, (2, 3))
    batch.step_to(0.01)
    batch.reset([3, 1], q, {"j2.angle": [1.0, 2.0]})
    assert batch.time.tolist() == [0.01, 0, 0.01, 0]
    angles = batch[columns(3, "angle")]
    assert np.allclose(angles[[3, 1]], q, rtol=0, atol=1e-12) and np.allclose(batch["q2.rate"][[3, 1]], [1, 2], rtol=0, atol=1e-12)
    sim.reset(q[1], {"j2.angle": 2.0})
    batch.step_to(0.02)
    sim.step_to(0.02)
    assert batch.values()[1].tobytes() == sim.values().tobytes()
    batch.reset()
    sim.reset()
    assert batch.values().tobytes() == np.array([sim.values()] * 4).tobytes()
    batch.step()
    sim.step()
    assert batch.values().tobytes() == np.array([sim.values()] * 4).tobytes()
    with pytest.raises(ValueError, match="shape"):
        batch.reset([0], q)


def test_an_arm_has_its_equations_of_motion() -> None:
    """Kinetic energy, momentum of the tip, and the accelerations of a motion give mass matrix, Jacobian and torques."""
    model = arm(7)
    model.outputs["energy"] = entries.outputs.Energy()
    model.outputs.update({f"a{i}": entries.outputs.Acceleration(of=f"link{i}") for i in range(7)})
    sim = model.simulation()
    torques = [f"u{i}" for i in range(7)]
    rng = np.random.default_rng(3)
    sim.reset(rng.uniform(-2, 2, 7), rng.uniform(-1, 1, 7))
    given = rng.uniform(-5, 5, 7)
    sim.set(torques, given)
    for _ in range(20):
        sim.step()
    q, v = sim.joint_state()
    assert np.array_equal(q, sim[columns(7, "angle")]) and np.allclose(v, sim[columns(7, "rate")], rtol=0, atol=1e-13)
    mass, bias = sim.mass_matrix(), sim.bias()
    assert np.array_equal(mass, mass.T) and 0.5 * v @ mass @ v == pytest.approx(sim["energy.kinetic"], rel=1e-12)
    jacobian = sim.jacobian("speed")
    assert np.allclose(jacobian @ v, sim[["speed.v1", "speed.v2", "speed.v3"]], rtol=0, atol=1e-12)
    assert np.allclose(sim.jacobian("tip"), jacobian, rtol=0, atol=1e-12)
    # What acts in the motion of the steps comes back from its accelerations, which are differences of recovered rates.
    accelerations = np.linalg.solve(mass, given - bias)
    assert np.allclose(sim.inverse_dynamics(accelerations), given, rtol=0, atol=1e-9)
    step = 1e-4
    sim.step_to(sim.time + step)
    after = sim.joint_state()[1]
    assert np.allclose((after - v) / step, accelerations, rtol=0, atol=2e-2 * np.abs(accelerations).max())
    with pytest.raises(ValueError, match="2 accelerations, but 7"):
        sim.inverse_dynamics([1.0, 2.0])
    with pytest.raises(ValueError, match="no output `hand`"):
        sim.jacobian("hand")


def test_a_free_object_stays_apart() -> None:
    """An arm has the same equations of motion beside a ball, a door without motor and a ball on a spring from its tip."""
    alone, scene = arm(3), arm(3)
    scene.bodies["ball"] = Body(mass=5, inertia=[0.1, 0.2, 0.3], position=[1, 1, 1], velocity=[1, 2, 3])
    scene.bodies["door"] = Body(mass=9, inertia=[1, 1, 1], position=[3, 0, 0])
    scene.joints["hinge"] = entries.joints.Revolute(base="ground", tip="door", at=[2.5, 0, 0], axis=[0, 0, 1])
    scene.outputs["ball"] = entries.outputs.Position(of="ball")
    one, other = alone.simulation(), scene.simulation()
    q, v = [0.4, -1.1, 0.7], [1.0, -2.0, 0.5]
    for sim in (one, other):
        assert sim.coordinates() == ["j0.angle", "j1.angle", "j2.angle"]
        sim.reset(q, v)
        assert np.allclose(sim.joint_state(), [q, v], rtol=0, atol=1e-12)
    assert other[["ball.x", "ball.y", "ball.z"]].tolist() == [1, 1, 1]
    assert np.allclose(one.mass_matrix(), other.mass_matrix(), rtol=1e-12, atol=1e-14)
    assert np.allclose(one.bias(), other.bias(), rtol=1e-10, atol=1e-12)
    assert np.allclose(one.jacobian("tip"), other.jacobian("tip"), rtol=0, atol=1e-12)
    batch = scene.simulations(2)
    batch.reset([0, 1], q, v)
    assert np.allclose(batch[columns(3, "angle")], [q, q], rtol=0, atol=1e-12)
    # The door has its own, and all of them together as well; a part of the arm has none, as its joints are coupled.
    assert other.coordinates(["hinge.angle"]) == ["hinge.angle"]
    assert other.mass_matrix() == pytest.approx(1 + 9 * 0.5**2)
    other.coordinates(["hinge.angle", "j0.angle", "j1.angle", "j2.angle"])
    assert np.allclose(other.mass_matrix()[1:, 0], 0, rtol=0, atol=1e-12)
    with pytest.raises(ValueError, match="3 degrees of freedom, but 2"):
        other.coordinates(["j0.angle", "j1.angle"])
    # A spring couples forces, not motions.
    scene.springs["cord"] = entries.springs.Point(base="link2", tip="ball", stiffness=100.0, length=0.1)
    tied = scene.simulation()
    tied.reset(q, v)
    assert np.allclose(tied.mass_matrix(), one.mass_matrix(), rtol=1e-12, atol=1e-14)
    assert np.abs(tied.bias() - one.bias()).max() > 1


def test_computed_torques_give_the_accelerations() -> None:
    """With the torques of the inverse dynamics the joints accelerate as asked for."""
    sim = arm(7).simulation()
    rng = np.random.default_rng(4)
    q, v, wanted = rng.uniform(-2, 2, 7), rng.uniform(-1, 1, 7), rng.uniform(-3, 3, 7)
    sim.reset(q, v)
    sim.set([f"u{i}" for i in range(7)], sim.inverse_dynamics(wanted))
    assert np.allclose(np.linalg.solve(sim.mass_matrix(), sim[[f"u{i}" for i in range(7)]] - sim.bias()), wanted, rtol=0, atol=1e-9)
    step = 1e-5
    sim.step_to(step)
    assert np.allclose(sim.joint_state()[1], v + step * wanted, rtol=0, atol=1e-7)
