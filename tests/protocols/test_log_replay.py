"""From replays to logs, and back."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from rsoccer import Field
from rsoccer.frame import Frame
from rsoccer.game import Command, Stage
from rsoccer.protocols import referee, tracker, vision
from rsoccer.protocols.errors import Code, MessageError
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.log_replay import log_to_replay
from rsoccer.protocols.logs import LogKind, LogWriter, read_log
from rsoccer.protocols.referee import RefereeStatus, Stamp, TeamStatus
from rsoccer.protocols.replay_log import replay_to_log
from rsoccer.replay import Replay, record_replay
from tests.protocols.matches import SIDES, SSL, layout, state


@cache
def match() -> Replay:
    """Part of a match with a referee, in which a kick-off and fouls happen."""
    return record_replay("SSLMatch-v0", {"all": "strike"}, seconds=8.0, names=("a", "b"))


def without(path: Path, kind: LogKind, target: Path) -> Path:
    """The log without messages of a kind."""
    with LogWriter(target) as log:
        for entry in read_log(path):
            if entry.kind != kind:
                log.write(*entry)
    return target


@pytest.mark.parametrize("positive", SIDES)
def test_a_match_survives(positive: bool, tmp_path: Path) -> None:
    replay = match()
    path = replay_to_log(replay, tmp_path / "a.log.gz", start=1.7e9, blue_on_positive_half=positive)
    found = log_to_replay(path)
    assert len(found) == len(replay)
    there = replay.frame.robots.absent == 0
    for name in ("position", "heading", "velocity", "angular_velocity"):
        now, then = getattr(found.frame.robots, name), getattr(replay.frame.robots, name)
        assert np.allclose(now[there], then[there], atol=1e-5), name
    for name in ("position", "velocity", "height", "vertical_velocity"):
        now, then = getattr(found.frame.ball, name), getattr(replay.frame.ball, name)
        assert np.allclose(now, then, atol=1e-5), name
    assert found.names == ("a", "b")
    assert found.config.field == replay.config.field or positive
    states, before = found.referee_states, replay.referee_states
    assert states is not None
    assert before is not None
    n_blue = replay.config.n_blue
    blue, yellow = slice(n_blue), slice(n_blue, None)
    for now, then in zip(states, before, strict=True):
        assert (now.command, now.stage, now.next_command) == (
            then.command,
            then.stage,
            then.next_command,
        )
        assert (now.score, now.yellow_cards, now.red_cards) == (
            then.score,
            then.yellow_cards,
            then.red_cards,
        )
        assert (now.in_play, now.kick) == (then.in_play, then.kick)
        for team in (blue, yellow):  # packets do not tell who may not touch the ball twice
            assert any(now.may_touch[team]) == any(then.may_touch[team])
        # A restart takes the referee a step that the packets do not tell.
        step = replay.config.time_step
        assert now.command_seconds == pytest.approx(then.command_seconds, abs=1.01 * step)
    assert len({state.command for state in before}) > 2
    assert {state.in_play for state in before if state.command is Command.NORMAL_START} == {
        False,
        True,
    }


def test_events_of_a_match_survive(tmp_path: Path) -> None:
    replay = match()
    found = log_to_replay(replay_to_log(replay, tmp_path / "a.log"))
    own = ("kick", "touch", "pass", "end")
    expected = [event for event in replay.events if event.kind not in own]
    assert list(found.events) == expected
    assert expected


def test_the_replay_can_be_kept(tmp_path: Path) -> None:
    found = log_to_replay(replay_to_log(match(), tmp_path / "a.log"))
    again = Replay.load(found.save(tmp_path / "a.rsr"))
    assert np.allclose(again.frame.robots.position, found.frame.robots.position, atol=2e-3)
    assert again.to_bytes() == Replay.from_bytes(again.to_bytes()).to_bytes()
    assert again.save_html(tmp_path / "a.html").stat().st_size > 10_000


def test_logs_have_an_index_on_demand(tmp_path: Path) -> None:
    path = replay_to_log(match(), tmp_path / "a.log", index=True)
    entries = list(read_log(path))
    assert len(entries) == 3 * len(match())
    assert {entry.kind for entry in entries} == {LogKind.VISION, LogKind.TRACKER, LogKind.REFEREE}
    assert path.read_bytes().endswith(b"INDEXED")


def test_cameras_alone_are_enough(tmp_path: Path) -> None:
    path = replay_to_log(match(), tmp_path / "a.log", blue_on_positive_half=True)
    found = log_to_replay(without(path, LogKind.TRACKER, tmp_path / "b.log"))
    replay = match()
    there = replay.frame.robots.absent == 0
    assert np.allclose(
        found.frame.robots.position[there], replay.frame.robots.position[there], atol=1e-5
    )
    step = replay.config.time_step
    moved = np.diff(replay.frame.ball.position, axis=0) / step
    assert np.allclose(found.frame.ball.velocity[1:], moved, atol=1e-3)
    assert np.abs(moved).max() > 1.0


def test_matches_of_vsss_have_no_referee_in_logs(tmp_path: Path) -> None:
    replay = record_replay("VSSSelfPlay-v0", {"all": "chase"}, seconds=1.0)
    path = replay_to_log(replay, tmp_path / "a.log")
    assert {entry.kind for entry in read_log(path)} == {LogKind.VISION, LogKind.TRACKER}


def test_the_side_of_a_log_without_a_referee_is_given(tmp_path: Path) -> None:
    replay = match()
    whole = replay_to_log(replay, tmp_path / "a.log", blue_on_positive_half=True)
    path = without(whole, LogKind.REFEREE, tmp_path / "b.log")
    expected = replay.frame.ball.position
    for given, sign in ((True, 1.0), (False, -1.0)):
        found = log_to_replay(path, blue_on_positive_half=given)
        assert np.allclose(sign * found.frame.ball.position, expected, atol=1e-5)
    # Packets of a referee count before what is given.
    for given in (True, False):
        found = log_to_replay(whole, blue_on_positive_half=given)
        assert np.allclose(found.frame.ball.position, expected, atol=1e-5)


def test_sides_change_at_half_time(tmp_path: Path) -> None:
    frame = state(worlds=1)
    with LogWriter(tmp_path / "a.log") as log:
        for i in range(8):
            made, time = layout(positive=i >= 4), i * 25_000_000
            status = RefereeStatus(Command.HALT, Stage.NORMAL_SECOND_HALF)
            reported = referee.to_packet(made, status, Stamp(0.0, 1, 0.0))
            log.write(time, LogKind.REFEREE, reported.SerializeToString())
            seen = tracker.to_packet(made, frame, frame_number=i, timestamp=0.0, uuid="a")
            log.write(time, LogKind.TRACKER, seen.SerializeToString())
    found = log_to_replay(tmp_path / "a.log", field="ssl_b")
    order = np.argsort([5, 0, 11]).tolist() + (3 + np.argsort([7, 3, 1, 15])).tolist()
    assert len(found) == 8
    for i in range(8):
        assert np.allclose(
            found.frame.robots.position[i], frame.robots.position[0, order], atol=1e-6
        )


def test_robots_that_are_not_seen_are_absent_and_goals_follow_from_scores(tmp_path: Path) -> None:
    made, frame = WireLayout(SSL), state(worlds=1)
    with LogWriter(tmp_path / "a.log") as log:
        for i in range(60):
            frame.robots.absent[0, 1] = float(i >= 20)
            seen = tracker.to_packet(made, frame, frame_number=i, timestamp=0.0, uuid="a")
            log.write(i * 25_000_000, LogKind.TRACKER, seen.SerializeToString())
            blue = TeamStatus("x", score=int(i >= 30))
            status = RefereeStatus(Command.STOP, Stage.NORMAL_FIRST_HALF, (blue, TeamStatus("y")))
            reported = referee.to_packet(made, status, Stamp(0.0, 1, 0.0))
            log.write(i * 25_000_000 + 1, LogKind.REFEREE, reported.SerializeToString())
    found = log_to_replay(tmp_path / "a.log", field=Field("ssl_a"))
    absent = found.frame.robots.absent[:, 1]
    assert absent[:39].max() == 0.0
    assert absent[41:].min() == 1.0
    assert found.score[-1].tolist() == [1, 0]
    assert [event.frame for event in found.events] == [30]
    assert found.config.field.name == "ssl_a"


def test_the_tracker_that_sent_most_is_followed_and_rare_robots_are_errors(tmp_path: Path) -> None:
    frame = state(worlds=1)
    many, few = layout(), WireLayout(SSL, (7, 8, 9), (2, 4, 6, 8))
    with LogWriter(tmp_path / "a.log") as log:
        for i in range(150):
            seen = tracker.to_packet(many, frame, frame_number=i, timestamp=0.0, uuid="many")
            if i == 10:
                seen.tracked_frame.robots[0].robot_id.id = 14
            log.write(i * 10_000_000, LogKind.TRACKER, seen.SerializeToString())
            if i % 2:
                other = tracker.to_packet(few, frame, frame_number=i, timestamp=0.0, uuid="few")
                log.write(i * 10_000_000, LogKind.TRACKER, other.SerializeToString())
        log.write(1_490_000_000, LogKind.VISION, b"\xff\xff")
    found = log_to_replay(tmp_path / "a.log", time_step=0.01)
    assert (found.config.n_blue, found.config.n_yellow) == (3, 4)
    assert len(found) == 150


def test_useless_logs_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.log"
    with LogWriter(path):
        pass
    with pytest.raises(MessageError, match=r"^log: expected tracked frames or detections") as error:
        log_to_replay(path)
    assert error.value.code is Code.BAD_LOG
    frame = state(worlds=1)
    with LogWriter(path) as log:
        for time in (0, 10**17):
            seen = vision.to_packet(layout(), frame, frame_number=0, t_capture=0.0, t_sent=0.0)
            log.write(time, LogKind.VISION, seen.SerializeToString())
    with pytest.raises(MessageError, match=r"^log: expected at most 21600 s of play, got 1e\+08"):
        log_to_replay(path)
    with pytest.raises(ValueError, match=r"^time_step: expected a positive number"):
        log_to_replay(path, time_step=0.0)
    with pytest.raises(ValueError, match=r"^start: expected 0 to"):
        replay_to_log(match(), path, start=-1.0)


def test_a_damaged_time_of_the_referee_adds_no_frames(tmp_path: Path) -> None:
    frame = state(worlds=1)
    status = RefereeStatus(Command.STOP, Stage.NORMAL_FIRST_HALF)
    reported = referee.to_packet(layout(), status, Stamp(0.0, 1, 0.0)).SerializeToString()
    with LogWriter(tmp_path / "a.log") as log:
        for i in range(8):
            time = i * 25_000_000
            log.write(time + 3600 * 10**9 if i == 4 else time, LogKind.REFEREE, reported)
            seen = tracker.to_packet(layout(), frame, frame_number=i, timestamp=0.0, uuid="a")
            log.write(time, LogKind.TRACKER, seen.SerializeToString())
    assert len(log_to_replay(tmp_path / "a.log", field="ssl_b")) == 8


def test_robots_of_both_teams_have_their_slots(tmp_path: Path) -> None:
    frame = Frame.empty(1, 3, 4)
    frame.robots.position[0, :, 0] = np.arange(7) / 10
    with LogWriter(tmp_path / "a.log") as log:
        seen = vision.to_packet(layout(), frame, frame_number=0, t_capture=0.0, t_sent=0.0)
        log.write(0, LogKind.VISION, seen.SerializeToString())
    found = log_to_replay(tmp_path / "a.log", field="ssl_b").frame
    assert np.allclose(found.blue.position[0, :, 0], [0.1, 0.0, 0.2])
    assert np.allclose(found.yellow.position[0, :, 0], [0.5, 0.4, 0.3, 0.6])


@pytest.mark.parametrize("name", ["match.log", "match.log.gz"])
def test_a_log_that_is_cut_off_ends_where_it_is(
    name: str, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    path = replay_to_log(match(), tmp_path / name)
    whole = log_to_replay(path)
    assert not caplog.messages
    data = path.read_bytes()
    path.write_bytes(data[: len(data) // 2])
    part = log_to_replay(path)
    assert 10 < len(part) < len(whole) - 10
    np.testing.assert_array_equal(part.frame.rows[:10], whole.frame.rows[:10])
    assert caplog.messages == [f"log: {path} is cut off; the replay ends where it does"]
