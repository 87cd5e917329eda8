import numpy as np
import pytest

import rsoccer
from rsoccer import Matches
from rsoccer.arrays import Floats
from rsoccer.frame import Frame
from rsoccer.policies.base import Memory, Policy, PolicyInput
from rsoccer.policies.vss.drive_control import (
    DriveController,
    DriveTarget,
    require_differential_drive,
    wheel_speeds,
)
from rsoccer.rng import WorldRng
from rsoccer.tasks import VssSelfPlay
from rsoccer.vectors import norm

TASK = VssSelfPlay(n_blue=1, n_yellow=0)
ROBOT = TASK.config.robot


class FixedTarget(Policy):
    """Drives to the same target all the time."""

    observes = "view"

    def __init__(self, target: DriveTarget, max_wheel_speed: float = 1.0) -> None:
        self.target, self.max_wheel_speed = target, np.float32(max_wheel_speed)
        self.controller = DriveController(ROBOT)

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        return {"slow_steps": np.zeros(shape[:2], np.int64)}

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        assert inputs.view is not None
        ego, slow_steps = inputs.view.ego, memory["slow_steps"]
        return self.controller.drive(ego, self.target, self.max_wheel_speed, slow_steps, rng)


def drive_target(n: int, **fields: float) -> DriveTarget:
    """The same target for the one robot of each world; other fields are 0."""
    zeros = DriveTarget(*(np.zeros((n, 1), np.float32) for _ in DriveTarget._fields))
    return zeros._replace(**{k: np.full((n, 1), v, np.float32) for k, v in fields.items()})


def driven(n: int, steps: int, max_wheel_speed: float = 1.0, **fields: float) -> Matches:
    """One robot that starts at the left with any heading; the ball is not in its path."""
    policy = FixedTarget(drive_target(n, **fields), max_wheel_speed)
    matches = Matches(TASK, n, controllers={"blue": policy}, autoreset="disabled")
    frame = Frame.empty(n, 1, 0)
    frame.ball.position[:] = [0.0, 0.6]
    frame.blue.position[:] = [-0.4, -0.2]
    angle = np.linspace(0.0, 2.0 * np.pi, n, endpoint=False)
    frame.blue.heading[:, 0] = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    matches.reset(rows=frame.rows)
    for _ in range(steps):
        matches.step(np.zeros((n, 0, 2), np.float32))
    return matches


def test_it_stops_at_the_target() -> None:
    ego = driven(12, 120, x=0.3, y=0.1).frame.blue
    assert np.abs(ego.position - [0.3, 0.1]).max() < 0.02
    assert np.abs(ego.velocity).max() < 0.05
    assert ego.heading[..., 0].min() < -0.5, "some came backwards"
    assert ego.heading[..., 0].max() > 0.5


def test_it_drives_through_a_target() -> None:
    matches = driven(12, 50, x=0.6, y=-0.2, through=1.0)
    speeds = []
    for _ in range(40):
        matches.step(np.zeros((12, 0, 2), np.float32))
        speeds.append(norm(*np.moveaxis(matches.frame.blue.velocity, -1, 0)).max(axis=1))
    assert np.max(speeds, axis=0).min() > 0.3, "it does not come to rest"


def test_wheel_speed_is_limited() -> None:
    slow, fast = driven(4, 8, 0.4, x=0.4, y=-0.2), driven(4, 8, 1.0, x=0.4, y=-0.2)
    assert np.abs(slow.play.actions).max() == pytest.approx(0.4)
    assert np.abs(fast.play.actions).max() == pytest.approx(1.0)


def test_a_turn_is_on_the_spot() -> None:
    ego = driven(4, 60, turn=-1.0, x=0.5).frame.blue
    assert ego.angular_velocity.max() < -0.8 * ROBOT.top_speed / (ROBOT.track_width / 2)
    assert np.abs(ego.position - [-0.4, -0.2]).max() < 0.02


def test_a_stuck_robot_backs_off_and_tries_again() -> None:
    wall = TASK.config.field.half_length
    matches = driven(6, 60, x=-wall - 0.3, y=-0.5, through=1.0)
    backing = []
    for _ in range(60):
        matches.step(np.zeros((6, 0, 2), np.float32))
        backing.append(matches.state_dict()["blue_0.slow_steps"][:, 0] < 0)
    share = np.mean(backing, axis=0)
    assert ((share > 0.0) & (share < 0.9)).all()


def test_a_waiting_robot_is_not_stuck() -> None:
    slow_steps = driven(6, 200, x=-0.3, y=-0.2).state_dict()["blue_0.slow_steps"]
    assert not slow_steps.any()


def test_scaled_wheel_speeds_keep_the_curvature() -> None:
    forward = np.array([1.0, 0.2, -1.0], np.float32)
    turn = np.array([1.0, 0.3, 0.5], np.float32)
    left, right = np.moveaxis(wheel_speeds(forward, turn), -1, 0)
    assert np.maximum(np.abs(left), np.abs(right)).tolist() == [1.0, 0.5, 1.0]
    assert (right - left) / (right + left) == pytest.approx(turn / forward, rel=1e-5)


@pytest.mark.parametrize("name", [name for name in rsoccer.list_tasks() if "SSL" in name])
def test_other_drives_are_refused(name: str) -> None:
    with pytest.raises(
        ValueError, match=f"task: chase needs robots with a differential drive.* got {name}"
    ):
        require_differential_drive("chase", rsoccer.make_task(name))
