"""Pictures of environments and matches in notebooks, without a notebook."""

import subprocess
import sys
from collections.abc import Callable
from typing import Any

import gymnasium
import numpy as np
import pytest

pytest.importorskip("pygame")

import rsoccer
from rsoccer.render import Picture

MAKERS: list[Callable[[], Any]] = [
    lambda: rsoccer.single_env("VSS-v0"),
    lambda: rsoccer.single_env("SSLGoToBall-v0", render_mode="rgb_array"),
    lambda: rsoccer.parallel_env("VSSSelfPlay-v0"),
    lambda: rsoccer.vector_env("VSS-v0", 2),
    lambda: rsoccer.Matches("VSSSelfPlay-v0", 3),
    lambda: rsoccer.Matches("SSLMatch-v0", 2),
    lambda: rsoccer.parallel_env("VSSMatch-v0"),
    lambda: rsoccer.robots_vector_env("VSSMulti-v0", 3),
    lambda: gymnasium.make("rsoccer/VSS-v0").unwrapped,
    lambda: gymnasium.make_vec("rsoccer/VSS-v0", num_envs=2).unwrapped,
]
NAMES = ["single", "SSL", "parallel", "vector", "Matches", "SSL match", "VSSS match"]
NAMES += ["robots", "make", "make_vec"]


@pytest.mark.parametrize("make", MAKERS, ids=NAMES)
def test_a_notebook_shows_the_match(make: Callable[[], Any]) -> None:
    shown = make()
    assert shown._repr_png_() is None  # nothing to show before the reset
    shown.reset(seed=1)
    first = shown._repr_png_()
    assert first.startswith(b"\x89PNG")
    shown.reset(seed=3)
    assert shown._repr_png_() != first


def test_matches_show_nothing_before_the_first_has_begun() -> None:
    matches = rsoccer.Matches("VSSSelfPlay-v0", 2)
    matches.reset(mask=np.array([False, True]))
    assert matches._repr_png_() is None
    matches.reset(mask=np.array([True, False]))
    assert matches._repr_png_() is not None


@pytest.mark.parametrize("steps", [0, 20])
def test_pictures_have_ghosts_where_robots_have_senses(steps: int) -> None:
    shown = [
        (rsoccer.single_env("VSS-v0", render_mode="rgb_array", sensing=sensing), sensing)
        for sensing in (None, "vsss")
    ]
    matches = rsoccer.Matches("VSS-v0", seed=0, sensing="vsss")
    matches.reset()
    action = np.ones(2, np.float32)
    for env, _ in shown:
        env.reset(seed=0)
    for _ in range(steps):
        matches.step(action[None, None])
        for env, _ in shown:
            env.step(action)
    plain, sensed = (env.render() for env, _ in shown)
    assert isinstance(plain, np.ndarray)
    assert isinstance(sensed, np.ndarray)
    assert (plain != sensed).any()
    assert matches._repr_png_() == Picture(sensed).to_png()


def test_a_closed_environment_shows_nothing() -> None:
    env = rsoccer.single_env("VSS-v0")
    env.reset()
    env.close()
    assert env._repr_png_() is None


def test_the_picture_is_the_rendered_image() -> None:
    env = rsoccer.single_env("VSS-v0", render_mode="rgb_array")
    env.reset(seed=0)
    image = env.render()
    assert type(image) is np.ndarray
    assert env._repr_png_() == Picture(image).to_png()


def test_the_picture_of_matches_is_the_image_of_the_first() -> None:
    """With its clock and the markers of its task, as a single environment draws them."""
    env = rsoccer.single_env("SSLDribbling-v0", render_mode="rgb_array")
    matches = rsoccer.Matches("SSLDribbling-v0", 2, seed=3)
    env.reset(seed=3)
    matches.reset()
    action = np.array([0.0, 0.0, 0.5, 0.0, 0.0], np.float32)[: matches.action_size]
    for step in range(50):
        env.step(action)
        matches.step(np.tile(action, (2, 1, 1)))
        if step == 45:
            matches.reset(mask=np.array([False, True]))
    image = env.render()
    assert type(image) is np.ndarray
    assert matches._repr_png_() == Picture(image).to_png()


def test_an_image_of_a_wrapped_match_is_shown_by_picture() -> None:
    env = rsoccer.env("VSSSelfPlay-v0", render_mode="rgb_array")
    env.reset(seed=1)
    image = env.render()
    assert type(image) is np.ndarray
    assert Picture(image)._repr_png_().startswith(b"\x89PNG")


def test_without_pygame_the_text_remains() -> None:
    code = (
        "import sys; sys.modules['pygame'] = None\n"
        "import rsoccer\n"
        "for shown in (rsoccer.single_env('VSS-v0'), rsoccer.Matches('VSS-v0')):\n"
        "    shown.reset()\n"
        "    assert shown._repr_png_() is None\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
