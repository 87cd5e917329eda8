"""The driver: controls of a person as actions of one robot, in any task of either league."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final

import numpy as np

from rsoccer.arrays import Floats
from rsoccer.controllers import Controller, Controllers, resolve
from rsoccer.frame import team_of
from rsoccer.human.controls import Controls
from rsoccer.policies import PolicyLike, make_policy
from rsoccer.policies.base import CommandPolicy, Memory, Observes, Policy, PolicyInput, actions_of
from rsoccer.rng import WorldRng
from rsoccer.task import Learn, Task
from rsoccer.tasks.ssl import CHIP_ANGLE

FRAMES: Final = ("field", "robot")
"""Axes of the deflections of an SSL robot: those of the picture, or those of the robot."""
WHEEL_TURN: Final = 0.3
"""Wheel speed of a full turn of a differential robot, as a fraction of the top speed."""
TURN: Final = 0.5
"""Action of a full turn of an omnidirectional robot: 5 rad/s in the tasks of the package."""
SLOW: Final = 0.4
"""Factor on speeds while they are reduced."""


class Driver:
    """A person's controls as actions of the driven robot.

    Attributes:
        task: the task that is played.
        robot: name of the driven robot.
        frame: "field" or "robot", the axes of the deflections of an SSL robot.
        controls: current controls.
    """

    def __init__(self, task: Task, robot: str | None = None) -> None:
        """Begin with a robot and controls at rest.

        Args:
            task: the task that is played.
            robot: name of the robot; by default the first learner.

        Raises:
            ValueError: no such robot, or a task with other actions than those of VSSS and SSL.
        """
        columns = tuple(task.config.command_columns)
        self._is_differential = columns == ("left", "right") and task.action_size == 2
        self._chips_by_action = task.action_size == 6
        if not self._is_differential and (
            "dribbler" not in columns or task.action_size not in (5, 6)
        ):
            raise ValueError(
                "task: expected one with the actions of VSSS (2 numbers) or SSL (5 or 6 numbers), "
                f"got {task.name} with {task.action_size}"
            )
        self.task = task
        self.frame = FRAMES[0]
        self.controls = Controls()
        self.robot = ""
        self.choose(next(iter(task.agents or task.robots)) if robot is None else robot)

    @property
    def has_kicker(self) -> bool:
        """True where the robots are omnidirectional, with kicker and dribbler."""
        return not self._is_differential

    @property
    def index(self) -> int:
        """Index of the driven robot in the order of a state row."""
        return list(self.task.robots).index(self.robot)

    def choose(self, robot: str) -> None:
        """Drive another robot.

        Args:
            robot: its name.

        Raises:
            ValueError: no such robot.
        """
        if robot not in self.task.robots:
            raise ValueError(f"robot: expected one of {list(self.task.robots)}, got {robot!r}")
        self.robot = robot

    def choose_next(self) -> None:
        """Drive the next robot in the order of a state row; the first follows the last."""
        self.robot = self.task.robots[(self.index + 1) % len(self.task.robots)]

    def choose_number(self, number: int) -> bool:
        """Drive the robot of the same team with a number, if there is one.

        Args:
            number: number of the robot in its team.

        Returns:
            False if there is none.
        """
        robot = f"{team_of(self.robot)}_{number}"
        exists = robot in self.task.robots
        if exists:
            self.robot = robot
        return exists

    def change_frame(self) -> None:
        """Exchange the axes of the deflections of an SSL robot."""
        self.frame = FRAMES[1 - FRAMES.index(self.frame)]

    def action(self, heading: Sequence[float]) -> Floats:
        """Return the action of the driven robot for the current controls.

        In a discrete task the action is the row of the `action_table` that is nearest to it.

        Args:
            heading: cosine and sine of the robot's heading in the view of its team, which
                attacks +x.

        Returns:
            (action,) in [-1, 1].
        """
        table = self.task.action_table
        if self._is_differential:
            action = self._wheels(1.0 if table is not None else WHEEL_TURN)
        else:
            action = self._motion(heading)
        if table is None:
            return action
        if self.has_kicker and self.controls.kick:
            action[4] = -1.0  # a table's kick has the dribbler off
            action[:3] = 0.0
        nearest = ((table - action) ** 2).sum(axis=1).argmin()
        chosen: Floats = table[nearest].astype(np.float32)
        return chosen

    def command(self, converted: Floats) -> Floats:
        """Return the command of the driven robot for the current controls.

        Args:
            converted: (..., command) command that follows from `action`, SI units.

        Returns:
            The same, a new array, with a kick as a chip where the controls say so.
        """
        command = np.array(converted, np.float32)
        if self.has_kicker and self.controls.chip and not self._chips_by_action:
            columns = list(self.task.config.command_columns)
            speed = command[..., columns.index("kick_v_x")].copy()
            command[..., columns.index("kick_v_x")] = speed * math.cos(CHIP_ANGLE)
            command[..., columns.index("kick_v_z")] = speed * math.sin(CHIP_ANGLE)
        return command

    def _wheels(self, turn_share: float) -> Floats:
        """Wheel speeds; too fast a wheel slows both, so that the curve stays the same."""
        controls = self.controls
        turn = turn_share * max(-1.0, min(1.0, controls.turn - controls.right))
        wheels = self._speed * np.array([controls.up - turn, controls.up + turn], np.float32)
        limited: Floats = wheels / np.float32(max(1.0, float(np.abs(wheels).max())))
        return limited

    @property
    def _speed(self) -> float:
        """Factor on speeds; the table of a discrete task has no reduced ones."""
        return SLOW if self.controls.slow and self.task.action_table is None else 1.0

    def _motion(self, heading: Sequence[float]) -> Floats:
        """Velocity, angular velocity, kick and dribbler of an omnidirectional robot."""
        controls = self.controls
        x, y = self._velocity(heading)
        # A diagonal of two keys is no faster than one key.
        speed = self._speed / max(1.0, math.hypot(x, y))
        action = [
            speed * x,
            speed * y,
            self._speed * TURN * controls.turn,
            controls.kick or -1.0,
            1.0 if controls.dribble else -1.0,
        ]
        if self._chips_by_action:
            action.append(1.0 if controls.chip else -1.0)
        return np.array(action, np.float32)

    def _velocity(self, heading: Sequence[float]) -> tuple[float, float]:
        """Velocity in the axes of the task's actions."""
        cos, sin = heading
        in_robot_axes = getattr(self.task, "velocity_frame", "field") == "robot"
        if self.frame == "robot":
            forward, left = self.controls.up, -self.controls.right
            if in_robot_axes:
                return forward, left
            return cos * forward - sin * left, sin * forward + cos * left
        sign = 1.0 if team_of(self.robot) == "blue" else -1.0  # yellow's view is rotated
        x, y = sign * self.controls.right, sign * self.controls.up
        if in_robot_axes:
            return cos * x + sin * y, cos * y - sin * x
        return x, y


