"""The examples in Python run and give the expected results."""

from __future__ import annotations

import json
import runpy
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import scipy.io

import lissom
from conftest import PENDULUM, ROOT

Program = Callable[..., "subprocess.CompletedProcess[str]"]
FOLDER = ROOT / "examples" / "python"


def example(name: str) -> dict[str, Any]:
    return runpy.run_path(str(FOLDER / f"{name}.py"))


def test_an_absorber_is_tuned() -> None:
    own = example("tune_damper")
    found, course = own["tune"](show=False)
    assert found.success and len(course) < 40, found.message
    assert all(later <= earlier * (1 + 1e-12) for earlier, later in zip(course[1:], course[2:])), "it converges"
    assert found.fun < 0.55 * course[0]
    # An optimum indeed: the measure of runs, without gradients, is larger on all sides.
    model = own["build"]()
    best = np.exp(found.x)

    def value(numbers: Any) -> float:
        run = model.replace({**dict(zip(own["PATHS"], numbers)), "analysis.tolerance": 1e-12}).run()
        x, t = run["mass.x"], run.time
        return 1e3 * float(np.sqrt(np.trapezoid(x**2, t) / (t[-1] - t[0])))

    assert value(best) == pytest.approx(found.fun, rel=1e-9)
    for factors in ([1.02, 1], [0.98, 1], [1, 1.05], [1, 0.95]):
        assert value(best * factors) > found.fun


def test_a_stiffness_is_identified() -> None:
    own = example("identify_stiffness")
    numbers, deviations, course = own["identify"](show=False)
    assert np.all(np.abs(numbers - own["TRUE"]) < 3 * deviations) and np.all(deviations < [0.05, 0.02])
    assert course[-1] < 0.02 * course[0] and course[-1] == pytest.approx(301 / 2, rel=0.2), "what is left is the noise"


def test_a_controller_is_tuned_to_the_optimal_one() -> None:
    """The best PD law is the linear-quadratic regulator: k = r^(-1/2), d = (2 J k)^(1/2), and the integral is r k d."""
    own = example("tune_controller")
    study, course = own["tune"](show=False)
    assert len(course) == len(study.trials) == 120 and all(later <= earlier for earlier, later in zip(course, course[1:]))
    stiffness = own["EFFORT"] ** -0.5
    damping = (2 * (1 / 12 + 1 / 4) * stiffness) ** 0.5
    least = own["EFFORT"] * stiffness * damping / 2
    assert course[-1] == study.best_value == pytest.approx(least, rel=5e-3) and course[-1] < 0.6 * course[0]
    assert study.best_params["stiffness"] == pytest.approx(stiffness, rel=0.1)
    assert study.best_params["damping"] == pytest.approx(damping, rel=0.1)
    # The same seed gives the same study, and a trial is a run of the model with its gains.
    again, _ = own["tune"](10, show=False)
    assert [trial.value for trial in again.trials] == [trial.value for trial in study.trials[:10]]
    model = lissom.loads(own["MODEL"], "arm.toml")
    assert own["measure"](model, study.best_params) == study.best_value
    # Runs without a solution are never taken for good ones.
    failed, course = own["tune"](3, show=False, overrides={"analysis.max_iterations": 1})
    assert all(trial.state.name == "PRUNED" and "max_iterations" in trial.user_attrs["diagnosis"] for trial in failed.trials)
    assert not np.isfinite(course).any()


def test_the_environment_is_one_of_gymnasium() -> None:
    from gymnasium.utils.env_checker import check_env

    own = example("gymnasium_arm")
    env = own["ArmEnv"]()
    check_env(env, skip_render_check=True)
    first = [env.reset(seed=3)[0], *(env.step(np.array([1.0]))[0] for _ in range(5))]
    again = [env.reset(seed=3)[0], *(env.step(np.array([1.0]))[0] for _ in range(5))]
    assert np.array_equal(first, again), "the same seed gives the same episode"
    observation, _ = env.reset(seed=0)
    highest, steps, ended = -1.0, 0, False
    while not ended:
        observation, _, terminated, ended, _ = env.step(own["swing_up"](observation))
        highest, steps = max(highest, -observation[0]), steps + 1
        assert not terminated
    assert steps == 200 and highest > 0.9, "it is swung up"


