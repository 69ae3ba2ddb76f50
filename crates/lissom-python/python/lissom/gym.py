"""Environments of Gymnasium: `Env` of one simulation, `VectorEnv` of a batch. They need `pip install lissom[gym]`.

>>> from lissom.gym import VectorEnv
>>> envs = VectorEnv(model, 64, actions={"motor": (-1, 1)}, observations=["arm.angle", "arm.rate"], period=0.02, steps=500,
...                  reward=lambda observation, action: -observation[..., 0] ** 2)
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import gymnasium
import numpy as np
import numpy.typing as npt
from gymnasium.vector import AutoresetMode

from ._lissom import SolutionError
from ._model import Model
from ._types import Array

#: Joint coordinates and rates of a start, as `Simulation.reset` takes them.
Start = tuple[Array, Array]


class Task:
    """What an agent sees and does; the arguments of `Env` and `VectorEnv`.

    Args:
        actions: inputs of the model and their ranges; actions are these values, in this order.
        observations: columns, signals, inputs or states of the model.
        period: time between actions [s].
        steps: actions after which an episode is truncated.
        reward: of observation and action, of shape (…, number of observations) and (…, number of actions): index the last axis.
        terminated: whether an episode ends with an observation, of the same shape; by default none does.
        start: random joint coordinates and rates of an episode; by default episodes start as the model does.
        failure: reward of a step without a solution, which ends the episode.
        episode_inputs: random values of inputs that no action sets, constant in an episode: a target, a payload, the gain of a motor.
    """

    def __init__(
        self,
        actions: Mapping[str, tuple[float, float]],
        observations: Sequence[str],
        period: float,
        steps: int,
        reward: Callable[[Array, Array], Any],
        terminated: Callable[[Array], Any] | None = None,
        start: Callable[[np.random.Generator], Start] | None = None,
        failure: float = 0.0,
        episode_inputs: Callable[[np.random.Generator], Mapping[str, float]] | None = None,
    ) -> None:
        self.inputs, self.observations = list(actions), list(observations)
        self.period, self.steps, self.reward, self.start, self.failure = period, steps, reward, start, failure
        self.episode_inputs = episode_inputs or (lambda rng: {})
        self.terminated = terminated or (lambda observation: np.zeros(observation.shape[:-1], bool))
        low, high = np.array(list(actions.values()), float).reshape(-1, 2).T
        self.action_space = gymnasium.spaces.Box(low, high, dtype=np.float64)
        self.observation_space = gymnasium.spaces.Box(-np.inf, np.inf, (len(self.observations),), np.float64)

    def clipped(self, action: Any) -> Array:
        limited: Array = np.clip(np.asarray(action, float), self.action_space.low, self.action_space.high)
        return limited


def _rendering(
    env: Env | VectorEnv, mode: str | None, picture: Mapping[str, Any] | None
) -> tuple[str | None, dict[str, Any], dict[str, Any]]:
    """Render mode, metadata and arguments of pictures of an environment."""
    modes = env.metadata["render_modes"]
    if mode is not None and mode not in modes:
        raise ValueError(f"there is no render mode {mode!r}; the modes are {modes}")
    return mode, {**env.metadata, "render_fps": 1 / env.task.period}, dict(picture or {})


class Env(gymnasium.Env[Array, Array]):
    """An environment of one simulation, with the arguments of `Task`.

    Args:
        render_mode: `"rgb_array"`: `render` returns a picture of the present state.
        picture: arguments of `Simulation.picture`: `size`, `view`, `center`, `extent`.
    """

    metadata = {"render_modes": ["rgb_array"]}

    def __init__(
        self, model: Model, *, render_mode: str | None = None, picture: Mapping[str, Any] | None = None, **task: Any
    ) -> None:
        self.task = Task(**task)
        self.render_mode, self.metadata, self._picture = _rendering(self, render_mode, picture)
        self.action_space, self.observation_space = self.task.action_space, self.task.observation_space
        #: The `lissom.Simulation`.
        self.sim = model.simulation()
        self._begin, self._kept, self._steps = self.sim.time, self.sim.snapshot(), 0
        self._last = self.sim[self.task.observations]

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Array, dict[str, Any]]:
        super().reset(seed=seed)
        if self.task.start is None:
            self.sim.restore(self._kept)
        else:
            self.sim.reset(*self.task.start(self.np_random))
        if drawn := self.task.episode_inputs(self.np_random):
            self.sim.set(drawn)
        self._steps, self._last = 0, self.sim[self.task.observations]
        return self._last, {}

    def step(self, action: Array) -> tuple[Array, float, bool, bool, dict[str, Any]]:
        task = self.task
        action = task.clipped(action)
        self._steps += 1
        try:
            self.sim.set(task.inputs, action)
            self.sim.step_to(self._begin + self._steps * task.period)
        except SolutionError as error:
            return self._last, task.failure, True, False, {"error": str(error)}
        self._last = self.sim[task.observations]
        ends = bool(task.terminated(self._last)) or self.sim.stopped_by is not None
        return self._last, float(task.reward(self._last, action)), ends, self._steps >= task.steps, {}

    def render(self) -> Any:
        """Picture of the present state, of shape (height, width, 3); None without a `render_mode`."""
        return None if self.render_mode is None else self.sim.picture(**self._picture)


class VectorEnv(gymnasium.vector.VectorEnv[Array, Array, npt.NDArray[Any]]):
    """Environments of a `lissom.Batch`, with the arguments of `Env`. One that has ended starts again with the next action."""

    metadata = {"render_modes": ["rgb_array"], "autoreset_mode": AutoresetMode.NEXT_STEP}

    def __init__(
        self,
        model: Model,
        num_envs: int,
        *,
        render_mode: str | None = None,
        picture: Mapping[str, Any] | None = None,
        **task: Any,
    ) -> None:
        self.task, self.num_envs = Task(**task), num_envs
        self.render_mode, self.metadata, self._picture = _rendering(self, render_mode, picture)
        self.single_action_space, self.single_observation_space = self.task.action_space, self.task.observation_space
        self.action_space = gymnasium.vector.utils.batch_space(self.single_action_space, num_envs)
        self.observation_space = gymnasium.vector.utils.batch_space(self.single_observation_space, num_envs)
        #: The `lissom.Batch`.
        self.batch = model.simulations(num_envs)
        self._begin = self.batch.time
        self._steps, self._ended = np.zeros(num_envs, int), np.zeros(num_envs, bool)
        self._last = self.batch[self.task.observations]
        #: Inputs that are constant in an episode, by name.
        self._drawn: dict[str, Array] = {}

    def _start(self, members: npt.NDArray[np.intp]) -> None:
        if self.task.start is None:
            self.batch.reset(members)
        elif len(members):
            q, v = zip(*(self.task.start(self.np_random) for _ in members))
            self.batch.reset(members, np.array(q), np.array(v))
        for member in members:
            for name, value in self.task.episode_inputs(self.np_random).items():
                self._drawn.setdefault(name, np.zeros(self.num_envs))[member] = value
        self._steps[members] = 0

    def reset(self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None) -> tuple[Array, dict[str, Any]]:
        # One generator serves all environments.
        super().reset(seed=seed[0] if isinstance(seed, list) else seed)
        self._start(np.arange(self.num_envs))
        if self._drawn:
            self.batch.set(dict(self._drawn))
        self._ended[:] = False
        self._last = self.batch[self.task.observations]
        return self._last.copy(), {}

    def step(self, actions: Array) -> tuple[Array, Array, npt.NDArray[np.bool_], npt.NDArray[np.bool_], dict[str, Any]]:
        task, again = self.task, self._ended
        actions = task.clipped(actions)
        self._start(np.flatnonzero(again))
        self._steps[~again] += 1
        inputs = np.where(again[:, None], self.batch[task.inputs], actions)
        self.batch.set([*task.inputs, *self._drawn], np.column_stack([inputs, *self._drawn.values()]))
        self.batch.step_to(self._begin + self._steps * task.period)
        failed = self.batch.failed
        self._last = np.where(failed[:, None], self._last, self.batch[task.observations])
        stopped = np.array([event is not None for event in self.batch.stopped_by])
        rewards = np.where(failed, task.failure, task.reward(self._last, actions)) * ~again
        terminations = (failed | stopped | np.asarray(task.terminated(self._last), bool)) & ~again
        truncations = (self._steps >= task.steps) & ~again
        self._ended = terminations | truncations
        return self._last.copy(), rewards, terminations, truncations, {"failed": failed}

    def render(self) -> Any:
        """Pictures of the present states, one for each environment; None without a `render_mode`."""
        if self.render_mode is None:
            return None
        return tuple(self.batch.picture(index, **self._picture) for index in range(self.num_envs))
