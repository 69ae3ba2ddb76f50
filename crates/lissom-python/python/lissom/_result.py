"""Results of a run: columns over time, and a summary."""

from __future__ import annotations

import functools
import html
import json
import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _lissom
from ._animation import Animation
from ._tables import known
from ._types import Array, Parts

if TYPE_CHECKING:
    import pandas
    from typing_extensions import Self


class Result:
    """Columns over time, in SI units. `result["midspan.u2"]` is an array of shape (number of records,), which is read-only."""

    def __init__(
        self,
        time: Array,
        columns: dict[str, Array],
        units: dict[str, str],
        summary: dict[str, Any],
        page: Callable[[], str] | None = None,
    ) -> None:
        self._page = page
        #: Times of the records [s], of shape (number of records,).
        self.time = time
        #: Unit of each column, as `m`; empty for none.
        self.units = units
        #: The facts of `summary.json`: steps, iterations, times, violations, energies.
        self.summary = summary
        self._columns = columns
        for array in (time, *columns.values()):
            array.flags.writeable = False

    def __reduce__(self) -> tuple[Any, ...]:
        # Arrays forget that they are read-only when they are pickled.
        return type(self), (self.time, self._columns, self.units, self.summary, self._page)

    @classmethod
    def _of(cls, parts: Parts, page: Callable[[], str] | None = None) -> Self:
        time, names, units, arrays, summary = parts
        return cls(time, dict(zip(names, arrays)), dict(zip(names, units)), json.loads(summary), page)

    @property
    def names(self) -> list[str]:
        """Names of the columns, in the order of the model."""
        return list(self._columns)

    @property
    def is_complete(self) -> bool:
        """Whether the run reached its end. False for results of a run that failed or was cut off."""
        return bool(self.summary.get("stopped") == "end")

    def __getitem__(self, name: str) -> Array:
        return self._columns[self._name(name)]

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and self._found(name) is not None

    def _found(self, name: str) -> str | None:
        """The present name of the column that is called `name`, which may be one of its former names."""
        if name in self._columns:
            return name
        names = self.names
        position = _lissom.column_position(names, name)
        return None if position is None else names[position]

    def _name(self, name: str) -> str:
        """The same, or a `KeyError` that suggests a similar name."""
        return self._found(name) or known(name, self._columns, "column")

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def to_pandas(self) -> pandas.DataFrame:
        """A `pandas.DataFrame` with the time as index. Its `to_parquet` writes Parquet."""
        import pandas

        return pandas.DataFrame(self._columns, index=pandas.Index(self.time, name="time"))

    def to_npz(self, path: str | os.PathLike[str]) -> None:
        """Writes a NumPy archive: `time`, every column under its name, and `lissom`, units and summary as JSON.

        `lissom.read` and `numpy.load` read it, to the last bit. The file has the ending `.npz`.
        """
        target = Path(path)
        if target.suffix != ".npz":
            raise ValueError(f"the name of a NumPy archive ends with `.npz`, not `{target.name}`")
        taken = [name for name in self._columns if name in ("time", "lissom", "file")]
        if taken:
            raise ValueError(f"an archive cannot hold a column called `{taken[0]}`: give the output another name")
        about = json.dumps({"units": self.units, "summary": self.summary})
        arrays: dict[str, Any] = {"time": self.time, **self._columns, "lissom": np.array(about)}
        np.savez(target, **arrays)

    @classmethod
    def _of_npz(cls, path: Path) -> Self:
        with np.load(path, allow_pickle=False) as archive:
            if "lissom" not in archive or "time" not in archive:
                raise ValueError(f"`{path}` was not written by `Result.to_npz`")
            about = json.loads(str(archive["lissom"]))
            columns = {name: archive[name] for name in archive.files if name not in ("time", "lissom")}
            return cls(archive["time"], columns, about["units"], about["summary"])

    def plot(self, *names: str) -> Any:
        """Columns over time as a `matplotlib.figure.Figure`: all outputs, or the outputs and columns that are named."""
        from ._plots import result_figure

        return result_figure(self, names, "time [s]")

    def animate(self) -> Animation:
        """The animated page of `lissom view` with plots, for a cell of a notebook.

        Results of `Model.run` contain no motion: the model is run again. Those of a folder use its motion.
        """
        if self._page is None:
            raise ValueError("these results have no model and no folder from which a motion could be shown")
        return Animation(self._page())

    def _repr_html_(self) -> str:
        """A table of the columns, for a cell of a notebook."""
        rows = []
        for name, values in self._columns.items():
            numbers = [values[0], values[-1], np.nanmin(values), np.nanmax(values)] if np.isfinite(values).any() else []
            cells = [name, self.units.get(name, ""), *(f"{number:.6g}" for number in numbers)]
            rows.append("<tr>" + "".join(f"<td>{html.escape(cell)}</td>" for cell in cells) + "</tr>")
        head = "".join(f"<th>{word}</th>" for word in ("column", "unit", "first", "last", "min", "max"))
        return f"<p>{html.escape(repr(self)[1:-1])}</p><table><thead><tr>{head}</tr></thead><tbody>{''.join(rows)}</tbody></table>"

    def __repr__(self) -> str:
        stopped = self.summary.get("stopped", "unknown")
        return f"<lissom.Result of {len(self.time)} records, {len(self._columns)} columns, stopped: {stopped}>"


def read(path: str | os.PathLike[str]) -> Result:
    """Results of `lissom run` in a folder, or of `Result.to_npz` in a file. `is_complete` states whether the run reached its end.

    Raises:
        OSError: if there is no table. ValueError: if it is damaged.
    """
    if os.fspath(path).endswith(".npz"):
        return Result._of_npz(Path(path))
    folder = os.fspath(path)
    return Result._of(_lissom.read_folder(folder), functools.partial(_lissom.folder_animation, folder))
