"""Reinforcement learning without a framework: a policy by which the robot of `quadruped.py` stands up, by proximal policy
optimisation (PPO).

Policy and value are networks of two hidden layers in NumPy; environments of a `lissom.gym.VectorEnv` provide the experience. In two
minutes on two processors, 145 000 actions, the mean return of an episode rises from -2 to between 79 and 90 of at most 100, by the seed.
Needs `pip install lissom[gym]`.

Source of the algorithm: J. Schulman et al., Proximal policy optimization algorithms, arXiv:1707.06347.
"""

from __future__ import annotations

import os
import time
import warnings

# Before NumPy is loaded: its matrices are too small for threads, which would keep the processors from the environments.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
import numpy.typing as npt

import quadruped

Array = npt.NDArray[np.float64]

ENVIRONMENTS, STEPS = 24, 101  # and actions of each of them between two updates: an episode and its reset
DISCOUNT, TRACE = 0.97, 0.95  # of later rewards, and of later errors of the value in an advantage
EPOCHS, BATCH, RATE, CLIP = 8, 256, 1e-3, 0.2


class Network:
    """Layers of tanh with a linear last one, and Adam's method for their gradients."""

    def __init__(self, rng: np.random.Generator, sizes: list[int], last: float, free: int = 0) -> None:
        scales = [1.0] * (len(sizes) - 2) + [last]
        shapes = list(zip(sizes, sizes[1:], scales))
        self.weights = [scale * rng.normal(size=(n, m)) / np.sqrt(n) for n, m, scale in shapes]
        # Parameters in addition to the layers: logarithms of standard deviations.
        self.biases: list[Array] = [np.zeros(m) for _, m, _ in shapes] + [np.full(free, -1.0)]
        self.moments = [(np.zeros_like(own), np.zeros_like(own)) for own in self.weights + self.biases]
        self.updates = 0

    def __call__(self, x: Array) -> Array:
        self.layers = [x]
        for k, weight in enumerate(self.weights):
            x = x @ weight + self.biases[k]
            x = x if k == len(self.weights) - 1 else np.tanh(x)
            self.layers.append(x)
        return self.layers[-1]

    def descend(self, slope: Array, free: Array, rate: float) -> None:
        """A step against the gradient, for derivatives by the outputs of the last call and by the free parameters."""
        of_weights: list[Array] = []
        of_biases: list[Array] = []
        for weight, layer in zip(self.weights[::-1], self.layers[-2::-1]):
            of_weights.insert(0, layer.T @ slope)
            of_biases.insert(0, slope.sum(axis=0))
            slope = (slope @ weight.T) * (1 - layer**2)
        self.updates += 1
        gradient = of_weights + of_biases + [free]
        for own, (first, second), change in zip(self.weights + self.biases, self.moments, gradient):
            first += 0.1 * (change - first)
            second += 0.001 * (change**2 - second)
            corrected = second / (1 - 0.999**self.updates)
            own -= rate * first / (1 - 0.9**self.updates) / (np.sqrt(corrected) + 1e-8)


