"""Sweeps on a cluster of `dask.distributed`: members as batched tasks, results in Parquet files, one per batch."""

from __future__ import annotations

import functools
import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import __version__
from ._lissom import NativeModel, NativeSweep
from ._model import Progress, _shown
from ._sweep import SweepTable, table_of

if TYPE_CHECKING:
    from ._types import Outcome

#: How often a task that raises an error is tried again; tasks of workers that die are not counted.
RETRIES = 3

#: Text, name and overrides of the model, files it includes, sweep file, version of the package.
Specification = tuple[str, str, tuple[tuple[str, str], ...], tuple[tuple[str, str], ...], str, str]


def _specification(*parts: Any) -> Any:
    """A separate task, so that it is repeated if a worker loses it."""
    return parts


@functools.lru_cache(maxsize=4)
def _prepared(specification: Specification) -> NativeSweep:
    """The sweep on a worker, read once."""
    text, name, overrides, known, sweep, version = specification
    if version != __version__:
        raise RuntimeError(f"this worker has version {__version__} of lissom, the client has {version}: install the same")
    return NativeSweep(NativeModel(text, name, list(overrides), dict(known)), sweep, "sweep")


def _solve(specification: Specification, first: int, end: int) -> list[Outcome]:
    """One task: the members from `first` up to `end`, by one thread."""
    return _prepared(specification).solve(list(range(first, end)), 1, None)


def _write(table: SweepTable, path: Path) -> None:
    """The file appears as a whole."""
    import pyarrow
    import pyarrow.parquet

    unfinished = path.with_name(f"_{path.name}.new")
    pyarrow.parquet.write_table(pyarrow.table({name: table[name] for name in table}), unfinished)
    os.replace(unfinished, path)


def _read(path: Path) -> SweepTable:
    import pyarrow
    import pyarrow.parquet

    columns: dict[str, np.ndarray[Any, Any]] = {}
    read = pyarrow.parquet.read_table(path)
    for name in read.column_names:
        column = read.column(name)
        if pyarrow.types.is_string(column.type):
            columns[name] = np.array(column.to_pylist(), dtype=object)
        else:
            columns[name] = column.to_numpy()
    return SweepTable(columns)


def _write_histories(outcomes: list[Outcome], folder: Path) -> None:
    """The requested histories, one file per member. Readers of the folder of parts ignore names with `_`."""
    for outcome in outcomes:
        if outcome[7] is not None:
            path = folder / "_histories" / f"member-{outcome[0]:08}.parquet"
            path.parent.mkdir(exist_ok=True)
            unfinished = path.with_name(f"_{path.name}.new")
            unfinished.write_bytes(outcome[7])
            os.replace(unfinished, path)


def _batch(folder: Path | None, definition: str, restart: bool, batch: int) -> int:
    """Members per batch: the number stored in the folder, if it contains this sweep."""
    if folder is None:
        return batch
    folder.mkdir(parents=True, exist_ok=True)
    kept = folder / "_definition.json"
    if restart:
        kept.unlink(missing_ok=True)
        for part in [*folder.glob("part-*.parquet"), *folder.glob("_histories/member-*.parquet")]:
            part.unlink()
    if kept.exists():
        found = json.loads(kept.read_text(encoding="utf-8"))
        if found["definition"] != definition:
            raise ValueError(
                f"`{folder}` holds another sweep: its model, what is varied or the version of the package is not this "
                "one; choose another folder, or discard what is there by `restart=True`"
            )
        return int(found["batch"])
    if any(folder.glob("part-*.parquet")):
        raise ValueError(f"`{folder}` holds Parquet files of something else: choose another folder")
    unfinished = folder / "_definition.new"
    unfinished.write_text(json.dumps({"definition": definition, "batch": batch}), encoding="utf-8")
    os.replace(unfinished, kept)
    return batch


def sweep_on_cluster(
    model: NativeModel,
    text: str,
    native: NativeSweep,
    client: Any,
    out: str | os.PathLike[str] | None,
    restart: bool,
    batch: int | None,
    progress: Progress,
) -> SweepTable:
    """Solves the members that are missing in `out`, and returns the table of all."""
    from distributed import as_completed

    members = len(native)
    threads = max(1, sum(client.nthreads().values()))
    folder = None if out is None else Path(out)
    if batch is None:
        batch = min(1000, max(1, members // (20 * threads)))
    if batch < 1:
        raise ValueError(f"a batch has at least one member, not {batch}")
    batch = _batch(folder, native.definition(), restart, batch)
    starts = range(0, members, batch)
    tables: dict[int, SweepTable] = {}
    if folder is not None:
        for first in starts:
            part = folder / f"part-{first:08}.parquet"
            if part.exists():
                tables[first] = _read(part)
    done = sum(len(table) for table in tables.values())
    model_text, name, overrides, known = model.__getnewargs__()
    parts = (model_text, name, tuple(overrides), tuple(sorted(known.items())), text, __version__)
    specification = client.submit(_specification, *parts, pure=False)
    futures = {
        client.submit(_solve, specification, first, min(first + batch, members), pure=False, retries=RETRIES): first
        for first in starts
        if first not in tables
    }
    show, clear = _shown(progress)
    try:
        for future in as_completed(list(futures)):
            first = futures.pop(future)
            # An error of a task that was tried often enough is raised here.
            outcomes = future.result()
            table = table_of(native, outcomes)
            future.release()
            if folder is not None:
                _write_histories(outcomes, folder)
                _write(table, folder / f"part-{first:08}.parquet")
            tables[first] = table
            done += len(table)
            if show is not None:
                show(done, members)
    finally:
        client.cancel(list(futures))
        clear()
    ordered = [tables[first] for first in starts]
    columns = {column: np.concatenate([table[column] for table in ordered]) for column in ordered[0]}
    whole = SweepTable(columns, native.paths(), native.collected())
    if not np.array_equal(whole["member"], np.arange(members)):
        raise RuntimeError(f"the files in `{folder}` do not hold every member once: discard them by `restart=True`")
    return whole
