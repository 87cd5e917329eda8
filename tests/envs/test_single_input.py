"""Options and actions of Gymnasium's Env: used as given, or refused without a change."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer.envs.single import single_env
from rsoccer.task import LEARN
from tests.helpers import comparable
from tests.parallel_matches import SELF_PLAY, crowded, shot_at
from tests.single_learner import draw


@pytest.mark.parametrize(
    ("make", "error", "message"),
    [
        (lambda: single_env("VSS-v9"), ValueError, "unknown task 'VSS-v9'.*VSSMulti-v0"),
        (lambda: single_env("VSS-v0", bal_speed=1), TypeError, "unexpected keyword .* .bal_speed."),
        (lambda: single_env("VSS-v0", max_steps=0), ValueError, "max_steps.*at least 1.*0"),
        (lambda: single_env("VSS-v0", "ansi"), ValueError, "render_mode.*rgb_array.*'ansi'"),
        (
            lambda: single_env(SELF_PLAY),
            ValueError,
            r"'yellow_2'\]: name the learner.*learner='blue_0'",
        ),
        (
            lambda: single_env("VSS-v0", controllers={"blue_1": LEARN}),
            ValueError,
            r"got \['blue_0', 'blue_1'\].*controllers=\{'all': 'ou'\}",
        ),
        (
            lambda: single_env("VSS-v0", controllers={"all": "ou"}),
            ValueError,
            "expected at least one learner, got none",
        ),
        (
            lambda: single_env("VSS-v0", learner="red_0"),
            ValueError,
            r"learner: expected one of \['blue_0'.*'red_0'",
        ),
        (
            lambda: single_env("VSS-v0", controllers={"blue_1": "oo"}),
            ValueError,
            "unknown policy 'oo'.*chase",
        ),
        (
            lambda: single_env(rsoccer.make_task("VSS-v0"), max_steps=0),
            ValueError,
            "max_steps: expected at least 1, got 0",
        ),
        (
            lambda: single_env(rsoccer.make_task("VSS-v0"), ball_speed=1.0),
            TypeError,
            r"a Task object has its own options, got \['ball_speed'\]",
        ),
        (lambda: single_env(3), TypeError, "task: expected a task or its name, got 3"),  # type: ignore[arg-type]
        (
            lambda: single_env("VSS-v0", controllers=["ou"]),  # type: ignore[arg-type]
            TypeError,
            r"controllers: expected a mapping.*, got \['ou'\]",
        ),
    ],
)
def test_wrong_options_are_named(
    make: Callable[[], object], error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message):
        make()


def test_a_match_starts_from_a_given_frame() -> None:
    env = single_env("VSS-v0")
    env.reset(seed=0, options={"frame": shot_at(1)})
    assert np.array_equal(env._matches.frame.rows[0], shot_at(1))


@pytest.mark.parametrize(
    ("reset", "error", "message"),
    [
        ({"options": {"frame": np.zeros(3, np.float32)}}, ValueError, r"\['frame'\].*\(3,\)"),
        ({"options": {"frame": "left"}}, TypeError, r"options\['frame'\].*floating-point"),
        ({"options": {"frame": np.full_like(shot_at(1), np.nan)}}, ValueError, "finite.*nan"),
        ({"options": {"frame": crowded()}}, ValueError, "blue_0.*yellow_2"),
        ({"options": ["frame"]}, TypeError, "options: expected a dictionary, got list"),
        ({"seed": -1}, ValueError, "seed: expected at least 0, got -1"),
        ({"seed": 1.5}, TypeError, "seed: expected a whole number"),
        ({"seed": [1]}, TypeError, "seed: expected a whole number"),
    ],
)
def test_a_refused_reset_changes_nothing(
    reset: dict[str, Any], error: type[Exception], message: str
) -> None:
    env, twin = single_env("VSS-v0"), single_env("VSS-v0")
    for each in (env, twin):
        each.reset(seed=0)
    with pytest.raises(error, match=message):
        env.reset(**{"seed": 1, **reset})
    assert env.np_random_seed == 0
    action = draw(env, np.random.default_rng(0))
    assert comparable(env.step(action)) == comparable(twin.step(action))
    assert comparable(env.reset()) == comparable(twin.reset())


WRONG_ACTIONS = {
    "too long": (np.zeros(3, np.float32), ValueError, r"expected shape \(2,\), got \(3,\)"),
    "one axis more": (np.zeros((1, 2), np.float32), ValueError, r"\(2,\), got \(1, 2\)"),
    "scalar": (np.float32(0), ValueError, r"\(2,\), got \(\)"),
    "texts": (np.array(["1", "0"]), TypeError, "floating-point.*<U1"),
    "integers": (np.zeros(2, int), TypeError, "floating-point.*int"),
    "none": (None, TypeError, "floating-point.*NoneType"),
    "NaN": (np.array([0.0, np.nan]), ValueError, r"finite numbers, got nan at \(1,\)"),
    "infinite": (np.array([-np.inf, 0.0]), ValueError, "finite numbers, got -inf"),
}
WRONG_INDICES = {
    "fraction": (1.0, TypeError, "expected whole numbers, got float64"),
    "too high": (9, ValueError, "expected 0 to 8, got 9"),
    "negative": (np.int64(-1), ValueError, "expected 0 to 8, got -1"),
    "several": (np.zeros(2, int), ValueError, r"expected shape \(\), got \(2,\)"),
    "a row": (np.zeros(2, np.float32), ValueError, r"expected shape \(\), got \(2,\)"),
}


@pytest.mark.parametrize(
    ("discrete", "action", "error", "message"),
    [(False, *wrong) for wrong in WRONG_ACTIONS.values()]
    + [(True, *wrong) for wrong in WRONG_INDICES.values()],
    ids=[*WRONG_ACTIONS, *WRONG_INDICES],
)
def test_refused_actions_change_nothing(
    discrete: bool,
    action: Any,  # noqa: ANN401
    error: type[Exception],
    message: str,
) -> None:
    env, twin = (single_env("VSS-v0", discrete=discrete) for _ in range(2))
    for each in (env, twin):
        each.reset(seed=0)
        each.action_space.seed(0)
    with pytest.raises(error, match=message):
        env.step(action)
    assert comparable(env.step(env.action_space.sample())) == comparable(
        twin.step(twin.action_space.sample())
    )


def test_a_step_without_an_episode_raises() -> None:
    env = single_env("VSS-v0", max_steps=1)
    still = np.zeros(2, np.float32)
    with pytest.raises(RuntimeError, match=r"step before reset: call reset\(\)"):
        env.step(still)
    for _ in range(2):
        env.reset()
        assert env.step(still)[3]
        with pytest.raises(RuntimeError, match=r"after the end of the episode: call reset\(\)"):
            env.step(still)


def test_actions_beyond_the_bounds_are_clipped() -> None:
    env, twin = single_env("VSS-v0"), single_env("VSS-v0")
    for each in (env, twin):
        each.reset(seed=0)
    for _ in range(3):
        beyond, clipped = (
            env.step(np.array([1e300, -7.0])),
            twin.step(np.array([1, -1], np.float32)),
        )
        assert comparable(beyond) == comparable(clipped)
