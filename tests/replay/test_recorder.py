from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer import Matches
from rsoccer.arrays import Floats, Mask
from rsoccer.play import Play
from rsoccer.replay import Recorder, Replay, record_replay
from tests.helpers import Crowd, pushing, same, zeros
from tests.replay.conftest import vss


def test_a_recorded_match_has_every_state_and_reward() -> None:
    matches = Matches(Crowd(), seed=3, autoreset="disabled")
    recorder = Recorder(matches)
    rng = np.random.default_rng(0)
    rows, rewards, commands = [], [], []
    for _ in range(2):
        matches.reset()
        recorder.begin()
        rows.append(matches.frame.rows[0].copy())
        while not matches.done[0]:
            outcome = matches.step(pushing(rng, matches))
            recorder.add(outcome)
            rows.append(matches.frame.rows[0].copy())
            rewards.append(outcome.rewards[0])
            commands.append(matches.play.commands[0].copy())
    replay = recorder.replay()
    assert same(replay.rows, np.stack(rows))
    assert len(replay.episodes) == replay.starts.sum() == 2
    assert same(replay.commands[~replay.starts], np.stack(commands))
    np.testing.assert_allclose(replay.rewards[~replay.starts], np.stack(rewards), atol=1e-5)
    assert not replay.rewards[replay.starts].any()
    assert replay.seconds == pytest.approx(0.025 * len(rewards)) == recorder.seconds
    first, second = replay.episodes
    assert first.stop == second.start
    assert {first.end, second.end} <= {"terminated", "truncated"}
    assert set(first.metrics) == {"goal_score", "free_balls"}
    assert replay.observers == matches.task.robots


def test_robots_with_a_policy_that_observes_are_paid_too() -> None:
    replay = record_replay("VSSSelfPlay-v0", {"blue": "chase", "yellow": "ou"}, seconds=0.5)
    assert replay.observers == ("blue_0", "blue_1", "blue_2")
    assert replay.terms["energy"].shape == (21, 3)
    assert replay.terms["energy"][1:].any()


def test_one_world_of_many_is_the_match_of_its_seed() -> None:
    matches = Matches("VSS-v0", 3, seed=5, autoreset="disabled")
    alone = Matches("VSS-v0", 1, seed=7, autoreset="disabled")
    recorders = [Recorder(matches, 2), Recorder(alone)]
    for recorder in recorders:
        recorder.matches.reset()
        recorder.begin()
        for _ in range(20):
            recorder.add(recorder.matches.step(zeros(recorder.matches)))
    batch, single = (recorder.replay() for recorder in recorders)
    assert same(batch.rows, single.rows)
    assert same(batch.rewards, single.rewards)


def test_a_waiting_world_adds_nothing() -> None:
    matches = Matches(Crowd(max_steps=5), 2, autoreset="disabled")
    recorder = Recorder(matches, 1)
    matches.reset()
    recorder.begin()
    for _ in range(8):
        recorder.add(matches.step(zeros(matches)))
    assert matches.done.all()
    replay = recorder.replay()
    assert replay.episodes[0].end in ("terminated", "truncated")
    assert len(replay) <= 6


def test_next_step_begins_episodes_by_itself() -> None:
    matches = Matches(Crowd(max_steps=5), autoreset="next_step")
    recorder = Recorder(matches)
    matches.reset()
    recorder.begin()
    for _ in range(13):
        recorder.add(matches.step(zeros(matches)))
    replay = recorder.replay()
    assert len(replay) == 14
    assert len(replay.episodes) >= 3
    assert replay.episodes[-1].stop == 14
    assert (np.diff(replay.clock) == 0).sum() == len(replay.episodes) - 1


@dataclass(frozen=True)
class NotFinite(Crowd):
    """A metric, and from the fifth step on a reward term, that is not finite in world 0."""

    metric: float = 0.0
    reward: float = 0.0

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        terms, done = super().calculate_reward_and_done(play)
        own = np.where(play.steps >= 5, self.reward, 0.0)[:, None]
        return terms | {"own": own.astype(np.float32)}, done

    def metrics(self, play: Play) -> dict[str, Floats]:
        return super().metrics(play) | {"speed": np.full(len(play.frame), self.metric, np.float32)}


