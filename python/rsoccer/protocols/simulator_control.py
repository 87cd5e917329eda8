"""Control of the simulator in the simulation protocol of the SSL: teleports and configuration."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from functools import partial
from typing import Final

from rsoccer._core import RobotModel
from rsoccer.frame import Frame
from rsoccer.game import BLUE, YELLOW
from rsoccer.protocols.errors import Code, MessageError, Problem
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.placing import Placement
from rsoccer.protocols.robot_specs import to_robot_model
from rsoccer.protocols.schemas import simulation_pb2

_TEAMS: Final = {simulation_pb2.BLUE: BLUE, simulation_pb2.YELLOW: YELLOW}
_PLACES: Final = ("x", "y", "orientation", "v_x", "v_y", "v_angular")
"""Fields of a robot's teleport that put it somewhere."""
_MAX_SPEED: Final = 1e6
"""Greatest speed of the simulation, times real time: beyond what any computer reaches."""


@dataclass
class ControlResult:
    """Demands of a message to the control port.

    Attributes:
        placement: the state with the bodies that are put somewhere.
        simulation_speed: speed of the simulation, times real time, 0 to stand still; None to leave
            it.
        vision_port: port to send vision to; None to leave it.
        robot_models: new models of robots by index in a state row.
    """

    placement: Placement
    simulation_speed: float | None = None
    vision_port: int | None = None
    robot_models: dict[int, RobotModel] = field(default_factory=dict)

    @property
    def problems(self) -> list[Problem]:
        """Parts of the message that are not honored."""
        return self.placement.problems


def read_command(
    layout: WireLayout, message: simulation_pb2.Command, frame: Frame, world: int = 0
) -> ControlResult:
    """Return what a message to the control port asks for.

    Args:
        layout: the match.
        message: the message, from `rsoccer.protocols.parsing.parse`.
        frame: states.
        world: index of the world.

    Returns:
        All that can be honored, and why the rest is not.

    Raises:
        ValueError: a frame of other teams, or no such world.
    """
    result = ControlResult(Placement(layout, frame, world))
    _read_control(message.control, result)
    _read_config(layout, message.config, result)
    return result


def to_command(
    layout: WireLayout,
    frame: Frame,
    world: int = 0,
    *,
    removed: Iterable[tuple[int, int]] = (),
) -> simulation_pb2.Command:
    """Return the message that puts ball and robots where a state has them.

    Args:
        layout: the match.
        frame: states.
        world: index of the world.
        removed: team and uniform number, on the wire, of further robots to take off the field.

    Returns:
        The message. All numbers of each body are given, since simulators refuse parts.

    Raises:
        ValueError: a frame of other teams, or no such world.
    """
    layout.check_frame(frame, world)
    message = simulation_pb2.Command()
    ball, robots = message.control.teleport_ball, frame.robots
    ball.x, ball.y = layout.rotated(frame.ball.position[world]).tolist()
    ball.vx, ball.vy = layout.rotated(frame.ball.velocity[world]).tolist()
    ball.z, ball.vz = float(frame.ball.height[world]), float(frame.ball.vertical_velocity[world])
    positions = layout.rotated(robots.position[world]).tolist()
    velocities = layout.rotated(robots.velocity[world]).tolist()
    angles = layout.angle_to_wire(robots.heading[world]).tolist()
    colors = {team: color for color, team in _TEAMS.items()}
    for slot in range(layout.config.n_robots):
        team, number = layout.identity(slot)
        robot = message.control.teleport_robot.add()
        robot.id.id, robot.id.team = number, colors[team]
        robot.present = bool(robots.absent[world, slot] == 0)
        if robot.present:
            robot.x, robot.y = positions[slot]
            robot.orientation = angles[slot]
            robot.v_x, robot.v_y = velocities[slot]
            robot.v_angular = float(robots.angular_velocity[world, slot])
    for team, number in removed:
        robot = message.control.teleport_robot.add(present=False)
        robot.id.id, robot.id.team = number, colors[team]
    return message