def test_arms_reach_their_target() -> None:
    own = example("reaching_arms")
    computed, left = own["episode"]("computed", 4)
    random, _ = own["episode"]("random", 4, 30)
    assert left < 0.01 and computed > random and computed > -0.6


def test_a_quadruped_stands_on_its_feet() -> None:
    from gymnasium.utils.env_checker import check_env

    own = example("quadruped")
    env = own["environment"]("rgb_array")
    check_env(env)
    weight = 9.81 * (8 + 4 * 0.8)

    def episode(action: Any, seed: int = 0) -> tuple[list[Any], float, bool]:
        observations, total, ended = [env.reset(seed=seed)[0]], 0.0, False
        while not ended:
            observation, gain, terminated, truncated, _ = env.step(np.tile(action, 4) if len(action) == 2 else np.array(action))
            observations.append(observation)
            total, ended = total + gain, terminated or truncated
        return observations, total, terminated

    for action, low, high in (((0, 0), 0, 10), (own["STANDING"], 80, 100)):
        observations, total, fallen = episode(action)
        assert not fallen and len(observations) == 101 and low < total < high
        # At rest on the floor: the feet carry the weight, and the legs are bent as much as the height says.
        carried = [env.sim[f"{leg}_foot.f3"] for leg in own["LEGS"]]
        assert min(carried) > 10 and sum(carried) == pytest.approx(weight, rel=1e-3)
        assert np.abs(observations[-1][4:10]).max() < 0.02 and own["upright"](observations[-1]) > 0.999
        angles = observations[-1][10:18].reshape(4, 2)
        heights = own["FOOT"] + own["LINK"] * (np.cos(angles[:, 0]) + np.cos(angles.sum(axis=1)))
        assert np.mean(heights) == pytest.approx(observations[-1][0], abs=2e-3)
    # Legs that are extended on one side alone overturn it, before the time is over.
    observations, _, fallen = episode(np.array([[-1, 1], [1, -1]] * 2).ravel())
    assert fallen and len(observations) < 100 and own["falls"](observations[-1]) and not own["falls"](observations[-2])
    # Starts are random, by the seed.
    assert np.array_equal(episode((0, 0), 3)[0], episode((0, 0), 3)[0]) and not np.array_equal(episode((0, 0), 4)[0][0], observations[0])
    # Friction holds it on a slope of 1 in 5; without friction it slides down.
    for friction, slides in ((0.8, False), (0.0, True)):
        changes = {f"contacts.{leg}_foot.friction": friction for leg in own["LEGS"]}
        env = own["Env"](own["build"]().replace({"gravity": [1.92, 0, -9.62], **changes}), **own["TASK"])
        assert (abs(episode(own["STANDING"])[0][-1][4]) > 1) == slides
    # Steps are short enough: shorter ones give the same heights.
    height = episode(own["STANDING"])[0][-1][0]
    env = own["Env"](own["build"]().replace({"analysis.step": 1e-3}), **own["TASK"])
    assert episode(own["STANDING"])[0][-1][0] == pytest.approx(height, abs=2e-3)


