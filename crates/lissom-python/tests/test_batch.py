"""Several simulations that advance together."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from typing import Any

import numpy as np
import pytest

import lissom

CART = """
lissom = 1
[inputs]
thrust = 0
brake = 0
[point_masses.cart]
mass = 2
[loads.thrust]
kind = "force"
on = "cart"
vector = [1, 0, 0]
scale = "thrust - brake"
[outputs.cart]
kind = "position"
of = "cart"
[outputs.speed]
kind = "velocity"
of = "cart"
[events.far]
zero_of = "cart.x - 5"
stop = true
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 2
step = 0.1
"""


def test_a_batch_is_so_many_simulations() -> None:
    """Same steps, same bits, whatever the number of processors."""
    model = lissom.loads(CART)
    batch = model.simulations(5)
    sims = [model.simulation() for _ in range(5)]
    assert len(batch) == 5 and batch.inputs == ["thrust", "brake"] and batch.names == sims[0].names and batch.units == sims[0].units
    rng = np.random.default_rng(0)
    for index in range(6):
        inputs = rng.uniform(-1, 1, (5, 2))
        batch.set(inputs)
        for sim, (thrust, brake) in zip(sims, inputs):
            sim.set({"thrust": thrust, "brake": brake})
        if index % 2:
            batch.step()
            for sim in sims:
                sim.step()
        else:
            batch.step_to(batch.time + 0.07)
            for sim in sims:
                sim.step_to(sim.time + 0.07)
        assert batch.values().tobytes() == np.array([sim.values() for sim in sims]).tobytes()
        assert batch["cart.x"].tobytes() == np.array([sim["cart.x"] for sim in sims]).tobytes()
        pairs = batch[["speed.v1", "thrust"]]
        assert pairs.shape == (5, 2) and pairs.tobytes() == np.array([sim[["speed.v1", "thrust"]] for sim in sims]).tobytes()
    assert not batch.failed.any() and batch.errors == {} and batch.warnings == [[]] * 5


def test_inputs_have_the_shapes_of_numpy() -> None:
    batch = lissom.loads(CART).simulations(3)
    batch.set("thrust", 2.0)
    batch.set({"brake": [1.0, 2.0, 3.0]})
    assert np.array_equal(batch[["brake", "thrust"]], [[1, 2], [2, 2], [3, 2]])
    batch.set(["thrust", "brake"], np.array([5, 4]))
    assert np.array_equal(batch[["brake", "thrust"]], [[4, 5]] * 3)
    batch.set([[1, 2], [3, 4], [5, 6]])
    before = batch[batch.inputs]
    assert np.array_equal(before, [[1, 2], [3, 4], [5, 6]])
    wrong: list[tuple[Any, ...]] = [
        ("shape", np.zeros((2, 2))),
        ("shape", "thrust", [1.0, 2.0]),
        ("thrust, brake", "trust", 1.0),
        ("finite", "thrust", [1.0, np.nan, 0.0]),
        ("with their values", "thrust"),
    ]
    for words, *arguments in wrong:
        with pytest.raises(ValueError, match=words):
            batch.set(*arguments)
    with pytest.raises(ValueError, match="simulation 1"):
        batch.step_to([1.0, -1.0, 1.0])
    assert np.array_equal(batch[batch.inputs], before) and not batch.time.any()
    with pytest.raises(KeyError, match="cart.x"):
        batch["cart"]
    with pytest.raises(KeyError, match="did you mean `brake`"):
        batch[["cart.x", "brakes"]]
    with pytest.raises(ValueError, match="`count` is 0"):
        lissom.loads(CART).simulations(0)


def test_simulations_are_reset_apart() -> None:
    batch = lissom.loads(CART).simulations(4)
    batch.set("thrust", [0.0, 1.0, 2.0, 40.0])
    batch.step_to(1.0)
    assert batch.stopped_by == [None, None, None, "far"] and batch.is_finished.tolist() == [False, False, False, True]
    assert batch.time[3] == pytest.approx(np.sqrt(0.5))
    with pytest.raises(ValueError, match="simulation 3 has ended"):
        batch.step()
    batch.reset(batch.is_finished)
    batch.reset([1])
    assert batch.time.tolist() == [1.0, 0.0, 1.0, 0.0] and batch["thrust"].tolist() == [0.0, 0.0, 2.0, 0.0]
    batch.step_to(batch.time + [0.5, 0.25, 0.5, 0.0])
    assert batch.time.tolist() == [1.5, 0.25, 1.5, 0.0] and batch["cart.x"][2] == pytest.approx(0.5 * 1.5**2)
    with pytest.raises(IndexError, match="no simulation 4"):
        batch.reset([4])
    with pytest.raises(ValueError, match="the mask has 3"):
        batch.reset(np.array([True, False, True]))
    batch.reset()
    assert not batch.time.any() and not batch.values().any()


def test_a_simulation_without_a_solution_waits() -> None:
    """A load that is infinite with some inputs."""
    batch = lissom.loads(CART.replace("thrust - brake", "thrust / (1 - brake)")).simulations(3)
    batch.set("thrust", 1.0)
    batch.step_to(0.1)
    with pytest.warns(lissom.SolutionWarning, match="simulation 1: .*1 more") as warned:
        batch.set("brake", [0.0, 1.0, 1.0])
    assert len(warned) == 1 and batch.failed.tolist() == [False, True, True] and list(batch.errors) == [1, 2]
    error = batch.errors[1]
    assert isinstance(error, lissom.SolutionError) and error.code is not None
    batch.step_to([0.2, 0.0, 0.0])
    values = batch.values()
    assert np.isfinite(values[0]).all() and np.isnan(values[1:]).all() and np.isnan(batch["thrust"][1])
    batch.reset(batch.failed)
    assert not batch.failed.any() and batch.time.tolist() == [0.2, 0.0, 0.0]
    batch.set("thrust", 1.0)
    batch.step_to(0.2)
    assert batch["cart.x"][1] == pytest.approx(0.25 * 0.2**2)


def test_ctrl_c_ends_a_batch() -> None:
    code = f"""
import lissom
batch = lissom.loads({CART!r}.replace('stop = true', 'stop = false')).simulations(3)
print("begun", flush=True)
try:
    batch.step_to(1e9)
except KeyboardInterrupt:
    print("interrupted", not batch.failed.any(), flush=True)
"""
    child = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    assert child.stdout is not None and child.stdout.readline() == "begun\n"
    time.sleep(0.3)
    child.send_signal(signal.SIGINT)
    output, _ = child.communicate(timeout=30)
    assert output == "interrupted True\n" and child.returncode == 0


FORKED = """
import multiprocessing

import lissom

model = lissom.loads(open("cart.toml").read())


def stepped(count: int) -> float:
    batch = model.simulations(count)
    batch.step_to(0.5)
    return float(batch.time[0])


if __name__ == "__main__":
    stepped(3)
    with multiprocessing.get_context("fork").Pool(2) as pool:
        print(pool.map(stepped, [2, 3, 4, 5]))
"""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="processes are forked on Linux")
def test_forked_processes_have_threads_of_their_own(tmp_path: Any) -> None:
    """The child of a fork has none of the threads of its parent."""
    (tmp_path / "cart.toml").write_text(CART)
    (tmp_path / "forked.py").write_text(FORKED)
    ended = subprocess.run(
        [sys.executable, "forked.py"], cwd=tmp_path, timeout=60, capture_output=True, text=True, check=False
    )
    assert ended.stdout.strip() == "[0.5, 0.5, 0.5, 0.5]", ended.stderr
