"""Runs and their results, which are those of the command line to the last bit."""

from __future__ import annotations

import copy
import json
import pickle
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import lissom
from conftest import PENDULUM, ROOT

Program = Callable[..., "subprocess.CompletedProcess[str]"]


@pytest.mark.parametrize("name", ["pendulum", "tip-crank", "top", "four-bar"])
def test_results_are_those_of_the_command_line(name: str, program: Program, tmp_path: Path) -> None:
    example = ROOT / "examples" / f"{name}.toml"
    changes = {"analysis.end": 0.05}
    ended = program("run", example, "--no-plots", "--out", tmp_path, "--set", "analysis.end=0.05")
    assert ended.returncode == 0, ended.stderr
    result, there = lissom.load(example, **changes).run(), lissom.read(tmp_path)
    assert result.names == there.names and result.is_complete and there.is_complete
    assert result.time.tobytes() == there.time.tobytes()
    for column in result.names:
        assert result[column].tobytes() == there[column].tobytes(), column
    assert result.units == there.units
    clocks = {"wall_seconds", "solve_seconds", "seconds", "model"}
    facts = {key: value for key, value in result.summary.items() if key not in clocks}
    assert facts == {key: value for key, value in there.summary.items() if key not in clocks}
    with open(tmp_path / "summary.json") as file:
        assert there.summary == json.load(file)


def test_the_table_of_a_run_is_read_in_one_line(program: Program, tmp_path: Path) -> None:
    import pandas

    assert program("run", PENDULUM, "--out", tmp_path, "--quiet").returncode == 0
    there = lissom.read(tmp_path)
    frame = pandas.read_csv(tmp_path / "history.csv")
    array = np.genfromtxt(tmp_path / "history.csv", delimiter=",", names=True, deletechars="")
    assert list(frame.columns) == list(array.dtype.names or ()) == ["time", *there.names]
    for name in there.names:
        assert array[name].tobytes() == there[name].tobytes()
        assert np.allclose(frame[name], there[name], rtol=1e-14, atol=0), "older versions of pandas round"


def test_a_run_is_exported_as_parquet(program: Program, tmp_path: Path) -> None:
    import pandas
    import pyarrow.parquet

    assert program("run", PENDULUM, "--out", tmp_path, "--quiet").returncode == 0
    ended = program("export", tmp_path, "--format", "parquet")
    assert ended.returncode == 0, ended.stderr
    there = lissom.read(tmp_path)
    frame = pandas.read_parquet(tmp_path / "history.parquet")
    assert list(frame.columns) == ["time", *there.names]
    assert frame["time"].to_numpy().tobytes() == there.time.tobytes()
    assert all(frame[name].to_numpy().tobytes() == there[name].tobytes() for name in there.names)
    units = json.loads(pyarrow.parquet.read_metadata(tmp_path / "history.parquet").metadata[b"units"])
    assert units == {"time": "s", **there.units}


def test_columns_are_arrays() -> None:
    result = lissom.load(PENDULUM).run()
    assert result["bob.x"].dtype == np.float64 and result["bob.x"].shape == result.time.shape == (101,)
    assert result.units["bob.x"] == "m" and "bob.x" in result and len(result) == len(list(result)) == 15
    with pytest.raises(KeyError, match="did you mean `bob.x`"):
        result["bob.xx"]
    # A former name.
    assert np.array_equal(result["arm.rotation"], result["arm.angle"]) and "arm.rotation" in result
    assert "arm.rotation" not in result.names and "bob.xx" not in result
    frame = result.to_pandas()
    assert frame.index.name == "time" and np.array_equal(frame["bob.y"], result["bob.y"])


def test_columns_are_read_only() -> None:
    model = lissom.load(PENDULUM)
    result = model.run()
    for own in (result, pickle.loads(pickle.dumps(result)), copy.copy(result)):
        for array in (own.time, own["bob.x"]):
            with pytest.raises(ValueError, match="read-only"):
                array[0] = 1.0
        assert own.names == result.names and own.summary == result.summary and own.is_complete
    assert (2 * result["bob.x"])[0] == 2 * result["bob.x"][0]


