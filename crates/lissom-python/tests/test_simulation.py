"""Simulations taken step by step."""

from __future__ import annotations

import pickle
import time
from typing import Any

import numpy as np
import pytest

import lissom
from conftest import PENDULUM, ROOT

STONE = """
lissom = 1
point_masses.stone.mass = 1
analysis = { kind = "dynamics", end = 1, step = 0.1 }
"""


def test_steps_are_those_of_a_run() -> None:
    model = lissom.load(PENDULUM)
    result, sim = model.run(), model.simulation()
    assert sim.names == result.names and sim.units == [result.units[name] for name in sim.names]
    for index in range(len(result.time)):
        assert sim.time == result.time[index]
        assert sim["bob.x"] == result["bob.x"][index] and sim["force.f1"] == result["force.f1"][index]
        assert sim.values().tobytes() == np.array([result[name][index] for name in result.names]).tobytes()
        if not sim.is_finished:
            sim.step()
    assert sim.is_finished and sim.time == sim.end == 1.0
    with pytest.raises(ValueError, match="at its end"):
        sim.step()
    sim.step_to(1.5)
    assert sim.time == 1.5


THROWN = """
lissom = 1
[point_masses.stone]
mass = 1
velocity = [2, 0, 0]
[outputs.stone]
kind = "position"
of = "stone"
[events.far]
zero_of = "stone.x - 0.5"
stop = true
[analysis]
kind = "dynamics"
end = 1
step = 0.1
"""


def test_an_event_ends_a_simulation() -> None:
    model = lissom.loads(THROWN)
    sim = model.simulation()
    assert sim.stopped_by is None and sim.events == []
    sim.step_to(1.0)
    assert sim.stopped_by == "far" and sim.is_finished and abs(sim.time - 0.25) < 1e-12
    assert sim.events == [("far", sim.time)]
    with pytest.raises(ValueError, match="event `far`"):
        sim.step()
    sim.step_to(1.0)
    assert sim.time == 1.0 and sim.stopped_by is None and abs(sim["stone.x"] - 2.0) < 1e-9


def test_a_simulation_goes_to_any_time() -> None:
    sim = lissom.load(PENDULUM).simulation()
    sim.step_to(0.1234)
    assert sim.time == 0.1234
    for time in (0.1, float("nan"), float("inf")):
        with pytest.raises(ValueError, match="cannot go"):
            sim.step_to(time)
    with pytest.raises(KeyError, match="bob.x"):
        sim["bob"]
    with pytest.raises(KeyError, match="no column, signal, input or state; did you mean `bob.x`"):
        sim["bob.xx"]
    assert "0.1234" in repr(sim)


def test_a_snapshot_goes_on_to_the_last_bit() -> None:
    model = lissom.load(PENDULUM)
    sim = model.simulation()
    sim.step_to(0.3)
    kept = pickle.loads(pickle.dumps(sim.snapshot()))
    first = []
    for _ in range(20):
        sim.step()
        first.append(sim.values())
    for again in (sim, model.simulation()):
        again.restore(kept)
        assert again.time == 0.3
        for values in first:
            again.step()
            assert again.values().tobytes() == values.tobytes()


def test_foreign_snapshots_are_refused() -> None:
    sim = lissom.load(PENDULUM).simulation()
    sim.step()
    before = sim.values()
    for nothing in (b"", b"nothing", b"nothing at all", sim.snapshot()[:-1]):
        with pytest.raises(ValueError):
            sim.restore(nothing)
    other = lissom.loads(STONE).simulation()
    with pytest.raises(ValueError, match="another model"):
        sim.restore(other.snapshot())
    # Not with other values either: accelerations, and what is learned between steps, would be those of the other.
    heavier = lissom.load(PENDULUM, **{"point_masses.bob.mass": 3}).simulation()
    with pytest.raises(ValueError, match="values put into it"):
        sim.restore(heavier.snapshot())
    assert sim.time == 0.01 and np.array_equal(sim.values(), before)


def test_failures_name_the_time() -> None:
    sim = lissom.load(PENDULUM, **{"analysis.max_iterations": 1}).simulation()
    with pytest.raises(lissom.SolutionError, match="max_iterations"):
        sim.step()
    assert sim.time == 0


def test_warnings_are_issued_while_stepping() -> None:
    model = lissom.load(ROOT / "examples" / "four-bar.toml", **{"analysis.step": 0.05})
    with pytest.warns(lissom.ModelWarning) as of_run:
        expected = model.run().summary["warnings"]
    assert [str(warning.message) for warning in of_run] == expected
    codes = sorted(warning.split(":")[0] for warning in expected)
    assert "energy-surplus" in codes
    with pytest.warns(lissom.ModelWarning) as of_steps:
        sim = model.simulation()
        while not sim.is_finished:
            sim.step()
    # Issued when it first occurs; its figures grow afterwards.
    assert sim.warnings == expected and sorted(str(warning.message).split(":")[0] for warning in of_steps) == codes
    assert any("from t = 3.4" in str(warning.message) for warning in of_steps)
    with pytest.warns(lissom.ModelWarning) as of_time:
        model.simulation().step_to(sim.end)
    assert sorted(str(warning.message).split(":")[0] for warning in of_time) == codes


