"""Logs of the simulator."""

import numpy as np
import pytest

from rsoccer import RobotModel, Sensing
from rsoccer.identify import Program, program, record
from tests.identify.logs import ROBOT

STEP = Program(
    "omni",
    np.array([0.0, 0.3]),
    np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]),
    np.zeros(2),
    1.0,
    (),
)


@pytest.mark.parametrize("delay", [0.0, 0.031, 0.0725])
def test_poses_arrive_late_by_the_delay(delay: float) -> None:
    log = record(sensing=Sensing(delay=delay), excitation=STEP)
    track = log.poses[ROBOT]
    # x = a (t - 0.3 - delay)² / 2 while the robot gets faster.
    times = track.times[(track.positions[:, 0] > 0.01) & (track.positions[:, 0] < 0.09)]
    x = track.positions[(track.positions[:, 0] > 0.01) & (track.positions[:, 0] < 0.09), 0]
    started = times - np.sqrt(2.0 * x / RobotModel("ssl_generic").max_acceleration)
    assert len(started) > 5
    assert started == pytest.approx(0.3 + delay, abs=0.0015)


def test_logs_have_the_noise_and_the_rate_of_the_cameras() -> None:
    log = record(sensing=Sensing("rc2021", missing=0.0))
    track = log.poses[ROBOT]
    rest = track.positions[track.times < 0.2]
    assert len(rest) > 8
    assert 0.0005 < rest.std(axis=0).mean() < 0.003
    frames = np.diff(track.times)[1:]
    assert np.quantile(frames, [0.0, 0.9]) == pytest.approx(0.015)


def test_missing_detections_are_missing() -> None:
    whole = record(excitation=STEP, sensing=Sensing(robot_position_noise=0.001))
    some = record(excitation=STEP, sensing=Sensing(robot_position_noise=0.001, missing=0.3))
    assert 0.5 < len(some.poses[ROBOT]) / len(whole.poses[ROBOT]) < 0.9


def test_the_robot_kicks_and_the_ball_rolls() -> None:
    log = record()
    speeds = np.linalg.norm(np.diff(log.ball.positions, axis=0), axis=1) / np.diff(log.ball.times)
    assert sorted({float(kick) for kick in log.commands[ROBOT].kicks}) == [0.0, 1.5, 3.0, 6.0]
    assert 5.5 < np.quantile(speeds, 0.98) < 6.5
    rolled = record("vss_440rpm")
    assert not rolled.commands[ROBOT].kicks.any()
    assert np.ptp(rolled.ball.positions[:, 0]) > 1.0


def test_gains_and_seeds() -> None:
    slow = record(excitation=STEP, gains=(0.5, 1.0, 1.0)).poses[ROBOT].positions[-1, 0]
    fast = record(excitation=STEP).poses[ROBOT].positions[-1, 0]
    assert slow < 0.6 * fast
    noisy = Sensing("rc2021")
    first, again, other = (record(excitation=STEP, sensing=noisy, seed=seed) for seed in (1, 1, 2))
    assert (first.poses[ROBOT].positions == again.poses[ROBOT].positions).all()
    assert not np.array_equal(first.poses[ROBOT].positions, other.poses[ROBOT].positions)


def test_faulty_arguments_are_refused() -> None:
    with pytest.raises(ValueError, match="excitation: expected one for differential, got omni"):
        record("vss_440rpm", excitation=program("ssl_generic"))
    with pytest.raises(ValueError, match="gains: expected 3 numbers"):
        record(gains=(1.0,))