def test_a_notebook_shows_results_and_models() -> None:
    model = lissom.load(PENDULUM)
    result = model.run()
    shown = result._repr_html_()
    assert shown.count("<tr>") == 1 + len(result) and f"<td>bob.x</td><td>m</td><td>{result['bob.x'][0]:.6g}</td>" in shown
    assert "&lt;" not in shown and "point_masses.bob" in model._repr_html_()
    empty = lissom.Result(np.zeros(0), {"a": np.zeros(0)}, {"a": "m"}, {})
    assert "<td>a</td>" in empty._repr_html_()


def test_a_run_without_a_solution_keeps_what_it_has() -> None:
    model = lissom.load(ROOT / "examples" / "four-bar.toml")
    drive = "5*t^2 + 1e7*max(t-0.05, 0)^3"
    with pytest.raises(lissom.SolutionError, match="step to t =") as caught:
        model.replace({"analysis.end": 0.1, "joints.drive.rotation": drive}).run()
    result = caught.value.result
    assert not result.is_complete and result.summary["error"] == str(caught.value)
    assert 0.02 < result.time[-1] < 0.1


def test_folders_that_hold_nothing_are_refused(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="no such file"):
        lissom.read(tmp_path)
    (tmp_path / "history.csv").write_text("time,a\n0,1\nx,2\n")
    with pytest.raises(ValueError, match="line 3"):
        lissom.read(tmp_path)
    (tmp_path / "history.csv").write_text("time,a\n0,1\n")
    assert not lissom.read(tmp_path).is_complete, "a run without summary was cut off"


def test_progress_is_reported() -> None:
    reports: list[tuple[float, float]] = []
    model = lissom.load(PENDULUM, **{"analysis.step": 1e-5})
    model.run(progress=lambda done, planned: reports.append((done, planned)))
    assert reports and all(0 < done <= planned == 100000 for done, planned in reports)
    with pytest.raises(ZeroDivisionError):
        model.run(progress=lambda done, planned: 1 / 0)
    with pytest.raises(TypeError, match="True, False or a function"):
        model.run(progress="yes")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="`threads` is 0"):
        model.run(threads=0)


def test_a_line_on_the_terminal_tells_what_is_left(capsys: pytest.CaptureFixture[str]) -> None:
    lissom.load(PENDULUM, **{"analysis.step": 5e-6}).run(progress=True)
    lines = capsys.readouterr().err.split("\r")
    assert any("#" in line and line.rstrip().endswith("left") for line in lines), lines
    assert lines[-2].strip() == "" and lines[-1] == "", "the line is gone in the end"


def test_other_threads_go_on_while_a_model_runs() -> None:
    model = lissom.load(PENDULUM, **{"analysis.step": 5e-6})
    ended = threading.Event()

    def run() -> None:
        model.run()
        ended.set()

    thread = threading.Thread(target=run)
    thread.start()
    count = 0
    while not ended.is_set():
        time.sleep(0.001)
        count += 1
    thread.join()
    assert count > 20


@pytest.mark.parametrize("work", ["model.run()", "model.simulation().step_to(1e9)"])
def test_ctrl_c_ends_a_run(work: str) -> None:
    code = f"""
import lissom
model = lissom.load({PENDULUM!r}, **{{"analysis.end": 1e6}})
print("begun", flush=True)
try:
    {work}
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""
    child = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    # What hangs is killed, so that nothing is read from it any more and the test fails.
    timer = threading.Timer(60, child.kill)
    timer.start()
    assert child.stdout is not None and child.stdout.readline() == "begun\n"
    time.sleep(0.3)
    child.send_signal(signal.SIGINT)
    output, _ = child.communicate(timeout=30)
    timer.cancel()
    assert output == "interrupted\n" and child.returncode == 0
