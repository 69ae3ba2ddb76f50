"""The analyses around motion, which are those of the command line to the last bit."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import scipy.io
import scipy.signal

import lissom
from lissom import entries
from conftest import PENDULUM, ROOT

Program = Callable[..., "subprocess.CompletedProcess[str]"]

COLUMN = """
lissom = 1
title = "Clamped column"
[parameters]
speed = 1
load = 10
[sections.bar]
shape = "general"
stiffness = [1e7, 1e7, 1e7, 1e4, 100, 300]
mass = [1, 1, 1, 1e-3, 1e-3, 1e-3]
[beams.bar]
section = "bar"
from = [0, 0, 0]
to = [1, 0, 0]
up = [0, 0, 1]
elements = 4
[joints.root]
kind = "clamp"
base = "ground"
tip = "bar.start"
[loads.push]
kind = "force"
on = "bar.end"
vector = [-1, 0, 0]
scale = "load"
[loads.side]
kind = "force"
on = "bar.end"
vector = [0, 0, 1]
scale = 1e-3
[outputs.tip]
kind = "displacement"
of = "bar.end"
[analysis]
kind = "dynamics"
end = 0.1
step = 0.01
"""

TRUSS = """
lissom = 1
[point_masses.top]
mass = 1.0
position = [0, 0.3, 0]
plane = "xy"
[springs.left]
kind = "point"
base = "ground"
at_base = [-1, 0, 0]
tip = "top"
stiffness = 1000.0
[springs.right]
kind = "point"
base = "ground"
at_base = [1, 0, 0]
tip = "top"
stiffness = 1000.0
[loads.down]
kind = "force"
on = "top"
vector = [0, -1, 0]
[outputs.top]
kind = "position"
of = "top"
[analysis]
kind = "path"
end = 60
"""

CLOCKS = {"wall_seconds", "model", "set", "files"}


@pytest.fixture
def column(tmp_path: Path) -> Path:
    file = tmp_path / "column.toml"
    file.write_text(COLUMN)
    return file


def left(program: Program, out: Path, *args: object) -> Path:
    ended = program(*args, "--out", out, "--quiet")
    assert ended.returncode == 0, ended.stderr
    return out


def same(found: Any, folder: Path) -> None:
    """Tables to the letter, facts to the last bit."""
    for name, text in found.files.items():
        assert (folder / name).read_text() == text, name
    facts = json.loads((folder / "summary.json").read_text())
    for name in facts.keys() - CLOCKS:
        assert found.summary[name] == facts[name], name


def test_modes_are_those_of_the_command_line(program: Program, column: Path, tmp_path: Path) -> None:
    model = lissom.load(column)
    out = left(program, tmp_path / "modes", "modes", column, "--count", 6, "--about", "undeformed")
    modes = model.modes(6, about="undeformed")
    same(modes, out)
    table = np.genfromtxt(out / "modes.csv", delimiter=",", names=True, usecols=(0, 1, 2))
    assert len(modes) == 6 and np.array_equal(modes.frequencies, table["frequency"])
    assert np.all(np.diff(modes.frequencies) >= 0) and set(modes.kinds) == {"oscillation"}
    assert np.allclose(np.abs(modes.eigenvalues) / (2 * np.pi), modes.frequencies, rtol=1e-12)
    assert modes.shapes.shape == (6, len(modes.nodes), 6) and modes.positions.shape == (len(modes.nodes), 3)
    # The clamped end stands still, the free end of the first mode does not.
    root, tip = modes.positions[:, 0].argmin(), modes.positions[:, 0].argmax()
    assert np.abs(modes.shapes[:, root]).max() < 1e-9 and np.abs(modes.shapes[0, tip, :3]).max() > 0.1
    assert set(modes.kinetic_shares[0]) == {"bar"}
    with pytest.raises(ValueError, match="count"):
        model.modes(0)
    with pytest.raises(lissom.ModelError, match="neither|static"):
        model.modes(3, about="sideways")
    with pytest.raises(lissom.SolutionError):
        model.modes(3, about=0.0)


def test_buckling_is_that_of_the_command_line(program: Program, column: Path, tmp_path: Path) -> None:
    out = left(program, tmp_path / "buckling", "buckling", column, "--count", 2)
    found = lissom.load(column).buckling(2)
    same(found, out)
    # Euler: π² EI / (2L)² over the load.
    assert len(found) == 2 and abs(found.load_factors[0] * 10 / (np.pi**2 * 100 / 4) - 1) < 1e-3


def test_gradients_are_those_of_the_command_line(program: Program, tmp_path: Path) -> None:
    paths = ["point_masses.bob.mass", "springs.spring.stiffness"]
    out = left(program, tmp_path / "gradient", "gradient", PENDULUM, "--of", "bob.x@0.5", "--by", ",".join(paths))
    model = lissom.load(PENDULUM)
    found = model.gradient("bob.x@0.5", paths)
    same(found, out)
    assert found.time == 0.5 and found.value == pytest.approx(model.run()["bob.x"][50], abs=1e-9)
    assert found[paths[1]] == found.derivatives[1] and list(found) == paths and found.numbers[1] == 10.0
    apart = 1e-3

    def value(stiffness: float) -> float:
        changes: dict[str, Any] = {"springs.spring.stiffness": stiffness, "analysis.tolerance": 1e-12}
        return float(model.replace(changes).run()["bob.x"][50])

    assert (value(10 + apart) - value(10 - apart)) / (2 * apart) == pytest.approx(found[paths[1]], rel=1e-5)
    with pytest.raises(KeyError, match="did you mean"):
        found["springs.spring.stifness"]
    with pytest.raises(lissom.ModelError, match="no output column"):
        model.gradient("bob.q", paths)


def test_responses_are_those_of_the_command_line(program: Program, column: Path, tmp_path: Path) -> None:
    asked = ("--input", "loads.side", "--output", "tip.u3", "--from", 0.1, "--to", 100, "--points", 30)
    out = left(program, tmp_path / "response", "response", column, *asked)
    with pytest.warns(lissom.ModelWarning, match="no damping"):
        found = lissom.load(column).response("loads.side", "tip.u3", 0.1, 100, 30)
    same(found, out)
    assert found.names == ["tip.u3/loads.side"] and found.units["tip.u3/loads.side"] == "m"
    table = np.genfromtxt(out / "response.csv", delimiter=",", skip_header=1)
    assert np.array_equal(found["tip.u3/loads.side"], table[:, 3] + 1j * table[:, 4])
    assert np.array_equal(found.frequencies, table[:, 0])


def test_campbell_diagrams_are_those_of_the_command_line(program: Program, column: Path, tmp_path: Path) -> None:
    out = left(program, tmp_path / "campbell", "campbell", column, "--vary", "parameters.load=1:20:4", "--count", 3)
    found = lissom.load(column).campbell("parameters.load", 1, 20, 4, count=3)
    same(found, out)
    values, frequencies = found.line(1)
    assert np.array_equal(values, np.linspace(1, 20, 4)) and np.all(np.diff(frequencies) < 0), "a load makes it softer"
    with pytest.raises(KeyError, match="line 9"):
        found.line(9)


def test_arguments_have_the_names_of_the_interface(column: Path) -> None:
    """`vary` is a path, `points` a number of values, `count` a number of modes, `values` what inputs are set to."""
    model = lissom.load(column)
    diagram = model.campbell(vary="parameters.load", start=1, end=20, points=3, count=2)
    assert diagram.summary["values"] == 3 and np.array_equal(diagram.line(1)[0], [1, 10.5, 20])
    with pytest.raises(ValueError, match="`points` is 1"):
        model.campbell("parameters.load", 1, 20, points=1)
    with pytest.raises(ValueError, match="`points` is 1"):
        model.response("loads.side", "tip.u3", 1, 2, points=1)


def test_reductions_are_those_of_the_command_line(program: Program, column: Path, tmp_path: Path) -> None:
    asked = ("--interfaces", "bar.start,bar.end", "--modes", 3, "--modes-alone", "--name", "rod")
    out = left(program, tmp_path / "reduced", "reduce", column, *asked)
    model = lissom.load(column)
    found = model.reduce(["bar.start", "bar.end"], 3, corrections=False, name="rod")
    same(found, out)
    size = 12 + 3
    assert found.name == "rod" and found.interfaces == ["bar_start", "bar_end"] and len(found.frequencies) == 3
    arrays = np.load(out / "rod.npz")
    assert found.M.shape == (size, size) and np.array_equal(found.M, arrays["mass"]) and np.array_equal(found.K, arrays["stiffness"])
    # Clamped at its only interface, a rod has the modes of the superelement with fixed interfaces.
    rod = lissom.load(ROOT / "examples" / "connecting-rod.toml")
    fixed = rod.reduce("rod.start", 4, corrections=False)
    assert fixed.M.shape == (10, 10)
    free = rod.reduce(["rod.start", "rod.end"], 4)
    assert free.summary["corrections"] > 0 and len(free.K) == 12 + 4 + free.summary["corrections"]
    rod.joints["root"] = entries.joints.Clamp(base="ground", tip="rod.start")
    wanted = rod.modes(3).frequencies
    assert np.allclose(fixed.frequencies[:3], wanted, rtol=1e-6, atol=0)
    # The folder is what a model uses.
    free.to_folder(tmp_path / "rod")
    text = free.files[f"{free.name}.toml"] + (
        f'[joints.root]\nkind = "clamp"\nbase = "ground"\ntip = "{free.name}.{free.interfaces[0]}"\n'
        f'[outputs.tip]\nkind = "displacement"\nof = "{free.name}.{free.interfaces[1]}"\n'
        '[analysis]\nkind = "dynamics"\nend = 0.1\nstep = 0.01\n'
    )
    again = lissom.loads(text, str(tmp_path / "rod" / "model.toml")).modes(2)
    assert np.allclose(again.frequencies, wanted[:2], rtol=1e-2, atol=0)
    with pytest.raises(lissom.ModelError, match="bar.middle"):
        model.reduce(["bar.middle"])
    with pytest.raises(ValueError, match="`count` is -1"):
        model.reduce("bar.start", -1)


def test_linear_models_are_those_of_the_command_line(program: Program, column: Path, tmp_path: Path) -> None:
    out = left(program, tmp_path / "linear", "linearize", column, "--input", "loads.side", "--output", "tip")
    model = lissom.load(column)
    linear = model.linearize("loads.side", "tip")
    for name in "MDKG":
        assert (getattr(linear, name) != scipy.io.mmread(out / f"{name}.mtx").tocsr()).nnz == 0, name
    assert (linear.F != scipy.io.mmread(out / "inputs.mtx").tocsr()).nnz == 0
    assert (linear.output_matrix("place") != scipy.io.mmread(out / "outputs-place.mtx").tocsr()).nnz == 0
    for name, matrix in zip("ABCD", linear.state_space):
        assert np.array_equal(matrix, scipy.io.mmread(out / f"state-space-{name}.mtx")), name
    assert linear.M.shape == (linear.coordinates, linear.coordinates) and linear.G.shape[0] == linear.multipliers
    assert linear.outputs[0].startswith("tip.") and len(linear.states) == len(linear.state_space.A)
    # The state space and the sparse matrices say the same, at 3 Hz.
    response = model.response("loads.side", "tip.u3", 3, 3.1, 2)
    A, B, C, D = linear.state_space
    row = linear.outputs.index("tip.u3")
    amplitude = C[row] @ np.linalg.solve(6j * np.pi * np.eye(len(A)) - A, B[:, 0]) + D[row, 0]
    assert response["tip.u3/loads.side"][0] == pytest.approx(amplitude, rel=1e-8)
    assert scipy.signal.StateSpace(A, B, C, D).outputs == len(linear.outputs)
    with pytest.raises(ValueError, match="place, rate"):
        linear.output_matrix("speed")
    with pytest.raises(lissom.ModelError, match="no input `sidee`"):
        model.linearize("sidee", "tip")


def test_a_simulation_is_linearised_where_it_stands(program: Program, tmp_path: Path) -> None:
    top = ROOT / "examples" / "top.toml"
    out = left(program, tmp_path / "linear", "linearize", top, "--about", 0.02)
    model = lissom.load(top)
    sim = model.simulation()
    sim.step_to(0.02)
    linear = sim.linearize()
    with pytest.warns(lissom.ModelWarning, match="not steady"):
        about = model.linearize(about=0.02)
    assert linear.warnings == about.warnings and "frozen" in linear.warnings[0]
    for name in "MDKG":
        there = scipy.io.mmread(out / f"{name}.mtx").tocsr()
        assert (getattr(linear, name) != there).nnz == 0 and (getattr(about, name) != there).nnz == 0, name
    before = sim.values()
    (output,) = {name.rsplit(".", 1)[0] for name in model.names[:3]}
    assert sim.linearize([], output).outputs == sim.linearize(outputs=(output,)).outputs == model.names[:3]
    assert linear.K.nnz > 0 and np.array_equal(before, sim.values())
    sim.step()
    assert (sim.linearize().K != linear.K).nnz > 0


def test_paths_are_those_of_the_command_line(program: Program, tmp_path: Path) -> None:
    file = tmp_path / "truss.toml"
    file.write_text(TRUSS)
    out = left(program, tmp_path / "out", "run", file)
    model = lissom.load(file)
    path, there = model.path(), lissom.read(out)
    assert path.names == there.names and path.arc.tobytes() == there.time.tobytes()
    for name in path.names:
        assert path[name].tobytes() == there[name].tobytes(), name
    assert path.critical_points == there.summary["critical_points"] and len(path.critical_points) == 2
    assert path["load_factor"][-1] == pytest.approx(60, rel=1e-12)
    shorter = model.path(end=5, step=1)
    assert shorter["load_factor"][-1] == pytest.approx(5, rel=1e-12) and shorter.critical_points == []
    with pytest.raises(lissom.SolutionError) as caught:
        model.path(end=60, steps=3)
    assert 0 < len(caught.value.result.arc) < len(path.arc) and not caught.value.result.is_complete
    with pytest.raises(lissom.ModelError, match="not `path`"):
        lissom.load(PENDULUM).path()
    with pytest.raises(ValueError, match="no motion"):
        path.animate()
