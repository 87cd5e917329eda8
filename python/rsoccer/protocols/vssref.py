"""VSSReferee's packets: commands of the referee, and the places that teams choose for robots."""

from __future__ import annotations

import math
from typing import Final, NamedTuple

from rsoccer.arrays import Mask
from rsoccer.frame import Frame
from rsoccer.game import BLUE, NOBODY, YELLOW, Command, Stage
from rsoccer.protocols.errors import Code, MessageError
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.placing import Placement
from rsoccer.protocols.schemas import vssref_pb2

_COLORS: Final = {BLUE: vssref_pb2.BLUE, YELLOW: vssref_pb2.YELLOW, NOBODY: vssref_pb2.NONE}
_TEAMS: Final = {int(color): team for team, color in _COLORS.items()}
_FOULS: Final = {
    Command.HALT: (vssref_pb2.HALT, NOBODY),
    Command.STOP: (vssref_pb2.STOP, NOBODY),
    Command.NORMAL_START: (vssref_pb2.GAME_ON, NOBODY),
    Command.FORCE_START: (vssref_pb2.GAME_ON, NOBODY),
    Command.PREPARE_KICKOFF_BLUE: (vssref_pb2.KICKOFF, BLUE),
    Command.PREPARE_KICKOFF_YELLOW: (vssref_pb2.KICKOFF, YELLOW),
    Command.PREPARE_PENALTY_BLUE: (vssref_pb2.PENALTY_KICK, BLUE),
    Command.PREPARE_PENALTY_YELLOW: (vssref_pb2.PENALTY_KICK, YELLOW),
    Command.DIRECT_FREE_BLUE: (vssref_pb2.FREE_KICK, BLUE),
    Command.DIRECT_FREE_YELLOW: (vssref_pb2.FREE_KICK, YELLOW),
    Command.GOAL_KICK_BLUE: (vssref_pb2.GOAL_KICK, BLUE),
    Command.GOAL_KICK_YELLOW: (vssref_pb2.GOAL_KICK, YELLOW),
    Command.FREE_BALL: (vssref_pb2.FREE_BALL, NOBODY),
}
_COMMANDS: Final = {
    (int(foul), team): command
    for command, (foul, team) in _FOULS.items()
    if command is not Command.FORCE_START
}
_HALVES: Final = {
    Stage.NORMAL_FIRST_HALF_PRE: vssref_pb2.FIRST_HALF,
    Stage.NORMAL_FIRST_HALF: vssref_pb2.FIRST_HALF,
    Stage.NORMAL_SECOND_HALF_PRE: vssref_pb2.SECOND_HALF,
    Stage.NORMAL_SECOND_HALF: vssref_pb2.SECOND_HALF,
    Stage.EXTRA_FIRST_HALF_PRE: vssref_pb2.OVERTIME_FIRST_HALF,
    Stage.EXTRA_FIRST_HALF: vssref_pb2.OVERTIME_FIRST_HALF,
    Stage.EXTRA_SECOND_HALF_PRE: vssref_pb2.OVERTIME_SECOND_HALF,
    Stage.EXTRA_SECOND_HALF: vssref_pb2.OVERTIME_SECOND_HALF,
    Stage.PENALTY_SHOOTOUT: vssref_pb2.PENALTY_SHOOTOUTS,
}
_STAGES: Final = {
    int(half): stage for stage, half in _HALVES.items() if not stage.name.endswith("PRE")
}


class VssStatus(NamedTuple):
    """State of VSSReferee."""

    command: Command
    """Command of the referee; a start is `NORMAL_START`."""
    stage: Stage | None
    """Half of the match; None in breaks."""
    quadrant: int
    """Quadrant of a free ball on the wire, 1 to 4 counterclockwise from +x, +y; 0 for none."""
    timestamp: float
    """Time by the sender's clock."""


def quadrant(layout: WireLayout, position: tuple[float, float]) -> int:
    """Return the quadrant of a place on the wire, 1 to 4.

    Args:
        layout: the match.
        position: place in the package, m; 0 counts as negative, as in VSSReferee.
    """
    right, upper = (value * layout.sign > 0 for value in position)
    if upper:
        return 1 if right else 2
    return 4 if right else 3


