from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer import LEARN, Field, Matches, RobotModel, Sensing
from rsoccer.controllers import Controller
from rsoccer.policies.vss.chase import Chase
from rsoccer.registry import options_of
from rsoccer.replay import Recorder, Replay, ReplayError, record_replay
from rsoccer.task import Task
from rsoccer.tasks import VssSelfPlay
from tests.helpers import same, zeros
from tests.replay.conftest import sensed_vss, vss


@dataclass(frozen=True)
class Unregistered(VssSelfPlay):
    pass


def test_a_resumed_match_goes_on_exactly_as_it_did() -> None:
    recorded = vss()
    read = Replay.from_bytes(recorded.to_bytes())
    for frame in read.snapshots:
        episode = next(e for e in recorded.episodes if e.start <= frame < e.stop)
        matches = read.resume(frame)
        assert same(matches.frame.rows[0], recorded.rows[frame])
        for later in range(frame + 1, episode.stop):
            matches.step(zeros(matches))
            assert same(matches.frame.rows[0], recorded.rows[later])
        assert matches.done[0] == bool(episode.end)


@pytest.mark.parametrize("name", ["VSSMatch-v0", "SSLMatch-v0"])
def test_a_resumed_match_has_the_same_referee(name: str) -> None:
    task = rsoccer.make_task(name, referee={"max_prepare_seconds": 0.5, "prepare_seconds": 0.5})
    controllers = {robot: "scripted" for robot in task.robots}
    replay = record_replay(task, controllers, 4, seconds=6.0, snapshot_interval=3.0)
    read = Replay.from_bytes(replay.to_bytes())
    for frame in (0, 120):
        matches = read.resume(frame)
        for later in range(frame + 1, 241):
            matches.step(zeros(matches))
            assert same(matches.frame.rows[0], replay.rows[later])
        assert matches.play.game.statistics.any(), "it was never in play"


def test_a_frame_without_a_snapshot_is_refused() -> None:
    held = ", ".join(map(str, vss().snapshots))
    with pytest.raises(ReplayError, match=rf"expected one with a snapshot \(\[{held}\]\), got 1$"):
        vss().resume(1)
    with pytest.raises(ReplayError, match=r"a snapshot \(none\)"):
        replace(vss(), snapshots={}).resume(0)


def test_another_version_of_the_physics_is_refused() -> None:
    with pytest.raises(ReplayError, match=r"physics: expected version \d+, got 1"):
        replace(vss(), physics=1).resume(0)


def test_learners_are_driven_by_the_caller() -> None:
    matches = Matches("VSS-v0", autoreset="disabled")
    recorder = Recorder(matches, snapshot_interval=0.1)
    matches.reset()
    recorder.begin()
    actions = np.full((1, 1, 2), 0.5, np.float32)
    for _ in range(10):
        recorder.add(matches.step(actions))
    replay = Replay.from_bytes(recorder.replay().to_bytes())
    assert replay.controllers["blue_0"] == "LEARN"
    resumed = replay.resume(4)
    for _ in range(6):
        resumed.step(actions)
    assert same(resumed.frame.rows[0], recorder.replay().rows[10])


@pytest.mark.parametrize(
    "task",
    [
        rsoccer.make_task("VSS-v0", max_steps=77, opponent="chase"),
        rsoccer.make_task("VSSSelfPlay-v0", reward_weights={"goal": 3.0}),
        rsoccer.make_task("VSSSelfPlay-v0", robot=RobotModel("vss_440rpm", mass=0.2)),
        rsoccer.make_task("SSLSelfPlay-v0", field=Field("ssl_b", width=5.0), n_blue=2),
    ],
    ids=["numbers", "weights", "robot", "field"],
)
def test_options_of_the_task_are_kept(task: Task) -> None:
    controllers = {robot: "zero" for robot in task.robots}
    replay = record_replay(task, controllers, seconds=0.1, snapshot_interval=1.0)
    resumed = Replay.from_bytes(replay.to_bytes()).resume(0)
    assert resumed.task == task
    assert resumed.task.config == task.config


def test_a_match_goes_on_with_the_simulator_and_the_senses_that_are_given() -> None:
    named: dict[str, Any] = {
        "simulator": "tests.simulators:Still",
        "sensing": "tests.simulators:Blind",
    }
    teams: dict[str, Controller] = {"blue": "chase", "yellow": "ou"}
    replay = record_replay("VSSSelfPlay-v0", teams, seconds=0.5, snapshot_interval=0.25, **named)
    resumed = replay.resume(10, **named)
    actions = np.zeros((1, 0, resumed.action_size), np.float32)
    for _ in range(5):
        resumed.step(actions)
    assert same(resumed.frame.rows[0], replay.rows[15])
    assert np.abs(replay.commands).max() > 1.0
    assert np.abs(replay.frame.robots.position - replay.frame.robots.position[0]).max() < 0.02
    assert not resumed.play.sensed.ball.position.any()
    with pytest.raises(ReplayError, match=r"resume: sensing: the module .* has no 'missing'"):
        replay.resume(10, sensing="tests.simulators:missing")


