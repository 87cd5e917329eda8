import numpy as np
import pytest

import rsoccer
from rsoccer import Matches
from rsoccer.frame import Floats, Frame, length
from rsoccer.policies.base import Memory, Policy, PolicyInput
from rsoccer.policies.vectors import inverse
from rsoccer.policies.vss import driving
from rsoccer.policies.vss.driving import Driver, Orders
from rsoccer.rng import WorldRng
from rsoccer.tasks import VssSelfPlay

TASK = VssSelfPlay(n_blue=1, n_yellow=0)
ROBOT = TASK.config.robot


class Ordered(Policy):
    """Does as it is told, all the time."""

    observes = "view"

    def __init__(self, orders: Orders, pace: float = 1.0) -> None:
        self.orders, self.pace = orders, np.float32(pace)
        self.driver = Driver(ROBOT)

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        return {"slow": np.zeros(shape[:2], np.int64)}

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        assert inputs.view is not None
        return self.driver.drive(inputs.view.ego, self.orders, self.pace, memory["slow"], rng)


def orders(n: int, **given: float) -> Orders:
    """The same for the one robot of each world; what is not given is 0."""
    zeros = Orders(*(np.zeros((n, 1), np.float32) for _ in Orders._fields))
    return zeros._replace(**{k: np.full((n, 1), v, np.float32) for k, v in given.items()})


def driven(n: int, steps: int, pace: float = 1.0, **given: float) -> Matches:
    """A robot on its own that starts at the left, facing anywhere; the ball is out of its way."""
    policy = Ordered(orders(n, **given), pace)
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


def test_it_stops_where_it_is_ordered_to() -> None:
    ego = driven(12, 120, x=0.3, y=0.1).frame.blue
    assert np.abs(ego.position - [0.3, 0.1]).max() < 0.02
    assert np.abs(ego.velocity).max() < 0.05
    assert ego.heading[..., 0].min() < -0.5, "some came backwards"
    assert ego.heading[..., 0].max() > 0.5


def test_it_runs_through_a_place() -> None:
    ego = driven(12, 120, x=0.6, y=-0.2, run=1.0)
    speeds = []
    for _ in range(40):
        ego.step(np.zeros((12, 0, 2), np.float32))
        speeds.append(length(*np.moveaxis(ego.frame.blue.velocity, -1, 0)).max(axis=1))
    assert np.max(speeds, axis=0).min() > 0.3, "it does not come to rest"


def test_pace_limits_power() -> None:
    slow, fast = driven(4, 8, 0.4, x=0.4, y=-0.2), driven(4, 8, 1.0, x=0.4, y=-0.2)
    assert np.abs(slow.play.actions).max() == pytest.approx(0.4)
    assert np.abs(fast.play.actions).max() == pytest.approx(1.0)


def test_spin_turns_on_the_spot() -> None:
    ego = driven(4, 60, spin=-1.0, x=0.5).frame.blue
    assert ego.spin.max() < -0.8 * ROBOT.top_speed / (ROBOT.track / 2)
    assert np.abs(ego.position - [-0.4, -0.2]).max() < 0.02


def test_who_is_stuck_backs_off_and_tries_again() -> None:
    wall = TASK.config.field.half_length
    matches = driven(6, 60, x=-wall - 0.3, y=-0.5, run=1.0)
    backs = []
    for _ in range(60):
        matches.step(np.zeros((6, 0, 2), np.float32))
        backs.append(matches.state_dict()["blue_0.slow"][:, 0] < 0)
    share = np.mean(backs, axis=0)
    assert ((share > 0.0) & (share < 0.9)).all()


def test_who_waits_is_not_stuck() -> None:
    slow = driven(6, 200, x=-0.3, y=-0.2).state_dict()["blue_0.slow"]
    assert not slow.any()


def test_a_way_past_keeps_off() -> None:
    """Step by step towards where it leads, from all around, never nearer than told."""
    n = 16
    angle = np.linspace(0.0, 2.0 * np.pi, n, endpoint=False)
    ego, to = (
        np.stack([size * np.cos(way), size * np.sin(way)], axis=-1, dtype=np.float32)[:, None]
        for size, way in ((0.5, angle), (-0.4, angle + 0.1))
    )
    zero, radius = np.zeros((n, 1), np.float32), np.float32(0.1)
    nearest, bent = np.inf, np.zeros((n, 1), np.bool_)
    for _ in range(150):
        x, y = driving.past(ego, (to[..., 0], to[..., 1]), (zero, zero), radius, zero == 0.0)
        bent |= x != to[..., 0]
        way = np.stack([x, y], axis=-1) - ego
        per = inverse(length(way[..., 0], way[..., 1]), np.float32(0.01))
        ego = ego + way * per[..., None] * np.float32(0.01)
        nearest = min(nearest, float(length(ego[..., 0], ego[..., 1]).min()))
    assert bent.all(), "the thing is in the way of all"
    assert nearest > 0.095
    assert np.abs(ego - to).max() < 0.02
    straight, _ = driving.past(ego, (zero, zero), (zero, zero), radius, zero == 1.0)
    assert not straight.any(), "where it is not told to, it goes straight on"


def test_wheels_keep_the_curve_where_power_runs_out() -> None:
    forward = np.array([1.0, 0.2, -1.0], np.float32)
    turn = np.array([1.0, 0.3, 0.5], np.float32)
    left, right = np.moveaxis(driving.wheels(forward, turn), -1, 0)
    assert np.maximum(np.abs(left), np.abs(right)).tolist() == [1.0, 0.5, 1.0]
    assert (right - left) / (right + left) == pytest.approx(turn / forward, rel=1e-5)


@pytest.mark.parametrize("name", [name for name in rsoccer.list_tasks() if "SSL" in name])
def test_other_drives_are_refused(name: str) -> None:
    with pytest.raises(ValueError, match=f"ego drives two wheels, which the robots of {name}"):
        driving.expect_two_wheels(rsoccer.make_task(name), "ego")
