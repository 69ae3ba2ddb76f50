"""What calls from Python cost beyond the work they ask for: `python benches/python_calls.py`, with the package installed.

Every figure is processor time, the least of several rounds, on the smallest model there is.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

import lissom

PENDULUM = Path(__file__).resolve().parents[1] / "examples" / "pendulum.toml"
ROUNDS = 7


def least(work: Callable[[], float]) -> float:
    return min(work() for _ in range(ROUNDS))


def timed(work: Callable[[], object]) -> float:
    """Time of the processor [s], so that other programs on the machine disturb it little."""
    began = time.process_time()
    work()
    return time.process_time() - began


#: What a call of `sim.step()` may cost beyond its step [s].
MOST = 3e-6


def stepping() -> float:
    """`sim.step()` against `sim.step_to(end)`, which takes the same steps within one call: the difference by call [s]."""
    model = lissom.load(PENDULUM, **{"analysis.end": 20, "analysis.step": 0.01})
    steps = 2000

    def one_by_one() -> float:
        sim = model.simulation()

        def all_of_them() -> None:
            step = sim.step
            for _ in range(steps):
                step()

        return timed(all_of_them)

    def at_once() -> float:
        sim = model.simulation()
        return timed(lambda: sim.step_to(20.0))

    apart, together = least(one_by_one), least(at_once)
    print(f"a step of the pendulum: {1e6 * together / steps:.2f} µs")
    print(f"sim.step() costs beyond that: {1e6 * (apart - together) / steps:.2f} µs per call")
    sim = model.simulation()
    count = 100_000

    def reading() -> float:
        return timed(lambda: [sim["bob.x"] for _ in range(count)])

    print(f'sim["bob.x"]: {1e6 * least(reading) / count:.2f} µs per call')
    return (apart - together) / steps


def driving() -> None:
    """A function as an input, once per step."""
    text = PENDULUM.read_text() + '[inputs]\nforce = 0\n[loads.force]\nkind = "force"\non = "bob"\nvector = [1, 0, 0]\nscale = "force"\n'
    model = lissom.loads(text, **{"analysis.end": 20, "analysis.step": 0.01})
    changing = least(lambda: timed(lambda: model.run(inputs={"force": lambda sim: sim.time}, sample=0.01)))
    constant = least(lambda: timed(lambda: model.run(inputs={"force": lambda sim: 0.0}, sample=0.01)))
    plain = least(lambda: timed(model.run))
    print(f"a function as an input: {1e6 * (constant - plain) / 2000:.2f} µs per sample; where the input changes {1e6 * (changing - plain) / 2000:.2f} µs")


def sweeping() -> None:
    """Members of a sweep against their steps."""
    model = lissom.load(PENDULUM)
    members = 2000

    def all_members() -> float:
        vary = {"point_masses.bob.mass": {"from": 1, "to": 2}}
        collect = ["max(bob.x)"]
        return timed(lambda: lissom.sweep(model, vary, collect=collect, sampling="sobol", members=members, workers=1))

    def one() -> float:
        sim = model.simulation()
        return timed(lambda: sim.step_to(1.0))

    member, steps = least(all_members) / members, least(one)
    print(f"a member: {1e3 * member:.3f} ms, its 100 steps {1e3 * steps:.3f} ms, beyond them {1e3 * (member - steps):.3f} ms")


if __name__ == "__main__":
    call = stepping()
    driving()
    sweeping()
    verdict = "reached" if call < MOST else "missed"
    print(f"a call of sim.step() beyond its step: {1e6 * call:.2f} µs, aim less than {1e6 * MOST:.0f} µs: {verdict}")
