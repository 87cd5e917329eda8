"""Options and actions of PettingZoo environments: used as given, or refused without a change."""

import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

import rsoccer
from rsoccer.arrays import Floats
from rsoccer.envs.aec import env
from rsoccer.envs.parallel import SoccerParallelEnv, parallel_env
from tests.helpers import comparable
from tests.parallel_matches import SELF_PLAY, crowded, play_episode, random_actions, shot_at

# -- Options ----------------------------------------------------------------------------------


def test_robots_with_controllers_are_no_agents() -> None:
    match = parallel_env(SELF_PLAY, controllers={"yellow": "zero", "blue_1": "chase"})
    assert match.possible_agents == ["blue_0", "blue_2"]
    observations, _ = match.reset(seed=0)
    assert list(observations) == ["blue_0", "blue_2"]
    with pytest.raises(ValueError, match="expected at least one learner, got none"):
        parallel_env(SELF_PLAY, controllers={"all": "ou"})


@pytest.mark.parametrize("make", [parallel_env, env])
def test_a_task_is_given_by_name_or_as_an_object(make: Callable[..., Any]) -> None:
    task = rsoccer.VssMulti(n_blue=2, max_steps=9)
    assert make(task).possible_agents == ["blue_0", "blue_1"]
    assert make(task=SELF_PLAY).possible_agents == list(rsoccer.make_task(SELF_PLAY).agents)
    with pytest.raises(TypeError, match=r"a Task object has its own options, got \['n_blue'\]"):
        make(task, n_blue=1)
    with pytest.raises(TypeError, match="expected a task or its name, got 7"):
        make(7)


def test_the_time_limit_has_two_names() -> None:
    task = rsoccer.VssMulti(max_steps=9)
    assert parallel_env(task).max_cycles == 9
    assert parallel_env(task, max_cycles=3).max_cycles == 3
    assert parallel_env(SELF_PLAY, max_steps=4).max_cycles == 4
    assert parallel_env(SELF_PLAY, max_steps=4, max_cycles=3).max_cycles == 3
    assert task.max_steps == 9, "the caller's task does not change"


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: parallel_env("VSS-v9"), "unknown task 'VSS-v9'.*VSSMulti-v0"),
        (lambda: parallel_env(SELF_PLAY, bal_speed=1.0), "unexpected .* 'bal_speed'.*ball_speed"),
        (lambda: parallel_env(SELF_PLAY, max_cycles=0), "^max_cycles: expected at least 1, got 0"),
        (lambda: rsoccer.env(SELF_PLAY, max_cycles=True), "^max_cycles: expected a whole .*True"),
        (lambda: parallel_env(SELF_PLAY, max_steps=0), "^max_steps: expected at least 1, got 0"),
        (lambda: parallel_env(SELF_PLAY, "ansi"), "render_mode.*rgb_array.*'ansi'"),
        (lambda: parallel_env(SELF_PLAY, controllers={"red": "ou"}), "unknown.*red.*blue_0"),
        (lambda: parallel_env(SELF_PLAY, controllers={"blue_0": "oo"}), "'oo'.*chase"),
    ],
)
def test_wrong_options_are_named(make: Callable[[], object], message: str) -> None:
    with pytest.raises((TypeError, ValueError), match=message):
        make()


def test_the_time_limit_can_be_set_without_a_change_of_the_callers_task() -> None:
    task = rsoccer.make_task(SELF_PLAY, max_steps=9)
    match = SoccerParallelEnv(task)
    match.max_cycles = 2
    assert (match.max_cycles, task.max_steps) == (2, 9)
    assert play_episode(match, 0)[-1]["steps"] == 2.0
    with pytest.raises(ValueError, match="max_cycles: expected at least 1, got 0"):
        match.max_cycles = 0


def test_a_match_starts_from_a_given_frame() -> None:
    match = parallel_env(SELF_PLAY)
    match.reset(seed=0, options={"frame": shot_at(1)})
    assert np.array_equal(match._matches.frame.rows[0], shot_at(1))


