"""What a run leaves: columns over time, and a summary."""

from __future__ import annotations

import difflib
import json
import os
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from . import _lissom
from ._types import Array, Parts

if TYPE_CHECKING:
    import pandas


class Result:
    """Columns over time, in SI units. `result["midspan.u2"]` is an array of shape (number of records,)."""

    def __init__(self, time: Array, columns: dict[str, Array], units: dict[str, str], summary: dict[str, Any]) -> None:
        #: Times of the records [s], of shape (number of records,).
        self.time = time
        #: Unit of each column, as `m`; empty for none.
        self.units = units
        #: The facts of `summary.json`: steps, iterations, times, violations, energies.
        self.summary = summary
        self._columns = columns

    @classmethod
    def _of(cls, parts: Parts) -> Result:
        time, names, units, arrays, summary = parts
        return cls(time, dict(zip(names, arrays)), dict(zip(names, units)), json.loads(summary))

    @property
    def names(self) -> list[str]:
        """Names of the columns, in the order of the model."""
        return list(self._columns)

    @property
    def is_complete(self) -> bool:
        """Whether the run reached its end. False for results of a run that failed or was cut off."""
        return bool(self.summary.get("stopped") == "end")

    def __getitem__(self, name: str) -> Array:
        try:
            return self._columns[name]
        except KeyError:
            near = difflib.get_close_matches(name, self._columns, n=1)
            help = f"did you mean `{near[0]}`?" if near else "the columns are " + ", ".join(self._columns)
            raise KeyError(f"`{name}` is no column; {help}") from None

    def __contains__(self, name: object) -> bool:
        return name in self._columns

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def to_pandas(self) -> pandas.DataFrame:
        """A `pandas.DataFrame` with the time as index. Its `to_parquet` writes Parquet."""
        import pandas

        return pandas.DataFrame(self._columns, index=pandas.Index(self.time, name="time"))

    def __repr__(self) -> str:
        stopped = self.summary.get("stopped", "unknown")
        return f"<lissom.Result of {len(self.time)} records, {len(self._columns)} columns, stopped: {stopped}>"


def read(folder: str | os.PathLike[str]) -> Result:
    """What `lissom run` left in a folder. Ask `is_complete` whether that run reached its end.

    Raises:
        OSError: if there is no table. ValueError: if it is damaged.
    """
    return Result._of(_lissom.read_folder(os.fspath(folder)))