def to_command(
    layout: WireLayout,
    command: Command,
    stage: Stage,
    *,
    timestamp: float,
    position: tuple[float, float] = (0.0, 0.0),
) -> vssref_pb2.Command:
    """Return the packet of the referee.

    Args:
        layout: the match.
        command: command of the referee.
        stage: part of the match.
        timestamp: time of sending.
        position: place of the ball at a free ball, m.

    Raises:
        MessageError: a command that VSSReferee does not have, such as a ball placement.
    """
    if command not in _FOULS:
        raise MessageError(
            Code.UNSUPPORTED_COMMAND, f"command: expected one of VSSS, got {command.name}"
        )
    foul, team = _FOULS[command]
    free = command is Command.FREE_BALL
    return vssref_pb2.Command(
        foul=foul,
        teamcolor=_COLORS[team],
        foulQuadrant=quadrant(layout, position) if free else vssref_pb2.NO_QUADRANT,  # type: ignore[arg-type]
        timestamp=timestamp,
        gameHalf=_HALVES.get(stage, vssref_pb2.NO_HALF),
    )


def read_command(message: vssref_pb2.Command) -> VssStatus:
    """Return what a packet of the referee tells.

    Args:
        message: the packet, from `rsoccer.protocols.parsing.parse`.

    Raises:
        MessageError: a command, a half or a quadrant that does not exist, or a kick of no team.
    """
    foul, color = int(message.foul), int(message.teamcolor)
    command = _COMMANDS.get((foul, NOBODY), _COMMANDS.get((foul, _TEAMS.get(color, NOBODY))))
    if command is None:
        raise MessageError(
            Code.UNSUPPORTED_COMMAND, f"foul: expected a known one of a team, got {foul}, {color}"
        )
    if not 0 <= message.foulQuadrant <= 4:
        text = f"foulQuadrant: expected 0 to 4, got {int(message.foulQuadrant)}"
        raise MessageError(Code.OUT_OF_RANGE, text)
    half = int(message.gameHalf)
    if half and half not in _STAGES:
        raise MessageError(Code.OUT_OF_RANGE, f"gameHalf: expected 0 to 5, got {half}")
    return VssStatus(command, _STAGES.get(half), int(message.foulQuadrant), message.timestamp)


def to_placement(
    layout: WireLayout, frame: Frame, world: int, team: int, robots: Mask | None = None
) -> vssref_pb2.Placement:
    """Return the packet with the places that a team chooses.

    Args:
        layout: the match.
        frame: states with these places.
        world: index of the world.
        team: `BLUE` or `YELLOW`.
        robots: (robots,) robots to place; None for all of the team that are on the field.

    Raises:
        ValueError: a frame of other teams, or no such world.
    """
    layout.check_frame(frame, world)
    message = vssref_pb2.Placement()
    message.world.teamColor = _COLORS[team]
    chosen = frame.robots.absent[world] == 0 if robots is None else robots
    for slot in layout.slots(team):
        if chosen[slot]:
            x, y = layout.rotated(frame.robots.position[world, slot]).tolist()
            angle = float(layout.angle_to_wire(frame.robots.heading[world, slot]))
            message.world.robots.add(
                robot_id=layout.identity(slot)[1], x=x, y=y, orientation=math.degrees(angle)
            )
    return message


def read_placement(
    layout: WireLayout, message: vssref_pb2.Placement, frame: Frame, world: int = 0
) -> Placement:
    """Return the state with the places that a team chose.

    Args:
        layout: the match.
        message: the packet, from `rsoccer.protocols.parsing.parse`.
        frame: states.
        world: index of the world.

    Returns:
        The state with the robots of the team that are put somewhere; they rest.

    Raises:
        MessageError: no team.
        ValueError: a frame of other teams, or no such world.
    """
    team = _TEAMS.get(int(message.world.teamColor), NOBODY)
    if team == NOBODY:
        raise MessageError(
            Code.UNKNOWN_TEAM, f"teamColor: expected 0 or 1, got {int(message.world.teamColor)}"
        )
    placement = Placement(layout, frame, world)
    for robot in message.world.robots:
        try:
            slot = placement.slot(team, robot.robot_id)
            placement.put_robot(slot, (robot.x, robot.y), math.radians(robot.orientation))
        except MessageError as error:
            placement.add(error)
    return placement
