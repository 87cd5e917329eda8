"""Frames of the simulator's cameras, as software of teams gets them."""

import numpy as np
import pytest

from rsoccer import Frame, Sensing, SimConfig, Simulator
from rsoccer.arrays import Floats
from tests.helpers import same

TICK = 0.005


def simulator(sensing: Sensing | None, worlds: int = 1) -> tuple[Simulator, Floats]:
    config = SimConfig("ssl_b", 3, 3, time_step=TICK, tick=TICK, sensing=sensing)
    made = Simulator(config, worlds)
    frame = Frame.empty(worlds, 3, 3)
    frame.robots.position[..., 0] = [-3.0, -2.0, -1.0, 1.0, 2.0, 3.0]
    frame.robots.heading[..., 0] = 1.0
    frame.robots.absent[:, 5] = 1.0
    frame.ball.position[:] = [0.0, 1.0]
    frame.ball.velocity[:] = [1.0, 0.0]
    made.place(np.ones(worlds, np.bool_), frame.rows, frame.rows)
    return made, frame.rows


def step(made: Simulator, rows: Floats) -> None:
    config = made.config
    commands = np.zeros((made.worlds, config.n_robots, len(config.command_columns)), np.float32)
    made.step(commands, rows)


def test_exact_cameras_see_the_state_after_the_delay() -> None:
    made, rows = simulator(Sensing(delay=3 * TICK))
    states: list[Floats] = []
    arrived = 0
    for tick in range(1, 30):
        step(made, rows)
        states.append(rows.copy())
        for seconds, balls, robots in made.camera_frames():
            arrived += 1
            assert tick * TICK - seconds == pytest.approx(3 * TICK, abs=1e-6)
            then = Frame(states[round(seconds / TICK) - 1], 3, 3)
            assert balls.shape == (1, 4)
            np.testing.assert_allclose(balls[0, 1:3], then.ball.position[0], atol=1e-5)
            assert robots[:, 1].tolist() == [0, 1, 2, 3, 4], "an absent robot is not seen"
            np.testing.assert_allclose(robots[:, 2:4], then.robots.position[0, :5], atol=1e-5)
            np.testing.assert_allclose(robots[:, 4:6], then.robots.heading[0, :5], atol=1e-5)
    assert arrived >= 25


def test_each_camera_reports_its_part_and_what_it_misses() -> None:
    sensing = Sensing("none", frame_rate=200.0, cameras_along=2, camera_overlap=3.0)
    made, rows = simulator(sensing)
    step(made, rows)
    step(made, rows)
    (frame,) = made.camera_frames()[-1:]
    cameras = {robot: set() for robot in range(5)}  # type: dict[int, set[int]]
    for camera, robot in frame[2][:, :2].astype(int).tolist():
        cameras[robot].add(camera)
    assert cameras == {0: {0}, 1: {0}, 2: {0, 1}, 3: {0, 1}, 4: {1}}
    assert frame[1][:, 0].tolist() == [0.0, 1.0]
    blind, rows = simulator(Sensing(frame_rate=200.0, missing_balls=1.0, missing_robots=1.0))
    step(blind, rows)
    step(blind, rows)
    (frame,) = blind.camera_frames()[-1:]
    assert (frame[1].shape, frame[2].shape) == ((0, 4), (0, 6))


def test_worlds_have_frames_of_their_own() -> None:
    made, rows = simulator(Sensing("realistic"), 2)
    made.begin_senses(np.ones(2, np.bool_), np.array([1, 2], np.uint64))
    seen = []
    for _ in range(40):
        step(made, rows)
        seen.append([made.camera_frames(world) for world in (0, 1)])
    times = [[frame[0] for both in seen for frame in both[world]] for world in (0, 1)]
    assert min(map(len, times)) > 5
    assert times[0] != times[1]


def test_a_restored_simulator_has_the_same_frames() -> None:
    made, rows = simulator(Sensing("realistic"), 2)
    made.begin_senses(np.ones(2, np.bool_), np.array([1, 2], np.uint64))
    while not made.camera_frames(1):
        step(made, rows)
    for _ in range(3):  # with frames that have just arrived, then with others on their way
        restored = Simulator(made.config, 2)
        restored.restore(made.snapshot())
        compared, cameras = 0, set()
        for _ in range(20):
            for world in (0, 1):
                expected, frames = made.camera_frames(world), restored.camera_frames(world)
                assert [frame[0] for frame in frames] == [frame[0] for frame in expected]
                for theirs, ours in zip(frames, expected, strict=True):
                    assert same(theirs[1], ours[1])
                    assert same(theirs[2], ours[2])
                    compared += 1
                    cameras |= set(ours[2][:, 0].tolist())
            for each in (made, restored):
                step(each, rows)
        assert compared > 10
        assert cameras == {0.0, 1.0}


def test_without_senses_there_are_no_frames() -> None:
    made, rows = simulator(None)
    step(made, rows)
    assert made.camera_frames() == []


@pytest.mark.parametrize("world", [-1, 1])
def test_a_world_that_does_not_exist_is_named(world: int) -> None:
    made, _ = simulator(Sensing("rc2021"))
    with pytest.raises(ValueError, match=f"world must be 0 to 0, got {world}"):
        made.camera_frames(world)
