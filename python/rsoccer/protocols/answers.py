"""Answers in the simulation protocol of the SSL: feedback of robots, and errors."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeVar

import numpy as np

from rsoccer.arrays import Mask
from rsoccer.frame import Frame
from rsoccer.protocols.errors import MessageError, Problem
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.schemas import simulation_pb2

_R = TypeVar("_R", simulation_pb2.Response, simulation_pb2.RobotControlResponse)


def to_robot_control_response(
    layout: WireLayout,
    frame: Frame,
    world: int,
    team: int,
    given: Mask | None = None,
    problems: Iterable[Problem] = (),
) -> simulation_pb2.RobotControlResponse:
    """Return the answer to a team.

    Args:
        layout: the match.
        frame: states.
        world: index of the world.
        team: `BLUE` or `YELLOW`.
        given: (robots,) robots to tell about; None for all of the team that are on the field.
        problems: parts of the team's message that were not honored.

    Returns:
        The message: a robot has contact if the ball cuts its break beam.

    Raises:
        ValueError: a frame of other teams, or no such world.
    """
    layout.check_frame(frame, world)
    message = simulation_pb2.RobotControlResponse()
    robots = frame.robots.absent[world] == 0 if given is None else given
    for slot in layout.slots(team):
        if robots[slot]:
            message.feedback.add(
                id=layout.identity(slot)[1],
                dribbler_ball_contact=bool(frame.robots.infrared[world, slot] > 0),
            )
    return _with_errors(message, problems)


def to_response(problems: Iterable[Problem]) -> simulation_pb2.Response:
    """Return the answer to a message to the control port.

    Args:
        problems: parts of the message that were not honored; none for success.
    """
    return _with_errors(simulation_pb2.Response(), problems)


def refusal(error: MessageError, kind: type[_R]) -> _R:
    """Return the answer to bytes that are no message.

    Args:
        error: the reason.
        kind: class of the answer.
    """
    return _with_errors(kind(), [Problem(error.code, str(error))])


def _with_errors(message: _R, problems: Iterable[Problem]) -> _R:
    for problem in problems:
        message.errors.add(code=str(problem.code), message=problem.message)
    return message


def read_feedback(
    layout: WireLayout, message: simulation_pb2.RobotControlResponse, team: int
) -> tuple[Mask, Mask]:
    """Return what an answer tells about a team's robots.

    Args:
        layout: the match.
        message: the answer, from `rsoccer.protocols.parsing.parse`.
        team: `BLUE` or `YELLOW`.

    Returns:
        (robots,) robots that the answer has, and those whose dribbler has contact to the ball.
        Robots that the match does not have are left out.
    """
    reported, contact = np.zeros((2, layout.config.n_robots), np.bool_)
    for feedback in message.feedback:
        try:
            slot = layout.slot(team, feedback.id)
        except MessageError:
            continue
        reported[slot] = feedback.HasField("dribbler_ball_contact")
        contact[slot] = feedback.dribbler_ball_contact
    return reported, contact


def read_errors(
    message: simulation_pb2.Response | simulation_pb2.RobotControlResponse,
) -> list[tuple[str, str]]:
    """Return codes and texts of the errors in an answer; codes are the sender's own.

    Args:
        message: the answer, from `rsoccer.protocols.parsing.parse`.
    """
    return [(error.code, error.message) for error in message.errors]
