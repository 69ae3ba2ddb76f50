"""A model: a text with values put into it, checked when it is made."""

from __future__ import annotations

import difflib
import functools
import html
import os
import sys
import time
import warnings
from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeVar, Union

from . import _lissom, _toml
from ._analyses import Buckling, Campbell, Gradient, Modes, Path, Reduced, Response
from ._driven import InputFunction, driven
from ._linear import LinearModel, linear_model
from ._lissom import Batch, NativeModel, Simulation
from ._result import Result
from ._tables import Files
from .entries._entry import Entries, written
from .entries._model_tables import ORDER, ModelTables

Progress = Union[bool, Callable[[float, float], object]]
#: `"static"`, `"undeformed"`, `"rotation"` or a time [s].
About = Union[str, float]
Report = TypeVar("Report", Modes, Reduced, Buckling, Campbell, Response, LinearModel)


class ModelWarning(UserWarning):
    """Something in a model may not be meant as it is written, or its results are to be doubted."""


class Model(ModelTables):
    """A model: read by `load` or `loads`, or built from the objects of `lissom.entries`. It can be pickled.

    >>> from lissom.entries import PointMass, analyses, outputs
    >>> model = lissom.Model(title="A stone", gravity=[0, 0, -9.81])
    >>> model.point_masses["stone"] = PointMass(mass=2, velocity=[3, 0, 0])
    >>> model.outputs["stone"] = outputs.Position(of="stone")
    >>> model.analysis = analyses.Dynamics(end=1, step=0.1)
    >>> print(model)               # the model file it means

    The tables of the model file are attributes: dictionaries of entries by name. What is changed in them counts from then on;
    a model is checked when it is used.

    Args:
        title: one line about the model.
        name: name in messages; files that the text refers to are searched in the folder of a file of this name.
        tables: everything else at the top of a model file, as `gravity=[0, 0, -9.81]`, `bodies={"rod": Body(…)}`.
    """

    __slots__ = ("_name", "_checked", "_text", "_facts", "__weakref__")

    def __init__(self, title: str | None = None, *, name: str = "model", **tables: Any) -> None:
        self._name = name
        #: Checked model of the compiled part, for a text that was read or printed.
        self._checked: NativeModel | None = None
        self._text = ""
        self._facts: dict[str, Any] = {}
        self._tables = {}
        for key, of in {"title": title, **tables}.items():
            if key not in ORDER:
                near = difflib.get_close_matches(key, ORDER, n=1)
                help = f"did you mean `{near[0]}`?" if near else "it has " + ", ".join(ORDER[1:])
                raise TypeError(f"a model has no `{key}`; {help}")
            self._set(key, Entries(of) if isinstance(of, Mapping) else of)

    @classmethod
    def _of(cls, native: NativeModel) -> Model:
        model = cls.__new__(cls)
        model._name, model._text, model._tables = native.name, "", None
        model._become(native, 4)
        return model

    def _become(self, native: NativeModel, stacklevel: int) -> None:
        self._checked, self._facts = native, native.check()
        for words in self._facts["warnings"]:
            warnings.warn(f"{native.name}: {words}", ModelWarning, stacklevel=stacklevel)

    @property
    def _native(self) -> NativeModel:
        """The checked model; checked again where the tables have changed."""
        if self._tables is not None:
            text = written(self._tables)
            if self._checked is None or text != self._text:
                self._become(NativeModel(text, self._name, []), 5)
                self._text = text
        assert self._checked is not None
        return self._checked

    def _source(self) -> str:
        assert self._checked is not None
        return self._checked.to_toml()

    def __reduce__(self) -> tuple[Callable[[NativeModel], Model], tuple[NativeModel]]:
        return (Model._of, (self._native,))

    @property
    def name(self) -> str:
        """Path or name."""
        return self._name

    @property
    def overrides(self) -> dict[str, str]:
        """Overrides of the model: paths and TOML values."""
        return dict(self._native.overrides)

    @property
    def names(self) -> list[str]:
        """Names of the columns that a run records, as `midspan.u2`."""
        return list(self._native.check()["names"])

    def replace(self, changes: dict[str, Any] | None = None, /, **more: Any) -> Model:
        """The model with other values: `model.replace({"bodies.top.mass": 2})`, or the same as keywords."""
        return Model._of(self._native.replace(_toml.overrides({**(changes or {}), **more})))

    def to_toml(self) -> str:
        """The model as TOML: the text as it was written; with values put into it, or built of objects, without comments.

        A model that is built is written as it is, complete or not.

        Raises:
            ValueError: if an override is inside an included part, which a single text cannot express.
        """
        if self._tables is not None:
            return written(self._tables)
        return self._native.to_toml()

    def __str__(self) -> str:
        return self.to_toml()

    def check(self) -> dict[str, Any]:
        """The report of `lissom check`.

        Returns:
            `title`, `unknowns`, `coordinates`, `constraints`, `independent_constraints`, `freedoms`, `redundant`
            (sentences), `warnings` (sentences), `names` (columns).
        """
        return dict(self._native.check())

    def run(
        self,
        progress: Progress = False,
        threads: int | None = None,
        *,
        inputs: Mapping[str, InputFunction] | None = None,
        sample: float | None = None,
    ) -> Result:
        """Simulates the model as specified by its table `[analysis]`. The interpreter lock is released; Ctrl-C ends the run.

        Args:
            progress: `True` for a line on the terminal with the time that is left, or a function of (steps done, steps planned).
            threads: for models of thousands of elements or joints; results do not depend on it. All by default.
            inputs: functions by the names of entries of `[inputs]`, as `{"motor": lambda sim: -3 * sim["arm.rate"]}`: each is
                called with the simulation every `sample` seconds, from the start on, and its value holds until the next
                call. Rows are then recorded at these instants. A call costs some microseconds, the step that it ends far
                more where steps are shorter than they would be.
            sample: time from call to call [s], with `inputs`.

        Raises:
            SolutionError: if a step has no solution; `error.result` has the results before the failure.
        """
        show, clear = _shown(progress)
        if (inputs is None) != (sample is None):
            raise ValueError("`inputs` and `sample` belong together")
        if inputs is not None and sample is not None:
            try:
                return driven(self._native, inputs, float(sample), show)
            finally:
                clear()
        threads = _at_least(1, threads, "threads")
        try:
            parts, failure = self._native.run(show, threads)
        finally:
            clear()
        result = Result._of(parts, functools.partial(_lissom.animation, self._native, threads))
        if failure is not None:
            failure.result = result
            raise failure
        self._warn(result.summary.get("warnings", []))
        return result

    def _warn(self, found: Sequence[str]) -> None:
        """Warnings about the model itself were reported when it was created."""
        for words in found:
            if words not in self._facts["warnings"]:
                warnings.warn(words, ModelWarning, stacklevel=3)

    def simulation(self) -> Simulation:
        """The model at its start, to be taken on step by step.

        Raises:
            SolutionError: if there are no consistent initial values.

        Warns:
            ModelWarning: when a warning about the results occurs, also while stepping.
        """
        sim = self._native.simulation()
        self._warn(sim.warnings)
        return sim

    def simulations(self, count: int) -> Batch:
        """So many simulations of the model, which are advanced together on all processors.

        Raises:
            SolutionError: if there are no consistent initial values.
        """
        batch = self._native.simulations(_at_least(1, count, "count") or 1)
        self._warn(batch.warnings[0])
        return batch

    def modes(self, count: int | None = None, *, about: About | None = None, shift: float | None = None) -> Modes:
        """Natural modes, as `lissom modes` finds them.

        Args:
            count: number of modes, the lowest first; default: that of the model, or 20.
            about: the state: `"static"`, `"undeformed"`, `"rotation"` (steady, with the velocities of the file) or a time of
                the model's analysis [s].
            shift: seek the modes nearest to this frequency [Hz].

        Raises:
            ModelError: if the request is invalid for the model. SolutionError: if the state is not reached or no
            equilibrium, or modes were missed.
        """
        state = None if about is None else _about(about)
        request = _request(count=_at_least(1, count, "count"), about=state, shift=None if shift is None else float(shift))
        page = functools.partial(_lissom.modes_animation, self._native, request)
        return self._warned(Modes(_lissom.analyse(self._native, "modes", request), page))

    def buckling(self, count: int | None = None) -> Buckling:
        """Load factors at which the model buckles, by a linear estimate, as `lissom buckling` finds them."""
        return self._warned(Buckling(self._analysed("buckling", count=_at_least(1, count, "count"))))

    def reduce(
        self,
        interfaces: str | Sequence[str],
        count: int = 10,
        *,
        parts: str | Sequence[str] = (),
        corrections: bool = True,
        free_modes: bool = False,
        recover: str | Sequence[str] = (),
        about: About = "static",
        name: str | None = None,
    ) -> Reduced:
        """Flexible parts as a superelement with a few interface nodes and modes, as `lissom reduce` computes it.

        Args:
            interfaces: nodes for joints, such as `["beam.start", "beam.end"]`; the floating frame is attached to the first one.
            count: number of modes with fixed interfaces, 0 at least.
            parts: parts to be reduced; default: all.
            corrections: whether shapes compensate for truncated modes where loads and rotation change the stiffness.
            free_modes: whether modes are those of the free parts, without corrections, instead of those with fixed interfaces.
            recover: outputs of the model whose linear components are the rows of the matrix `recovery`.
            about: the state, as for `modes`, without `"rotation"`.
            name: name of the superelement; default: that of the only part, or of the model file.

        Raises:
            ModelError: if the request is invalid for the model. SolutionError: if there is no such state, or the parts are not one
            elastic assembly.
        """
        chosen = {"parts": _names(parts), "interfaces": _names(interfaces), "modes": _at_least(0, count, "count")}
        chosen |= {"recover": _names(recover), "free_modes": free_modes}
        return self._warned(Reduced(self._analysed("reduce", **chosen, corrections=corrections, about=_about(about), name=name)))

    def path(self, **analysis: Any) -> Path:
        """Follows the equilibria under the loads times a load factor, as `lissom run` does for an analysis of kind `path`.

        Args:
            analysis: keys of that analysis, as `end=1.2, step=0.05`; they take the place of the model's table
                `[analysis]`. Without any, the model's own analysis must be of kind `path`.

        Raises:
            SolutionError: if the path cannot be followed to its end; `error.result` has the equilibria before the failure.
        """
        model = self.replace({"analysis": {"kind": "path", **analysis}}) if analysis else self
        parts, failure = _lissom.path(model._native)
        path = Path._of(parts)
        if failure is not None:
            failure.result = path
            raise failure
        return path

    def gradient(self, of: str, by: str | Sequence[str], *, confirm: bool = True) -> Gradient:
        """Derivatives of an output by numbers of the model file, along the steps of a run, as `lissom gradient` finds them.

        Args:
            of: a column, and what of it: `tip.u3` (at the end), `tip.u3@0.5` (at a time), `tip.u3@max`, `tip.u3@rms`.
            by: paths of numbers, as `["bodies.top.mass", "springs.s.stiffness"]`.
            confirm: whether the derivatives are verified by a run with all numbers perturbed.
        """
        return Gradient(self._analysed("gradient", of=of, by=_names(by), unconfirmed=not confirm))

    def campbell(
        self,
        vary: str,
        start: float,
        end: float,
        points: int = 41,
        *,
        count: int = 8,
        rays: Sequence[int] = (1, 2, 3),
    ) -> Campbell:
        """Natural frequencies over a number of the model file, as `lissom campbell` finds them.

        Args:
            vary: path of the number, such as `parameters.speed`.
            start: its first value.
            end: its last value.
            points: number of values.
            count: number of modes, the lowest first.
            rays: multiples of the rotation whose crossings are critical speeds.
        """
        variation = {"path": vary, "from": float(start), "to": float(end), "values": _at_least(2, points, "points")}
        multiples = [_at_least(1, ray, "rays") for ray in rays]
        return self._warned(Campbell(self._analysed("campbell", vary=variation, count=_at_least(1, count, "count"), rays=multiples)))

    def response(
        self,
        inputs: str | Sequence[str],
        outputs: str | Sequence[str],
        start: float,
        end: float,
        points: int = 400,
        *,
        about: About = "static",
    ) -> Response:
        """Response of outputs to harmonic inputs of the linearised model, as `lissom response` finds it.

        Args:
            inputs: inputs, loads (per unit of size) or prescribed motions (per m or rad).
            outputs: outputs, or columns of them.
            start: first frequency [Hz].
            end: last frequency [Hz].
            points: number of frequencies in equal ratios; more are put where a response changes fast.
            about: the state, as for `modes`.
        """
        ports = {"inputs": _names(inputs), "outputs": _names(outputs), "about": _about(about)}
        count = _at_least(2, points, "points")
        return self._warned(Response(self._analysed("response", **ports, **{"from": float(start), "to": float(end)}, points=count)))

    def linearize(
        self, inputs: str | Sequence[str] = (), outputs: str | Sequence[str] = (), *, about: About = "static"
    ) -> LinearModel:
        """The linear model about a state: M, D, K, G, and A, B, C, D of small models, as `lissom linearize` leaves them.

        Args:
            inputs: inputs, loads (per unit of size) or prescribed motions (per m or rad).
            outputs: outputs, or columns of them.
            about: the state, as for `modes`.
        """
        files = self._analysed("linearize", inputs=_names(inputs), outputs=_names(outputs), about=_about(about))
        return self._warned(linear_model(files))

    def _analysed(self, name: str, /, **request: Any) -> Files:
        """The files of an analysis."""
        return _lissom.analyse(self._native, name, _request(**request))

    def _warned(self, found: Report) -> Report:
        for words in found.warnings:
            warnings.warn(words, ModelWarning, stacklevel=3)
        return found

    def _repr_html_(self) -> str:
        """The model file, for a cell of a notebook."""
        return f"<details><summary>{html.escape(repr(self)[1:-1])}</summary><pre>{html.escape(str(self))}</pre></details>"

    def __repr__(self) -> str:
        if self._tables is not None:
            entries = sum(len(of) for of in self._tables.values() if isinstance(of, dict))
            return f"<lissom.Model {self.name!r} of {entries} entries>"
        return f"<lissom.Model {self.name!r}, {self._facts['unknowns']} unknowns>"


