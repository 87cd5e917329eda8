"""Options and actions of Gymnasium's VectorEnv: used as given, or refused without a change."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from rsoccer.envs.robots_vector import robots_vector_env
from rsoccer.envs.vector import vector_env
from tests.helpers import comparable
from tests.parallel_matches import SELF_PLAY, crowded, shot_at
from tests.single_learner import TASKS, learner_options

N = 3


@pytest.mark.parametrize(
    ("make", "error", "message"),
    [
        (lambda: vector_env("VSS-v9", N), ValueError, "unknown task 'VSS-v9'"),
        (
            lambda: vector_env("VSS-v0", N, bal_speed=1),
            TypeError,
            "unexpected keyword .* .bal_speed.",
        ),
        (lambda: vector_env("VSS-v0", 0), ValueError, "expected at least 1, got 0"),
        (lambda: vector_env("VSS-v0", N, threads=0), ValueError, "threads: .*at least 1"),
        (lambda: vector_env("VSS-v0", N, "human"), ValueError, "render_mode.*'rgb_array'.*'human'"),
        (
            lambda: vector_env("VSS-v0", N, autoreset_mode="never"),
            ValueError,
            r"autoreset_mode: expected one of \['next_step', .*'never'",
        ),
        (lambda: vector_env(SELF_PLAY, N), ValueError, "learner='blue_0'"),
        (
            lambda: vector_env(SELF_PLAY, N, learner="ego"),
            ValueError,
            "learner: expected (.*)'ego'",
        ),
        (lambda: vector_env("VSS-v0", N, max_steps=0), ValueError, "max_steps.*at least 1"),
        (
            lambda: vector_env("VSS-v0", N, max_episode_steps=0),
            ValueError,
            "^max_episode_steps: expected at least 1, got 0",
        ),
        (
            lambda: robots_vector_env("VSS-v0", N, max_episode_steps=True),
            TypeError,
            "^max_episode_steps: expected a whole number, got True",
        ),
    ],
)
def test_wrong_options_are_named(
    make: Callable[[], object], error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message):
        make()


def test_matches_start_from_given_frames() -> None:
    envs = vector_env("VSS-v0", N)
    left, right = shot_at(-1), shot_at(1)
    envs.reset(seed=0, options={"frame": right})
    assert comparable(envs._matches.frame.rows) == comparable(np.stack([right] * N))
    rows, mask = np.stack([left, right, left]), np.array([True, False, True])
    envs.reset(options={"frame": rows, "reset_mask": mask})
    assert comparable(envs._matches.frame.rows) == comparable(rows)
    with pytest.raises(ValueError, match=r"options\['frame'\]: expected shape \(3, 89\)"):
        envs.reset(options={"frame": rows[:2], "reset_mask": mask})


@pytest.mark.parametrize(
    ("reset", "error", "message"),
    [
        ({"options": {"frame": np.zeros(3, np.float32)}}, ValueError, r"\['frame'\].*\(3,\)"),
        ({"options": {"frame": crowded()}}, ValueError, "blue_0.*yellow_2"),
        (
            {"seed": [4, None, 6], "options": {"frame": np.stack([shot_at(1)] * 2 + [crowded()])}},
            ValueError,
            "blue_0.*yellow_2",
        ),
        ({"options": ["frame"]}, TypeError, "options: expected a dictionary, got list"),
        ({"options": {"reset_mask": [True] * N}}, ValueError, "bool array .*, got .*True"),
        ({"options": {"reset_mask": np.ones(N)}}, ValueError, r"bool array \(3,\), got float64"),
        ({"options": {"reset_mask": np.ones(2, bool)}}, ValueError, r"got bool \(2,\)"),
        ({"options": {"reset_mask": np.zeros(N, bool)}}, ValueError, "at least one match"),
        ({"seed": -1}, ValueError, "seed: expected at least 0, got -1"),
        ({"seed": 1.5}, TypeError, "seed: expected a whole number"),
        ({"seed": [1, 2]}, ValueError, "seed: expected a number or 3 of them, got 2"),
        ({"seed": [1, 2, 0.5]}, TypeError, "seed: expected a whole number"),
    ],
)
def test_a_refused_reset_changes_nothing(
    reset: dict[str, Any], error: type[Exception], message: str
) -> None:
    envs, twin = vector_env("VSS-v0", N), vector_env("VSS-v0", N)
    for each in (envs, twin):
        each.reset(seed=0)
    with pytest.raises(error, match=message):
        envs.reset(**{"seed": 1, **reset})
    assert envs.np_random_seed == 0
    actions = np.ones((N, 2), np.float32)
    assert comparable(envs.step(actions)) == comparable(twin.step(actions))
    assert comparable(envs.reset()) == comparable(twin.reset())


WRONG_ACTIONS = {
    "one match": (np.zeros(2, np.float32), ValueError, r"\(3, 2\), got \(2,\)"),
    "too many": (np.zeros((4, 2), np.float32), ValueError, r"\(3, 2\), got \(4, 2\)"),
    "integers": (np.zeros((N, 2), int), TypeError, "floating-point.*int"),
    "NaN": (np.full((N, 2), np.nan), ValueError, r"finite numbers, got nan at \(0, 0\)"),
}
WRONG_INDICES = {
    "fractions": (np.zeros(N), TypeError, "expected whole numbers, got float64"),
    "too high": (np.array([0, 9, 0]), ValueError, "expected 0 to 8, got 9"),
    "one choice": (np.int64(3), ValueError, r"expected shape \(3,\), got \(\)"),
}


@pytest.mark.parametrize(
    ("discrete", "actions", "error", "message"),
    [(False, *wrong) for wrong in WRONG_ACTIONS.values()]
    + [(True, *wrong) for wrong in WRONG_INDICES.values()],
    ids=[*WRONG_ACTIONS, *WRONG_INDICES],
)
def test_refused_actions_change_nothing(
    discrete: bool,
    actions: Any,  # noqa: ANN401
    error: type[Exception],
    message: str,
) -> None:
    envs, twin = (vector_env("VSS-v0", N, discrete=discrete) for _ in range(2))
    for each in (envs, twin):
        each.reset(seed=0)
        each.action_space.seed(0)
    with pytest.raises(error, match=message):
        envs.step(actions)
    given, expected = (each.step(each.action_space.sample()) for each in (envs, twin))
    assert comparable(given) == comparable(expected)


@pytest.mark.parametrize("mode", ["next_step", "same_step", "disabled"])
def test_a_step_before_reset_raises(mode: str) -> None:
    envs = vector_env("VSS-v0", N, autoreset_mode=mode)
    still = np.zeros((N, 2), np.float32)
    with pytest.raises(RuntimeError, match="step before reset"):
        envs.step(still)
    envs.reset(options={"reset_mask": np.array([True, False, True])})
    with pytest.raises(RuntimeError, match="step before reset"):
        envs.step(still)


def test_without_autoreset_a_step_after_the_end_raises() -> None:
    envs = vector_env("VSS-v0", N, autoreset_mode="disabled", max_steps=2)
    still, mask = np.zeros((N, 2), np.float32), np.array([False, True, False])
    envs.reset(seed=0)
    envs.step(still)
    envs.reset(options={"reset_mask": mask})
    envs.step(still)
    with pytest.raises(RuntimeError, match=r"after the end of the episode in worlds \[0, 2\]"):
        envs.step(still)
    envs.reset(options={"reset_mask": ~mask})
    assert envs.step(still)[3].tolist() == [False, True, False]


@pytest.mark.parametrize("name", TASKS)
def test_images_show_each_match(name: str) -> None:
    pytest.importorskip("pygame")
    envs = vector_env(name, 2, "rgb_array", **learner_options(name))
    with pytest.raises(RuntimeError, match="render before reset"):
        envs.render()
    envs.reset(seed=0)
    envs.step(np.array([[1.0], [-1.0]], np.float32).repeat(envs.task.action_size, axis=1))
    images = envs.render()
    assert images is not None
    first, second = images
    assert first.dtype == np.uint8
    assert first.shape == second.shape
    assert comparable(first) != comparable(second)


def test_render_without_a_mode_warns() -> None:
    envs = vector_env("VSS-v0", N)
    envs.reset()
    with pytest.warns(UserWarning, match="rgb_array") as warned:
        assert envs.render() is None
    assert [each.filename for each in warned] == [__file__]


def test_render_modes_are_those_that_are_accepted() -> None:
    for mode in vector_env(SELF_PLAY, N, learner="blue_0", controllers={"all": "ou"}).metadata[
        "render_modes"
    ]:
        envs = vector_env(
            SELF_PLAY, N, learner="blue_0", controllers={"all": "ou"}, render_mode=mode
        )
        envs.reset(seed=0)
        assert envs.render() is not None
        envs.close()
