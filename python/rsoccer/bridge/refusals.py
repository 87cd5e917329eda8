"""Reasons for which the server refuses what a message asks for, beyond those of protocols."""

from __future__ import annotations

from collections.abc import Iterable
from enum import StrEnum
from typing import NamedTuple

from rsoccer.protocols.schemas import simulation_pb2


class Refusal(StrEnum):
    """Stable code of a refusal, for programs. Answers on the network carry it."""

    TEAM_TAKEN = "TEAM_TAKEN"
    """Another client drives the team; it is free once that one is silent."""
    REMOTE_CONTROL = "REMOTE_CONTROL"
    """Control of the simulator is for this machine alone, unless the server allows it."""
    BLOCKED = "BLOCKED"
    """A body cannot be where it is to be put: it overlaps another one, or is outside."""
    UNSUPPORTED_SPEED = "UNSUPPORTED_SPEED"
    """The simulation goes on as fast as clients answer, so it has no speed to set."""
    RECORDING = "RECORDING"
    """Robots cannot be exchanged while a replay is recorded: it has the same ones all the time."""


class Reason(NamedTuple):
    """A part of a message that was refused."""

    code: str
    """Stable code, of `Refusal` or of `rsoccer.protocols.errors.Code`."""
    message: str
    """The field, what was expected and what came."""


def to_response(reasons: Iterable[tuple[str, str]]) -> bytes:
    """Return the answer to a message to the control port.

    Args:
        reasons: code and message of what was refused; none for success.
    """
    response = simulation_pb2.Response()
    for code, message in reasons:
        response.errors.add(code=str(code), message=message)
    data: bytes = response.SerializeToString()
    return data


def to_team_response(reasons: Iterable[tuple[str, str]]) -> bytes:
    """Return the answer to a message to a team's port, without feedback.

    Args:
        reasons: code and message of what was refused.
    """
    response = simulation_pb2.RobotControlResponse()
    for code, message in reasons:
        response.errors.add(code=str(code), message=message)
    data: bytes = response.SerializeToString()
    return data
