"""Branches of replays: what if other policies had played on."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import rsoccer
from rsoccer.arrays import Floats
from rsoccer.controllers import Controller
from rsoccer.policies.base import Memory, PolicyInput
from rsoccer.policies.vss.chase import Chase
from rsoccer.replay import Recorder, Replay, ReplayError, record_replay, what_if
from rsoccer.replay.branch import has_exact_start
from rsoccer.rng import WorldRng
from rsoccer.task import LEARN
from tests.helpers import same

TEAMS: dict[str, Controller] = {"blue": "chase", "yellow": "ou"}


@cache
def vss() -> Replay:
    """A match with snapshots at each second, as its file has it."""
    replay = record_replay("VSSSelfPlay-v0", TEAMS, 3, seconds=4.0, snapshot_interval=1.0)
    return Replay.from_bytes(replay.to_bytes())


def exact() -> Replay:
    """The same match, not rounded."""
    return record_replay("VSSSelfPlay-v0", TEAMS, 3, seconds=4.0, snapshot_interval=1.0)


def test_a_branch_begins_with_each_bit_of_the_recording_between_snapshots() -> None:
    recorded = exact()
    frame = 53
    assert frame not in vss().snapshots
    assert has_exact_start(vss(), frame)
    matches = vss().branch(frame, {"all": "zero"})
    assert same(matches.frame.rows[0], recorded.rows[frame])
    start = max(part.start for part in recorded.episodes if part.start <= frame)
    assert matches.play.steps[0] == frame - start > 0
    assert not matches.agents


def test_the_same_policies_play_as_they_did_and_others_do_not() -> None:
    teams: dict[str, Controller] = {"blue": "chase", "yellow": "zero"}
    recorded = record_replay("VSSSelfPlay-v0", teams, 3, seconds=2.0, snapshot_interval=1.0)
    again = what_if(recorded, 50, teams, seconds=0.5)
    assert same(again.rows, recorded.rows[50:71])
    assert len(again.episodes) == 1
    other = what_if(recorded, 50, {"blue": "zero", "yellow": "chase"}, seconds=0.5)
    assert same(other.rows[0], recorded.rows[50])
    assert not np.allclose(other.rows[-1], again.rows[-1], atol=0.01)


def test_equal_seeds_give_equal_branches() -> None:
    first, again = (what_if(vss(), 53, {"all": "ou"}, seconds=0.5, seed=4) for _ in range(2))
    other = what_if(vss(), 53, {"all": "ou"}, seconds=0.5, seed=5)
    assert same(first.rows, again.rows)
    assert not same(first.rows, other.rows)


def test_a_replay_without_snapshots_goes_on_with_the_bodies_of_the_frame() -> None:
    plain = replace(vss(), snapshots={})
    assert not has_exact_start(plain, 53)
    matches = plain.branch(53, {"all": "zero"})
    assert np.abs(matches.frame.rows[0] - vss().rows[53])[:2].max() < 1e-3
    assert matches.play.steps[0] == 0, "a new episode"
    assert what_if(plain, 53, {"all": "chase"}, seconds=0.5).seconds == 0.5


def test_a_branch_keeps_the_referee_and_the_clock_of_the_match() -> None:
    task = rsoccer.make_task("VSSMatch-v0", referee={"prepare_seconds": 0.5})
    teams: dict[str, Controller] = {robot: "scripted" for robot in task.robots}
    recorded = record_replay(task, teams, 4, seconds=6.0, snapshot_interval=3.0)
    matches = recorded.branch(150, {"all": "zero"})
    assert matches.play.steps[0] == 150
    played = recorded.resume(120)
    none = np.zeros((1, 0, played.action_size), np.float32)
    for _ in range(30):
        played.step(none)
    assert same(matches.play.game.referee, played.play.game.referee)
    assert matches.play.game.referee.any()


def test_a_branch_keeps_the_senses() -> None:
    recorded = record_replay(
        "VSSSelfPlay-v0", TEAMS, 4, seconds=2.0, snapshot_interval=1.0, sensing="vsss"
    )
    snapshot = sorted(recorded.snapshots)[1]
    assert snapshot + 10 < recorded.episodes[0].stop, "both go on in one episode"
    matches = recorded.branch(snapshot + 10, {"blue": "zero", "yellow": "chase"})
    resumed = recorded.resume(snapshot)
    none = np.zeros((1, 0, resumed.action_size), np.float32)
    for _ in range(10):
        resumed.step(none)
    assert same(matches.play.sensed.rows, resumed.play.sensed.rows)
    assert not same(matches.play.sensed.rows, matches.frame.rows)


def test_learners_of_ones_own_take_over() -> None:
    matches = vss().branch(53, {"blue": LEARN, "yellow": "ou"})
    assert matches.agents == ("blue_0", "blue_1", "blue_2")
    outcome = matches.step(np.ones((1, 3, matches.action_size), np.float32))
    assert outcome.observations.shape[1] == 3
    with pytest.raises(ReplayError, match="expected a policy for every robot, got none for"):
        what_if(vss(), 53, {"blue": LEARN, "yellow": "ou"})


def test_recorded_learners_cannot_play_again_between_snapshots() -> None:
    matches = rsoccer.Matches("VSS-v0", autoreset="disabled")
    recorder = Recorder(matches, snapshot_interval=0.25)
    matches.reset(seed=0)
    recorder.begin()
    for _ in range(12):
        recorder.add(matches.step(np.zeros((1, 1, 2), np.float32)))
    replay = recorder.replay()
    with pytest.raises(ReplayError, match=r"expected one with a snapshot \(\[0, 10\]\), as learn"):
        replay.branch(5, {"all": "zero"})
    assert same(replay.branch(10, {"all": "zero"}).frame.rows[0], replay.rows[10])


class Backward(Chase):
    """Has the memory of the recorded policy, and plays otherwise."""

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        return -super().act(inputs, rng, memory)


def test_policies_without_a_name_have_to_be_given() -> None:
    task = rsoccer.make_task("VSSSelfPlay-v0")
    teams: dict[str, Controller] = {"blue": Chase(task), "yellow": "zero"}
    replay = record_replay(task, teams, 3, seconds=1.0, snapshot_interval=2.0)
    with pytest.raises(ReplayError, match=r"controllers: expected policies for \['blue_0'"):
        replay.branch(8, {"all": "zero"})
    assert same(replay.branch(8, {"all": "zero"}, recorded=teams).frame.rows[0], replay.rows[8])
    with pytest.raises(ReplayError, match=r"as the policies play otherwise .* a body is"):
        replay.branch(30, {"all": "zero"}, recorded={"blue": Backward(task), "yellow": "zero"})


@pytest.mark.parametrize(
    ("frame", "message"),
    [(-1, "frame: expected"), (len(vss()), f"frame: expected 0 to {len(vss()) - 1}, got")],
)
def test_other_frames_are_refused(frame: int, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        vss().branch(frame, {"all": "zero"})


def test_the_end_of_a_match_has_no_continuation() -> None:
    replay = record_replay(rsoccer.make_task("VSSSelfPlay-v0", max_steps=10), TEAMS, 3, seconds=0.5)
    with pytest.raises(ReplayError, match="before the end of the match, got 10"):
        replay.branch(10, {"all": "zero"})
    assert len(what_if(replay, 9, {"all": "zero"})) > 1


def test_another_physics_is_refused() -> None:
    with pytest.raises(ReplayError, match=r"physics: expected version"):
        replace(vss(), physics=1).branch(53, {"all": "zero"})