def _read_control(control: simulation_pb2.Control, result: ControlResult) -> None:
    placement = result.placement
    if control.HasField("teleport_ball"):
        _try(placement, partial(_teleport_ball, placement, control.teleport_ball))
    for robot in control.teleport_robot:
        _try(placement, partial(_teleport_robot, placement, robot))
    if control.HasField("simulation_speed"):
        speed = control.simulation_speed
        if 0.0 <= speed <= _MAX_SPEED:
            result.simulation_speed = speed
        else:
            placement.add(
                MessageError(
                    Code.OUT_OF_RANGE,
                    f"simulation_speed: expected 0 to {_MAX_SPEED:g}, got {speed:g}",
                )
            )


def _teleport_ball(placement: Placement, ball: simulation_pb2.TeleportBall) -> None:
    if ball.by_force:
        raise MessageError(Code.UNSUPPORTED_BY_FORCE, "by_force: expected false, got true")

    def given(name: str) -> float | None:
        return getattr(ball, name) if ball.HasField(name) else None

    position = (given("x"), given("y"), given("z"))
    velocity = (given("vx"), given("vy"), given("vz"))
    if ball.roll or any(number is not None for number in (*position, *velocity)):
        placement.put_ball(position, velocity, roll=ball.roll)
    placement.safely |= ball.teleport_safely


def _teleport_robot(placement: Placement, robot: simulation_pb2.TeleportRobot) -> None:
    slot = placement.slot(*_identity(robot.id))
    if robot.by_force:
        raise MessageError(Code.UNSUPPORTED_BY_FORCE, "by_force: expected false, got true")
    present = robot.present if robot.HasField("present") else None
    if present is not False and not any(robot.HasField(name) for name in _PLACES):
        on_field = not placement.frame.robots.absent[0, slot]
        if on_field or present is None:
            return  # nothing asks for a change
    placement.put_robot(
        slot,
        (robot.x if robot.HasField("x") else None, robot.y if robot.HasField("y") else None),
        robot.orientation if robot.HasField("orientation") else None,
        (robot.v_x, robot.v_y, robot.v_angular),
        present,
    )


def _read_config(layout: WireLayout, config: simulation_pb2.Config, result: ControlResult) -> None:
    placement = result.placement
    if config.HasField("geometry"):
        text = "geometry: expected none while the simulation runs, got one"
        placement.add(MessageError(Code.UNSUPPORTED_GEOMETRY, text))
    if config.HasField("realism_config"):
        text = "realism_config: expected none, got one; choose senses at the start"
        placement.add(MessageError(Code.UNSUPPORTED_REALISM, text))
    if config.HasField("vision_port"):
        if 1 <= config.vision_port <= 65535:
            result.vision_port = config.vision_port
        else:
            text = f"vision_port: expected 1 to 65535, got {config.vision_port}"
            placement.add(MessageError(Code.OUT_OF_RANGE, text))
    for specs in config.robot_specs:
        if specs.custom:
            text = "robot_specs.custom: expected none, got some"
            placement.add(MessageError(Code.UNSUPPORTED_CUSTOM, text))
        try:
            slot = layout.slot(*_identity(specs.id))
            model = result.robot_models.get(slot, layout.config.robots[slot])
            result.robot_models[slot] = to_robot_model(model, specs)
        except MessageError as error:
            placement.add(error)


def _identity(identity: simulation_pb2.RobotId) -> tuple[int, int]:
    """Team and uniform number of a robot."""
    team = _TEAMS.get(identity.team)
    if team is None or not identity.HasField("id"):
        raise MessageError(Code.UNKNOWN_TEAM, "id: expected a number and a team, got fewer")
    return team, identity.id


def _try(placement: Placement, change: Callable[[], None]) -> None:
    try:
        change()
    except MessageError as error:
        placement.add(error)