def test_a_resumed_match_has_the_senses_and_the_varied_numbers_of_the_recording() -> None:
    recorded = sensed_vss()
    read = Replay.from_bytes(recorded.to_bytes())
    assert len(recorded.episodes) > 2, "each of them draws numbers"
    assert recorded.sensed is not None
    for frame in list(read.snapshots)[:2]:
        matches = read.resume(frame)
        assert matches.sensing == Sensing("vsss")
        for later in range(frame + 1, len(recorded)):
            if recorded.starts[later]:
                matches.reset()
            else:
                matches.step(zeros(matches))
            assert same(matches.frame.rows[0], recorded.rows[later])
            assert same(matches.play.sensed.robots.position[0], recorded.sensed.robots[later])


def test_resumed_learners_have_the_history_of_the_recording() -> None:
    matches = Matches("VSS-v0", autoreset="disabled", sensing="vsss", history=3)
    recorder = Recorder(matches, snapshot_interval=0.1)
    matches.reset()
    recorder.begin()
    rng = np.random.default_rng(0)
    actions = rng.uniform(-1.0, 1.0, (10, 1, 1, 2)).astype(np.float32)
    shown = []
    for action in actions:
        outcome = matches.step(action)
        recorder.add(outcome)
        shown.append(outcome.observations)
    read = Replay.from_bytes(recorder.replay().to_bytes())
    assert read.history == 3
    resumed = read.resume(4)
    for action, observations in zip(actions[4:], shown[4:], strict=True):
        assert same(resumed.step(action).observations, observations)


def test_a_sensor_model_has_to_be_given_and_no_module_that_a_file_names_is_imported() -> None:
    teams: dict[str, Controller] = {"blue": "chase", "yellow": "ou"}
    text = "tests.simulators:Blind"
    replay = record_replay(
        "VSSSelfPlay-v0", teams, seconds=0.5, snapshot_interval=0.25, sensing=text
    )
    resumed = Replay.from_bytes(replay.to_bytes()).resume(10, sensing=text)
    for _ in range(5):
        resumed.step(zeros(resumed))
    assert same(resumed.frame.rows[0], replay.rows[15])
    assert resumed.sensing == text
    with pytest.raises(ReplayError, match=r"sensing: expected .*: it was 'tests.simulators:Blind'"):
        replay.resume(10)
    with pytest.raises(ReplayError, match=r"sensing: expected .*: it has no name"):
        replace(replay, sensing=None).resume(10)


def test_default_options_are_not_written() -> None:
    assert options_of(rsoccer.make_task("VSS-v0")) == {}
    assert options_of(rsoccer.make_task("VSS-v0", max_steps=5)) == {"max_steps": 5}
    assert options_of(Unregistered()) is None


def test_a_task_that_is_not_registered_has_to_be_given() -> None:
    task = Unregistered()
    replay = record_replay(task, {"all": "zero"}, seconds=0.1, snapshot_interval=1.0)
    replay = Replay.from_bytes(replay.to_bytes())
    with pytest.raises(ReplayError, match=r"task: expected .* as an argument"):
        replay.resume(0)
    assert replay.resume(0, task=task).task is task
    with pytest.raises(ReplayError, match=r"task: expected .* config, got another"):
        replay.resume(0, task=rsoccer.make_task("VSSSelfPlay-v0", n_blue=2))


def test_a_policy_without_a_name_has_to_be_given() -> None:
    task = rsoccer.make_task("VSSSelfPlay-v0")
    controllers: dict[str, Controller] = {"blue": Chase(task), "yellow": "zero"}
    replay = record_replay(task, controllers, seconds=0.1, snapshot_interval=1.0)
    assert replay.controllers["blue_0"] is None
    with pytest.raises(ReplayError, match=r"controllers: expected policies for \['blue_0'"):
        replay.resume(0)
    assert not replay.resume(0, controllers=controllers).agents
    with pytest.raises(ReplayError, match="resume: state"):
        replay.resume(0, controllers={"blue": LEARN, "yellow": "ou"})
    with pytest.raises(ReplayError, match=r"resume: .*unknown"):
        replay.resume(0, controllers={"blue": "unknown", "yellow": "zero"})


@pytest.mark.parametrize(
    "options",
    [
        {"unknown": 1},
        {"max_steps": -5},
        {"max_steps": "many"},
        {"reward_weights": 5},
        {"reward_weights": {"mapping": {"goal": None}}},
        {"field": {"model": "Field", "json": "{"}},
        {"field": {"model": "Field", "json": 5}},
        {"robot": {}},
        {"n_blue": 10**30},
    ],
    ids=str,
)
def test_wrong_options_are_refused(options: dict[str, object]) -> None:
    with pytest.raises(ReplayError, match=r"resume|options"):
        replace(vss(), options=options).resume(0)