@pytest.mark.parametrize(
    ("task", "message"),
    [
        (NotFinite(reward=np.nan), "calculate_reward_and_done: .* for 'own', got .*nan"),
        (NotFinite(reward=np.inf), "calculate_reward_and_done: .* for 'own', got .*inf"),
        (NotFinite(metric=np.nan, max_steps=8), "metrics: .* for 'speed', got nan"),
    ],
)
def test_numbers_that_no_file_holds_are_refused_when_they_are_recorded(
    task: NotFinite, message: str
) -> None:
    """The replay could once not be saved, and nothing named the number."""
    matches = Matches(task, autoreset="disabled")
    recorder = Recorder(matches)
    matches.reset()
    recorder.begin()
    with pytest.raises(ValueError, match=rf"^NotFinite\.{message}"):
        while not matches.done[0]:
            recorder.add(matches.step(zeros(matches)))
    kept = recorder.replay()
    assert len(kept) == (8 if task.metric != 0.0 else 5)
    assert len(Replay.from_bytes(kept.to_bytes())) == len(kept)


def test_an_episode_that_is_not_over_has_no_end() -> None:
    replay = record_replay("VSSSelfPlay-v0", {"all": "zero"}, seconds=0.5)
    (episode,) = replay.episodes
    assert (episode.start, episode.stop, episode.end, episode.metrics) == (0, 21, "", {})


def test_a_match_has_the_goals_that_the_film_counts() -> None:
    replay = vss()
    blue, yellow = replay.score[-1]
    goals = [event for event in replay.events if event.kind == "goal"]
    assert blue + yellow == len(goals) > 0
    assert (replay.score[goals[0].frame - 1] == 0).all()
    assert f"A B {blue}-{yellow}" in repr(replay)


def test_snapshots_are_apart_by_the_interval() -> None:
    frames = list(vss().snapshots)
    assert frames[0] == 0
    assert np.diff(vss().clock[frames]) == pytest.approx(3.0)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"world": 2}, "world: expected 0 to 1, got 2"),
        ({"snapshot_interval": 0.0}, "snapshot_interval: expected a positive number"),
        ({"snapshot_interval": 1.0}, "snapshot_interval: expected None for 2 worlds"),
    ],
)
def test_wrong_settings_are_refused(options: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Recorder(Matches("VSS-v0", 2, autoreset="disabled"), **options)


def test_matches_that_hide_the_last_state_are_refused() -> None:
    with pytest.raises(ValueError, match="autoreset"):
        Recorder(Matches("VSS-v0"))


def test_calls_in_a_wrong_order_are_refused() -> None:
    matches = Matches("VSS-v0", autoreset="disabled")
    recorder = Recorder(matches)
    with pytest.raises(RuntimeError, match="replay before begin"):
        recorder.replay()
    matches.reset()
    outcome = matches.step(zeros(matches))
    with pytest.raises(RuntimeError, match="add before begin"):
        recorder.add(outcome)
    with pytest.raises(RuntimeError, match="begin after a step"):
        recorder.begin()


@pytest.mark.parametrize("seconds", [0.0, -1.0, float("nan")])
def test_a_duration_that_is_not_positive_is_refused(seconds: float) -> None:
    with pytest.raises(ValueError, match="seconds"):
        record_replay(controllers={"all": "zero"}, seconds=seconds)


def test_robots_without_a_policy_are_refused() -> None:
    with pytest.raises(ValueError, match="controllers: expected a policy for every robot"):
        record_replay(rsoccer.make_task("VSS-v0"))


@pytest.mark.parametrize("autoreset", ["same_step", "next_step"])
def test_attached_records_have_a_frame_for_each_step_and_one_for_the_start(autoreset: str) -> None:
    matches = Matches("VSS-v0", 2, seed=1, autoreset=autoreset, max_steps=5)
    recorder = Recorder(matches, 1, attach=True)
    matches.reset()
    firsts, played = [matches.frame.rows[1].copy()], 0
    for _ in range(20):
        waited = matches.done[1]
        outcome = matches.step(zeros(matches))
        played += not waited
        if waited or (autoreset == "same_step" and outcome.ended[1]):
            firsts.append(matches.frame.rows[1].copy())
    replay = recorder.replay()
    assert len(replay.episodes) == len(firsts) >= 4
    assert [len(range(each.start, each.stop)) for each in replay.episodes[:3]] == [6, 6, 6]
    assert len(replay) == played + len(firsts)
    assert same(replay.rows[replay.starts], np.stack(firsts))