class Agent:
    def __init__(self, seed: int, observations: int, actions: int) -> None:
        self.rng = np.random.default_rng(seed)
        self.policy = Network(self.rng, [observations, 64, 64, actions], 0.01, free=actions)
        self.value = Network(self.rng, [observations, 64, 64, 1], 1.0)
        self.count, self.mean, self.variance = 1e-4, np.zeros(observations), np.ones(observations)

    def normalised(self, observations: Array) -> Array:
        scaled: Array = np.clip((observations - self.mean) / np.sqrt(self.variance + 1e-8), -10, 10)
        return scaled

    def observe(self, observations: Array) -> None:
        """Updates mean and variance of all observations."""
        count = self.count + len(observations)
        shift, share = observations.mean(axis=0) - self.mean, len(observations) / count
        self.variance = (1 - share) * self.variance + share * observations.var(axis=0) + share * (1 - share) * shift**2
        self.mean, self.count = self.mean + share * shift, count

    def act(self, observations: Array) -> Array:
        mean = self.policy(self.normalised(observations))
        return mean + self.rng.normal(size=mean.shape) * np.exp(self.policy.biases[-1])

    def likelihood(self, mean: Array, actions: Array) -> Array:
        """Logarithm of the density of actions, apart from a constant."""
        deviation = self.policy.biases[-1]
        return np.asarray((-0.5 * ((actions - mean) / np.exp(deviation)) ** 2 - deviation).sum(axis=-1))

    def learn(self, observations: Array, actions: Array, advantages: Array, values: Array, rate: float) -> None:
        inputs = self.normalised(observations)
        before = self.likelihood(self.policy(inputs), actions)
        advantages = (advantages - advantages.mean()) / (advantages.std() + 1e-8)
        for _ in range(EPOCHS):
            for own in np.array_split(self.rng.permutation(len(inputs)), max(1, len(inputs) // BATCH)):
                mean = self.policy(inputs[own])
                ratio, gain = np.exp(self.likelihood(mean, actions[own]) - before[own]), advantages[own]
                # The gradient vanishes where the policy has changed by more than CLIP in the direction of its gain.
                is_free = np.where(gain > 0, ratio < 1 + CLIP, ratio > 1 - CLIP)
                weight = (-gain * ratio * is_free / len(own))[:, None]
                error = (actions[own] - mean) / np.exp(self.policy.biases[-1])
                self.policy.descend(weight * error / np.exp(self.policy.biases[-1]), (weight * (error**2 - 1)).sum(axis=0), rate)
                self.value.descend((self.value(inputs[own]) - values[own, None]) / len(own), np.zeros(0), rate)


def advantages_of(rewards: Array, values: Array, terminations: Array, ends: Array) -> Array:
    """Generalised advantages, of shape (steps, environments); `values` also has those after the last step."""
    result, later = np.zeros_like(rewards), np.zeros(rewards.shape[1])
    for k in reversed(range(len(rewards))):
        # A truncated episode would go on: what follows counts by its value.
        error = rewards[k] + DISCOUNT * values[k + 1] * (1 - terminations[k]) - values[k]
        result[k] = later = error + DISCOUNT * TRACE * (1 - ends[k]) * later
    return result


def learn(iterations: int = 60, count: int = ENVIRONMENTS, steps: int = STEPS, seed: int = 0, show: bool = True) -> tuple[Agent, list[float]]:
    """Trains an agent. Returns it with the mean return of the episodes that ended in each iteration."""
    envs = quadruped.environments(count)
    size, force = len(quadruped.OBSERVATIONS), len(quadruped.JOINTS)
    agent, course, began = Agent(seed, size, force), [], time.monotonic()
    observation, _ = envs.reset(seed=seed)
    is_reset, total = np.zeros(count, bool), np.zeros(count)
    for iteration in range(iterations):
        seen, done = np.zeros((steps + 1, count, size)), np.zeros((steps, count, force))
        rewards, terminations, ends, valid = (np.zeros((steps, count)) for _ in range(4))
        returns: list[float] = []
        for k in range(steps):
            seen[k], done[k] = observation, agent.act(observation)
            # The step after the end of an episode begins the next one and ignores the action.
            valid[k] = ~is_reset
            observation, rewards[k], terminated, truncated, _ = envs.step(done[k])
            total += rewards[k]
            terminations[k], is_reset = terminated, terminated | truncated
            ends[k] = is_reset
            returns.extend(total[is_reset])
            total[is_reset] = 0
        seen[steps] = observation
        values = agent.value(agent.normalised(seen.reshape(-1, size))).reshape(steps + 1, count)
        # Values are of the order of one.
        advantages = advantages_of((1 - DISCOUNT) * rewards, values, terminations, ends)
        used = valid.astype(bool)
        # Shorter and shorter steps: the last policies differ little.
        rate = RATE * (1 - iteration / iterations)
        agent.learn(seen[:-1][used], done[used], advantages[used], (advantages + values[:-1])[used], rate)
        agent.observe(seen[:-1][used])
        course.append(float(np.mean(returns)) if returns else np.nan)
        if show:
            spread = np.exp(agent.policy.biases[-1]).mean()
            taken = (iteration + 1) * count * steps
            print(f"{taken:7d} steps  {time.monotonic() - began:4.0f} s  mean return {course[-1]:6.1f}  deviation of actions {spread:.2f}")
    return agent, course


def evaluate(agent: Agent, count: int = 16, seed: int = 1000) -> tuple[Array, Array]:
    """Returns of episodes without random actions, and heights of the trunk at their ends [m]."""
    envs = quadruped.environments(count)
    observation, _ = envs.reset(seed=seed)
    total, height, runs = np.zeros(count), np.zeros(count), np.ones(count, bool)
    while runs.any():
        observation, rewards, terminated, truncated, _ = envs.step(agent.policy(agent.normalised(observation)))
        total += rewards * runs
        height[runs] = observation[runs, 0]
        runs &= ~(terminated | truncated)
    return total, height


if __name__ == "__main__":
    # The steps damp the motion of feet between touches; heights of a standing robot do not depend on them.
    warnings.filterwarnings("ignore", ".*scheme-damps-motion")
    agent, _ = learn()
    returns, heights = evaluate(agent)
    print(f"without random actions: return {returns.mean():.1f} (least {returns.min():.1f}), height {heights.mean():.3f} m")