def load(path: str | os.PathLike[str], /, **overrides: Any) -> Model:
    """A model from a file.

    Args:
        path: the model file.
        overrides: values to put into it: `load("m.toml", **{"analysis.end": 2})`. Numbers, booleans, texts (also
            expressions, as `"2*pi"`), lists and dictionaries.

    Raises:
        ModelError: if the model is wrong. OSError: if the file cannot be read.
    """
    return Model._of(NativeModel.read(os.fspath(path), _toml.overrides(overrides)))


def loads(text: str, name: str = "model", /, **overrides: Any) -> Model:
    """A model from a text; `name` is its name in messages. Otherwise as `load`."""
    return Model._of(NativeModel(text, name, _toml.overrides(overrides)))


def _names(names: str | Sequence[str]) -> list[str]:
    return [names] if isinstance(names, str) else [str(name) for name in names]


def _request(**values: Any) -> str:
    """The request of an analysis as TOML; values that are None are those of the program."""
    return _toml.value({key: of for key, of in values.items() if of is not None})


def _about(state: About) -> str:
    """The words of the command line."""
    return state if isinstance(state, str) else repr(float(state))


def _at_least(least: int, number: int | None, name: str) -> int | None:
    if number is None:
        return None
    if number != int(number) or not least <= number < 2**32:
        raise ValueError(f"`{name}` is {number}: it must be a whole number, {least} at least")
    return int(number)


