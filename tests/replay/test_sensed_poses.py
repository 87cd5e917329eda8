from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from rsoccer import Matches, Sensing
from rsoccer.controllers import Controller
from rsoccer.replay import Recorder, Replay, ReplayError, container, record_replay, sensed_poses
from rsoccer.replay.sensed_poses import HEADING_STEP, POSITION_STEP, SensedPoses
from tests.helpers import same, zeros
from tests.replay.conftest import RANDOMIZATION, sensed_ssl, sensed_vss, vss
from tests.simulators import Blind

CHASE: dict[str, Controller] = {"blue": "chase", "yellow": "ou"}


def poses(replay: Replay) -> SensedPoses:
    assert replay.sensed is not None
    return replay.sensed


def test_a_recording_has_what_the_robots_knew_of_each_frame() -> None:
    matches = Matches("VSS-v0", 2, autoreset="next_step", sensing="vsss", max_steps=12)
    recorder = Recorder(matches, 1)
    matches.reset(seed=3)
    recorder.begin()
    frames = [matches.play.sensed.take(np.array([1]))]
    for _ in range(20):
        recorder.add(matches.step(zeros(matches)))
        frames.append(matches.play.sensed.take(np.array([1])))
    found = poses(recorder.replay())
    assert len(recorder.replay().episodes) == 2
    assert same(found.ball, np.concatenate([frame.ball.position for frame in frames]))
    assert same(found.robots, np.concatenate([frame.robots.position for frame in frames]))
    assert same(found.headings, np.concatenate([frame.robots.heading for frame in frames]))


@pytest.mark.parametrize("recorded", [sensed_vss, sensed_ssl], ids=["VSSS", "SSL"])
def test_poses_come_back_within_half_a_step(recorded: Callable[[], Replay]) -> None:
    written = poses(recorded())
    content = recorded().to_bytes()
    read = poses(Replay.from_bytes(content))
    for name in ("ball", "robots"):
        off = np.abs(getattr(read, name) - getattr(written, name)).max()
        assert 0.0 < off <= 0.501 * POSITION_STEP
    # The length of a tracked heading is only about 1.
    length = np.linalg.norm(written.headings, axis=-1, keepdims=True)
    assert np.abs(read.headings - written.headings / length).max() <= 0.501 * HEADING_STEP
    assert Replay.from_bytes(content).to_bytes() == content


@pytest.mark.parametrize("recorded", [sensed_vss, sensed_ssl], ids=["VSSS", "SSL"])
def test_poses_differ_from_the_truth_by_what_robots_drive_in_the_delay(
    recorded: Callable[[], Replay],
) -> None:
    replay = recorded()
    robots = replay.frame.robots
    off = np.linalg.norm(poses(replay).robots - robots.position, axis=-1)[robots.absent == 0]
    assert 0.02 < off.max() < 0.5
    assert np.median(off) < 0.05


def test_poses_take_at_most_a_third_of_the_other_bytes() -> None:
    for replay in (sensed_vss(), sensed_ssl()):
        size = len(replay.to_bytes(snapshots=False))
        without = len(replace(replay, sensed=None).to_bytes(snapshots=False))
        assert without < size < 1.34 * without


def test_matches_without_senses_have_neither_poses_nor_conditions() -> None:
    header, sections = container.unpack(vss().to_bytes())
    assert header["columns"]["sensed"] == header["steps"]["sensed"] == []
    assert "sensed" not in sections
    assert not {"sensing", "randomization", "history"} & set(header)
    read = Replay.from_bytes(vss().to_bytes())
    assert (read.sensed, read.sensing, read.randomization) == (None, None, {})


def test_senses_and_varied_numbers_come_back() -> None:
    header, _ = container.unpack(sensed_vss().to_bytes())
    assert header["sensing"] == Sensing("vsss").to_json()
    assert header["randomization"]["robot.mass"] == [0.8, 1.2]
    read = Replay.from_bytes(sensed_vss().to_bytes())
    assert read.sensing == Sensing("vsss")
    assert set(read.randomization) == set(RANDOMIZATION)
    named = record_replay("VSSSelfPlay-v0", CHASE, seconds=0.1, sensing="tests.simulators:Blind")
    assert Replay.from_bytes(named.to_bytes()).sensing == "tests.simulators:Blind"
    unnamed = record_replay("VSSSelfPlay-v0", CHASE, seconds=0.1, sensing=Blind())
    read = Replay.from_bytes(unnamed.to_bytes())
    assert read.sensing is None
    assert not poses(read).ball.any()


def changed(key: str, value: object) -> bytes:
    """A file with a valid checksum and another value in its header."""
    header, sections = container.unpack(sensed_vss().to_bytes(snapshots=False))
    return container.pack({**header, key: value}, sections)


@pytest.mark.parametrize(
    ("key", "value", "message"),
    [
        ("sensing", 3, "sensing: expected a text, got int"),
        ("sensing", "vsss", "sensing: expected JSON of a Sensing or 'module:name', got 'vsss'"),
        ("sensing", ":", "sensing: expected JSON of a Sensing or 'module:name'"),
        ("sensing", "{}", "not a Sensing"),
        ("randomization", [], "randomization: expected an object, got list"),
        ("randomization", {"robot.mass": "heavy"}, r"randomization\['robot.mass'\]: expected"),
        ("randomization", {"robot.color": 1.0}, "randomization: expected one of .*'robot.color'"),
        ("randomization", {"robot.mass": 10**400}, "randomization"),
        ("history", 0, "history: expected 1 to 100000, got 0"),
        ("history", True, "history: expected 1 to 100000, got True"),
    ],
)
def test_wrong_conditions_are_refused_by_name(key: str, value: object, message: str) -> None:
    with pytest.raises(ReplayError, match=message):
        Replay.from_bytes(changed(key, value))


def test_poses_without_their_section_are_refused() -> None:
    header, sections = container.unpack(sensed_vss().to_bytes())
    del sections["sensed"]
    with pytest.raises(ReplayError, match="columns"):
        Replay.from_bytes(container.pack(header, sections))


def test_headings_turn_on_in_the_columns_of_a_file() -> None:
    angles = np.linspace(0.0, 12.0, 40)
    headings = np.stack([np.cos(angles), np.sin(angles)], axis=-1, dtype=np.float32)[:, None]
    nowhere = np.zeros((40, 2), np.float32)
    columns = SensedPoses(nowhere, nowhere[:, None], headings).columns()
    np.testing.assert_allclose(columns[:, -1], angles, atol=1e-5)
    np.testing.assert_allclose(SensedPoses.of_columns(columns).headings, headings, atol=1e-6)


def test_columns_have_names_and_steps() -> None:
    config = sensed_vss().config
    assert sensed_poses.names(config)[:5] == ("ball_x", "ball_y", "x_0", "y_0", "heading_0")
    assert len(sensed_poses.steps(config)) == 2 + 3 * config.n_robots