def test_a_manipulator_holds_its_tip_at_targets_of_episodes() -> None:
    from gymnasium.utils.env_checker import check_env

    own = example("manipulator")
    env, policy = own["environment"]("rgb_array"), own["Transposed"]()
    check_env(env)
    targets = []
    for seed in range(3):
        observation, _ = env.reset(seed=seed)
        targets.append(observation[9:])
        assert own["distance"](observation) > 0.05
        truncated = False
        while not truncated:
            observation, reward, terminated, truncated, _ = env.step(policy(observation))
            assert not terminated and np.array_equal(observation[9:], targets[-1])
        # At rest the spring of 100 N/m carries the payload, which the policy does not know.
        sag = [0, 0, env.sim["payload"] * 9.81 / 100]
        assert observation[9:] - observation[6:9] == pytest.approx(sag, abs=2e-3) and 0 < env.sim["payload"] < 0.5
        assert -0.2 < reward < -np.linalg.norm(sag) + 2e-3
    assert len({tuple(target) for target in targets}) == 3
    envs = own["environments"](3)
    observations, _ = envs.reset(seed=0)
    observations, _, _, _, _ = envs.step(np.array([policy(observation) for observation in observations]))
    assert len({tuple(target) for target in observations[:, 9:]}) == 3


def test_a_policy_is_learned(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(FOLDER))
    own = example("learn_to_stand")
    rng = np.random.default_rng(0)
    # Derivatives of a network are those of differences.
    network = own["Network"](rng, [3, 5, 4, 2], 1.0, free=1)
    x, slope = rng.normal(size=(7, 3)), rng.normal(size=(7, 2))
    differences = []
    for values in network.weights + network.biases[:-1]:
        for index in np.ndindex(values.shape):
            kept, sums = values[index], []
            for shift in (1e-6, -1e-6):
                values[index] = kept + shift
                sums.append((network(x) * slope).sum())
            values[index] = kept
            differences.append((sums[0] - sums[1]) / 2e-6)
    network(x)
    network.descend(slope, np.array([3.0]), 0.0)
    # The first moments are a tenth of the first gradient.
    found = np.concatenate([10 * first.ravel() for first, _ in network.moments])
    assert found == pytest.approx([*differences, 3.0], rel=1e-6, abs=1e-8)
    # Advantages by their definition, with an episode that fails, one that is truncated, and one that goes on.
    rewards, values = rng.normal(size=(6, 3)), rng.normal(size=(7, 3))
    terminations, ends = np.zeros((6, 3)), np.zeros((6, 3))
    terminations[2, 0] = ends[2, 0] = ends[3, 1] = 1
    found = own["advantages_of"](rewards, values, terminations, ends)
    discount, trace = own["DISCOUNT"], own["TRACE"]
    for env in range(3):
        for first in range(6):
            wanted = 0.0
            for k in range(first, 6):
                later = 0 if terminations[k, env] else discount * values[k + 1, env]
                wanted += (discount * trace) ** (k - first) * (rewards[k, env] + later - values[k, env])
                if ends[k, env]:
                    break
            assert found[first, env] == pytest.approx(wanted)
    # Actions become those that are rewarded, with certainty: 0.5 where the observation is 1, and -0.5 where it is -1.
    agent = own["Agent"](0, 1, 1)
    observations = np.repeat([[1.0], [-1.0]], 30, axis=0)
    for _ in range(80):
        actions = agent.act(observations)
        agent.learn(observations, actions, -((actions - 0.5 * observations) ** 2)[:, 0], np.zeros(60), 3e-3)
    assert agent.policy(np.array([[1.0], [-1.0]]))[:, 0] == pytest.approx([0.5, -0.5], abs=0.05)
    assert np.exp(agent.policy.biases[-1][0]) < 0.2
    # The whole of it, by the seed.
    agent, course = own["learn"](iterations=2, count=4, steps=101, show=False)
    assert np.isfinite(course).all() and own["learn"](iterations=2, count=4, steps=101, show=False)[1] == course
    assert own["learn"](iterations=1, count=4, steps=101, seed=1, show=False)[1] != course[:1]
    returns, heights = own["evaluate"](agent, 3)
    assert returns.shape == heights.shape == (3,) and (heights > 0.05).all() and (heights < 0.5).all()


