"""Models that are built from objects, and objects of models that were read."""

from __future__ import annotations

import copy
import dataclasses
import json
import pickle
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import lissom
from conftest import PENDULUM, ROOT
from lissom.entries import Body, Contact, Entry, Ground, PointMass, analyses, joints, loads, outputs, springs
from lissom.entries._entry import required
from lissom.entries._model_tables import CLASSES, ORDER

Program = Callable[..., "subprocess.CompletedProcess[str]"]
EXAMPLES = sorted((ROOT / "examples").glob("*.toml"))


def stone() -> lissom.Model:
    model = lissom.Model(title='A "stone"', gravity=[0, 0, -9.81])
    model.parameters["speed"] = 3.0
    model.point_masses["stone"] = PointMass(mass=2, velocity=["speed", 0, 0])
    model.outputs["stone"] = outputs.Position(of="stone")
    model.analysis = analyses.Dynamics(end=1, step=0.1)
    return model


def test_a_model_is_built_from_objects() -> None:
    model = stone()
    assert str(model) == model.to_toml() == """lissom = 1
title = "A \\"stone\\""
gravity = [0, 0, -9.81]

[parameters]
speed = 3.0

[point_masses.stone]
mass = 2
velocity = ["speed", 0, 0]

[outputs.stone]
kind = "position"
of = "stone"

[analysis]
kind = "dynamics"
end = 1
step = 0.1
"""
    result = model.run()
    assert result["stone.x"][-1] == pytest.approx(3, abs=1e-12) and result["stone.z"][-1] == pytest.approx(-4.905, abs=1e-9)
    assert model.check()["freedoms"] == 6 - 3 and model.names == ["stone.x", "stone.y", "stone.z"]
    again = lissom.loads(model.to_toml()).run()
    assert all(result[name].tobytes() == again[name].tobytes() for name in result.names)


def test_changes_count_from_then_on() -> None:
    model = stone()
    assert model.run()["stone.x"][-1] == pytest.approx(3)
    model.point_masses["stone"].velocity = [1, 0, 0]
    model.gravity = None
    assert model.run()["stone.x"][-1] == pytest.approx(1) and model.run()["stone.z"][-1] == 0
    assert model.replace({"analysis.end": 2}).run()["stone.x"][-1] == pytest.approx(2)
    model.loads["push"] = loads.Force(on="stone", vector=[0, 4, 0])
    assert model.run()["stone.y"][-1] == pytest.approx(1, rel=1e-3)
    del model.loads["push"]
    assert model.run()["stone.y"][-1] == 0
    assert model.modes is not None and pickle.loads(pickle.dumps(model)).run()["stone.x"][-1] == pytest.approx(1)


def test_a_model_that_was_read_has_objects() -> None:
    model = lissom.load(PENDULUM)
    text = model.to_toml()
    arm, spring = model.joints["arm"], model.springs["spring"]
    assert isinstance(arm, joints.SwingArm) and arm.base == "ground" and arm.axis == [0, 0, 1]
    assert isinstance(spring, springs.Torsional) and isinstance(model.analysis, analyses.Dynamics)
    assert model.to_toml() != text, "the comments are gone"
    before = lissom.load(PENDULUM).run()
    assert all(model.run()[name].tobytes() == before[name].tobytes() for name in before.names)
    spring.stiffness = 20
    other = lissom.load(PENDULUM, **{"springs.spring.stiffness": 20}).run()
    assert all(model.run()[name].tobytes() == other[name].tobytes() for name in other.names)


@pytest.mark.parametrize("file", EXAMPLES, ids=lambda file: file.stem)
def test_every_example_comes_back(file: Path) -> None:
    """Read, taken apart into objects, written, read again: the same model, to the last bit of its first steps."""
    read = lissom.load(file)
    built = lissom.load(file)
    assert all(isinstance(of, Entry) for name in CLASSES for of in entries(getattr(built, name)))
    text = built.to_toml()
    assert tree(text) == tree(read.to_toml()), "keys and values are all there"
    again = lissom.Model(name=str(file), **{name: getattr(built, name) for name in ORDER[1:] if getattr(built, name)})
    assert again.to_toml() == text
    if 'kind = "modes"' in text:
        return  # nothing is stepped
    sims = [model.simulation() for model in (read, built, again)]
    for _ in range(2):
        for sim in sims:
            sim.step()
        assert len({sim.values().tobytes() for sim in sims}) == 1


