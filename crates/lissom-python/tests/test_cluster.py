"""Sweeps on a cluster: two worker processes, one of which is killed."""

from __future__ import annotations

import os
import runpy
import signal
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from distributed import Client, LocalCluster

import lissom
from conftest import PENDULUM, ROOT

VARY = {"point_masses.bob.mass": {"from": 1, "to": 4}, "springs.spring.stiffness": {"from": 1, "to": 100, "spacing": "logarithmic"}}
COLLECT = {"swing": "max(bob.x)", "rest": "rms(energy.kinetic)"}


@pytest.fixture
def client() -> Iterator[Any]:
    with LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        with Client(cluster) as client:
            yield client


def equal(a: lissom.SweepTable, b: lissom.SweepTable) -> None:
    assert a.names == b.names and len(a) == len(b)
    for name in a:
        if a[name].dtype == np.float64:
            assert a[name].tobytes() == b[name].tobytes(), name
        else:
            assert list(a[name]) == list(b[name]), name


def test_a_cluster_that_loses_a_worker_gives_the_serial_table(client: Any, tmp_path: Path) -> None:
    model = lissom.load(PENDULUM, **{"analysis.end": 0.5, "analysis.step": 2e-3})
    drawn: dict[str, Any] = {"collect": COLLECT, "sampling": "latin-hypercube", "members": 1000, "seed": 4}
    serial = lissom.sweep(model, VARY, workers=1, **drawn)
    workers = client.run(os.getpid)
    killed: list[int] = []

    def kill() -> None:
        while len(list(tmp_path.glob("part-*.parquet"))) < 3:
            time.sleep(0.01)
        killed.append(next(iter(workers.values())))
        os.kill(killed[0], signal.SIGKILL)

    killer = threading.Thread(target=kill)
    killer.start()
    table = lissom.sweep(model, VARY, client=client, out=tmp_path, batch=20, **drawn)
    killer.join(timeout=60)
    equal(table, serial)
    assert killed and killed[0] not in client.run(os.getpid).values(), "a worker was killed on the way"
    parts = sorted(tmp_path.glob("part-*.parquet"))
    assert len(parts) == 50

    # What is there is not solved again; what is missing is.
    for part in parts[7:20]:
        part.unlink()
    before = {part: part.stat().st_mtime_ns for part in parts[:7] + parts[20:]}
    reports: list[tuple[float, float]] = []
    again = lissom.sweep(
        model, VARY, client=client, out=tmp_path, progress=lambda done, all: reports.append((done, all)), **drawn
    )
    equal(again, serial)
    assert len(reports) == 13 and reports[-1] == (1000, 1000)
    assert all(part.stat().st_mtime_ns == time for part, time in before.items())
    with pytest.raises(ValueError, match="another sweep"):
        lissom.sweep(model, VARY, client=client, out=tmp_path, **{**drawn, "seed": 5})

    import pandas

    frame = pandas.read_parquet(tmp_path)
    assert sorted(frame["member"]) == list(range(1000))


def test_the_example_runs_on_processes_of_its_own(tmp_path: Path) -> None:
    own = runpy.run_path(str(ROOT / "examples" / "python" / "sweep_on_cluster.py"))
    table = own["sweep"](tmp_path, members=64, show=False)
    model = lissom.load(PENDULUM, **{"analysis.end": 0.5})
    collect = {"swing": "max(bob.x)", "rest": "final(energy.total)"}
    equal(table, lissom.sweep(model, own["VARY"], collect=collect, sampling="sobol", members=64))
    assert len(table) == 64 and len(list(tmp_path.glob("part-*.parquet"))) > 1


def test_members_that_fail_have_their_diagnosis(client: Any) -> None:
    model = lissom.load(PENDULUM, **{"analysis.end": 0.1})
    with pytest.warns(lissom.SolutionWarning, match="1 of 3"):
        table = lissom.sweep(model, {"point_masses.bob.mass": [1, -1, 2]}, collect=COLLECT, client=client)
    assert list(table["state"]) == ["solved", "wrong_model", "solved"] and "greater than zero" in table["diagnosis"][1]


def test_histories_come_from_the_workers(client: Any, tmp_path: Path) -> None:
    import pandas

    model = lissom.load(PENDULUM, **{"analysis.end": 0.1})
    here, there = tmp_path / "here", tmp_path / "there"
    for out, more in ((here, {"workers": 1}), (there, {"client": client, "batch": 2})):
        lissom.sweep(model, {"point_masses.bob.mass": [1, 2, 3, 4, 5]}, collect=COLLECT, histories=["bob.x"], out=out, **more)
    files = sorted((here / "histories").iterdir())
    assert [file.name for file in files] == [f"member-{member:08}.parquet" for member in range(5)]
    assert all(file.read_bytes() == (there / "_histories" / file.name).read_bytes() for file in files)
    assert list(pandas.read_parquet(there)["member"]) == list(range(5)), "the parts are the table alone"
    assert sorted(pandas.read_parquet(there / "_histories")["member"].unique()) == list(range(5))
