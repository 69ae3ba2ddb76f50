"""Ctrl-C ends whatever takes long, with a KeyboardInterrupt, and leaves the package usable."""

from __future__ import annotations

import signal
import subprocess
import sys
import threading
import time

import pytest

from conftest import PENDULUM
from test_analyses import COLUMN, TRUSS

#: What is called, and the model it is called on: far longer than anybody waits.
LONG = {
    "run": ("model.run()", PENDULUM, '{"analysis.end": 1e6}'),
    "step_to": ("model.simulation().step_to(1e9)", PENDULUM, "{}"),
    "statics": (
        "model.run()",
        COLUMN,
        '{"analysis": {"kind": "statics", "end": 1, "steps": 1000000}}',
    ),
    "path": ("model.path(end=1e9, step=1e-3, steps=10**6)", TRUSS, "{}"),
    "gradient": ('model.gradient("bob.x", ["point_masses.bob.mass"])', PENDULUM, '{"analysis.end": 1e5}'),
    "response": ('model.response("loads.side", "tip.u3", 1e-3, 1e3, 10**8)', COLUMN, "{}"),
    "campbell": ('model.campbell("parameters.load", 1, 20, 10**8, count=2)', COLUMN, "{}"),
    "modes": ("model.modes(400)", COLUMN, '{"beams.bar.elements": 20000}'),
    "buckling": ("model.buckling(100)", COLUMN, '{"beams.bar.elements": 20000}'),
    "linearize": ("model.linearize()", COLUMN, '{"beams.bar.elements": 20000}'),
    "assembly": ("model.simulation()", COLUMN, '{"beams.bar.elements": 20000}'),
    "sweep": (
        'lissom.sweep(model, {"point_masses.bob.mass": {"from": 1, "to": 2}}, collect=["max(bob.x)"], sampling="monte-carlo", '
        "members=10**6)",
        PENDULUM,
        "{}",
    ),
}


@pytest.mark.parametrize("name", LONG)
def test_ctrl_c_ends_it(name: str) -> None:
    call, model, changes = LONG[name]
    load = "load" if model == PENDULUM else "loads"
    code = f"""
import lissom, signal, time, warnings
# What runs in the background of a shell ignores it otherwise.
signal.signal(signal.SIGINT, signal.default_int_handler)
warnings.simplefilter("ignore")
model = lissom.{load}({model!r}, **{changes})
print("begun", flush=True)
try:
    {call}
    print("ended", flush=True)
except KeyboardInterrupt:
    print("interrupted", flush=True)
for _ in range(300):
    before = time.process_time()
    time.sleep(0.2)
    if time.process_time() - before < 0.05:
        break
else:
    print("it goes on", flush=True)
print(len(lissom.load({PENDULUM!r}, **{{"analysis.end": 0.1}}).run().time), flush=True)
"""
    child = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    # What hangs is killed, so that nothing is read from it any more and the test fails.
    timer = threading.Timer(120, child.kill)
    timer.start()
    assert child.stdout is not None and child.stdout.readline() == "begun\n"
    time.sleep(0.3)
    child.send_signal(signal.SIGINT)
    began = time.monotonic()
    # The interpreter is asked every 50 ms.
    assert child.stdout.readline() == "interrupted\n" and time.monotonic() - began < 10
    # What was begun then ends unseen: no processor is busy with it any more.
    output, errors = child.communicate(timeout=100)
    timer.cancel()
    assert output == "11\n" and child.returncode == 0, errors


def test_a_getter_waits_for_the_step_of_another_thread() -> None:
    """The thread that steps asks for the interpreter lock at times, which a thread that waits for it must not have."""
    code = f"""
import lissom, threading
sim = lissom.load({PENDULUM!r}).simulation()
worker = threading.Thread(target=sim.step_to, args=(2000.0,))
worker.start()
while sim.time == 0:
    pass
for _ in range(20):
    sim["bob.x"], sim.values(), sim.is_finished, sim.events, sim.warnings, repr(sim)
worker.join()
print(sim.time)
"""
    # One that waits for ever has the lock, and no thread of its own process could end it.
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120, check=True)
    assert ended.stdout == "2000.0\n"