def entries(of: Any) -> list[Any]:
    return [] if of is None else [of] if isinstance(of, Entry) else list(of.values())


def tree(text: str) -> Any:
    from lissom import _toml

    return json.loads(json.dumps(_toml.parse(text), sort_keys=True))


def test_all_kinds_have_a_class(program: Program) -> None:
    """What `lissom schema` says, a new kind included, has a class with these keys."""
    ended = program("schema")
    assert ended.returncode == 0, ended.stderr
    properties = json.loads(ended.stdout)["properties"]
    assert list(properties) == list(ORDER)
    for name, classes in CLASSES.items():
        of = properties[name]
        table = of if name in ("analysis", "ground", "initial") else of["additionalProperties"]
        if not isinstance(classes, dict):
            # A class for all kinds that the other keys imply has the keys of an entry without `kind`.
            compare(classes, table["allOf"][-1]["then"] if "allOf" in table else table, set())
            continue
        branches = {next(iter(branch["if"]["properties"].values()))["const"]: branch["then"] for branch in table["allOf"]}
        assert branches.keys() == classes.keys(), name
        for word, branch in branches.items():
            compare(classes[word], branch, {next(iter(table["required"]))})


def compare(entry: type[Entry], table: dict[str, Any], tag: set[str]) -> None:
    own = {field.name.rstrip("_") for field in dataclasses.fields(entry)}  # type: ignore[arg-type]
    if entry._table == "initial":
        own -= {"motions"}
    assert own == set(table["properties"]) - tag, entry
    assert set(required(entry)) == set(table["required"]) - tag, entry
    assert entry.__doc__ and all(f"{name}: " in entry.__doc__ or f"{name}_: " in entry.__doc__ for name in own)


def test_mistakes_are_told() -> None:
    with pytest.raises(TypeError, match="axs"):
        joints.Revolute(base="ground", tip="rod", axs=[0, 0, 1])  # type: ignore[call-arg]
    joint = joints.Revolute(base="ground", tip="rod", axis=[0, 0, 1])
    with pytest.raises(AttributeError):
        joint.axs = [0, 0, 1]  # type: ignore[attr-defined]
    with pytest.raises(TypeError, match="did you mean `joints`"):
        lissom.Model(jonts={})
    model = stone()
    with pytest.raises(AttributeError):
        model.jonts = {}  # type: ignore[attr-defined]
    with pytest.raises(KeyError, match="`stne` is no entry; did you mean `stone`"):
        model.point_masses["stne"]
    with pytest.raises(KeyError, match="did you mean `bob`"):
        lissom.load(PENDULUM).point_masses["bop"]
    model.joints["a"] = Body(mass=1, inertia=[1, 1, 1])  # type: ignore[assignment]
    with pytest.raises(TypeError, match="`joints.a` is Body"):
        model.run()
    model.joints["a"] = joint
    with pytest.raises(lissom.ModelError, match="rod"):
        model.run()
    assert "axis = [0, 0, 1]" in model.to_toml(), "what is wrong can be looked at"
    with pytest.raises(lissom.ModelError, match="analysis"):
        lissom.Model().check()


def test_parts_touch_the_ground() -> None:
    model = stone()
    model.ground = Ground(shape={"kind": "plane"})
    model.bodies["ball"] = Body(mass=1, inertia=[1, 1, 1], shape={"sphere": 0.1}, position=[0, 0, 0.2])
    model.contacts["floor"] = Contact(base="ground", tip="ball", stiffness=1e4, restitution=0.5)
    model.check()
    assert '[ground]\nshape = { kind = "plane" }' in model.to_toml()


def test_objects_are_copied_and_compared() -> None:
    joint = joints.Revolute(base="ground", tip="rod", axis=np.array([0.0, 0.0, 1.0]).tolist())
    other = copy.copy(joint)
    assert other == joint and str(joint) == 'kind = "revolute"\nbase = "ground"\ntip = "rod"\naxis = [0.0, 0.0, 1.0]'
    other.tip = "arm"
    assert other != joint


def test_a_value_inside_a_part_is_not_dropped_from_the_text() -> None:
    model = lissom.load(ROOT / "examples/turbine-rotor.toml", **{"blade1.blade.elements": 4})
    with pytest.raises(ValueError, match="into a part"):
        model.to_toml()
    with pytest.raises(ValueError, match="into a part"):
        model.bodies
