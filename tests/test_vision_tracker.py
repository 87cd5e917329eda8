"""The tracker of the senses, for detections of other cameras."""

from __future__ import annotations

import numpy as np
import pytest

from rsoccer import Sensing, SimConfig, Simulator
from rsoccer._core import ROBOT_COLUMNS, VisionTracker
from rsoccer.frame import Frame

CONFIG = SimConfig("ssl_b", 1, 1)
NOBODY = np.zeros((0, 5), np.float32)
NO_BALL = np.zeros((0, 2), np.float32)


def read(tracker: VisionTracker) -> Frame:
    row = np.full((1, CONFIG.row_size), np.nan, np.float32)
    tracker.read(row)
    assert np.isfinite(row).all()
    return Frame(row, 1, 1)


def seen(slot: int, x: float, angle: float = 0.0) -> np.ndarray:
    return np.array([[slot, x, 0.5, np.cos(angle), np.sin(angle)]], np.float32)


def test_velocities_of_noisy_detections_are_estimated() -> None:
    rng = np.random.default_rng(0)
    tracker = VisionTracker(CONFIG)
    for frame in range(120):
        time = frame / 60
        ball = np.array([[0.5 * time, -time]]) + rng.normal(0.0, 0.0005, (1, 2))
        assert tracker.take(time, ball.astype(np.float32), seen(1, time, 2.0 * time))
    found = read(tracker)
    np.testing.assert_allclose(found.ball.velocity[0], [0.5, -1.0], atol=0.1)
    np.testing.assert_allclose(found.robots.velocity[0, 1], [1.0, 0.0], atol=0.05)
    assert found.robots.angular_velocity[0, 1] == pytest.approx(2.0, abs=0.1)
    assert found.robots.absent[0].tolist() == [1.0, 0.0]
    assert tracker.robots_in_sight == [1]
    assert tracker.has_ball
    assert tracker.time == pytest.approx(119 / 60)
    assert repr(tracker).startswith("VisionTracker(2 robots, time=1.98")


def test_a_ghost_far_from_the_ball_is_ignored() -> None:
    tracker = VisionTracker(CONFIG)
    for frame in range(60):
        ghost = [[3.0, 2.0]] if frame % 10 == 5 else []
        balls = np.array([*ghost, [0.1, 0.2]], np.float32)
        tracker.take(frame / 60, balls, NOBODY)
    np.testing.assert_allclose(read(tracker).ball.position[0], [0.1, 0.2], atol=1e-4)


def test_a_second_camera_at_another_place_gives_bodies_no_velocity() -> None:
    tracker = VisionTracker(CONFIG)
    for frame in range(60):
        for camera in (0, 1):
            if (frame % 7, camera) == (3, 0):
                continue
            x, time = 0.03 * camera, frame / 60 + 0.003 * camera
            ball = np.array([[x + 1.0, 0.2]], np.float32)
            assert tracker.take(time, ball, seen(1, x), camera=camera)
            found = read(tracker)
            np.testing.assert_allclose(found.ball.velocity[0], 0.0, atol=0.02)
            np.testing.assert_allclose(found.robots.velocity[0, 1], 0.0, atol=0.02)
    with pytest.raises(ValueError, match="camera must be from 0 to 255, got 256"):
        tracker.take(2.0, NO_BALL, NOBODY, camera=256)


def test_a_ball_that_no_camera_sees_moves_with_the_robot_whose_beam_it_cuts() -> None:
    mouth = CONFIG.robots[0].front_distance + CONFIG.ball.radius
    last = {}
    for cut in (None, (), (1,), (0,)):
        tracker = VisionTracker(CONFIG)
        for frame in range(90):
            x = max(0.0, frame / 60 - 0.25)
            ball = NO_BALL if frame > 15 else np.array([[mouth + 0.005, 0.5]], np.float32)
            tracker.take(frame / 60, ball, seen(0, x), None if cut is None else list(cut))
        found = read(tracker)
        last[cut] = float(found.ball.position[0, 0] - found.robots.position[0, 0, 0])
    assert last.pop((0,)) == pytest.approx(mouth, abs=0.01)
    assert max(last.values()) < -1.0, "without a report it stays where it was seen"


def test_reports_of_robots_that_do_not_exist_are_refused() -> None:
    tracker = VisionTracker(CONFIG)
    with pytest.raises(ValueError, match="cut must have indices from 0 to 1, got 2"):
        tracker.take(0.0, NO_BALL, NOBODY, [2])
    with pytest.raises(OverflowError):
        tracker.take(0.0, NO_BALL, NOBODY, [-1])
    assert tracker.time is None


