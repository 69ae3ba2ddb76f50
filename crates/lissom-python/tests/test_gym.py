"""Environments of Gymnasium."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

pytest.importorskip("gymnasium", reason="the package `gymnasium` is not installed: pip install gymnasium")

import lissom
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AsyncVectorEnv
from lissom.gym import Env, VectorEnv
from test_batch import CART


def task(**more: Any) -> dict[str, Any]:
    own: dict[str, Any] = dict(
        actions={"thrust": (-3.0, 3.0)},
        observations=["cart.x", "speed.v1"],
        period=0.1,
        steps=4,
        reward=lambda observation, action: observation[..., 0] - action[..., 0],
    )
    return {**own, **more}


def test_an_environment_is_one_of_gymnasium() -> None:
    env = Env(lissom.loads(CART), **task())
    check_env(env, skip_render_check=True)
    env.reset(seed=1)
    for step in range(1, 5):
        observation, reward, terminated, truncated, _ = env.step(np.array([9.0]))
        # The action is limited to 3 N on 2 kg.
        assert np.allclose(observation, [0.75 * (0.1 * step) ** 2, 0.15 * step]) and reward == pytest.approx(observation[0] - 3)
        assert not terminated and truncated == (step == 4)


def test_environments_of_a_batch_are_those_of_simulations() -> None:
    model = lissom.loads(CART)
    more = task(terminated=lambda observation: observation[..., 1] > 0.25)
    envs, env = VectorEnv(model, 3, **more), Env(model, **more)
    first, _ = envs.reset(seed=1)
    assert first.shape == (3, 2) and envs.action_space.shape == (3, 1)
    ends = []
    actions = np.array([[1.0], [2.0], [3.0]])
    alone = env.reset()[0]
    for _ in range(6):
        observations, rewards, terminations, truncations, info = envs.step(actions)
        ends.append(list(zip(terminations.tolist(), truncations.tolist())))
        if env_ended(ends[:-1], 0):
            alone = env.reset()[0]
            assert rewards[0] == 0
        else:
            alone, reward, *ended, _ = env.step(actions[0])
            assert rewards[0] == reward and ends[-1][0] == tuple(ended)
        assert np.array_equal(observations[0], alone) and not info["failed"].any()
    # The third is too fast after two steps, starts again with the third action, and so on; the first ends after four.
    assert [end[2][0] for end in ends] == [False, True, False, False, True, False]
    assert [end[0][1] for end in ends] == [False, False, False, True, False, False]


def env_ended(ends: list[list[tuple[bool, bool]]], index: int) -> bool:
    return bool(ends) and any(ends[-1][index])


def test_a_failed_environment_starts_again() -> None:
    model = lissom.loads(CART.replace("thrust - brake", "1 / (1 - thrust)"))
    envs = VectorEnv(model, 2, **task(failure=-7.0))
    envs.reset()
    with pytest.warns(lissom.SolutionWarning):
        observations, rewards, terminations, _, info = envs.step(np.array([[1.0], [0.0]]))
    assert rewards[0] == -7 and terminations.tolist() == info["failed"].tolist() == [True, False] and np.isfinite(observations).all()
    observations, rewards, terminations, _, _ = envs.step(np.zeros((2, 1)))
    assert not terminations.any() and rewards[0] == 0 and np.array_equal(observations[0], [0, 0])
    env = Env(model, **task(failure=-7.0))
    env.reset()
    _, reward, terminated, _, facts = env.step(np.array([1.0]))
    assert reward == -7 and terminated and "error" in facts


def test_inputs_of_an_episode_are_drawn_when_it_begins() -> None:
    """The brake is constant in an episode, and the motion is that of the drawn one."""
    model = lissom.loads(CART)
    more = task(
        observations=["cart.x", "speed.v1", "brake"],
        terminated=lambda observation: observation[..., 1] > 0.25,
        episode_inputs=lambda rng: {"brake": rng.uniform(0, 1)},
    )
    check_env(Env(model, **more), skip_render_check=True)
    envs = VectorEnv(model, 3, **more)
    before = envs.reset(seed=1)[0][:, 2]
    assert len(set(before)) == 3 and np.array_equal(envs.reset(seed=1)[0][:, 2], before)
    brakes = [before]
    begins, alone = np.ones(3, bool), [Env(model, **task(observations=["cart.x", "speed.v1", "brake"])) for _ in range(3)]
    actions = np.array([[1.0], [2.0], [3.0]])
    for env, brake in zip(alone, before):
        env.task.episode_inputs = with_brake(brake)
        env.reset()
    for _ in range(7):
        observations, _, terminations, truncations, _ = envs.step(actions)
        brakes.append(observations[:, 2])
        assert np.array_equal(brakes[-1] != brakes[-2], begins if len(brakes) > 2 else np.zeros(3, bool))
        for index, (env, own) in enumerate(zip(alone, observations)):
            if begins[index] and len(brakes) > 2:
                env.task.episode_inputs = with_brake(own[2])
                other, _ = env.reset()
            else:
                other = env.step(actions[index])[0]
            assert np.array_equal(own, other), "as a simulation of its own"
        begins = terminations | truncations
    # The first is never fast, and starts again after four steps; the third is, and does so more often.
    changes = (np.diff(brakes, axis=0) != 0).sum(axis=0)
    assert changes[0] == 1 and changes[2] >= 2
    assert np.isclose(observations[0, 0], (1 - brakes[-1][0]) / 4 * 0.2**2)


def with_brake(brake: float) -> Callable[[np.random.Generator], dict[str, float]]:
    return lambda rng: {"brake": brake}


def test_environments_work_in_processes_of_their_own() -> None:
    """Both ways of starting a process; a forked one must not wait for threads that it does not have."""
    alone = cart_environment()
    actions = np.array([[1.0], [2.0]])
    for context in ("fork", "spawn"):
        # Threads of this process, which a fork does not copy.
        VectorEnv(lissom.loads(CART), 4, **task()).reset()
        envs = AsyncVectorEnv([cart_environment] * 2, context=context)
        try:
            first, _ = envs.reset(seed=[1, 2])
            assert first.shape == (2, 2) and not first.any()
            results = [envs.step(actions) for _ in range(4)]
            pictures = envs.render()
        finally:
            envs.close()
        for index in range(2):
            alone.reset()
            for observations, rewards, terminations, truncations, _ in results:
                own, reward, terminated, truncated, _ = alone.step(actions[index])
                assert np.array_equal(observations[index], own) and rewards[index] == reward
                assert (terminations[index], truncations[index]) == (terminated, truncated)
            assert pictures is not None and np.array_equal(pictures[index], alone.render())
        assert results[-1][3].all()


def cart_environment() -> Env:
    return Env(lissom.loads(CART), render_mode="rgb_array", picture=dict(size=(40, 30), view="front"), **task())
