"""A sweep on a cluster of Dask: processes of this machine here, other machines by another line.

The pendulum of `examples/` with a thousand masses and stiffnesses of its spring. Members go to the workers in batches; every batch that
arrives becomes a Parquet file, so that a sweep that was cut off goes on when it is started again.
"""

from __future__ import annotations

import os
from pathlib import Path

from distributed import Client, LocalCluster

import lissom

PENDULUM = Path(__file__).resolve().parents[1] / "pendulum.toml"
VARY = {
    "point_masses.bob.mass": {"from": 1, "to": 4},
    "springs.spring.stiffness": {"from": 1, "to": 100, "spacing": "logarithmic"},
}


def sweep(out: str | os.PathLike[str], members: int = 1000, workers: int = 2, show: bool = True) -> lissom.SweepTable:
    """The table of all members, whose parts are in the folder `out`."""
    model = lissom.load(PENDULUM, **{"analysis.end": 0.5})
    # In a cluster of a computing centre: `SLURMCluster(…)` of dask-jobqueue or `KubeCluster(…)` of dask-kubernetes.
    with LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        return lissom.sweep(
            model,
            VARY,
            collect={"swing": "max(bob.x)", "rest": "final(energy.total)"},
            sampling="sobol",
            members=members,
            client=client,
            out=out,
            progress=show,
        )


# Workers import this file: only the client starts a sweep.
if __name__ == "__main__":
    table = sweep("out/masses")
    print(table)
    print(f"the largest swing is {table['swing'].max():.4f} m, of member {table['swing'].argmax()}")