def test_drives_carry_robots_whose_commands_are_known() -> None:
    """Saturated commands that change, and noise of 2 mm and 0.02 rad."""
    config = SimConfig("ssl_b", 1, 0)
    simulator, rng = Simulator(config), np.random.default_rng(0)
    row = np.empty((1, config.row_size), np.float32)
    simulator.read(row)
    noise = Sensing(robot_position_noise=0.002, heading_noise=0.02, frame_rate=40.0)
    trackers = [VisionTracker(config.with_sensing(noise)) for _ in range(2)]
    errors: list[list[float]] = [[], []]
    frame = Frame(row, 1, 0)
    for step in range(160):
        commands = np.zeros((1, 1, 6), np.float32)
        phase = step // 8 % 4
        commands[0, 0, :3] = [[9, 0, 30], [-9, 9, 0], [0, -9, -30], [0, 0, 0]][phase]
        assert trackers[1].send(step / 40, commands[0], [0])
        simulator.step(commands, row)
        place, angle = frame.robots.position[0, 0], np.arctan2(*frame.robots.heading[0, 0, ::-1])
        angle += rng.normal(0.0, 0.02)
        pose = [0.0, *(place + rng.normal(0.0, 0.002, 2)), np.cos(angle), np.sin(angle)]
        for tracker, found in zip(trackers, errors, strict=True):
            tracker.take((step + 1) / 40, NO_BALL, np.array([pose], np.float32))
            known = np.empty_like(row)
            tracker.read(known)
            robots = Frame(known, 1, 0).robots
            found.append(float(robots.angular_velocity[0, 0] - frame.robots.angular_velocity[0, 0]))
    without, given = (float(np.std(found)) for found in errors)
    assert given < 0.5 * without


def test_wrong_commands_are_refused() -> None:
    tracker = VisionTracker(CONFIG)
    commands = np.zeros((2, 6), np.float32)
    with pytest.raises(ValueError, match="robots must have indices from 0 to 1, got 2"):
        tracker.send(0.0, commands, [2])
    with pytest.raises(ValueError, match="time must be finite"):
        tracker.send(np.inf, commands, [0])
    with pytest.raises(ValueError, match="commands must be finite"):
        tracker.send(0.0, commands + np.nan, [0])
    with pytest.raises(ValueError, match="commands must have shape"):
        tracker.send(0.0, commands[:1], [0])
    assert tracker.send(1.0, commands, [0])
    assert not tracker.send(0.5, commands, [0]), "older than the last ones"
    assert tracker.send(1.0, commands, [0, 1])


def test_a_frame_of_the_past_is_refused() -> None:
    tracker = VisionTracker(CONFIG)
    assert tracker.take(1.0, NO_BALL, seen(0, 0.3))
    assert not tracker.take(0.9, NO_BALL, seen(0, 0.9))
    assert read(tracker).robots.position[0, 0, 0] == pytest.approx(0.3)
    assert not tracker.has_ball


@pytest.mark.parametrize(
    ("time", "balls", "robots", "message"),
    [
        (np.nan, NO_BALL, NOBODY, "time must be finite"),
        (0.0, np.full((1, 2), np.inf, np.float32), NOBODY, "balls must be finite"),
        (0.0, np.zeros((1, 3), np.float32), NOBODY, "balls must have shape"),
        (0.0, NO_BALL, np.zeros(5, np.float32), "robots must have 2 axes"),
        (0.0, NO_BALL, seen(2, 0.0), "indices from 0 to 1, got 2"),
        (0.0, NO_BALL, seen(0, 0.0) * np.array([1, 1, 1, 0, 0], np.float32), "length above 0"),
    ],
)
def test_wrong_detections_are_refused(
    time: float, balls: np.ndarray, robots: np.ndarray, message: str
) -> None:
    tracker = VisionTracker(CONFIG)
    with pytest.raises(ValueError, match=message):
        tracker.take(time, balls, robots)
    assert tracker.time is None


def test_arrays_of_other_types_are_refused() -> None:
    tracker = VisionTracker(CONFIG)
    with pytest.raises(TypeError, match="balls must be an array of float32"):
        tracker.take(0.0, np.zeros((1, 2)), NOBODY)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="out must have shape"):
        tracker.read(np.zeros((1, len(ROBOT_COLUMNS)), np.float32))


@pytest.mark.parametrize("length", [1e-2, 1.0, 30.0, 1e20, 3e38])
def test_headings_may_have_any_length_above_0(length: float) -> None:
    tracker = VisionTracker(CONFIG)
    long = seen(0, 0.0, 0.5)
    long[0, 3:] *= np.float32(length)
    tracker.take(0.0, NO_BALL, long)
    found = read(tracker).robots.heading[0, 0]
    np.testing.assert_allclose(found, [np.cos(0.5), np.sin(0.5)], atol=1e-5)


def test_bodies_do_not_go_on_for_ever_over_a_gap() -> None:
    tracker = VisionTracker(CONFIG)
    for frame in range(60):
        tracker.take(frame / 60, np.array([[frame / 60, 1.0]], np.float32), seen(0, frame / 60))
    tracker.take(11.0, NO_BALL, NOBODY)
    found = read(tracker)
    assert found.ball.position[0, 0] == pytest.approx(1.98, abs=0.02)
    assert found.robots.position[0, 0, 0] == pytest.approx(1.98, abs=0.02)
    assert not found.ball.velocity.any()
