import math
from collections.abc import Iterator

import numpy as np
import pytest

import rsoccer
from rsoccer import LEARN, CommandPolicy, Matches, Policy, Task, make_task
from rsoccer.arrays import Floats
from rsoccer.human.controls import Controls
from rsoccer.human.driver import (
    SLOW,
    TURN,
    WHEEL_TURN,
    Driver,
    HumanPolicy,
    human_controllers,
)
from rsoccer.human.teams import team_controllers
from rsoccer.policies.base import Memory, PolicyInput
from rsoccer.rng import WorldRng

EAST, NORTH = (1.0, 0.0), (0.0, 1.0)
DIAGONAL = 1.0 / math.sqrt(2.0)

VSS_CASES = [
    (Controls(), [0.0, 0.0]),
    (Controls(up=1.0), [1.0, 1.0]),
    (Controls(up=-1.0), [-1.0, -1.0]),
    (Controls(up=1.0, slow=True), [SLOW, SLOW]),
    (Controls(right=1.0), [WHEEL_TURN, -WHEEL_TURN]),
    (Controls(right=-1.0), [-WHEEL_TURN, WHEEL_TURN]),
    (Controls(turn=1.0), [-WHEEL_TURN, WHEEL_TURN]),
    (Controls(up=1.0, right=1.0), [1.0, (1.0 - WHEEL_TURN) / (1.0 + WHEEL_TURN)]),
    (Controls(kick=1.0, dribble=True), [0.0, 0.0]),
]
VSS_DISCRETE_CASES = [
    (Controls(), [0.0, 0.0]),
    (Controls(up=1.0), [1.0, 1.0]),
    (Controls(up=-1.0, slow=True), [-1.0, -1.0]),
    (Controls(right=-1.0), [-1.0, 1.0]),
    (Controls(turn=-1.0), [1.0, -1.0]),
    (Controls(up=1.0, right=-1.0), [0.5, 1.0]),
    (Controls(up=-1.0, right=-1.0), [-1.0, -0.5]),
]
SSL_CASES = [
    (Controls(), [0.0, 0.0, 0.0, -1.0, -1.0]),
    (Controls(up=1.0), [0.0, 1.0, 0.0, -1.0, -1.0]),
    (Controls(right=1.0), [1.0, 0.0, 0.0, -1.0, -1.0]),
    (Controls(right=-1.0, up=1.0), [-DIAGONAL, DIAGONAL, 0.0, -1.0, -1.0]),
    (Controls(right=1.0, slow=True), [SLOW, 0.0, 0.0, -1.0, -1.0]),
    (Controls(turn=1.0), [0.0, 0.0, TURN, -1.0, -1.0]),
    (Controls(kick=0.5), [0.0, 0.0, 0.0, 0.5, -1.0]),
    (Controls(kick=1.0, chip=True, dribble=True), [0.0, 0.0, 0.0, 1.0, 1.0]),
]
SSL_DISCRETE_CASES = [
    (Controls(), [0.0, 0.0, 0.0, -1.0, 1.0]),
    (Controls(up=1.0), [0.0, 1.0, 0.0, -1.0, 1.0]),
    (Controls(right=-1.0, up=1.0, slow=True), [-1.0, 1.0, 0.0, -1.0, 1.0]),
    (Controls(turn=-1.0), [0.0, 0.0, -0.5, -1.0, 1.0]),
    (Controls(up=1.0, kick=1.0, dribble=True), [0.0, 0.0, 0.0, 1.0, -1.0]),
    (Controls(kick=0.5), [0.0, 0.0, 0.0, 1.0, -1.0]),
]


def cases() -> Iterator[tuple[str, bool, Controls, list[float]]]:
    for name in rsoccer.list_tasks():
        size = make_task(name).action_size
        for discrete in (False, True):
            ssl = SSL_DISCRETE_CASES if discrete else SSL_CASES
            vss = VSS_DISCRETE_CASES if discrete else VSS_CASES
            for controls, action in vss if size == 2 else ssl:
                chip = [1.0 if controls.chip and not discrete else -1.0][: size - len(action)]
                yield name, discrete, controls, action + chip


@pytest.mark.parametrize(("name", "discrete", "controls", "expected"), list(cases()))
def test_controls_are_actions_in_every_task(
    name: str, discrete: bool, controls: Controls, expected: list[float]
) -> None:
    task = make_task(name, discrete=discrete)
    driver = Driver(task)
    driver.controls = controls
    action = driver.action(EAST)
    assert action.dtype == np.float32
    np.testing.assert_allclose(action, expected, atol=1e-6)
    if task.action_table is not None:
        assert action.tolist() in task.action_table.tolist()


