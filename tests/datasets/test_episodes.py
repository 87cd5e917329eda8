"""Episodes for offline learning."""

import numpy as np
import pytest

import rsoccer
from rsoccer.datasets import record_episodes
from tests.helpers import same

TASK = "SSLGoToBall-v0"


def test_an_episode_is_what_an_environment_shows_for_the_same_actions() -> None:
    (episode,) = record_episodes("fetch", TASK, 1, 5)
    env = rsoccer.single_env(TASK)
    observation, _ = env.reset(seed=5)
    observations, rewards = [observation], []
    for action in episode.actions:
        observation, reward, terminated, _, _ = env.step(action)
        observations.append(observation)
        rewards.append(reward)
    assert terminated == episode.terminated
    assert same(np.stack(observations), episode.observations)
    assert np.allclose(rewards, episode.rewards)
    assert episode.metrics["reached"] == 1.0
    assert (episode.robot, episode.policy, len(episode)) == ("blue_0", "fetch", len(rewards))


def test_matches_end_one_by_one_and_do_not_depend_on_their_neighbors() -> None:
    together = record_episodes("ou", rsoccer.make_task(TASK, max_steps=60), 5, 7, worlds=5)
    alone = record_episodes("ou", rsoccer.make_task(TASK, max_steps=60), 5, 7, worlds=2)
    assert [part.seed for part in together] == [7, 8, 9, 10, 11]
    for first, second in zip(together, alone, strict=True):
        assert same(first.observations, second.observations)
        assert same(first.actions, second.actions)


def test_a_time_limit_is_no_end_of_the_task() -> None:
    (episode,) = record_episodes("zero", rsoccer.make_task(TASK, max_steps=8), 1)
    assert (len(episode), episode.terminated) == (8, False)
    assert not episode.actions.any()


def test_each_learner_has_episodes_of_its_own() -> None:
    task = rsoccer.make_task("VSSSelfPlay-v0", max_steps=6)
    episodes = record_episodes("chase", task, 2, opponent="zero")
    assert [part.robot for part in episodes] == ["blue_0", "blue_1", "blue_2"] * 2
    assert all(len(part) == 6 for part in episodes)
    assert not same(episodes[0].observations, episodes[1].observations)


def test_senses_are_what_the_policy_saw() -> None:
    task = rsoccer.make_task(TASK, max_steps=20)
    (true,) = record_episodes("zero", task, 1)
    (sensed,) = record_episodes("zero", task, 1, sensing="rc2021")
    assert not same(true.observations, sensed.observations)
    assert (true.sensing, true.opponent, true.randomization) == ("", "", {})
    assert sensed.sensing == "rc2021"


def test_episodes_know_the_conditions_of_their_matches() -> None:
    task = rsoccer.make_task("VSS-v0", max_steps=8)
    varied = {"robot.mass": (0.9, 1.1)}
    (episode,) = record_episodes(
        "best:robust", task, 1, opponent="zero", sensing="vsss", randomization=varied
    )
    assert episode.sensing == "vsss, forecast=1", "its policy needs a forecast"
    assert (episode.opponent, episode.randomization) == ("zero", varied)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("nobody", TASK, 1), "unknown policy 'nobody'"),
        (("fetch", "VSS-v0", 1), "dribbler"),
        (("fetch", TASK, 0), "matches: expected"),
        (("fetch", TASK, 1, -1), "seed: expected"),
    ],
)
def test_bad_arguments_are_refused(arguments: tuple[object, ...], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        record_episodes(*arguments)  # type: ignore[arg-type]
