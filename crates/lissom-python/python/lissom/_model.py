"""A model: a text with values put into it, checked when it is made."""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Callable
from typing import Any, Union

from . import _toml
from ._lissom import NativeModel, Simulation, SolutionError
from ._result import Result

Progress = Union[bool, Callable[[float, float], object]]


class ModelWarning(UserWarning):
    """Something in a model may not be meant as it is written, or its results are to be doubted."""


class Model:
    """A checked model, made by `load` or `loads`. It can be pickled.

    Args:
        text: the model file's text.
        name: what messages call it.
        overrides: paths into the model and the values to put there, as `{"analysis.step": 1e-4}`.

    Raises:
        ModelError: if the model is wrong; the text underlines every mistake.
    """

    def __init__(self, text: str, name: str = "model", overrides: dict[str, Any] | None = None) -> None:
        self._become(NativeModel(text, name, _toml.overrides(overrides or {})))

    def _become(self, native: NativeModel) -> None:
        self._native = native
        self._facts = native.check()
        for words in self._facts["warnings"]:
            warnings.warn(f"{native.name}: {words}", ModelWarning, stacklevel=4)

    @classmethod
    def _of(cls, native: NativeModel) -> Model:
        model = cls.__new__(cls)
        model._become(native)
        return model

    def __reduce__(self) -> tuple[Callable[[NativeModel], Model], tuple[NativeModel]]:
        return (Model._of, (self._native,))

    @property
    def name(self) -> str:
        """Path or name."""
        return self._native.name

    @property
    def overrides(self) -> dict[str, str]:
        """What was put into the model: paths and TOML values."""
        return dict(self._native.overrides)

    @property
    def names(self) -> list[str]:
        """Names of the columns that a run records, as `midspan.u2`."""
        return list(self._facts["names"])

    def replace(self, changes: dict[str, Any] | None = None, /, **more: Any) -> Model:
        """The model with other values: `model.replace({"bodies.top.mass": 2})`, or the same as keywords."""
        return Model._of(self._native.replace(_toml.overrides({**(changes or {}), **more})))

    def to_toml(self) -> str:
        """The model as TOML: the text as it was written, or, with values put into it, the same without its comments."""
        return self._native.to_toml()

    def check(self) -> dict[str, Any]:
        """What `lissom check` tells.

        Returns:
            `title`, `unknowns`, `coordinates`, `constraints`, `independent_constraints`, `freedoms`, `redundant`
            (sentences), `warnings` (sentences), `names` (columns).
        """
        return dict(self._native.check())

    def run(self, progress: Progress = False, threads: int | None = None) -> Result:
        """Simulates the model as its table `[analysis]` asks. The interpreter lock is released; Ctrl-C ends the run.

        Args:
            progress: `True` for a line on the terminal, or a function of (steps done, steps planned).
            threads: for models of thousands of elements or joints; results do not depend on it. All by default.

        Raises:
            SolutionError: if a step has no solution; `error.result` holds what was computed before.
        """
        show, clear = _shown(progress)
        try:
            parts, failure = self._native.run(show, threads)
        finally:
            clear()
        result = Result._of(parts)
        if failure is not None:
            error = SolutionError(failure)
            error.result = result
            raise error
        # Those of the model itself were told when it was made.
        for words in result.summary.get("warnings", []):
            if words not in self._facts["warnings"]:
                warnings.warn(words, ModelWarning, stacklevel=2)
        return result

    def simulation(self) -> Simulation:
        """The model at its start, to be taken on step by step.

        Raises:
            SolutionError: if there are no consistent initial values.
        """
        return self._native.simulation()

    def __repr__(self) -> str:
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
    """A model from a text; `name` is what messages call it. Otherwise as `load`."""
    return Model._of(NativeModel(text, name, _toml.overrides(overrides)))


def _shown(progress: Progress) -> tuple[Callable[[float, float], object] | None, Callable[[], None]]:
    """A function that shows progress, if it is wanted, and one that ends it."""
    if progress is False:
        return None, lambda: None
    if progress is not True:
        return progress, lambda: None
    width = 30

    def show(done: float, planned: float) -> None:
        share = done / planned if planned > 0 else 1.0
        bar = "#" * round(width * share)
        print(f"\r[{bar:<{width}}] {100 * share:5.1f} %", end="", file=sys.stderr, flush=True)

    def clear() -> None:
        print("\r" + " " * (width + 10) + "\r", end="", file=sys.stderr, flush=True)

    return show, clear
