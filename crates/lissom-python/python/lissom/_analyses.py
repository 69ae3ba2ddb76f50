"""Results of modes, buckling, gradients and other analyses: the tables of the command line as arrays."""

from __future__ import annotations

import json
import os
import pathlib
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from ._animation import Animation
from ._result import Result
from ._tables import Files, Table, full, known
from ._types import Array

if TYPE_CHECKING:
    import numpy.typing as npt


class _Found:
    """Tables, and a summary."""

    def __init__(self, files: Files) -> None:
        texts, summary, warnings = files
        self._texts = dict(texts)
        #: The facts of `summary.json`.
        self.summary: dict[str, Any] = json.loads(summary)
        #: Warnings.
        self.warnings = warnings

    @property
    def files(self) -> dict[str, str]:
        """The tables as texts, by the names that the command line gives their files."""
        return dict(self._texts)


class _Shapes(_Found):
    """Shapes over nodes."""

    def __init__(self, files: Files) -> None:
        super().__init__(files)
        table = Table._of(self._texts["shapes.csv"])
        count = int(table["mode"].max(initial=0))
        rows = len(table) // max(1, count)
        #: Names of the nodes.
        self.nodes = [str(node) for node in table["node"][:rows]]
        #: Their positions in the state of linearisation [m], of shape (nodes, 3).
        self.positions: Array = np.column_stack([table[axis][:rows] for axis in ("x", "y", "z")]).astype(np.float64)
        motion = ("u1", "u2", "u3", "r1", "r2", "r3")
        shapes = np.column_stack([table[name] for name in motion]).astype(np.float64)
        #: Displacements [m] and rotations [rad] in global axes, of shape (modes, nodes, 6); complex where modes are.
        self.shapes: npt.NDArray[Any] = shapes.reshape((count, rows, 6))
        if "u1_im" in table:
            imaginary = np.column_stack([table[f"{name}_im"] for name in motion]).astype(np.float64)
            self.shapes = self.shapes + 1j * imaginary.reshape((count, rows, 6))


class Modes(_Shapes):
    """Natural modes about a state, by ascending frequency, unstable ones first. Shapes have unit modal mass."""

    def __init__(self, files: Files, page: Callable[[], str]) -> None:
        super().__init__(files)
        self._page = page
        table = Table._of(self._texts["modes.csv"])
        #: Frequencies |s|/(2π) [Hz], of shape (modes,).
        self.frequencies: Array = table["frequency"]
        #: Damping ratios [-], of shape (modes,).
        self.damping: Array = table["damping"]
        #: `rigid`, `oscillation`, `decay`, `divergence` or `flutter`.
        self.kinds = [str(kind) for kind in table["kind"]]
        values = [mode["eigenvalue"] for mode in self.summary["modes"]]
        #: Eigenvalues s [1/s], complex, of shape (modes,).
        self.eigenvalues: npt.NDArray[np.complex128] = np.array([complex(*value) for value in values], dtype=np.complex128)
        #: Share of each part in the kinetic energy of each mode.
        self.kinetic_shares: list[dict[str, float]] = [mode["kinetic_shares"] for mode in self.summary["modes"]]

    def __len__(self) -> int:
        return len(self.frequencies)

    def animate(self) -> Animation:
        """The page that shows the shapes, for a cell of a notebook. The modes are found once more."""
        return Animation(self._page())

    def __repr__(self) -> str:
        return f"<lissom.Modes: {len(self)} about {self.summary['about']}>"


class Buckling(_Shapes):
    """Load factors at which a model buckles, by a linear estimate, and their shapes."""

    def __init__(self, files: Files) -> None:
        super().__init__(files)
        #: Load factors, of shape (modes,).
        self.load_factors: Array = Table._of(self._texts["buckling.csv"])["load_factor"]

    def __len__(self) -> int:
        return len(self.load_factors)

    def __repr__(self) -> str:
        return f"<lissom.Buckling: {len(self)} load factors>"


class Reduced(_Found):
    """A superelement: matrices over six displacements per interface [m, rad] and one coordinate per mode and correction."""

    def __init__(self, files: Files) -> None:
        super().__init__(files)
        #: Name of the superelement.
        self.name = next(name for name in self._texts if name.endswith(".toml")).removesuffix(".toml")
        #: Names of the interfaces, in the order of the matrices.
        self.interfaces: list[str] = list(self.summary["interfaces"])
        #: Frequencies of the modes with fixed interfaces [Hz], of shape (modes,).
        self.frequencies: Array = np.array(self.summary["frequencies"], dtype=np.float64)
        #: Mass and stiffness, of shape (coordinates, coordinates).
        self.M: Array = full(self._texts[f"{self.name}-mass.mtx"])
        self.K: Array = full(self._texts[f"{self.name}-stiffness.mtx"])

    def to_folder(self, path: str | os.PathLike[str]) -> None:
        """Writes the matrices and `NAME.toml`, which uses them, to a folder, for `include` and `[parts]` of a model."""
        os.makedirs(path, exist_ok=True)
        for name, text in self._texts.items():
            pathlib.Path(path, name).write_text(text, encoding="utf-8", newline="\n")

    def __repr__(self) -> str:
        return f"<lissom.Reduced {self.name!r}: {len(self.M)} coordinates, {len(self.interfaces)} interfaces>"


