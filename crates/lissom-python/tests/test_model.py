"""Models: read, changed, checked, written."""

from __future__ import annotations

import json
import pickle
import shutil
import subprocess
import warnings
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import lissom
from conftest import PENDULUM, ROOT

Program = Callable[..., "subprocess.CompletedProcess[str]"]

TEXT = """
lissom = 1
[point_masses.stone]
mass = 2
velocity = [3, 0, 0]
[outputs.stone]
kind = "position"
of = "stone"
[analysis]
kind = "dynamics"
end = 1.0
step = 0.1
"""


def test_values_are_put_in_place() -> None:
    model = lissom.loads(TEXT, **{"analysis.end": 2, "analysis.step": np.float64(0.05)})
    assert model.overrides == {"analysis.end": "2", "analysis.step": "0.05"}
    assert model.run().summary["steps"] == 40
    further = model.replace({"point_masses.stone.velocity": [0, "sqrt(4)", 0]}, **{"analysis.scheme": "hht"})
    result = further.run()
    assert result.summary["scheme"].startswith("hht") and abs(result["stone.y"][-1] - 4) < 1e-12
    assert model.run()["stone.y"][-1] == 0, "the model it was made from is as it was"


def test_a_model_written_as_toml_means_the_same() -> None:
    assert lissom.loads(TEXT).to_toml() == TEXT
    model = lissom.load(PENDULUM, **{"point_masses.bob.mass": 0.1 + 0.2})
    again = lissom.loads(model.to_toml())
    for name in model.names:
        assert np.array_equal(model.run()[name], again.run()[name])


def test_models_are_pickled() -> None:
    model = lissom.load(PENDULUM, **{"analysis.end": 0.1})
    again = pickle.loads(pickle.dumps(model))
    assert again.overrides == model.overrides and np.array_equal(again.run()["bob.x"], model.run()["bob.x"])


def test_a_pickled_model_brings_the_files_it_includes(tmp_path: Path) -> None:
    folder = tmp_path / "here"
    shutil.copytree(ROOT / "examples", folder)
    model = lissom.load(folder / "turbine-rotor.toml", **{"analysis.end": 0.01})
    shutil.move(folder, tmp_path / "there")
    again = pickle.loads(pickle.dumps(model))
    assert np.array_equal(again.run()["shaft.angle"], model.run()["shaft.angle"])


def test_a_check_counts_freedoms() -> None:
    facts = lissom.load(PENDULUM).check()
    assert facts["freedoms"] == 1 and facts["unknowns"] == 5 and facts["redundant"] == []
    assert facts["names"][:2] == ["bob.x", "bob.y"]


def test_mistakes_are_underlined() -> None:
    with pytest.raises(lissom.ModelError, match="did you mean `end`") as caught:
        lissom.load(PENDULUM, **{"analysis.endd": 2})
    assert "analysis.endd = 2" in str(caught.value) and "1 error" in str(caught.value)
    with pytest.raises(lissom.ModelError, match="point_masses"):
        lissom.loads(TEXT.replace("[point_masses.stone]", "[point_mases.stone]"))
    assert issubclass(lissom.ModelError, lissom.LissomError)
    assert (caught.value.part, caught.value.remedy, caught.value.time) == ("analysis", "did you mean `end`?", None)
    assert (caught.value.code, caught.value.values) == ("model-file", {"errors": 1})
    (problem,) = caught.value.problems
    assert problem["severity"] == "error" and problem["message"] in str(caught.value) and problem["line"] == 1
    with pytest.raises(OSError, match="no such file"):
        lissom.load("nothing.toml")
    with pytest.raises(TypeError, match="not object"):
        lissom.loads(TEXT, **{"analysis.end": object()})
    with pytest.raises(lissom.ModelError, match="finite"):
        lissom.loads(TEXT, **{"analysis.end": float("nan")})


