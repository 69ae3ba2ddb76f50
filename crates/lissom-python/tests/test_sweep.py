"""Sweeps on this machine."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.stats import qmc

import lissom
from conftest import PENDULUM

Program = Callable[..., "subprocess.CompletedProcess[str]"]

VARY = {
    "point_masses.bob.mass": {"from": 1, "to": 4},
    "springs.spring.stiffness": {"mean": 10, "standard_deviation": 1},
}
COLLECT = {"swing": "max(bob.x)", "rest": "final(energy.total)"}


def test_rows_are_single_runs() -> None:
    model = lissom.load(PENDULUM, **{"analysis.end": 0.2})
    table = lissom.sweep(
        model, {"point_masses.bob.mass": [1, 2.5], "analysis.scheme": ["generalized-alpha"]}, collect=COLLECT
    )
    assert len(table) == 2 and list(table["member"]) == [0, 1] and len(table.failed) == 0
    for row, mass in enumerate([1, 2.5]):
        result = model.replace({"point_masses.bob.mass": mass}).run()
        assert table["swing"][row] == result["bob.x"].max() and table["rest"][row] == result["energy.total"][-1]
        assert table["point_masses.bob.mass"][row] == mass and table["analysis.scheme"][row] == "generalized-alpha"
    frame = table.to_pandas()
    assert list(frame.columns) == table.names and frame["steps"].tolist() == [20, 20]


def test_means_are_those_of_numpy() -> None:
    model = lissom.load(PENDULUM)
    words = ["mean(bob.x)", "rms(bob.x)", "max_abs(bob.x)", "time_of_max(bob.x)", "time_of_min(bob.x)", "initial(bob.x)"]
    table = lissom.sweep(model, {"analysis.end": [0.7]}, collect=words)
    result = model.replace({"analysis.end": 0.7}).run()
    t, x = result.time, result["bob.x"]

    def integral(y: np.ndarray[Any, Any]) -> float:
        return float(np.sum(0.5 * np.diff(t) * (y[1:] + y[:-1])))

    wanted = [integral(x) / 0.7, np.sqrt(integral(x**2) / 0.7), abs(x).max(), t[x.argmax()], t[x.argmin()], x[0]]
    assert np.allclose([table[word][0] for word in words], wanted, rtol=1e-13, atol=0)


def test_the_table_is_that_of_the_command_line(program: Program, tmp_path: Path) -> None:
    file = tmp_path / "sweep.toml"
    file.write_text(
        f'lissom_sweep = 1\nmodel = "{PENDULUM}"\nsampling = "sobol"\nmembers = 20\nseed = 3\n[vary]\n'
        '"point_masses.bob.mass" = { from = 1, to = 4 }\n'
        '"springs.spring.stiffness" = { mean = 10, standard_deviation = 1 }\n'
        '[collect]\nswing = "max(bob.x)"\nrest = "final(energy.total)"\n'
    )
    ended = program("sweep", file, "--out", tmp_path / "program", "--quiet")
    assert ended.returncode == 0, ended.stderr
    model = lissom.load(PENDULUM)
    here = lissom.sweep(model, VARY, collect=COLLECT, sampling="sobol", members=20, seed=3, out=tmp_path / "here", workers=1)
    assert (tmp_path / "here/sweep.csv").read_bytes() == (tmp_path / "program/sweep.csv").read_bytes()
    # Each goes on with what the other has left.
    (tmp_path / "program/sweep.csv").unlink()
    again = lissom.sweep(model, VARY, collect=COLLECT, sampling="sobol", members=20, seed=3, out=tmp_path / "program")
    assert (tmp_path / "here/sweep.csv").read_bytes() == (tmp_path / "program/sweep.csv").read_bytes()
    assert np.array_equal(here["swing"], again["swing"])
    with pytest.raises(ValueError, match="another sweep"):
        lissom.sweep(model, VARY, collect=COLLECT, sampling="sobol", members=20, seed=4, out=tmp_path / "here")


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


def test_tables_and_histories_are_parquet(tmp_path: Path) -> None:
    import pandas
    import pyarrow.parquet

    model = lissom.loads(THROWN)
    speeds = [0.9, 2.0, 0.25, 4.0]
    with pytest.warns(lissom.SolutionWarning, match="event `far` has not happened"):
        table = lissom.sweep(
            model,
            {"point_masses.stone.velocity": [[speed, 0, 0] for speed in speeds], "analysis.scheme": ["hht", "radau-iia"]},
            collect={"arrival": "time_of_event(far)", "x": "final(stone.x)"},
            histories=["stone.x", "stone.y"],
            out=tmp_path,
        )
    assert list(table.failed) == [4, 5]
    assert np.allclose(table["arrival"][[0, 2, 6]], [0.5 / 0.9, 0.25, 0.125], rtol=0, atol=1e-12)
    # One table, the same as the one that is text.
    frame = pandas.read_parquet(tmp_path / "sweep.parquet")
    text = pandas.read_csv(tmp_path / "sweep.csv", keep_default_na=False, na_values=[""])
    assert list(frame.columns) == list(text.columns) == table.names and len(frame) == 8
    for name in table.names:
        wanted = table[name]
        if wanted.dtype == object:
            assert list(frame[name]) == list(wanted), name
        else:
            assert frame[name].to_numpy().tobytes() == wanted.tobytes(), name
            assert np.array_equal(text[name].to_numpy(), wanted, equal_nan=True), name
    assert pyarrow.parquet.read_metadata(tmp_path / "sweep.parquet").num_rows == 8
    # Whole histories, of members that failed too, which are those of runs.
    all_of_them = pandas.read_parquet(tmp_path / "histories")
    assert sorted(set(all_of_them["member"])) == list(range(8))
    for member in (0, 3, 5):
        own = all_of_them[all_of_them["member"] == member].sort_values("time")
        changes = {"point_masses.stone.velocity": [speeds[member // 2], 0, 0], "analysis.scheme": ["hht", "radau-iia"][member % 2]}
        run = model.replace(changes).run()
        assert own["time"].to_numpy().tobytes() == run.time.tobytes()
        assert own["stone.x"].to_numpy().tobytes() == run["stone.x"].tobytes()
    with pytest.raises(ValueError, match="`out`"):
        lissom.sweep(model, {"analysis.end": [1]}, collect=["max(stone.x)"], histories=["stone.x"])
    with pytest.raises(lissom.ModelError, match="its events are far"):
        lissom.sweep(model, {"analysis.end": [1]}, collect=["time_of_event(near)"])


def test_plots_show_every_member() -> None:
    import matplotlib

    matplotlib.use("Agg")
    model = lissom.load(PENDULUM, **{"analysis.end": 0.1})
    vary = {"point_masses.bob.mass": [1, 2, 3], "analysis.solver": ["sparse", "pivoting"]}
    table = lissom.sweep(model, vary, collect=COLLECT)
    axes = table.plot().axes
    assert len(axes) == 4
    (line,) = axes[0].lines
    assert np.array_equal(line.get_xdata(), table["point_masses.bob.mass"])
    assert np.array_equal(line.get_ydata(), table["swing"])
    assert [tick.get_text() for tick in axes[3].get_xticklabels()] == ["sparse", "pivoting"]
    (ax,) = table.plot_parallel().axes
    lines = [line for line in ax.lines if len(line.get_xdata()) == 4]
    assert len(lines) == 6 and [tick.get_text() for tick in ax.get_xticklabels()] == [*vary, *COLLECT]
    with pytest.warns(lissom.SolutionWarning):
        failed = lissom.sweep(model, {"point_masses.bob.mass": [1]}, collect=COLLECT, set={"analysis.max_iterations": 1})
    with pytest.raises(ValueError, match="no member is solved"):
        failed.plot()


def test_members_that_fail_are_warned_of() -> None:
    model = lissom.load(PENDULUM)
    with pytest.warns(lissom.SolutionWarning, match="2 of 3 members have no solution; member 0: .*greater than zero"):
        table = lissom.sweep(model, {"point_masses.bob.mass": [-1, 1, 0]}, collect=["max(bob.x)"], set={"analysis.end": 0.1})
    assert list(table.failed) == [0, 2] and list(table["state"]) == ["wrong_model", "solved", "wrong_model"]
    assert np.isnan(table["max(bob.x)"][[0, 2]]).all() and np.isfinite(table["max(bob.x)"][1])


def test_wrong_sweeps_are_refused() -> None:
    model = lissom.load(PENDULUM)
    with pytest.raises(lissom.ModelError, match="does not record"):
        lissom.sweep(model, {"point_masses.bob.mass": [1]}, collect=["max(bob.u1)"])
    with pytest.raises(lissom.ModelError, match="did you mean `mass`"):
        lissom.sweep(model, {"point_masses.bob.mas": [1]}, collect=["max(bob.x)"])
    with pytest.raises(lissom.ModelError, match="did you mean `sobol`"):
        lissom.sweep(model, VARY, collect=COLLECT, sampling="sobl")
    with pytest.raises(ValueError, match="`workers` is 0"):
        lissom.sweep(model, VARY, collect=COLLECT, workers=0)
    with pytest.raises(lissom.ModelError, match="requires the number of members"):
        lissom.sweep(model, VARY, collect=COLLECT, sampling="sobol")


def test_draws_are_those_of_scipy() -> None:
    """Sobol's points up to the shift, and normal quantiles, against an independent implementation."""
    from scipy.stats import norm

    # Only the values of the table are looked at: one step is enough.
    model = lissom.load(PENDULUM, **{"analysis.end": 1e-3, "analysis.step": 1e-3})
    dimensions, members = 8, 64
    model = lissom.loads(
        model.to_toml() + "[parameters]\n" + "".join(f"p{index} = 0\n" for index in range(dimensions))
    )
    vary = {f"parameters.p{index}": {"from": 0, "to": 1} for index in range(dimensions)}
    table = lissom.sweep(model, vary, collect=["max(bob.x)"], sampling="sobol", members=members, seed=9)
    points = np.column_stack([table[path] for path in vary])
    digits = np.floor(points * 2**32).astype(np.uint64)
    ours = digits ^ digits[0]
    theirs = (qmc.Sobol(dimensions, scramble=False).random(members) * 2**32).astype(np.uint64)
    assert np.array_equal(ours, theirs)

    normal = {"parameters.p0": {"mean": 0, "standard_deviation": 1}}
    table = lissom.sweep(model, normal, collect=["max(bob.x)"], sampling="latin-hypercube", members=1000, seed=1)
    x = np.sort(table["parameters.p0"])
    strata = norm.cdf(x) * 1000
    assert np.array_equal(np.floor(strata), np.arange(1000))


def test_ctrl_c_ends_a_sweep_that_goes_on_later(tmp_path: Path) -> None:
    code = f"""
import lissom, os, signal, threading
model = lissom.load({PENDULUM!r})
threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
try:
    lissom.sweep(model, {{"point_masses.bob.mass": {{"from": 1, "to": 2}}}}, collect=["max(bob.x)"], sampling="monte-carlo",
                 members=1000000, out={str(tmp_path)!r})
except KeyboardInterrupt:
    print("interrupted")
"""
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert ended.stdout == "interrupted\n", ended.stderr
    assert not (tmp_path / "sweep.csv").exists() and (tmp_path / "members.jsonl").stat().st_size > 1000
