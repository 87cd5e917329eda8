"""Answers in the simulation protocol."""

import numpy as np

from rsoccer.game import BLUE, YELLOW
from rsoccer.protocols import answers
from rsoccer.protocols.errors import Code, MessageError, Problem
from rsoccer.protocols.parsing import parse
from rsoccer.protocols.schemas import simulation_pb2
from tests.protocols.matches import layout, state


def test_feedback_survives_the_wire() -> None:
    made, frame = layout(), state()
    frame.robots.infrared[1] = (0, 0, 1, 1, 0, 0, 1)
    frame.robots.absent[1, 4] = 1.0
    message = answers.to_robot_control_response(
        made, frame, 1, YELLOW, problems=[Problem(Code.OUT_OF_RANGE, "text")]
    )
    sent = parse(simulation_pb2.RobotControlResponse, message.SerializeToString())
    reported, contact = answers.read_feedback(made, sent, YELLOW)
    assert reported.tolist() == [False, False, False, True, False, True, True]
    assert contact.tolist() == [False, False, False, True, False, False, True]
    assert answers.read_errors(sent) == [("OUT_OF_RANGE", "text")]
    other, _ = answers.read_feedback(made, sent, BLUE)
    assert not other.any()


def test_feedback_of_some_robots() -> None:
    given = np.array([False, True, False, True, True, True, True])
    message = answers.to_robot_control_response(layout(), state(), 0, BLUE, given)
    assert [feedback.id for feedback in message.feedback] == [0]


def test_errors_carry_codes() -> None:
    message = answers.to_response([Problem(Code.INVALID_SPEC, "a"), Problem(Code.INCOMPLETE, "b")])
    assert [(e.code, e.message) for e in message.errors] == [
        ("INVALID_SPEC", "a"),
        ("INCOMPLETE", "b"),
    ]
    assert not answers.to_response([]).errors


def test_bytes_that_are_no_message_are_answered() -> None:
    error = MessageError(Code.UNREADABLE, "text")
    expected = [("UNREADABLE", "text")]
    assert answers.read_errors(answers.refusal(error, simulation_pb2.Response)) == expected
    other = answers.refusal(error, simulation_pb2.RobotControlResponse)
    assert answers.read_errors(other) == expected
