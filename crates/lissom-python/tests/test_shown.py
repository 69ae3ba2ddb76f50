"""Pictures, pages and archives of results."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path

import matplotlib
import numpy as np
import pytest

import lissom
from conftest import PENDULUM, ROOT
from test_analyses import COLUMN, TRUSS

matplotlib.use("Agg")

Program = Callable[..., "subprocess.CompletedProcess[str]"]


def test_an_archive_holds_every_bit(tmp_path: Path) -> None:
    result = lissom.load(PENDULUM).run()
    result.to_npz(tmp_path / "a.npz")
    again = lissom.read(tmp_path / "a.npz")
    assert again.names == result.names and again.units == result.units and again.summary == result.summary
    assert again.time.tobytes() == result.time.tobytes() and again.is_complete
    assert all(again[name].tobytes() == result[name].tobytes() for name in result.names)
    with np.load(tmp_path / "a.npz") as archive:
        assert np.array_equal(archive["bob.x"], result["bob.x"])
    with pytest.raises(ValueError, match=r"\.npz"):
        result.to_npz(tmp_path / "a.csv")
    np.savez(tmp_path / "foreign.npz", a=result.time)
    with pytest.raises(ValueError, match="not written by"):
        lissom.read(tmp_path / "foreign.npz")
    with pytest.raises(ValueError, match="no model"):
        again.animate()


def test_plots_show_the_columns() -> None:
    result = lissom.load(PENDULUM).run()
    figure = result.plot()
    assert len(figure.axes) == len({name.rsplit(".", 1)[0] for name in result.names})
    (ax,) = result.plot("bob").axes
    assert [line.get_label() for line in ax.lines] == ["x", "y", "z"] and ax.get_ylabel() == "bob [m]"
    (ax,) = result.plot("bob.y").axes
    assert np.array_equal(ax.lines[0].get_ydata(), result["bob.y"]) and np.array_equal(ax.lines[0].get_xdata(), result.time)
    with pytest.raises(KeyError, match="did you mean `bob.x`"):
        result.plot("bob.xx")
    (ax,) = lissom.loads(TRUSS).path().plot("load_factor").axes
    assert "path" in ax.get_xlabel()
    model = lissom.loads(COLUMN)
    with pytest.warns(lissom.ModelWarning):
        above, below = model.response("loads.side", "tip.u3", 0.1, 100, 30).plot().axes
    assert above.get_yscale() == "log" and len(below.lines) == 1
    (ax,) = model.campbell("parameters.load", 1, 20, 3, count=2).plot().axes
    assert len(ax.lines) == 2 and ax.get_xlabel() == "parameters.load"


def test_a_page_shows_the_motion_of_the_run(program: Program, tmp_path: Path) -> None:
    ended = program("view", PENDULUM, "--out", tmp_path / "pendulum", "--quiet")
    assert ended.returncode == 0, ended.stderr
    there = (tmp_path / "pendulum" / "view.html").read_text(encoding="utf-8")
    animation = lissom.load(PENDULUM).run().animate()
    # The same page except for the name, which is that of the folder there.
    assert animation.html.replace(f'"name":"{PENDULUM}"', '"name":"pendulum"') == there
    assert lissom.read(tmp_path / "pendulum").animate().html == there
    cell = animation._repr_html_()
    assert cell.startswith("<iframe srcdoc=") and "<script" not in cell
    animation.save(tmp_path / "page.html")
    assert (tmp_path / "page.html").read_text(encoding="utf-8") == animation.html


def test_a_page_shows_modes() -> None:
    page = lissom.loads(COLUMN).modes(3, about="undeformed").animate()
    assert "3 modes" in page.html and "Clamped column" in page.html


def test_a_page_of_a_failed_run_says_so() -> None:
    drive = "5*t^2 + 1e7*max(t-0.05, 0)^3"
    model = lissom.load(ROOT / "examples/four-bar.toml", **{"analysis.end": 0.1, "joints.drive.rotation": drive})
    with pytest.raises(lissom.SolutionError) as caught:
        model.run()
    assert "The run failed" in caught.value.result.animate().html