def test_the_tutorial_tells_what_the_command_line_tells(program: Program, tmp_path: Path) -> None:
    values = example("tutorial")["values"]

    def run(name: str, *args: object) -> Path:
        ended = program(*args, "--out", tmp_path / name, "--quiet")
        assert ended.returncode == 0, ended.stderr
        return tmp_path / name

    def summary(folder: Path) -> Any:
        return json.loads((folder / "summary.json").read_text())

    assert values["pendulum_x"] == lissom.read(run("a", "run", PENDULUM))["bob.x"][-1]
    heavy = ("--set", "point_masses.bob.mass=4")
    assert values["heavy_x"] == lissom.read(run("b", "run", PENDULUM, *heavy))["bob.x"][-1]
    crank = ROOT / "examples/tip-crank.toml"
    modes = summary(run("c", "modes", crank, "--about", "undeformed", "--count", 3))
    assert values["first_frequency"] == modes["modes"][0]["frequency"]
    gradient = summary(run("d", "gradient", PENDULUM, "--of", "bob.x@0.5", "--by", "springs.spring.stiffness"))
    assert values["derivative"] == gradient["derivatives"][0]["derivative"]
    linear = run("e", "linearize", crank, "--about", "undeformed")
    assert values["mass_trace"] == float(scipy.io.mmread(linear / "M.mtx").tocsr().diagonal().sum())
    sweep = tmp_path / "sweep.toml"
    sweep.write_text(
        f'lissom_sweep = 1\nmodel = "{PENDULUM}"\n[vary]\n"point_masses.bob.mass" = [1, 2, 4]\n[collect]\nswing = "max(bob.x)"\n'
    )
    table = np.genfromtxt(run("f", "sweep", sweep) / "sweep.csv", delimiter=",", names=True, dtype=None, encoding="utf-8")
    assert values["sweep_swing"] == table["swing"][2]
    # The model that was built of objects, by its text.
    file = tmp_path / "swing.toml"
    file.write_text(str(example("tutorial")["swing"]))
    assert values["swing"] == lissom.read(run("g", "run", file))["hinge.angle"][-1]


CART = """
lissom = 1
[point_masses.cart]
mass = 2
position = [1, 0, 0]
{thrust}
[loads.thrust]
kind = "force"
on = "cart"
vector = [1, 0, 0]
scale = "thrust"
[outputs.place]
kind = "position"
of = "cart"
[outputs.speed]
kind = "velocity"
of = "cart"
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 3
step = 0.01
"""


def test_a_function_drives_an_input_as_a_sampled_signal_does() -> None:
    """The same law twice: in Python, and as a sampled signal of the model."""
    law = '[signals]\nthrust = { value = "-3*place.x - 2*speed.v1", sample = 0.05 }'
    there = lissom.loads(CART.format(thrust=law)).run()
    model = lissom.loads(CART.format(thrust="[inputs]\nthrust = 0"))

    def thrust(sim: lissom.Simulation) -> float:
        return -3 * sim["place.x"] - 2 * sim["speed.v1"]

    here = model.run(inputs={"thrust": thrust}, sample=0.05)
    assert here.is_complete and here.time[-1] == 3 and len(here.time) == 61 and here.summary["inputs"] == ["thrust"]
    assert np.allclose(here.time, there.time[::5], rtol=0, atol=1e-12)
    assert np.allclose(here["place.x"], there["place.x"][::5], rtol=0, atol=1e-9) and abs(here["place.x"][-1]) < 0.3
    # A sample that divides neither step nor end: the end is met all the same.
    other = model.run(inputs={"thrust": thrust}, sample=0.07)
    assert other.time[-1] == 3 and len(other.time) == 44
    with pytest.raises(ValueError, match="belong together"):
        model.run(inputs={"thrust": thrust})
    with pytest.raises(ValueError, match="greater than zero"):
        model.run(inputs={"thrust": thrust}, sample=0)
    with pytest.raises(ValueError, match="thust"):
        model.run(inputs={"thust": thrust}, sample=0.05)
    with pytest.raises(ZeroDivisionError):
        model.run(inputs={"thrust": lambda sim: 1 / 0}, sample=0.05)