#: An arm whose shoulder is driven by its own rate.
UNSTABLE = """
lissom = 1
[bodies.upper]
mass = 1.5
inertia = [0.2, 0.12, 0.1]
position = [0, 0, -0.4]
[bodies.lower]
mass = 0.7
inertia = [0.06, 0.05, 0.07]
position = [0, 0, -1.25]
[joints]
shoulder = {{ kind = "revolute", base = "ground", tip = "upper", at = [0, 0, 0], axis = [0, -1, 0] }}
elbow = {{ kind = "revolute", base = "upper", tip = "lower", at = [0, 0, -0.9], axis = [0, -1, 0] }}
[loads]
drive = {{ kind = "joint_torque", joint = "shoulder", torque = "{gain}*shoulder.rate + 1" }}
[outputs]
shoulder = {{ kind = "relative", of = "shoulder" }}
[analysis]
kind = "dynamics"
end = 1
{control}
"""


@pytest.mark.parametrize("control", ["relative_tolerance = 1e-4", "step = 1e-5"])
def test_an_unstable_loop_ends(control: str) -> None:
    """The steps of a motion that grows without bound would become shorter without end."""
    model = lissom.loads(UNSTABLE.format(gain=1e5, control=control))
    sim, began = model.simulation(), time.monotonic()
    with pytest.raises(lissom.SolutionError, match="(?s)coordinate `(shoulder|elbow).angle`.*feedback") as caught:
        sim.step_to(1e-3)
    assert time.monotonic() - began < 60
    error = caught.value
    assert error.code == "motion-diverges" and error.time is not None and 0 < error.time < 1e-3
    assert error.part in ("shoulder.angle", "elbow.angle") and sim.time < 1e-3 and np.isfinite(sim.values()).all()
    batch = model.simulations(2)
    with pytest.warns(lissom.SolutionWarning, match="diverges"):
        batch.step_to(1e-3)
    assert batch.failed.all() and batch.errors[1].code == "motion-diverges"
    # The other sign is a damper.
    stable = lissom.loads(UNSTABLE.format(gain=-1e5, control=control)).simulation()
    stable.step_to(1e-3)
    assert stable.time == 1e-3


def test_an_unstable_controller_ends() -> None:
    """A state that is infinite after a millisecond."""
    text = UNSTABLE.format(gain=0, control="relative_tolerance = 1e-4")
    sim = lissom.loads(text + '[states]\ncharge = { start = 1, derivative = "1e3*charge*charge" }\n').simulation()
    with pytest.raises(lissom.SolutionError, match="state `charge`"):
        sim.step_to(2e-3)
    assert sim.time == pytest.approx(1e-3, rel=1e-6)


def test_inputs_are_set_from_outside() -> None:
    """A mass under an input force, bang-bang: the place is known in closed form."""
    text = """
lissom = 1
[inputs]
thrust = 0
[point_masses.cart]
mass = 2
[loads.thrust]
kind = "force"
on = "cart"
vector = [1, 0, 0]
scale = "thrust"
[outputs.cart]
kind = "position"
of = "cart"
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 2
step = 0.1
"""
    sim = lissom.loads(text).simulation()
    sim.set("thrust", values=3.0)
    sim.set("thrust", 4.0)
    assert sim["thrust"] == 4.0 and sim.inputs == ["thrust"]
    with pytest.raises(KeyError, match="did you mean `thrust`"):
        sim["trust"]
    sim.step_to(1.0)
    kept = sim.snapshot()
    sim.set("thrust", -4.0)
    sim.step_to(2.0)
    assert abs(sim["cart.x"] - 2.0) < 1e-9
    sim.restore(kept)
    sim.step_to(2.0)
    assert abs(sim["cart.x"] - 4.0) < 1e-9, "the snapshot holds the input"
    with pytest.raises(ValueError, match="thrust"):
        sim.set("trust", 1.0)
    with pytest.raises(ValueError, match="finite"):
        sim.set("thrust", float("inf"))
    # Several at once, and several columns.
    sim.set({"thrust": 2.0})
    assert sim["thrust"] == 2.0
    sim.set(["thrust"], np.array([3.0]))
    thrust, x = sim[["thrust", "cart.x"]]
    assert (thrust, x) == (3.0, sim["cart.x"])
    wrong: list[tuple[Any, ...]] = [("thrust",), (["thrust"], [1.0, 2.0]), ({"thrust": 1.0}, 2.0)]
    for arguments in wrong:
        with pytest.raises(ValueError):
            sim.set(*arguments)
    assert sim["thrust"] == 3.0
