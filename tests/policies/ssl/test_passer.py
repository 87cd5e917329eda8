import numpy as np
import pytest

from rsoccer import policies
from rsoccer.arrays import Floats
from rsoccer.frame import Frame
from rsoccer.policies.base import PolicyInput
from rsoccer.policies.ssl.passer import DISTANCES, HELD_SECONDS, KICK_SECONDS
from rsoccer.policies.ssl.robot_control import DRIBBLER, KICK, TURN
from rsoccer.rng import WorldRng
from rsoccer.tasks import SslGoToBall, SslPassEndurance, SslPassEnduranceMulti
from rsoccer.view import Viewpoint
from tests.policies.ssl.ssl_policies import (
    expect_independent_worlds,
    expect_view_needed,
    mean_metric,
)

TASK = SslPassEnduranceMulti()
MOUTH = TASK.config.robot.front_distance + TASK.config.ball.radius
STEP = TASK.config.time_step
FORWARD, LEFT = 0, 1


class Scene:
    """Two robots at rest that face each other, of which the left one, blue_0, has the ball."""

    def __init__(self, distance: float = 2.4) -> None:
        self.policy, self.rng = policies.make_policy("passer", TASK), WorldRng.seeded(0, 1)
        self.memory = self.policy.new_memory((1, 2, 5), self.rng)
        self.frame = Frame.empty(1, 2, 0)
        self.frame.blue.position[0] = [(-distance / 2, 0.0), (distance / 2, 0.0)]
        self.frame.blue.heading[0] = [(1.0, 0.0), (-1.0, 0.0)]
        self.frame.blue.infrared[0, 0] = 1.0
        self.frame.ball.position[0] = (MOUTH - distance / 2, 0.0)

    def act(self) -> Floats:
        """Actions (robots, 5)."""
        viewpoint = Viewpoint(2, 0, [0, 1], ("blue",))
        view = viewpoint.new_view(1)
        viewpoint.fill(self.frame, view)
        inputs = PolicyInput((1, 2, 5), view, None)
        actions: Floats = self.policy.act(inputs, self.rng, self.memory)[0]
        return actions

    def steps_until_kick(self, most: int = 40) -> int:
        """Number of steps before the one that asks blue_0 for a kick."""
        return next(step for step in range(most) if self.act()[0, KICK] > 0.0)


@pytest.mark.parametrize("velocity_frame", ["field", "robot"])
def test_its_passes_are_received(velocity_frame: str) -> None:
    task = SslPassEndurance(velocity_frame=velocity_frame)
    assert mean_metric(task, "received", blue_0="passer", blue_1="receive") >= 0.96


def test_it_receives_passes() -> None:
    assert mean_metric(SslPassEndurance(), "received", blue="passer") >= 0.93


def test_two_passers_pass_back_and_forth() -> None:
    assert mean_metric(SslPassEnduranceMulti(max_steps=400), "passes", blue="passer") >= 5.0


@pytest.mark.parametrize(
    ("robot", "ball", "sensing"),
    [
        ("ssl_grsim", "grsim", "grsim"),
        ("ssl_erforce_simulator", "ssl_erforce_simulator", "erforce_simulator"),
        ("ssl_erforce_simulator", "ssl_erforce_simulator", "rc2021, command_delay=0.01"),
        (
            "ssl_erforce_simulator_rc2021",
            "ssl_erforce_simulator",
            "rc2021, command_delay=0.01",
        ),
    ],
)
@pytest.mark.parametrize("forecast", [0, 1])
def test_they_pass_as_robots_of_other_simulators(
    robot: str, ball: str, sensing: str, forecast: int
) -> None:
    task = SslPassEnduranceMulti(robot=robot, ball=ball, max_steps=400)
    senses = f"{sensing}, forecast={forecast}"
    assert mean_metric(task, "passes", senses, blue="passer") >= 5.0


def test_it_kicks_once_it_has_had_the_ball_for_a_moment() -> None:
    scene = Scene()
    assert scene.steps_until_kick() == round(HELD_SECONDS / STEP)
    scene.frame.blue.infrared[0, 0] = 0.0
    scene.frame.ball.position[0, 0] += 0.1
    assert scene.act()[0, KICK] == -1.0
    scene.frame.blue.infrared[0, 0] = 1.0
    scene.frame.ball.position[0, 0] -= 0.1
    assert scene.steps_until_kick() == round(HELD_SECONDS / STEP)


def test_a_kick_is_asked_for_as_long_as_kickers_need() -> None:
    scene = Scene()
    scene.steps_until_kick()
    scene.frame.blue.angular_velocity[0, 0] = 9.0  # no kick would begin now
    asked = 1
    while scene.act()[0, KICK] > 0.0:
        asked += 1
    assert asked == round(KICK_SECONDS / STEP)
    scene.frame.blue.angular_velocity[0, 0] = 0.0
    scene.act()
    scene.frame.blue.infrared[0, 0] = 0.0
    scene.frame.ball.position[0, 0] += 0.2  # the ball has gone
    assert scene.act()[0, KICK] == -1.0