@pytest.mark.parametrize(
    ("row", "error", "message"),
    [
        (np.zeros(3, np.float32), ValueError, r"options\['frame'\].*shape \(89,\).*\(3,\)"),
        ("left", TypeError, r"options\['frame'\].*floating-point"),
        (np.full(89, np.nan, np.float32), ValueError, r"options\['frame'\].*finite.*nan"),
        (np.zeros(89, np.float32), ValueError, "blue_0.*unit vector"),
        (crowded(), ValueError, "blue_0.*yellow_2"),
    ],
)
def test_refused_frames_change_nothing(row: object, error: type[Exception], message: str) -> None:
    match, twin = parallel_env(SELF_PLAY), parallel_env(SELF_PLAY)
    rng = np.random.default_rng(0)
    for each in (match, twin):
        each.reset(seed=0)
    with pytest.raises(error, match=message):
        match.reset(seed=1, options={"frame": row})
    actions = random_actions(match, rng)
    assert comparable(match.step(actions)[0]) == comparable(twin.step(actions)[0])
    assert comparable(match.reset()[0]) == comparable(twin.reset()[0])


@pytest.mark.parametrize("make", [parallel_env, env])
@pytest.mark.parametrize("key", ["frames", "initial_state", "seed", 1])
def test_unknown_options_of_a_reset_are_refused(make: Callable[[str], Any], key: object) -> None:
    """Formerly only those that look like `frame`; a wrong name left the start to chance."""
    match = make(SELF_PLAY)
    with pytest.raises(ValueError, match=re.escape(f"options: unknown [{key!r}]; valid are ['fr")):
        match.reset(seed=0, options={key: shot_at(1), "options": 1})
    match.reset(seed=0, options={"options": 1})  # as PettingZoo's tests do


def test_options_must_be_a_dictionary() -> None:
    options: Any = ["frame"]
    with pytest.raises(TypeError, match="options: expected a dictionary, got list"):
        parallel_env(SELF_PLAY).reset(options=options)


@pytest.mark.parametrize("make", [parallel_env, rsoccer.env])
@pytest.mark.parametrize(
    ("seed", "error"),
    [(-1, ValueError), (1.5, TypeError), ("a", TypeError), ([1], TypeError), ((1,), TypeError)],
)
def test_wrong_seeds_are_refused(
    make: Callable[[str], Any],
    seed: Any,  # noqa: ANN401
    error: type[Exception],
) -> None:
    with pytest.raises(error, match=r"^seed: expected"):
        make(SELF_PLAY).reset(seed=seed)


# -- Actions ----------------------------------------------------------------------------------


def test_a_step_without_an_episode_raises() -> None:
    match = parallel_env(SELF_PLAY, max_cycles=1)
    actions = {agent: np.zeros(2, np.float32) for agent in match.possible_agents}
    with pytest.raises(RuntimeError, match=r"step before reset: call reset\(\)"):
        match.step(actions)
    match.reset()
    match.step(actions)
    with pytest.raises(RuntimeError, match=r"after the end of the episode: call reset\(\)"):
        match.step(actions)
    match.reset()
    match.step(actions)


SIX = [f"{team}_{i}" for team in ("blue", "yellow") for i in range(3)]


def actions_with(**changes: object) -> dict[str, Any]:
    actions: dict[str, Any] = {agent: np.zeros(2, np.float32) for agent in SIX} | changes
    return {agent: action for agent, action in actions.items() if action is not None}


