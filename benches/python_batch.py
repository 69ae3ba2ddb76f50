"""Simulations in one call against threads: `python benches/python_batch.py`, with the package installed. Elapsed time, the least of several rounds."""

from __future__ import annotations

import os
import subprocess
import sys
import time

import numpy as np
from python_calls import arm

#: Simulations of a batch, and steps of each.
COUNT, STEPS = 64, 200
ROUNDS = 5


def elapsed() -> float:
    """Time of a step of one member [s]."""
    batch = arm().simulations(COUNT)
    angles = [f"q{i}.angle" for i in range(7)]
    torques = [f"u{i}" for i in range(7)]
    target = 0.1 * np.arange(7)
    rounds = []
    for _ in range(ROUNDS):
        began = time.perf_counter()
        for _ in range(STEPS):
            batch.set(torques, 20 * (target - batch[angles]))
            batch.step()
        rounds.append(time.perf_counter() - began)
    return min(rounds) / (COUNT * STEPS)


def main() -> None:
    """A row for each number of threads, each in a process of its own, since the threads are made once."""
    cores = os.cpu_count() or 1
    print(f"a batch of {COUNT} arms of seven axes, by the number of threads; the machine has {cores} processors")
    print("threads  µs per member and period  speed-up")
    alone = 0.0
    threads = 1
    while threads <= cores:
        environment = {**os.environ, "RAYON_NUM_THREADS": str(threads)}
        ended = subprocess.run([sys.executable, __file__, "row"], env=environment, capture_output=True, text=True, check=True)
        period = float(ended.stdout)
        alone = alone or period
        print(f"{threads:7}  {1e6 * period:24.1f}  {alone / period:8.2f}")
        threads *= 2


if __name__ == "__main__":
    if sys.argv[1:] == ["row"]:
        print(elapsed())
    else:
        main()
