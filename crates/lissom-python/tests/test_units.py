"""Units of other programs in models: made by PythonFMU (FMI 2.0), PythonFMU3 (FMI 3.0) and `lissom fmu`."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fmpy import simulate_fmu

import lissom

Program = Callable[..., "subprocess.CompletedProcess[str]"]

PENDULUM = """
lissom = 1
{more}
[bodies.bob]
mass = 1
inertia = [0.01, 0.01, 0.01]
position = [0.5, 0, 0]
[joints.arm]
kind = "revolute"
base = "ground"
tip = "bob"
at = [0, 0, 0]
axis = [0, 0, 1]
[loads.motor]
kind = "joint_torque"
joint = "arm"
torque = "{torque} - 0.3*arm.rate"
[outputs.arm]
kind = "relative"
of = "arm"
[outputs.torque]
kind = "expression"
value = "{torque}"
[analysis]
kind = "dynamics"
end = 0.2
step = 0.002
"""
UNIT = """
[units.pid]
file = "Controller.fmu"
sample = 5e-3
inputs = { u = "0.5 - arm.angle", mode = MODE }
outputs = { y = "y" }
parameters = { ki = 3 }
"""
# The same controller as signals: each sample has the input of the sample before.
SIGNALS = """
[signals]
u = { value = "0.5 - arm.angle", sample = 5e-3, start = 0.5 }
x = { value = "x + 5e-3*3*u.last", sample = 5e-3, start = -7.5e-3 }
y = { value = "2*u.last + x", sample = 5e-3, start = 0 }
"""
CONTROLLER = """
import os
from {package} import {imports}

class Controller({base}):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.time = 0.0
        self.u = self.x = self.y = self.mode = 0.0
        self.ki = 1.0
        for name, causality in [("u", "input"), ("mode", "input"), ("y", "output"), ("ki", "parameter")]:
            more = {{"variability": {variability}.tunable}} if causality == "parameter" else {{}}
            self.register_variable({real}(name, causality={causality}[causality], **more))
        {time}

    def exit_initialization_mode(self):
        pass

    def do_step(self, current_time, step_size):
        if self.mode and current_time > 0.1:
            if self.mode == 1:
                os.abort()
            raise ValueError("the valve is stuck")
        self.x += self.ki*step_size*self.u
        self.y = 2*self.u + self.x
        return True
"""


def made(folder: Path, version: int) -> Path:
    """A unit of PythonFMU or PythonFMU3 in a folder."""
    second = version == 2
    text = CONTROLLER.format(
        package="pythonfmu" if second else "pythonfmu3",
        imports="Fmi2Causality, Fmi2Slave, Fmi2Variability, Real"
        if second
        else "Fmi3Causality, Fmi3Slave, Fmi3Variability, Float64",
        base="Fmi2Slave" if second else "Fmi3Slave",
        real="Real" if second else "Float64",
        causality="Fmi2Causality" if second else "Fmi3Causality",
        variability="Fmi2Variability" if second else "Fmi3Variability",
        time="pass" if second else "self.register_variable(Float64('time', causality=Fmi3Causality.independent))",
    )
    (folder / "controller.py").write_text(text)
    module = "pythonfmu" if second else "pythonfmu3"
    subprocess.run(
        [sys.executable, "-m", module, "build", "-f", "controller.py", "--no-external-tool"], cwd=folder, check=True
    )
    return folder / "Controller.fmu"


@pytest.fixture(params=[2, 3])
def folder(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    made(tmp_path, request.param)
    return tmp_path


def model(folder: Path, more: str, torque: str) -> lissom.Model:
    path = folder / "model.toml"
    path.write_text(PENDULUM.format(more=more, torque=torque))
    return lissom.load(path)


def test_a_unit_is_equal_to_signals(folder: Path) -> None:
    there = model(folder, UNIT.replace("MODE", "0"), "pid.y").run()
    # Its output at the start is not computed before the first step.
    here = model(folder, SIGNALS.replace("2*u.last", "2*u.last*min(1, t*1e6)"), "y").run()
    assert abs(here["arm.angle"][-1]) > 1e-3
    for name in ["arm.angle", "torque.value"]:
        np.testing.assert_allclose(there[name], here[name], rtol=0, atol=1e-12)


@pytest.mark.parametrize(("mode", "words"), [("1", "signal 6"), ("2", "valve is stuck")])
def test_a_failure_ends_the_run_with_its_results(folder: Path, mode: str, words: str) -> None:
    with pytest.raises(lissom.SolutionError) as failed:
        model(folder, UNIT.replace("MODE", mode), "pid.y").run()
    error = failed.value
    assert error.code == "unit-failed" and error.part == "pid"
    assert error.time is not None and 0.1 < error.time < 0.12
    assert words in str(error) and "\x1b" not in str(error)
    assert len(error.result["arm.angle"]) >= 50


def test_the_program_runs_the_same_unit(folder: Path, program: Program, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("LISSOM_UNIT_HOST", sys.executable)
    expected = model(folder, UNIT.replace("MODE", "0"), "pid.y").run()
    out = folder / "out"
    ended = program("run", folder / "model.toml", "--out", out, "--no-plots")
    assert ended.returncode == 0, ended.stderr
    np.testing.assert_array_equal(lissom.read(out)["arm.angle"], expected["arm.angle"])


def test_our_own_unit_is_a_unit_of_a_model(program: Program, tmp_path: Path) -> None:
    """A pendulum that is exported and driven by a signal in another model, against FMPy."""
    text = PENDULUM.format(more="[inputs]\ntarget = 0", torque="target")
    (tmp_path / "inner.toml").write_text(text)
    ended = program("fmu", tmp_path / "inner.toml", "--out", tmp_path / "inner.fmu")
    if "is not in the folder of the program" in ended.stderr and "LISSOM_PROGRAM" not in os.environ:
        pytest.skip("the shared library of units is not built: cargo build --release --package lissom-fmi")
    assert ended.returncode == 0, ended.stderr
    step = 0.005
    unit = f"""
