"""Pictures of running simulations, also as `render` of environments."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import lissom
from test_batch import CART

Image = npt.NDArray[np.uint8]

#: 0.01 m per pixel, x = 1 m in the middle: the cart moves to the right.
FRAME: dict[str, Any] = dict(size=(400, 100), view="front", center=(1, 0, 0), extent=1)
ARM = """
lissom = 1
[inputs]
motor = 0
[bodies.bar]
mass = 1
inertia = [0.01, 0.1, 0.1]
position = [0.5, 0, 0]
shape = { kind = "box", sides = [1, 0.1, 0.1] }
[joints.hinge]
kind = "revolute"
base = "ground"
tip = "bar"
at = [0, 0, 0]
axis = "y"
[loads.motor]
kind = "joint_torque"
joint = "hinge"
torque = "motor"
[outputs.hinge]
kind = "relative"
of = "hinge"
[analysis]
kind = "dynamics"
end = 1
step = 0.01
"""


def middle(image: Image) -> tuple[float, float]:
    """Column and row of the middle of what is drawn."""
    rows, columns = np.nonzero((image < 255).any(axis=-1))
    return (columns.min() + columns.max()) / 2, (rows.min() + rows.max()) / 2


def test_a_picture_is_one_of_the_present_state() -> None:
    sim = lissom.loads(CART).simulation()
    sim.set("thrust", 4)
    before = sim.snapshot()
    for time in (0.0, 0.25, 1.0):
        sim.step_to(time)
        image = sim.picture(**FRAME)
        assert image.shape == (100, 400, 3) and image.dtype == np.uint8 and (image[0] == 255).all()
        # x of the cart in pixels, to the half of one; it is t² here.
        assert sim["cart.x"] == pytest.approx(time**2) and middle(image) == pytest.approx((199.5 + 100 * (time**2 - 1), 49.5), abs=0.6)
        assert np.array_equal(sim.picture(**FRAME), image), "drawing changes nothing"
    sim.restore(before)
    assert middle(sim.picture(**FRAME))[0] == pytest.approx(99.5, abs=0.6)
    # The cart leaves a frame that does not follow it.
    sim.step_to(1.9)
    assert (sim.picture(**FRAME) == 255).all()


def test_a_part_that_turns_is_drawn_turned() -> None:
    sim = lissom.loads(ARM).simulation()
    frame: dict[str, Any] = dict(size=(300, 300), view="front", center=(0, 0, 0), extent=3)

    def drawn(x: float, z: float) -> bool:
        return bool((sim.picture(**frame)[round(149.5 - 100 * z), round(149.5 + 100 * x)] < 255).any())

    ends = {0.0: (0.9, 0.0), np.pi / 2: (0.0, -0.9), np.pi: (-0.9, 0.0), -np.pi / 2: (0.0, 0.9)}
    for angle in ends:
        sim.reset({"hinge.angle": angle})
        assert [drawn(*end) for end in ends.values()] == [other == angle for other in ends]
    # From above nothing but its length is seen, and from the side its width.
    sim.reset()
    top, side = (sim.picture(**{**frame, "view": view}) for view in ("top", "side"))
    assert (top[149, 230] < 255).any() and (side[:, 170:] == 255).all() and (side[149, 149] < 255).any()


def test_the_default_frame_shows_the_start_and_does_not_depend_on_the_motion() -> None:
    model = lissom.loads(ARM)
    sim, moved = model.simulation(), model.simulation()
    image = sim.picture()
    edges = np.concatenate([image[0], image[-1], image[:, 0], image[:, -1]])
    assert image.shape == (480, 640, 3) and (edges == 255).all() and (image < 255).any(axis=-1).sum() > 3000
    # The first picture of this one is drawn after it has moved.
    moved.reset({"hinge.angle": 1})
    first = moved.picture()
    moved.reset()
    assert not np.array_equal(first, image) and np.array_equal(moved.picture(), image)
    assert np.array_equal(lissom.loads(ARM).simulation().picture(), image)

    def fixed(image: Image) -> npt.NDArray[np.bool_]:
        """Where the red ball of the ground is drawn."""
        of = image.astype(int)
        return np.asarray((of[..., 0] > 80) & (of[..., 1:].max(axis=-1) < 20))

    ball = '[ground]\nshape = { kind = "sphere", radius = 0.05, position = [0.5, 0, 0.3], colour = "#ff0000" }\n'
    sim = lissom.loads(ARM.replace("[bodies.bar]", ball + "[bodies.bar]")).simulation()
    at_first = fixed(sim.picture())
    for angle in (0.5, 1, 2):
        sim.reset({"hinge.angle": angle})
        assert at_first.sum() > 100 and np.array_equal(fixed(sim.picture()), at_first)


def test_simulations_of_a_batch_have_pictures_of_their_own() -> None:
    model = lissom.loads(CART)
    batch, sim = model.simulations(3), model.simulation()
    batch.set("thrust", np.array([0.0, 2.0, 4.0]))
    sim.set("thrust", 2)
    batch.step_to(1)
    sim.step_to(1)
    columns = [middle(batch.picture(index, **FRAME))[0] for index in range(3)]
    assert columns == pytest.approx([99.5, 149.5, 199.5], abs=0.6)
    assert np.array_equal(batch.picture(1, **FRAME), sim.picture(**FRAME))
    with pytest.raises(IndexError, match="no simulation 3"):
        batch.picture(3)


def test_invalid_frames_are_rejected() -> None:
    sim = lissom.loads(CART).simulation()
    wrong: list[tuple[dict[str, Any], str]] = [
        (dict(view="below"), "no view `below`"),
        (dict(size=(0, 10)), "pixels"),
        (dict(size=(10, 5000)), "pixels"),
        (dict(extent=0.0), "extent"),
        (dict(extent=float("nan")), "extent"),
        (dict(center=(0, float("inf"), 0)), "center"),
    ]
    for frame, words in wrong:
        with pytest.raises(ValueError, match=words):
            sim.picture(**frame)


def test_environments_render_their_present_state() -> None:
    pytest.importorskip("gymnasium", reason="the package `gymnasium` is not installed: pip install gymnasium")
    from gymnasium.utils.env_checker import check_env
    from lissom.gym import Env, VectorEnv

    from test_gym import task

    model = lissom.loads(CART)
    env = Env(model, render_mode="rgb_array", picture=FRAME, **task(steps=3))
    check_env(env)
    assert env.metadata["render_fps"] == 10
    envs = VectorEnv(model, 2, render_mode="rgb_array", picture=FRAME, **task(steps=3))
    env.reset()
    envs.reset()
    start = env.render()
    for _ in range(3):
        env.step(np.array([3.0]))
        envs.step(np.array([[3.0], [-3.0]]))
        image, both = env.render(), envs.render()
        assert np.array_equal(image, env.render())
        assert len(both) == 2 and np.array_equal(both[0], image) and not np.array_equal(both[1], image)
    assert middle(image)[0] == pytest.approx(99.5 + 100 * env.sim["cart.x"], abs=0.6) and env.sim["cart.x"] > 0.05
    env.reset()
    assert np.array_equal(env.render(), start)
    # The third step was the last: the next one starts again.
    envs.step(np.zeros((2, 1)))
    assert all(np.array_equal(picture, start) for picture in envs.render())
    # Without a mode there are no pictures, and other modes do not exist.
    assert Env(model, **task()).render() is None and VectorEnv(model, 2, **task()).render() is None
    with pytest.raises(ValueError, match="no render mode 'human'"):
        Env(model, render_mode="human", **task())


def test_environments_of_the_same_seed_have_equal_pictures() -> None:
    pytest.importorskip("gymnasium", reason="the package `gymnasium` is not installed: pip install gymnasium")
    from lissom.gym import Env

    def pictures(seed: int) -> list[Image]:
        env = Env(
            lissom.loads(ARM),
            render_mode="rgb_array",
            actions={"motor": (-1.0, 1.0)},
            observations=["hinge.angle"],
            period=0.1,
            steps=5,
            reward=lambda observation, action: 0.0,
            start=lambda rng: (rng.uniform(-1, 1, 1), np.zeros(1)),
        )
        env.reset(seed=seed)
        images = [env.render()]
        for _ in range(3):
            env.step(np.array([1.0]))
            images.append(env.render())
        return images

    first = pictures(1)
    assert all(not np.array_equal(one, other) for one, other in zip(first, first[1:]))
    assert np.array_equal(pictures(1), first) and not np.array_equal(pictures(2)[0], first[0])
