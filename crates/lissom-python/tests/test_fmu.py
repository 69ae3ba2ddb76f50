"""Functional mock-up units, driven by FMPy against our own steps."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi3 import FMU3Slave
from fmpy.validation import validate_fmu

import lissom
from conftest import ROOT
from test_simulation import THROWN

Program = Callable[..., "subprocess.CompletedProcess[str]"]
ARM = ROOT / "examples" / "controlled-arm.toml"
STEP = 0.005


@pytest.fixture
def unit(program: Program, tmp_path: Path) -> Path:
    target = tmp_path / "arm.fmu"
    ended = program("fmu", ARM, "--out", target, "--set", "analysis.end=0.2")
    if "is not in the folder of the program" in ended.stderr and "LISSOM_PROGRAM" not in os.environ:
        pytest.skip("the shared library of units is not built: cargo build --release --package lissom-fmi")
    assert ended.returncode == 0, ended.stderr
    assert "arm.fmu for " in ended.stdout
    return target


@pytest.fixture
def slave(unit: Path) -> Iterator[Any]:
    folder = extract(str(unit))
    yield instance(unit, folder)
    shutil.rmtree(folder)


def instance(unit: Path, folder: str) -> Any:
    description = read_model_description(str(unit))
    of = FMU3Slave(
        guid=description.guid,
        unzipDirectory=folder,
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="arm",
    )
    of.instantiate()
    return of


def references(unit: Path) -> dict[str, int]:
    return {variable.name: variable.valueReference for variable in read_model_description(str(unit)).modelVariables}


def test_the_description_is_valid(unit: Path) -> None:
    assert validate_fmu(str(unit)) == []
    description = read_model_description(str(unit), validate=True)
    assert description.fmiVersion == "3.0" and description.coSimulation.canGetAndSetFMUstate
    model = lissom.load(ARM)
    by = {variable.name: variable for variable in description.modelVariables}
    assert {name for name, of in by.items() if of.causality == "output"} == set(model.names)
    assert by["target"].causality == "input" and by["target"].start == "0.8"
    assert by["parameters.proportional"].causality == "parameter" and by["arm.angle"].unit == "rad"
    assert float(description.defaultExperiment.stopTime) == 0.2 and float(description.defaultExperiment.stepSize) == 1e-3


def test_a_unit_takes_our_own_steps(unit: Path) -> None:
    """With an input that changes, to the last bit."""
    names = lissom.load(ARM).names
    times = np.arange(41) * STEP
    targets = 0.8 + 0.3 * np.sin(20 * times)
    signals = np.array(list(zip(times, targets)), dtype=[("time", float), ("target", float)])
    there = simulate_fmu(str(unit), stop_time=0.2, step_size=STEP, output_interval=STEP, input=signals, output=names)
    # What FMPy did: the input of a point is set before the step from there, interpolated by itself.
    sim = lissom.load(ARM, **{"analysis.end": 0.2}).simulation()
    assert len(there) == 41
    for row, time in enumerate(there["time"]):
        if row:
            sim.set("target", float(np.interp(there["time"][row - 1], times, targets)))
            sim.step_to(float(there["time"][row - 1]) + STEP)
        for name in names[:2]:
            assert there[name][row] == pytest.approx(sim[name], abs=1e-12), (row, name)


def test_bits_are_those_of_our_own_loop(unit: Path, slave: Any) -> None:
    by = references(unit)
    names = lissom.load(ARM).names
    slave.enterInitializationMode(startTime=0.0)
    slave.exitInitializationMode()
    sim = lissom.load(ARM, **{"analysis.end": 0.2}).simulation()
    time = 0.0
    for count in range(20):
        target = 0.5 + 0.01 * count
        slave.setFloat64([by["target"]], [target])
        sim.set("target", target)
        slave.doStep(currentCommunicationPoint=time, communicationStepSize=STEP)
        sim.step_to(time + STEP)
        time += STEP
        there = np.array(slave.getFloat64([by[name] for name in names]))
        assert there.tobytes() == sim.values().tobytes(), time
    assert slave.getFloat64([by["time"], by["target"]]) == [sim.time, 0.5 + 0.01 * 19]
    slave.terminate()
    slave.freeInstance()


def test_states_are_gone_back_to(unit: Path, slave: Any) -> None:
    by = references(unit)
    angle = [by["arm.angle"]]
    slave.enterInitializationMode(startTime=0.0)
    slave.setFloat64([by["parameters.proportional"], by["target"]], [40.0, 0.6])
    slave.exitInitializationMode()
    slave.doStep(0.0, 0.05)
    state = slave.getFMUState()
    kept = slave.serializeFMUState(state)
    slave.setFloat64([by["target"]], [0.9])
    slave.doStep(0.05, 0.05)
    far = slave.getFloat64(angle)
    slave.setFMUState(state)
    slave.doStep(0.05, 0.05)
    here = slave.getFloat64(angle)
    assert here != far, "the input is part of the state"
    slave.freeFMUState(state)
    # Another instance, which knows nothing of the parameter, goes on to the same bits.
    other = instance(unit, slave.unzipDirectory)
    other.enterInitializationMode(startTime=0.0)
    other.exitInitializationMode()
    again = other.deserializeFMUState(kept)
    other.setFMUState(again)
    assert other.getFloat64([by["parameters.proportional"]]) == [40.0]
    other.doStep(0.05, 0.05)
    assert other.getFloat64(angle) == here
    sim = lissom.load(ARM, **{"parameters.proportional": 40}).simulation()
    sim.set("target", 0.6)
    sim.step_to(0.05)
    sim.step_to(0.1)
    assert here == [sim["arm.angle"]]
    for of in (slave, other):
        of.terminate()
        of.freeInstance()


def test_a_start_time_moves_the_analysis(unit: Path, slave: Any) -> None:
    by = references(unit)
    slave.enterInitializationMode(startTime=1.0)
    slave.exitInitializationMode()
    slave.doStep(1.0, STEP)
    sim = lissom.load(ARM, **{"analysis.start": 1.0, "analysis.end": 1.2}).simulation()
    sim.step_to(1.0 + STEP)
    assert slave.getFloat64([by["time"], by["arm.angle"]]) == [sim.time, sim["arm.angle"]]
    slave.terminate()
    slave.freeInstance()


def test_an_event_that_ends_the_model_ends_the_unit(program: Program, tmp_path: Path) -> None:
    file, target = tmp_path / "stone.toml", tmp_path / "stone.fmu"
    file.write_text(THROWN)
    ended = program("fmu", file, "--out", target, "--quiet")
    if ended.returncode == 2 and "LISSOM_PROGRAM" not in os.environ:
        pytest.skip("the shared library of units is not built")
    assert ended.returncode == 0, ended.stderr
    folder = extract(str(target))
    of = instance(target, folder)
    of.enterInitializationMode(startTime=0.0)
    of.exitInitializationMode()
    assert of.doStep(0.0, 0.2)[1] in (False, 0)
    needed, terminate, early, time = of.doStep(0.2, 0.2)
    assert terminate and early and abs(time - 0.25) < 1e-12
    of.terminate()
    of.freeInstance()
    shutil.rmtree(folder)


def test_what_is_not_allowed_is_an_error(unit: Path, slave: Any) -> None:
    by = references(unit)
    with pytest.raises(Exception, match="fmi3DoStep|failed|status"):
        slave.doStep(0.0, STEP)
    slave.enterInitializationMode(startTime=0.0)
    with pytest.raises(Exception):
        slave.setFloat64([by["arm.angle"]], [1.0])
    slave.exitInitializationMode()
    with pytest.raises(Exception):
        slave.setFloat64([by["parameters.proportional"]], [1.0])
    with pytest.raises(Exception):
        slave.setFloat64([by["target"]], [float("nan")])
    with pytest.raises(Exception):
        slave.doStep(0.1, STEP)
    with pytest.raises(Exception):
        slave.getFloat64([10000])
    slave.doStep(0.0, STEP)
    slave.reset()
    slave.enterInitializationMode(startTime=0.0)
    slave.exitInitializationMode()
    assert slave.getFloat64([by["time"]]) == [0.0]
    slave.terminate()
    slave.freeInstance()


def test_models_that_cannot_be_units_are_refused(program: Program, unit: Path, tmp_path: Path) -> None:
    ended = program("fmu", ARM, "--out", tmp_path / "b.fmu", "--set", 'analysis={ kind = "modes" }')
    assert ended.returncode == 2 and "no time steps" in ended.stderr and not (tmp_path / "b.fmu").exists()
    ended = program("fmu", ARM, "--library", tmp_path / "nothing.so", "--out", tmp_path / "b.fmu")
    assert ended.returncode == 2 and "nothing.so" in ended.stderr
    again = tmp_path / "again.fmu"
    assert program("fmu", ARM, "--out", again, "--set", "analysis.end=0.2", "--quiet").returncode == 0
    assert again.read_bytes() == unit.read_bytes(), "equal models give equal files"