@pytest.mark.parametrize("velocity_frame", ["field", "robot"])
@pytest.mark.parametrize("frame", ["field", "robot"])
@pytest.mark.parametrize("robot", ["blue_1", "yellow_1"])
@pytest.mark.parametrize("controls", [Controls(up=1.0), Controls(right=0.6, up=-0.3)])
def test_an_ssl_robot_moves_where_the_controls_point(
    velocity_frame: str, frame: str, robot: str, controls: Controls
) -> None:
    task = make_task("SSLSelfPlay-v0", velocity_frame=velocity_frame)
    driver = Driver(task, robot)
    if frame == "robot":
        driver.change_frame()
    assert driver.frame == frame
    driver.controls = controls
    team = team_controllers(task, robot)
    matches = Matches(task, controllers=human_controllers(driver, {**team, "all": "zero"}))
    matches.reset(rows=rows_with(task, driver.index, 0.7))
    for _ in range(6):
        matches.step(np.zeros((1, 0, 5), np.float32))
    velocity = matches.frame.robots.velocity[0, driver.index]
    wanted = np.array([controls.right, controls.up])
    if frame == "robot":  # forward and right of a robot with the heading 0.7
        forward, right = np.array([math.cos(0.7), math.sin(0.7)]), np.array([0.644, -0.765])
        wanted = controls.up * forward + controls.right * right
    cosine = velocity @ wanted / np.linalg.norm(velocity) / np.linalg.norm(wanted)
    assert np.linalg.norm(velocity) > 0.2
    assert cosine > 0.99


def rows_with(task: Task, robot: int, angle: float) -> Floats:
    """Robots in a row along y, one of them with a heading and free space on all sides."""
    frame = rsoccer.Frame.empty(1, task.n_blue, task.n_yellow)
    frame.robots.position[0, :, 1] = np.linspace(-1.8, 1.8, len(task.robots))
    frame.robots.position[0, :, 0] = -2.0
    frame.robots.heading[0] = 1.0, 0.0
    frame.robots.position[0, robot] = 0.0, 0.0
    frame.robots.heading[0, robot] = math.cos(angle), math.sin(angle)
    frame.ball.position[0] = 2.5, 1.5
    return frame.rows


def test_a_vss_robot_drives_forward_and_turns_left() -> None:
    task = make_task("VSSSelfPlay-v0")
    driver = Driver(task, "yellow_2")
    driver.controls = Controls(up=1.0, right=-0.3)
    matches = Matches(task, controllers=human_controllers(driver, {"all": "zero"}))
    frame = rsoccer.Frame.empty(1, 3, 3)
    frame.robots.position[0, :, 1] = np.linspace(-0.5, 0.5, 6)
    frame.robots.position[0, :, 0] = -0.6
    frame.robots.position[0, 5] = 0.0, 0.0
    frame.robots.heading[0] = 1.0, 0.0
    frame.ball.position[0] = 0.6, 0.5
    matches.reset(rows=frame.rows)
    for _ in range(8):
        matches.step(np.zeros((1, 0, 2), np.float32))
    robots = matches.frame.robots
    assert robots.velocity[0, 5, 0] > 0.3
    assert robots.angular_velocity[0, 5] > 0.5


@pytest.mark.parametrize("chip", [False, True])
@pytest.mark.parametrize("discrete", [False, True])
@pytest.mark.parametrize("chip_kick", [False, True])
def test_a_chip_leaves_the_floor_and_a_kick_does_not(
    chip: bool, discrete: bool, chip_kick: bool
) -> None:
    task = make_task("SSLGoToBall-v0", max_steps=100, discrete=discrete, chip_kick=chip_kick)
    driver = Driver(task)
    driver.controls = Controls(kick=0.6, chip=chip)
    matches = Matches(
        task,
        controllers=human_controllers(driver, {"all": "zero"}),
        autoreset="disabled",
    )
    frame = rsoccer.Frame.empty(1, 1, 0)
    frame.robots.heading[0, 0] = 1.0, 0.0
    frame.ball.position[0] = task.config.robot.front_distance + task.config.ball.radius, 0.0
    matches.reset(rows=frame.rows)
    heights, speeds = [], []
    for _ in range(10):
        matches.step(np.zeros((1, 0, task.action_size), np.float32))
        heights.append(float(matches.frame.ball.height[0]))
        speeds.append(float(matches.frame.ball.velocity[0, 0]))
        if matches.done[0]:
            matches.reset(rows=matches.frame.rows)
    assert max(speeds) > 1.0
    assert (max(heights) > 0.05) == chip


