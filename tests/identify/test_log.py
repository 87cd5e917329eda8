"""Rows of logs, and their files."""

from pathlib import Path

import numpy as np
import pytest

from rsoccer.identify import Log, read_log, record, write_log

POSE = {"time": 0.1, "robot": "a", "x": 1.0, "y": 2.0, "theta": 0.5}
COMMAND = {"time": 0.1, "robot": "a", "v_x": 1.0, "v_y": 0.0, "v_theta": 0.0}


def test_rows_say_what_was_seen_and_sent() -> None:
    rows: list[dict[str, object]] = [
        POSE | COMMAND | {"kick_v_x": 2.0},
        {"time": "0.2", "robot": " ball ", "x": "0.5", "y": "0", "theta": "", "v_x": None},
    ]
    log = Log.of_rows(rows)
    assert log.drive == "omni"
    assert log.poses["a"].positions.tolist() == [[1.0, 2.0]]
    assert log.poses["a"].headings.tolist() == [0.5]
    assert log.commands["a"].wheels.tolist() == [[1.0, 0.0, 0.0]]
    assert log.commands["a"].kicks.tolist() == [2.0]
    assert log.ball.times.tolist() == [0.2]
    assert np.isnan(log.ball.captured).all()


def test_repeated_poses_count_once() -> None:
    log = Log.of_rows([POSE, POSE | {"time": 0.2}, POSE | {"time": 0.3, "x": 1.1}])
    assert log.poses["a"].times.tolist() == [0.1, 0.3]


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        ([], "no poses"),
        ([COMMAND], "no poses"),
        ([{"robot": "a"}], "row 1: expected a time"),
        ([POSE | {"robot": ""}], "row 1: expected a time and the name"),
        ([POSE, POSE | {"x": "NaN"}], "row 2: x: expected a finite number, got 'NaN'"),
        ([POSE | {"y": "one"}], "row 1: y: expected a finite number"),
        ([POSE | {"theta": ""}], "row 1: a pose of a needs x, y, theta; no theta"),
        ([COMMAND | {"v_y": None}], "a command of a needs v_x, v_y, v_theta; no v_y"),
        ([POSE | {"time": 0.2}, POSE], "poses of a go back from 0.200000 to 0.100000"),
        ([COMMAND | {"time": 0.2}, COMMAND], "commands of a go back"),
        ([COMMAND, {"time": 1.0, "robot": "b", "left": 1.0, "right": 1.0}], "both omni and diff"),
        ([COMMAND | {"robot": "ball"}], "a command for the ball"),
    ],
)
def test_faulty_rows_are_refused(rows: list[dict[str, object]], message: str) -> None:
    if rows and message.startswith(("poses", "commands")):
        rows = [*rows, POSE | {"time": 1.0}]
    with pytest.raises(ValueError, match=message):
        Log.of_rows(rows)


def test_a_file_has_the_same_log(tmp_path: Path) -> None:
    log = record("vss_440rpm", sensing="rc2021")
    again = read_log(write_log(log, tmp_path / "log.csv"))
    for name in ("times", "wheels", "kicks"):
        old, new = getattr(log.commands["blue_0"], name), getattr(again.commands["blue_0"], name)
        assert (old == new).all()
    assert np.allclose(log.poses["blue_0"].positions, again.poses["blue_0"].positions, atol=1e-7)
    assert (log.ball.times == again.ball.times).all()
    assert len(log.ball) > 1000


def test_radio_and_cameras_may_have_a_file_each(tmp_path: Path) -> None:
    radio, cameras = tmp_path / "radio.csv", tmp_path / "cameras.csv"
    radio.write_text("time, robot, left, right\n0, a, 1, 2\n")
    cameras.write_text("\ufefftime,robot,x,y,theta,captured\n0.1,a,1,2,3,0.05\n")
    log = read_log(radio, cameras)
    assert log.commands["a"].wheels.tolist() == [[1.0, 2.0]]
    assert log.poses["a"].captured.tolist() == [0.05]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "no column time, robot"),
        ("time,x,y,theta\n", "no column robot"),
        ("time,robot,x,y,theta,speed\n", r"unknown columns \['speed'\]"),
        ("time,robot,x,theta\n", r"a pose needs the columns \['x', 'y'\]; no \['y'\]"),
        ("time,robot,v_x,v_y\n", "command of omni needs"),
        ("time,robot,x,y,theta,x, y\n", r"expected each column once, got \['x', 'y'\] twice"),
        ("time,robot\n0,a\n", "neither poses"),
        ("time,robot,x,y,theta\n0,a,1,2,3,4\n", "line 2: more cells than columns"),
        ("time,robot,x,y,theta\n0,a,1,2,\n", "line 2: a pose of a needs"),
    ],
)
def test_faulty_files_are_refused(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "log.csv"
    path.write_text(text)
    with pytest.raises(ValueError, match=message):
        read_log(path)


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="does not exist"):
        read_log(tmp_path / "gone.csv")
    with pytest.raises(ValueError, match="cannot read"):
        read_log(tmp_path)
    with pytest.raises(ValueError, match="expected one file"):
        read_log()


def test_a_body_at_rest_is_seen_in_every_frame() -> None:
    """Cameras without noise repeat its pose, and so do loops that are faster than a camera."""
    rows = []
    for tick in range(600):  # a loop at 200 Hz, a camera at 50 Hz
        frame = tick // 4
        x = 0.02 * max(frame - 100, 0)
        rows.append({"time": tick / 200, "robot": "ball", "x": x, "y": 0.0})
        rows.append({"time": tick / 200, "robot": "a", "x": 0.01 * frame, "y": 0.0, "theta": 0.0})
    log = Log.of_rows(rows)
    np.testing.assert_allclose(np.diff(log.poses["a"].times), 0.02)
    assert len(log.ball) == pytest.approx(150, abs=2)
    np.testing.assert_allclose(np.diff(log.ball.times), 0.02, atol=0.006)
    assert (log.ball.positions[:99, 0] == 0.0).all()