class HumanPolicy(CommandPolicy):
    """A policy in which the driver acts for one of its robots.

    The driver gives actions, and commands for the chips that most tasks' actions do not have.

    The other robots, and all of them while the driver has a robot elsewhere, follow the policy
    beneath. It plays a single match.
    """

    def __init__(self, policy: Policy, robots: Sequence[str], driver: Driver) -> None:
        """Put a driver over a policy.

        Args:
            policy: policy of the robots that are not driven.
            robots: names of the robots of the policy, in the order of a state row.
            driver: the driver.
        """
        super().__init__()
        self._policy = policy
        self._robots = list(robots)
        self._driver = driver
        needs_view = policy.observes == "nothing"
        self.observes: Observes = "view" if needs_view else policy.observes
        self.forecasts = policy.forecasts or needs_view  # as its scripted teammates do
        self.needs_forecast = policy.needs_forecast

    def check_fits(self, task: Task, observation_size: int) -> None:
        """Check that the policy beneath can play a task.

        Args:
            task: the task to be played.
            observation_size: numbers in one robot's observation.
        """
        self._policy.check_fits(task, observation_size)

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        """Return the memory of the policy beneath.

        Args:
            shape: (n, robots, action).
            rng: (n,) random streams of the worlds.

        Returns:
            New arrays, each (n, ...).
        """
        return self._policy.new_memory(shape, rng)

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Return the actions of the policy beneath, with the driven robot's replaced.

        Args:
            inputs: view and observations of the robots.
            rng: (n,) random streams of the worlds.
            memory: arrays of the policy beneath; updated in place.

        Returns:
            (n, robots, action) in [-1, 1].
        """
        actions = actions_of(self._policy, inputs, rng, memory)
        if self._driver.robot not in self._robots:
            return actions
        slot = self._robots.index(self._driver.robot)
        headings = inputs.required_view("the driver").ego.heading
        driven = np.array(actions, np.float32)
        for world in range(len(driven)):
            driven[world, slot] = self._driver.action(headings[world, slot].tolist())
        return driven

    def commands(
        self, inputs: PolicyInput, converted: Floats, rng: WorldRng, memory: Memory
    ) -> Floats:
        """Return the commands of all robots, with the driver's kick as a chip where it is one.

        Args:
            inputs: view and observations of the robots.
            converted: (n, robots, command) commands that follow from the actions.
            rng: (n,) random streams of the worlds.
            memory: arrays of the policy beneath; updated in place.

        Returns:
            (n, robots, command) in SI units.
        """
        driven = converted
        if isinstance(self._policy, CommandPolicy):
            driven = self._policy.commands(inputs, converted.copy(), rng, memory)
        if self._driver.robot in self._robots:
            slot = self._robots.index(self._driver.robot)
            driven = np.array(driven, np.float32)
            driven[:, slot] = self._driver.command(converted[:, slot])
        return driven


def human_controllers(driver: Driver, controllers: Controllers) -> dict[str, Controller]:
    """Return controllers with the driver over each policy.

    Args:
        driver: the driver.
        controllers: policies by robot, team or "all", as `Matches` takes them.

    Returns:
        A `HumanPolicy` by robot; robots that shared a policy share one.

    Raises:
        TypeError: something that is not a controller.
        ValueError: an unknown robot, a robot without a policy, or a policy that does not fit.
    """
    task = driver.task
    policies: dict[str, PolicyLike] = {}
    for robot, controller in resolve(task, controllers).items():
        if isinstance(controller, Learn):
            raise ValueError(
                f"controllers: expected a policy for every robot, got none for {robot}"
            )
        policies[robot] = controller
    robots_of: dict[str | int, list[str]] = {}
    for robot, policy in policies.items():
        robots_of.setdefault(policy if isinstance(policy, str) else id(policy), []).append(robot)
    human: dict[str, Controller] = {}
    for robots in robots_of.values():
        driven = HumanPolicy(make_policy(policies[robots[0]], task), robots, driver)
        human |= dict.fromkeys(robots, driven)
    return human