[units.inner]
file = "inner.fmu"
sample = {step}
inputs = {{ target = "cos(20*t)" }}
outputs = {{ angle = "arm.angle" }}
"""
    outer = model(tmp_path, unit, "inner.angle")
    result = outer.run()
    times = np.arange(41) * step
    held: Any = np.array(list(zip(times, np.cos(20 * times))), dtype=[("time", float), ("target", float)])
    options = {"stop_time": 0.2, "step_size": step, "output_interval": step, "output": ["arm.angle"]}
    there = simulate_fmu(str(tmp_path / "inner.fmu"), input=held, **options)
    here = result["torque.value"][np.isin(np.round(result.time / 1e-3), np.arange(0, 201, 10))]
    # The times of FMPy are sums of steps, so that the unit divides some of its own.
    np.testing.assert_allclose(here, there["arm.angle"][::2], rtol=0, atol=1e-8)
    inner = lissom.load(tmp_path / "inner.toml").simulation()
    angles = [inner["arm.angle"]]
    for time in times[:-1]:
        inner.set("target", float(np.cos(20 * time)))
        inner.step_to(time + step)
        angles.append(inner["arm.angle"])
    np.testing.assert_allclose(here, angles[::2], rtol=0, atol=1e-12)

    # Snapshots contain the state of the unit.
    simulation = outer.simulation()
    simulation.step_to(0.1)
    snapshot = simulation.snapshot()
    simulation.step_to(0.2)
    expected = simulation["torque.value"]
    simulation.restore(snapshot)
    simulation.step_to(0.2)
    assert simulation["torque.value"] == expected


def test_a_forked_process_cannot_use_the_units_of_the_original(folder: Path) -> None:
    pendulum = model(folder, UNIT.replace("MODE", "0"), "pid.y")
    sim = pendulum.simulation()
    sim.step_to(0.05)
    receiver, sender = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            sim.step_to(0.2)
            words = "no error"
        except lissom.SolutionError as error:
            words = str(error)
        del sim
        os.write(sender, words.encode())
        os._exit(0)
    os.waitpid(child, 0)
    assert "the simulation belongs to the process from which this one was forked" in os.read(receiver, 4096).decode()
    sim.step_to(0.2)
    other = pendulum.simulation()
    other.step_to(0.2)
    assert sim["arm.angle"] == other["arm.angle"]


def test_units_without_states_have_no_snapshot(folder: Path) -> None:
    simulation = model(folder, UNIT.replace("MODE", "0"), "pid.y").simulation()
    simulation.step_to(0.1)
    with pytest.raises(lissom.SolutionError, match="`pid`") as failed:
        simulation.snapshot()
    assert failed.value.code == "snapshot-of-unit"
