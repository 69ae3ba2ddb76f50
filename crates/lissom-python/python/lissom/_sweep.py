"""Sweeps: one model solved many times with other values."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _toml
from ._lissom import NativeSweep
from ._model import Model, Progress, _at_least, _shown
from ._tables import known

if TYPE_CHECKING:
    import pandas

    from ._types import Outcome


class SolutionWarning(UserWarning):
    """Members of a sweep, or simulations of a batch, have no solution."""


class SweepTable:
    """One row per member, in their order. `table["swing"]` is an array of shape (number of members,).

    Columns are those of `sweep.csv`: `member`, the varied paths, what was collected (NaN in members that are not solved),
    `state` (`solved`, `failed`, `wrong_model`), `time`, `steps`, `max_constraint_violation`, `diagnosis`.
    """

    def __init__(
        self, columns: dict[str, np.ndarray[Any, Any]], varied: Sequence[str] = (), collected: Sequence[str] = ()
    ) -> None:
        self._columns = columns
        #: Names of the columns that were varied, and of those that were collected.
        self.varied, self.collected = list(varied), list(collected)

    @property
    def names(self) -> list[str]:
        """Names of the columns."""
        return list(self._columns)

    @property
    def failed(self) -> np.ndarray[Any, Any]:
        """Numbers of the members that are not solved."""
        return np.array(self["member"][self["state"] != "solved"])

    def __getitem__(self, name: str) -> np.ndarray[Any, Any]:
        return self._columns[known(name, self._columns, "column")]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self["member"])

    def to_pandas(self) -> pandas.DataFrame:
        """A `pandas.DataFrame`. Its `to_parquet` writes Parquet."""
        import pandas

        return pandas.DataFrame(self._columns)

    def plot(self) -> Any:
        """A figure of matplotlib: collected scalars over varied numbers, for the solved members."""
        from ._plots import sweep_figure

        return sweep_figure(self)

    def plot_parallel(self) -> Any:
        """A figure of matplotlib: parallel coordinates, a line per solved member, coloured by the last column collected."""
        from ._plots import parallel_figure

        return parallel_figure(self)

    def __repr__(self) -> str:
        return f"<lissom.SweepTable of {len(self)} members, {len(self.failed)} not solved>"


def _text(
    vary: Mapping[str, Any],
    collect: Mapping[str, str] | Sequence[str],
    sampling: str,
    members: int | None,
    seed: int | None,
    set: Mapping[str, Any],
    histories: Sequence[str],
) -> str:
    """The sweep file that means the same."""
    if not isinstance(collect, Mapping):
        if isinstance(collect, str):
            collect = [collect]
        collect = {words: words for words in collect}
    lines = ["lissom_sweep = 1", f"sampling = {_toml.value(sampling)}"]
    if members is not None:
        lines.append(f"members = {_toml.value(members)}")
    if seed is not None:
        lines.append(f"seed = {_toml.value(seed)}")
    if histories:
        lines.append(f"histories = {_toml.value(list(histories))}")
    for name, table in (("set", set), ("vary", vary), ("collect", collect)):
        lines.append(f"[{name}]")
        lines += [f"{_toml.value(str(path))} = {_toml.value(of)}" for path, of in table.items()]
    return "\n".join(lines) + "\n"


def table_of(native: NativeSweep, outcomes: Sequence[Outcome]) -> SweepTable:
    """The table of some outcomes."""
    count = len(outcomes)
    values = [native.values(outcome[0]) for outcome in outcomes]
    columns: dict[str, np.ndarray[Any, Any]] = {"member": np.array([outcome[0] for outcome in outcomes], dtype=np.int64)}
    for index, path in enumerate(native.paths()):
        column = [value[index] for value in values]
        if all(isinstance(value, float) for value in column):
            columns[path] = np.array(column, dtype=np.float64)
        else:
            columns[path] = np.array([str(value) for value in column], dtype=object)
    for index, name in enumerate(native.collected()):
        of = (outcome[2][index] if outcome[2] else np.nan for outcome in outcomes)
        columns[name] = np.fromiter(of, dtype=np.float64, count=count)

    def number(value: float | None) -> float:
        return np.nan if value is None else value

    columns["state"] = np.array([outcome[1] for outcome in outcomes], dtype=object)
    columns["time"] = np.array([number(outcome[3]) for outcome in outcomes], dtype=np.float64)
    columns["steps"] = np.array([outcome[4] for outcome in outcomes], dtype=np.int64)
    columns["max_constraint_violation"] = np.array([number(outcome[5]) for outcome in outcomes], dtype=np.float64)
    columns["diagnosis"] = np.array([outcome[6] or "" for outcome in outcomes], dtype=object)
    return SweepTable(columns, native.paths(), native.collected())


def warn_of(table: SweepTable) -> None:
    """Warns of members that are not solved."""
    failed = table.failed
    if len(failed):
        first = int(failed[0])
        row = int(np.flatnonzero(table["member"] == first)[0])
        words = f"{len(failed)} of {len(table)} members have no solution; member {first}: {table['diagnosis'][row]}"
        warnings.warn(words, SolutionWarning, stacklevel=3)


def sweep(
    model: Model,
    vary: Mapping[str, Any],
    *,
    collect: Mapping[str, str] | Sequence[str],
    histories: Sequence[str] = (),
    sampling: str = "grid",
    members: int | None = None,
    seed: int | None = None,
    set: Mapping[str, Any] | None = None,
    out: str | os.PathLike[str] | None = None,
    restart: bool = False,
    workers: int | None = None,
    progress: Progress = False,
    client: Any = None,
    batch: int | None = None,
) -> SweepTable:
    """Solves a model many times with other values. Results do not depend on the number of workers.

    Args:
        model: the model.
        vary: paths into the model and their values: a list, or a dictionary as `{"from": 1, "to": 3, "count": 5}`,
            `{"from": 1, "to": 3, "spacing": "logarithmic"}` or `{"mean": 1, "standard_deviation": 0.1}`.
        collect: statistics of columns by name, such as `{"swing": "max(bob.x)"}`, or a list of statistics.
            Statistics: max, min, max_abs, time_of_max, time_of_min, mean, rms, initial, final; of events time_of_event.
        histories: columns whose whole histories are kept, a Parquet file per member in `histories` below `out`; with
            `client` in `_histories`.
        sampling: `grid`, `list`, `latin-hypercube`, `sobol` or `monte-carlo`.
        members: number of members, where values are drawn.
        seed: start of the random numbers.
        set: paths and values that all members have.
        out: folder for what `lissom sweep` leaves; a sweep that was cut off goes on from there. With `client` the folder
            of Parquet files, one per batch.
        restart: discard what an earlier sweep left in `out`.
        workers: members solved at the same time on this machine; all processors by default.
        progress: `True` for a line on the terminal with the time that is left, or a function of (members done, members in
            all).
        client: a `dask.distributed.Client`: members are solved in batches by its workers.
        batch: members per task of the cluster; by default a twentieth of a worker's share, at most 1000.

    Returns:
        The table. For unsolved members it has the cause of the failure, and a `SolutionWarning` is issued.

    Raises:
        ModelError: if every member has a wrong model, or the sweep itself is wrong.
        ValueError: if `out` contains another sweep.
    """
    if histories and out is None:
        raise ValueError("histories are kept in files: name a folder by `out`")
    workers = _at_least(1, workers, "workers")
    text = _text(vary, collect, sampling, members, seed, set or {}, histories)
    native = NativeSweep(model._native, text, "sweep")
    if client is not None:
        from ._cluster import sweep_on_cluster

        table = sweep_on_cluster(model._native, text, native, client, out, restart, batch, progress)
    else:
        show, clear = _shown(progress)
        try:
            if out is None:
                outcomes = native.solve(list(range(len(native))), workers, show)
            else:
                outcomes = native.solve_in_folder(os.fspath(out), restart, workers, show)
        finally:
            clear()
        table = table_of(native, outcomes)
    warn_of(table)
    return table
