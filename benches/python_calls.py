"""What calls from Python cost beyond the work they ask for: `python benches/python_calls.py`, with the package installed.

Every figure is processor time, the least of several rounds, on the smallest model there is.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

import lissom
from lissom import entries
from lissom.entries import Body

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


def arm(joints: int = 7) -> lissom.Model:
    """An arm whose joints turn about the vertical and across in turn, with a torque at each."""
    model = lissom.Model("An arm", gravity=[0, 0, -9.81])
    for i in range(joints):
        model.inputs[f"u{i}"] = 0
        model.bodies[f"link{i}"] = Body(mass=2, inertia=[0.02, 0.02, 0.01], position=[0, 0, 0.3 * i + 0.15])
        base, axis = f"link{i - 1}" if i else "ground", [0, 1, 0] if i % 2 else [0, 0, 1]
        model.joints[f"j{i}"] = entries.joints.Revolute(base=base, tip=f"link{i}", at=[0, 0, 0.3 * i], axis=axis)
        model.loads[f"motor{i}"] = entries.loads.JointTorque(joint=f"j{i}", torque=f"u{i}")
        model.outputs[f"q{i}"] = entries.outputs.Relative(of=f"j{i}")
    model.analysis = entries.analyses.Dynamics(end=1000, step=1e-3)
    return model


def controlling() -> None:
    """PD control of seven joints: seven inputs, a step, angles and rates; alone and in a batch."""
    model, count, periods = arm(), 64, 300
    torques = [f"u{i}" for i in range(7)]
    angles, rates = ([f"q{i}.{what}" for i in range(7)] for what in ("angle", "rate"))
    target = 0.1 * np.arange(7)

    def sample(read_rates: bool) -> Callable[[], float]:
        def control() -> None:
            sim = model.simulation()
            rate = np.zeros(7)
            for _ in range(periods):
                sim.set(torques, 20 * (target - sim[angles]) - 2 * rate)
                sim.step()
                if read_rates:
                    rate = sim[rates]

        return lambda: timed(control)

    def batch() -> float:
        sims = model.simulations(count)

        def control() -> None:
            for _ in range(periods // 10):
                sims.set(torques, 20 * (target - sims[angles]))
                sims.step()

        return timed(control)

    print(f"seven torques, a step and seven angles of an arm: {1e6 * least(sample(False)) / periods:.0f} µs, with seven rates {1e6 * least(sample(True)) / periods:.0f} µs")
    print(f"in a batch of {count}: {1e6 * least(batch) / (periods // 10) / count:.0f} µs per arm")


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
    controlling()
    sweeping()
    verdict = "reached" if call < MOST else "missed"
    print(f"a call of sim.step() beyond its step: {1e6 * call:.2f} µs, aim less than {1e6 * MOST:.0f} µs: {verdict}")