def test_only_the_driven_robot_chips_and_others_keep_their_commands() -> None:
    class Kicks(CommandPolicy):
        observes = "nothing"

        def commands(
            self, inputs: PolicyInput, converted: Floats, rng: WorldRng, memory: Memory
        ) -> Floats:
            return np.full(converted.shape, 0.5, np.float32)

    task = make_task("SSLSelfPlay-v0")
    driver = Driver(task, "blue_1")
    driver.controls = Controls(kick=1.0, chip=True)
    controllers = human_controllers(driver, {"blue": Kicks(), "yellow": "zero"})
    matches = Matches(task, controllers=controllers)
    matches.reset()
    matches.step(np.zeros((1, 0, 5), np.float32))
    commands = matches.play.commands[0]
    columns = list(task.config.command_columns)
    chip = commands[1, [columns.index("kick_v_x"), columns.index("kick_v_z")]]
    assert chip == pytest.approx(6.5 * DIAGONAL, rel=1e-5)
    assert (commands[[0, 2]] == 0.5).all()
    assert not commands[3:].any()


def test_robots_are_chosen_by_name_by_number_and_in_turn() -> None:
    driver = Driver(make_task("VSSSelfPlay-v0"), "yellow_1")
    driver.choose_number(2)
    assert (driver.robot, driver.index) == ("yellow_2", 5)
    driver.choose_number(7)
    assert driver.robot == "yellow_2"
    driver.choose_next()
    assert driver.robot == "blue_0"
    driver.choose_next()
    assert driver.robot == "blue_1"
    with pytest.raises(ValueError, match=r"robot: expected one of .*got 'blue_9'"):
        driver.choose("blue_9")


def test_a_task_with_other_actions_is_refused() -> None:
    class ThreeNumbers(type(make_task("VSS-v0"))):  # type: ignore[misc]
        action_size = 3

    with pytest.raises(ValueError, match="task: expected one with the actions of VSSS"):
        Driver(ThreeNumbers())


class Ones(Policy):
    observes = "nothing"

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        return np.ones(inputs.action_shape, np.float32)


def test_only_the_driven_robot_leaves_its_policy_and_it_returns_later() -> None:
    task = make_task("VSSSelfPlay-v0")
    driver = Driver(task, "blue_1")
    driver.controls = Controls(up=-1.0)
    controllers = human_controllers(driver, {"all": Ones()})
    assert len(set(map(id, controllers.values()))) == 1
    matches = Matches(task, controllers=controllers)
    matches.reset()
    for robot in ("blue_1", "yellow_0"):
        driver.choose(robot)
        matches.step(np.zeros((1, 0, 2), np.float32))
        expected = np.ones((6, 2))
        expected[driver.index] = -1.0
        np.testing.assert_array_equal(matches.play.actions[0], expected)


def test_the_other_robots_play_as_without_a_person() -> None:
    task = make_task("VSSSelfPlay-v0")
    teams = {"blue": "ou", "yellow": "scripted:0.5"}
    driver = Driver(task, "blue_2")
    plain = Matches(task, seed=5, controllers={**teams, "blue_2": "zero"})
    driven = Matches(
        task, seed=5, controllers=human_controllers(driver, {**teams, "blue_2": "zero"})
    )
    none = np.zeros((1, 0, 2), np.float32)
    for matches in (plain, driven):
        matches.reset()
        for _ in range(40):
            matches.step(none)
    np.testing.assert_array_equal(plain.frame.rows, driven.frame.rows)


def test_policies_keep_their_input() -> None:
    task = make_task("VSSSelfPlay-v0")
    driver = Driver(task)
    observes = {}
    for name in ("zero", "chase"):
        policy = human_controllers(driver, {"all": name})["blue_0"]
        assert isinstance(policy, HumanPolicy)
        observes[name] = policy.observes
    assert observes == {"zero": "view", "chase": "view"}


def test_a_robot_without_a_policy_is_refused() -> None:
    driver = Driver(make_task("VSSSelfPlay-v0"))
    with pytest.raises(ValueError, match="expected a policy for every robot, got none for yellow"):
        human_controllers(driver, {"blue": "zero", "yellow": LEARN})


def test_teams_have_the_tasks_policies_and_scripts_in_the_place_of_learners() -> None:
    task = make_task("VSS-v0")
    assert team_controllers(task, "blue_0") == {
        **dict.fromkeys(task.robots, "ou"),
        "blue_0": "scripted",
    }
    chosen = team_controllers(make_task("SSLSelfPlay-v0"), "yellow_1", "hold", "zero")
    assert chosen == {f"blue_{i}": "zero" for i in range(3)} | {
        f"yellow_{i}": "hold" for i in range(3)
    }


def test_each_team_has_the_script_of_its_part() -> None:
    task = make_task("SSLKeepaway-v0", learners="both")
    chosen = team_controllers(task, "blue_0")
    assert {name: chosen[name] for name in ("blue_2", "yellow_0", "yellow_1")} == {
        "blue_2": "keep",
        "yellow_0": "take",
        "yellow_1": "take",
    }


def test_wrong_teams_are_refused() -> None:
    with pytest.raises(ValueError, match="robot: expected one of"):
        team_controllers(make_task("VSS-v0"), "red_0")
    with pytest.raises(ValueError, match="one team only"):
        team_controllers(make_task("SSLGoToBall-v0"), "blue_0", opponent="hold")
