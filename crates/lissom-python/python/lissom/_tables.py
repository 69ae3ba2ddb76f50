"""The tables and matrices that analyses leave, read from their texts to the last bit."""

from __future__ import annotations

import csv
import difflib
import io
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from ._types import Array

if TYPE_CHECKING:
    import pandas

#: Names and texts of files, summary as JSON, warnings.
Files = tuple[list[tuple[str, str]], str, list[str]]


class Table:
    """Columns of equal length. `table["frequency"]` is an array of shape (number of rows,); numbers that are missing are NaN."""

    def __init__(self, columns: dict[str, np.ndarray[Any, Any]]) -> None:
        self._columns = columns

    @classmethod
    def _of(cls, text: str) -> Table:
        rows = list(csv.reader(io.StringIO(text)))
        names, body = rows[0], rows[1:]
        return cls({name: _column([row[index] for row in body]) for index, name in enumerate(names)})

    @property
    def names(self) -> list[str]:
        """Names of the columns."""
        return list(self._columns)

    def __getitem__(self, name: str) -> np.ndarray[Any, Any]:
        return self._columns[known(name, self._columns, "column")]

    def __contains__(self, name: object) -> bool:
        return name in self._columns

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(next(iter(self._columns.values()), ()))

    def to_pandas(self) -> pandas.DataFrame:
        """A `pandas.DataFrame`."""
        import pandas

        return pandas.DataFrame(self._columns)

    def __repr__(self) -> str:
        return f"<lissom.Table of {len(self)} rows: {', '.join(self._columns)}>"


def known(name: str, among: Iterable[str], what: str) -> str:
    """The name, or a `KeyError` that suggests a similar one."""
    names = list(among)
    if name in names:
        return name
    near = difflib.get_close_matches(name, names, n=1)
    help = f"did you mean `{near[0]}`?" if near else "known here: " + ", ".join(names)
    raise KeyError(f"`{name}` is no {what}; {help}")


def _column(words: list[str]) -> np.ndarray[Any, Any]:
    """Whole numbers, numbers, or texts."""
    for kind, dtype in ((int, np.int64), (_number, np.float64)):
        try:
            return np.array([kind(word) for word in words], dtype=dtype)
        except (ValueError, OverflowError):
            pass
    return np.array(words, dtype=object)


def _number(word: str) -> float:
    return float(word) if word else float("nan")


def full(text: str) -> Array:
    """A full matrix of shape (rows, columns) from its text in the Matrix Market format."""
    shape, values = _market(text, "array")
    return np.ascontiguousarray(values.reshape((shape[1], shape[0])).T)


def sparse(text: str) -> Any:
    """A `scipy.sparse.csr_matrix` from its text in the Matrix Market format."""
    scipy_sparse = scipy("sparse")
    shape, values = _market(text, "coordinate")
    entries = values.reshape((-1, 3))
    places = (entries[:, 0].astype(np.int64) - 1, entries[:, 1].astype(np.int64) - 1)
    return scipy_sparse.csr_matrix((entries[:, 2], places), shape=(shape[0], shape[1]))


def _market(text: str, form: str) -> tuple[list[int], Array]:
    lines = text.split("\n")
    if lines[0] != f"%%MatrixMarket matrix {form} real general":
        raise ValueError(f"`{lines[0]}` does not begin a matrix of the form {form}")
    first = next(index for index, line in enumerate(lines) if not line.startswith("%"))
    shape = [int(word) for word in lines[first].split()]
    words = " ".join(lines[first + 1 :]).split()
    # Python's own conversion: the nearest number, to the last bit.
    return shape, np.array([float(word) for word in words], dtype=np.float64)


def scipy(module: str) -> Any:
    """A module of SciPy, which only some calls need."""
    import importlib

    try:
        return importlib.import_module(f"scipy.{module}")
    except ImportError:
        raise ImportError("sparse matrices need SciPy: pip install scipy") from None
