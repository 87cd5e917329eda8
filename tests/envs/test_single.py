"""Gymnasium's Env: results, learners and images."""

from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.spaces import Discrete
from gymnasium.utils.env_checker import check_env

import rsoccer
from rsoccer.envs.single import SoccerEnv, single_env
from rsoccer.task import LEARN
from tests.fake_moviepy import assert_filmed, moviepy
from tests.helpers import comparable
from tests.parallel_matches import SELF_PLAY, shot_at
from tests.single_learner import DISCRETE, ONE_LEARNER, TASKS, draw, learner_options, short_env

# -- Gymnasium's own checks -------------------------------------------------------------------


@pytest.mark.parametrize("name", ONE_LEARNER)
def test_gymnasium_accepts_registered_tasks(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("pygame")
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    env = gymnasium.make(f"rsoccer/{name}", max_steps=60)
    assert isinstance(env.unwrapped, SoccerEnv)
    check_env(env.unwrapped)


@pytest.mark.parametrize("name", TASKS)
def test_gymnasium_accepts_every_task(name: str) -> None:
    check_env(single_env(name, **learner_options(name)), skip_render_check=True)


@pytest.mark.parametrize("name", DISCRETE)
def test_gymnasium_accepts_discrete_actions(name: str) -> None:
    check_env(single_env(name, discrete=True, **learner_options(name)), skip_render_check=True)


# -- Results ----------------------------------------------------------------------------------


@pytest.mark.parametrize("name", TASKS)
def test_only_the_last_info_holds_metrics(name: str) -> None:
    env = short_env(name, max_steps=9)
    metrics = env.task.metrics(env._matches.play)
    for seed in range(3):
        observation, info = env.reset(seed=seed)
        assert env.observation_space.contains(observation)
        steps, ended, terminated, truncated = 0, False, False, False
        while not ended:
            assert info == {}
            given = env.step(draw(env, np.random.default_rng(seed)))
            assert [type(part) for part in given] == [np.ndarray, float, bool, bool, dict]
            observation, _, terminated, truncated, info = given
            assert env.observation_space.contains(observation)
            steps, ended = steps + 1, terminated or truncated
        assert set(info) == {*metrics, "steps"}
        assert all(type(value) is float for value in info.values())
        assert info["steps"] == steps <= 9
        assert terminated is not truncated
        assert truncated is (steps == 9 and not terminated)


def test_a_goal_terminates() -> None:
    env = single_env(SELF_PLAY, learner="blue_1", controllers={"all": "zero"})
    env.reset(seed=0, options={"frame": shot_at(1)})
    terminated, reward = False, 0.0
    while not terminated:
        _, reward, terminated, truncated, info = env.step(np.zeros(2, np.float32))
    assert reward > 5.0
    assert not truncated
    assert info["goal_score"] == 1.0


@pytest.mark.parametrize("name", DISCRETE)
def test_a_discrete_action_is_a_row_of_the_table(name: str) -> None:
    env, twin = (
        short_env(name),
        single_env(name, discrete=True, max_steps=40, **learner_options(name)),
    )
    assert isinstance(twin.action_space, Discrete)
    table = twin.task.action_table
    assert table is not None
    assert twin.action_space.n == len(table)
    env.reset(seed=1)
    twin.reset(seed=1)
    for choice in range(len(table)):
        ours, theirs = env.step(table[choice]), twin.step(np.int64(choice))
        assert comparable(ours) == comparable(theirs)
        if ours[2] or ours[3]:
            env.reset(seed=choice)
            twin.reset(seed=choice)


def test_metadata() -> None:
    env = single_env("VSS-v0")
    assert env.metadata == {
        "name": "VSS-v0",
        "render_modes": ["human", "rgb_array"],
        "render_fps": 40,
    }
    assert env.unwrapped is env
    assert (env.task.name, env.learner, env.render_mode) == ("VSS-v0", "blue_0", None)


# -- Learners ---------------------------------------------------------------------------------


def test_the_learner_is_set_by_name() -> None:
    env = single_env(SELF_PLAY, learner="yellow_2", controllers={"all": "ou", "blue_0": "chase"})
    assert env.learner == "yellow_2"
    given: dict[str, Any] = {"all": "ou", "blue_1": LEARN}
    assert single_env(SELF_PLAY, controllers=given).learner == "blue_1"
    both = single_env(SELF_PLAY, learner="blue_1", controllers={"all": "ou", "blue_1": "zero"})
    assert both.learner == "blue_1"


def test_the_task_may_be_an_object() -> None:
    task = rsoccer.make_task("VSS-v0", n_blue=1)
    env = single_env(task, max_steps=3)
    assert (env.task.max_steps, task.max_steps) == (3, 1200)
    assert single_env(task).task is task


# -- Images -----------------------------------------------------------------------------------


@pytest.mark.parametrize("name", TASKS)
def test_images_show_the_match(name: str) -> None:
    pytest.importorskip("pygame")
    env = single_env(name, "rgb_array", **learner_options(name))
    with pytest.raises(RuntimeError, match="render before reset"):
        env.render()
    env.reset(seed=0)
    first, again = env.render(), env.render()
    assert first is not None
    assert again is not None
    assert first.dtype == np.uint8
    assert first.shape[2:] == (3,)
    assert np.array_equal(first, again)
    env.step(draw(env, np.random.default_rng(0)))
    assert comparable(first) != comparable(env.render())
    env.close()
    env.close()


def test_render_without_a_mode_warns() -> None:
    env = single_env("VSS-v0")
    env.reset()
    with pytest.warns(UserWarning, match="rgb_array") as warned:
        assert env.render() is None
    assert warned[0].filename == __file__, "the warning does not point at the caller"


@pytest.mark.parametrize("name", ["VSS-v0", "SSLDribbling-v0"])  # one of each league
def test_gymnasium_records_videos(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("pygame")
    clips = moviepy(monkeypatch)
    env = gymnasium.make(f"rsoccer/{name}", render_mode="rgb_array", max_steps=3)
    recorder = gymnasium.wrappers.RecordVideo(env, str(tmp_path / "videos"), episode_trigger=bool)
    for seed in range(2):
        recorder.reset(seed=seed)
        recorder.action_space.seed(seed)
        steps, ended = 0, False
        while not ended:
            _, _, terminated, truncated, _ = recorder.step(recorder.action_space.sample())
            steps, ended = steps + 1, bool(terminated or truncated)
    recorder.close()  # type: ignore[no-untyped-call]
    assert_filmed(clips, 1 + steps)