class Gradient(_Found):
    """Derivatives of an output by numbers of the model file, along the steps of a run. `gradient[path]` is one of them."""

    def __init__(self, files: Files) -> None:
        super().__init__(files)
        table = Table._of(self._texts["gradient.csv"])
        #: The value that is differentiated.
        self.value = float(self.summary["value"])
        #: Its time [s]; none for a mean.
        self.time: float | None = self.summary["time"]
        #: Paths of the numbers.
        self.paths = [str(path) for path in table["path"]]
        #: The numbers, of shape (paths,).
        self.numbers: Array = table["number"].astype(np.float64)
        #: Derivatives by them, of shape (paths,).
        self.derivatives: Array = table["derivative"].astype(np.float64)

    def __getitem__(self, path: str) -> float:
        return float(self.derivatives[self.paths.index(known(path, self.paths, "path"))])

    def __iter__(self) -> Iterator[str]:
        return iter(self.paths)

    def __len__(self) -> int:
        return len(self.paths)

    def __repr__(self) -> str:
        return f"<lissom.Gradient of {self.summary['of']} = {self.value:.6g} by {', '.join(self.paths)}>"


class Campbell(_Found):
    """Natural frequencies over a parameter, one row per value and mode.

    `table` has the columns of `campbell.csv`: `value`, `rotation` [Hz], `line` (from 1), `frequency` [Hz] and `damping` in the axes
    of the nodes, `kind`, `whirl`, `frequency_at_rest` [Hz] (NaN where there are two), `likeness`.
    """

    def __init__(self, files: Files) -> None:
        super().__init__(files)
        #: The rows.
        self.table = Table._of(self._texts["campbell.csv"])
        #: Where lines meet multiples of the rotation: dictionaries of `line`, `multiple`, `value`, `rotation` [Hz], `whirl`, `axes`.
        self.critical_speeds: list[dict[str, Any]] = self.summary["critical_speeds"]

    def line(self, number: int) -> tuple[Array, Array]:
        """Values of the parameter and frequencies [Hz] of a line, counted from 1."""
        own = self.table["line"] == number
        if not own.any():
            raise KeyError(f"there is no line {number}: they are 1 to {self.summary['lines']}")
        return self.table["value"][own], self.table["frequency"][own]

    def plot(self) -> Any:
        """The diagram as a `matplotlib.figure.Figure`."""
        from ._plots import figure_of

        figure, (ax,) = figure_of(1, height=4.4)
        for number in range(1, self.summary["lines"] + 1):
            ax.plot(*self.line(number), marker=".", markersize=3)
        for crossing in self.critical_speeds:
            ax.plot(crossing["value"], crossing["multiple"] * crossing["rotation"], "kx")
        ax.set_xlabel(self.summary["vary"])
        ax.set_ylabel("frequency [Hz]")
        ax.grid(True, alpha=0.3)
        return figure

    def __repr__(self) -> str:
        return f"<lissom.Campbell: {self.summary['lines']} lines over {self.summary['values']} values of {self.summary['vary']}>"


class Response(_Found):
    """Response of outputs to harmonic inputs. `response["tip.u3/motor"]` has one complex amplitude per frequency, output per input."""

    def __init__(self, files: Files) -> None:
        super().__init__(files)
        table = Table._of(self._texts["response.csv"])
        #: Frequencies [Hz], ascending, of shape (frequencies,).
        self.frequencies: Array = table["frequency"]
        #: Names of the pairs, `output/input`.
        self.names = [str(transfer["transfer"]) for transfer in self.summary["transfers"]]
        #: Units of the outputs, by pair.
        self.units: dict[str, str] = {name: of["unit"] for name, of in zip(self.names, self.summary["transfers"])}
        self._amplitudes = {name: table[f"{name}.real"] + 1j * table[f"{name}.imaginary"] for name in self.names}

    def __getitem__(self, name: str) -> npt.NDArray[np.complex128]:
        return self._amplitudes[known(name, self._amplitudes, "pair")]

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __len__(self) -> int:
        return len(self.names)

    def plot(self) -> Any:
        """Magnitudes and phases as a `matplotlib.figure.Figure`."""
        from ._plots import bode_figure

        return bode_figure(self)

    def __repr__(self) -> str:
        return f"<lissom.Response of {', '.join(self.names)} at {len(self.frequencies)} frequencies>"


class Path(Result):
    """An equilibrium path: `path["load_factor"]`, `path["unstable"]` and the outputs, over the length of the path.

    Where the analysis varies a number, the column is called after it, and critical points have `value` for `load_factor`.

    The length along the path [-] replaces the time of the results of a run.
    """

    @property
    def arc(self) -> Array:
        """Length along the path [-], of shape (records,)."""
        return self.time

    @property
    def critical_points(self) -> list[dict[str, Any]]:
        """Limit points and bifurcations: `kind`, `load_factor`, `arc`, `unstable_before`, `unstable_after`, `located`."""
        return list(self.summary.get("critical_points", []))

    def plot(self, *names: str) -> Any:
        """Columns over the length of the path as a `matplotlib.figure.Figure`."""
        from ._plots import result_figure

        return result_figure(self, names, "length of the path [-]")

    def animate(self) -> Animation:
        """There is none: `ValueError`."""
        raise ValueError("an analysis of kind `path` leaves no motion to be shown")