def _duration(seconds: float) -> str:
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    return f"{whole // 60}:{whole % 60:02} min" if whole < 3600 else f"{whole // 3600}:{whole % 3600 // 60:02} h"


def _shown(progress: Progress) -> tuple[Callable[[float, float], object] | None, Callable[[], None]]:
    """A function that shows progress, if requested, and one that ends it."""
    if progress is False:
        return None, lambda: None
    if progress is not True:
        if not callable(progress):
            raise TypeError(f"`progress` is {progress!r}: it must be True, False or a function of two numbers")
        return progress, lambda: None
    width = 30
    began: list[tuple[float, float]] = []

    def show(done: float, planned: float) -> None:
        share = done / planned if planned > 0 else 1.0
        bar = "#" * round(width * share)
        now = time.monotonic()
        if not began:
            # A resumed sweep already has members.
            began.append((now, share))
        since, first = began[0]
        left = (now - since) * (1 - share) / (share - first) if share > first else None
        words = "" if left is None else f", {_duration(left)} left"
        print(f"\r[{bar:<{width}}] {100 * share:5.1f} %{words:<20}", end="", file=sys.stderr, flush=True)

    def clear() -> None:
        print("\r" + " " * (width + 30) + "\r", end="", file=sys.stderr, flush=True)

    return show, clear