WRONG_ACTIONS = {
    "missing": (actions_with(blue_1=None), ValueError, r"missing \['blue_1'\]"),
    "empty": ({}, ValueError, "missing.*blue_0"),
    "extra": (actions_with(red_0=np.zeros(2)), ValueError, r"unknown \['red_0'\]"),
    "swapped": (actions_with(blue_1=None, red_0=np.zeros(2)), ValueError, "blue_1.*red_0"),
    "too long": (actions_with(blue_2=np.zeros(3)), ValueError, r"'blue_2'.*\(2,\).*\(3,\)"),
    "scalar": (actions_with(blue_2=np.float32(0)), ValueError, r"'blue_2'.*\(2,\).*\(\)"),
    "one axis more": (
        {agent: np.zeros((2, 1)) for agent in SIX},
        ValueError,
        r"'blue_0'.*\(2,\).*\(2, 1\)",
    ),
    "text": (actions_with(yellow_0="left"), TypeError, "'yellow_0'.*floating-point.*<U4"),
    "texts": (
        {agent: np.array(["1", "0"]) for agent in SIX},
        TypeError,
        "'blue_0'.*floating-point.*<U1",
    ),
    "integers": (
        {agent: np.zeros(2, int) for agent in SIX},
        TypeError,
        "'blue_0'.*floating-point.*int",
    ),
    "complex": (actions_with(blue_0=np.zeros(2, complex)), TypeError, "'blue_0'.*complex"),
    "none": ({**actions_with(), "blue_0": None}, TypeError, "'blue_0'.*NoneType"),
    "NaN": (
        actions_with(yellow_2=np.array([0.0, np.nan])),
        ValueError,
        r"'yellow_2'.*finite.*nan at \(1,\)",
    ),
    "infinite": (actions_with(blue_0=np.array([-np.inf, 0.0])), ValueError, "'blue_0'.*-inf"),
    "no dictionary": (np.zeros((6, 2), np.float32), TypeError, "dictionary.*ndarray"),
    "nothing": (None, TypeError, "dictionary.*NoneType"),
}


@pytest.mark.parametrize(("actions", "error", "message"), WRONG_ACTIONS.values(), ids=WRONG_ACTIONS)
def test_errors_of_actions_name_the_agent_and_change_nothing(
    actions: Any,  # noqa: ANN401
    error: type[Exception],
    message: str,
) -> None:
    match, twin = parallel_env(SELF_PLAY), parallel_env(SELF_PLAY)
    for each in (match, twin):
        each.reset(seed=0)
    with pytest.raises(error, match=message):
        match.step(actions)
    valid = random_actions(match, np.random.default_rng(0))
    assert comparable(match.step(valid)[0]) == comparable(twin.step(valid)[0])


@pytest.mark.parametrize("action", [[0], np.array([0]), [[0]], [0.5]])
def test_an_index_in_a_list_is_no_whole_number(action: object) -> None:
    """Formerly its vector was said to have a wrong shape."""
    match = parallel_env("VSSMulti-v0", discrete=True)
    match.reset(seed=0)
    actions: dict[str, Any] = dict.fromkeys(match.agents, 0)
    with pytest.raises(ValueError, match=r"^actions\['blue_1'\]: expected a whole number, got "):
        match.step({**actions, "blue_1": action})
    match.step(actions)


@given(
    action=arrays.arrays(
        st.sampled_from(["f2", "f4", "f8", "i4", "c8", "U2", "?"]),
        st.sampled_from([(2,), (1,), (3,), (), (2, 1), (0,)]),
    )
)
@settings(deadline=None, max_examples=60)
def test_any_action_is_either_used_or_refused_by_name(action: Floats) -> None:
    match = parallel_env(SELF_PLAY)
    match.reset(seed=0)
    before = match.state()
    valid = action.shape == (2,) and action.dtype.kind == "f" and np.isfinite(action).all()
    if valid:
        observations = match.step(actions_with(blue_1=action))[0]
        assert all(np.isfinite(observation).all() for observation in observations.values())
        return
    with pytest.raises((TypeError, ValueError), match="'blue_1'"):
        match.step(actions_with(blue_1=action))
    assert np.array_equal(match.state(), before)


def test_actions_beyond_the_bounds_are_clipped() -> None:
    match, twin = parallel_env(SELF_PLAY), parallel_env(SELF_PLAY)
    for each in (match, twin):
        each.reset(seed=0)
    beyond = {agent: np.array([1e30, -7.0]) for agent in SIX}
    clipped = {agent: np.array([1.0, -1.0], np.float32) for agent in SIX}
    for _ in range(3):
        assert comparable(match.step(beyond)[0]) == comparable(twin.step(clipped)[0])