def test_mistakes_are_those_of_the_command_line(program: Program, tmp_path: Path) -> None:
    file = tmp_path / "wrong.toml"
    file.write_text(TEXT.replace("mass = 2", "mass = -2").replace('of = "stone"', 'of = "stoney"'))
    ended = program("check", file, "--json")
    assert ended.returncode == 2
    with pytest.raises(lissom.ModelError) as caught:
        lissom.load(file)
    assert list(caught.value.problems) == json.loads(ended.stdout)["problems"]
    assert [problem["part"] for problem in caught.value.problems] == ["point_masses.stone", "outputs.stone"]
    assert (caught.value.part, caught.value.remedy) == ("point_masses.stone", caught.value.problems[0]["help"])
    again = pickle.loads(pickle.dumps(caught.value))
    assert str(again) == str(caught.value) and again.problems == caught.value.problems


def test_failures_say_what_the_summary_says(program: Program, tmp_path: Path) -> None:
    wrong = {"analysis.max_iterations": 1}
    ended = program("run", PENDULUM, "--set", "analysis.max_iterations=1", "--out", tmp_path, "--quiet")
    assert ended.returncode == 3
    summary = json.loads((tmp_path / "summary.json").read_text())
    with pytest.raises(lissom.SolutionError) as caught:
        lissom.load(PENDULUM, **wrong).run()
    error = caught.value
    assert str(error) == summary["error"]
    failure = summary["failure"]
    assert all(failure[part] in ended.stderr for part in ("cause", "remedy"))
    assert (error.time, error.part, error.remedy) == (failure["time"], failure["part"], failure["remedy"])
    assert error.code == failure["code"] == "not-converged" and error.values == failure["values"]
    assert (error.time, error.part) == (0.01, "bob")
    assert error.remedy is not None and "a small `max_iterations`" in error.remedy
    assert len(error.result.time) == 1 and error.result.summary["failure"] == summary["failure"]
    # The same of a simulation that is stepped, and of analyses along steps.
    model = lissom.load(PENDULUM, **wrong)
    for failing in (lambda: model.simulation().step(), lambda: model.gradient("bob.x", "point_masses.bob.mass")):
        with pytest.raises(lissom.SolutionError) as other:
            failing()
        assert (other.value.time, other.value.part) == (0.01, "bob") and other.value.result is None
    again = pickle.loads(pickle.dumps(error))
    assert (again.time, again.part, again.remedy) == (error.time, error.part, error.remedy)
    assert (again.code, again.values) == (error.code, error.values)


def test_invalid_requests_have_codes_and_values() -> None:
    model = lissom.load(PENDULUM)
    with pytest.raises(lissom.ModelError, match="no output column `bob.q`") as column:
        model.gradient("bob.q", "point_masses.bob.mass")
    assert column.value.code == "gradient-column" and column.value.values["name"] == "bob.q"
    assert column.value.remedy is not None and "bob.x" in column.value.remedy
    with pytest.raises(lissom.ModelError, match="greater than zero") as frequencies:
        model.response("force", "bob.x", 2.0, 1.0)
    assert frequencies.value.code == "response-range"
    with pytest.raises(lissom.ModelError, match="cannot be linearised at t = 99") as late:
        model.modes(about=99.0)
    assert (late.value.code, late.value.time) == ("linearization-time", 99.0)
    # A request that cannot be read has the code of requests, and its reason.
    with pytest.raises(lissom.ModelError, match="`about`") as unknown:
        model.modes(about="somewhere")
    assert unknown.value.code == "request" and "somewhere" in str(unknown.value.values["reason"])
    assert lissom.LissomError.code is None and dict(lissom.LissomError.values) == {}


def test_results_and_models_go_to_other_processes() -> None:
    result = lissom.load(PENDULUM, **{"analysis.end": 0.1}).run()
    again = pickle.loads(pickle.dumps(result))
    assert again["bob.x"].tobytes() == result["bob.x"].tobytes() and again.summary == result.summary
    assert again.animate().html == result.animate().html


def test_a_good_model_is_read_without_a_warning() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        lissom.load(PENDULUM)


def test_an_analysis_without_a_course_in_time_cannot_be_run() -> None:
    text = TEXT.split("[analysis]")[0]
    model = lissom.loads(text + '[analysis]\nkind = "modes"\n')
    with pytest.raises(lissom.ModelError, match="modes"):
        model.run()
    with pytest.raises(lissom.ModelError, match="modes"):
        model.simulation()