@pytest.mark.parametrize("change", ["aim", "turning", "running teammate", "rolling ball"])
def test_it_does_not_kick_before_all_is_ready(change: str) -> None:
    scene, frame = Scene(), Scene().frame
    if change == "aim":
        frame.blue.position[0, 1, 1] = 0.2
    elif change == "turning":
        frame.blue.angular_velocity[0, 0] = 2.0
    elif change == "running teammate":
        frame.blue.velocity[0, 1, 0] = 0.5
    else:
        frame.ball.velocity[0, 0] = 0.5
    scene.frame = frame
    assert all(scene.act()[0, KICK] == -1.0 for _ in range(20))


def test_it_touches_the_ball_before_it_kicks() -> None:
    scene = Scene()
    scene.frame.ball.position[0, 0] += 0.015
    first, _ = scene.act()
    assert first[FORWARD] > 0.0
    assert first[DRIBBLER] == 1.0


@pytest.mark.parametrize("distance", [1.2, 4.0])
def test_the_receiver_goes_to_a_good_distance(distance: float) -> None:
    scene = Scene(distance)
    _, other = scene.act()
    toward = -1.0 if distance > DISTANCES[1] else 1.0
    assert other[FORWARD] * toward > 0.1
    assert other[LEFT] == pytest.approx(0.0, abs=1e-6)


def test_the_receiver_stays_where_passes_are_good() -> None:
    _, other = Scene(float(sum(DISTANCES)) / 2).act()
    assert np.abs(other[: TURN + 1]).max() < 1e-3


@pytest.mark.parametrize(("speed", "comes"), [(2.5, False), (0.6, True)])
def test_the_receiver_meets_a_ball_that_is_too_slow(speed: float, comes: bool) -> None:
    scene = Scene()
    scene.frame.blue.infrared[0, 0] = 0.0
    scene.frame.ball.position[0] = (-0.5, 0.0)
    scene.frame.ball.velocity[0] = (speed, 0.0)
    _, other = scene.act()
    assert (other[FORWARD] < -0.3) == comes


@pytest.mark.parametrize("side", [-0.035, 0.035])
def test_it_aims_by_the_ball_which_lies_beside_the_middle_of_its_mouth(side: float) -> None:
    scene = Scene()
    scene.frame.ball.position[0, 0] += 0.003
    scene.frame.ball.position[0, 1] = side
    assert scene.act()[0, TURN] * side < 0.0
    to_teammate = scene.frame.blue.position[0, 1] - scene.frame.ball.position[0]
    scene.frame.blue.heading[0, 0] = to_teammate / np.linalg.norm(to_teammate)
    assert abs(scene.act()[0, TURN]) < 1e-3
    scene.steps_until_kick()


def test_it_turns_about_the_ball() -> None:
    scene = Scene()
    scene.frame.blue.position[0, 1] = (-1.2, 2.4)
    # It turns to its left: the ball stays, and the robot goes to its right.
    action = scene.act()[0]
    assert action[TURN] > 0.1
    assert action[LEFT] < -0.05


@pytest.mark.parametrize("nearest", ["blue_0", "blue_1", "yellow_0"])
def test_to_a_loose_ball_goes_the_nearest_of_all_robots(nearest: str) -> None:
    policy, rng = policies.make_policy("passer", TASK), WorldRng.seeded(0, 1)
    frame = Frame.empty(1, 2, 1)
    frame.robots.position[0] = [(-0.3, 0.0), (0.3, 0.0), (0.0, 0.35)]
    frame.robots.position[0, ["blue_0", "blue_1", "yellow_0"].index(nearest)] *= 0.6
    frame.robots.heading[0] = [(1.0, 0.0), (-1.0, 0.0), (0.0, -1.0)]
    viewpoint = Viewpoint(2, 1, [0, 1], ("blue",))
    view = viewpoint.new_view(1)
    viewpoint.fill(frame, view)
    memory = policy.new_memory((1, 2, 5), rng)
    actions = policy.act(PolicyInput((1, 2, 5), view, None), rng, memory)[0]
    toward_ball = -(frame.blue.position[0] * actions[:, :TURN]).sum(axis=-1)
    assert (toward_ball > 0.0).tolist() == [nearest == "blue_0", nearest == "blue_1"]


def test_a_ball_that_its_teammate_dribbles_is_no_pass() -> None:
    scene = Scene()
    scene.frame.ball.velocity[0] = (0.6, 0.0)
    assert np.abs(scene.act()[1, :TURN]).max() < 1e-3


def test_without_its_teammate_it_stands() -> None:
    scene = Scene()
    scene.frame.blue.absent[0, 0] = 1.0
    assert np.abs(scene.act()[1, :TURN]).max() < 1e-6


@pytest.mark.parametrize("task", [SslPassEndurance(), SslPassEnduranceMulti()])
def test_worlds_are_independent(
    task: SslPassEndurance | SslPassEnduranceMulti,
) -> None:
    expect_independent_worlds("passer", task, 120)


def test_it_needs_a_teammate_and_a_view() -> None:
    expect_view_needed("passer", SslPassEndurance())
    with pytest.raises(ValueError, match="task: passer needs a teammate, got"):
        policies.make_policy("passer", SslGoToBall())
