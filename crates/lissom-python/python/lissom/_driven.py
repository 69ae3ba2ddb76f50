"""Runs whose inputs are Python functions, evaluated at equal intervals of time."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from ._lissom import NativeModel, Simulation, SolutionError, __version__
from ._result import Result

#: Function that returns the next value of an input for the current state of the simulation.
InputFunction = Callable[[Simulation], float]


def driven(
    native: NativeModel,
    inputs: Mapping[str, InputFunction],
    sample: float,
    show: Callable[[float, float], object] | None,
) -> Result:
    """Simulates a model to its end. Rows are recorded at the samples, with the inputs that are valid after them."""
    if not (np.isfinite(sample) and sample > 0):
        raise ValueError(f"`sample` is {sample}: it must be a time in seconds, greater than zero")
    sim = native.simulation()
    start, end = sim.time, sim.end
    count = 0
    times: list[float] = []
    rows: list[np.ndarray[tuple[int], np.dtype[np.float64]]] = []
    error: SolutionError | None = None
    while True:
        is_finished = sim.is_finished or sim.time >= end
        values = {} if is_finished else {name: float(function(sim)) for name, function in inputs.items()}
        try:
            sim.set(values)
            times.append(sim.time)
            rows.append(sim.values())
            if is_finished:
                break
            count += 1
            # Products, not sums: no round-off gathers over many samples.
            target = start + count * sample
            sim.step_to(end if target > end - 1e-9 * sample else target)
        except SolutionError as failed:
            error = failed
            times.append(sim.time)
            rows.append(sim.values())
            break
        if show is not None:
            show(sim.time - start, end - start)
    columns = np.ascontiguousarray(np.array(rows).T)
    names = sim.names
    summary = {
        "model": native.name,
        "version": __version__,
        "analysis": "driven from Python",
        "stopped": "end" if error is None else "failed",
        "stopped_by": sim.stopped_by,
        "time": sim.time,
        "records": len(times),
        "sample": sample,
        "inputs": list(inputs),
        "warnings": sim.warnings,
        "events": [{"event": name, "time": time} for name, time in sim.events],
    }
    if error is not None:
        summary["error"] = str(error)
    result = Result(np.array(times), dict(zip(names, columns)), dict(zip(names, sim.units)), summary)
    if error is not None:
        error.result = result
        raise error
    return result
