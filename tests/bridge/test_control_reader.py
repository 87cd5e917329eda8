"""The fast reader gives what the protocol's reader gives, or leaves a message to it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rsoccer.bridge import control_reader
from rsoccer.bridge.control_reader import ControlReader
from rsoccer.bridge.match_tasks import make_match
from rsoccer.bridge.message_template import MessageTemplate
from rsoccer.frame import Frame
from rsoccer.game import BLUE, YELLOW
from rsoccer.protocols.answers import to_robot_control_response
from rsoccer.protocols.errors import MessageError
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.parsing import parse
from rsoccer.protocols.robot_control import read_robot_control
from rsoccer.protocols.schemas import simulation_pb2

CONFIG = make_match("ssl", "B", None, {}).config
LAYOUT = WireLayout(CONFIG)
READER = ControlReader(LAYOUT)
FRAME = Frame.empty(1, 6, 6)
FRAME.robots.heading[:] = [0.6, 0.8]

NUMBERS = st.one_of(
    st.floats(-10.0, 10.0, width=32), st.sampled_from([math.nan, math.inf, -math.inf, 1e20, 0.0])
)


@st.composite
def controls(draw: st.DrawFn) -> simulation_pb2.RobotControl:
    message = simulation_pb2.RobotControl()
    for number in draw(st.lists(st.integers(0, 7), max_size=4)):
        command = message.robot_commands.add(id=number)
        kind = draw(st.sampled_from(["local", "local", "local", "global", "none", "empty"]))
        if kind == "local":
            local = command.move_command.local_velocity
            local.forward, local.left, local.angular = (draw(NUMBERS) for _ in range(3))
        elif kind == "global":
            moved = command.move_command.global_velocity
            moved.x, moved.y, moved.angular = (draw(NUMBERS) for _ in range(3))
        elif kind == "empty":
            command.move_command.SetInParent()
        for name in ("kick_speed", "kick_angle", "dribbler_speed"):
            if draw(st.booleans()):
                setattr(command, name, draw(NUMBERS))
    return message


@given(message=controls(), team=st.sampled_from([BLUE, YELLOW]), seed=st.integers(0, 9))
@settings(deadline=None, max_examples=300)
def test_both_read_the_same(message: simulation_pb2.RobotControl, team: int, seed: int) -> None:
    data = message.SerializeToString()
    previous = np.random.default_rng(seed).uniform(0.0, 1.0, (12, 6)).astype(np.float32)
    fast = READER.read(data, team, previous)
    try:
        parsed = parse(simulation_pb2.RobotControl, data)
    except MessageError:
        assert fast is None
        return
    slow = read_robot_control(LAYOUT, parsed, team, FRAME, 0, previous)
    if fast is None:
        return
    assert not slow.problems
    np.testing.assert_allclose(fast[0], slow.commands, rtol=1e-6, atol=1e-7)
    np.testing.assert_array_equal(fast[1], slow.given)


@given(message=controls(), team=st.sampled_from([BLUE, YELLOW]), seed=st.integers(0, 9))
@settings(deadline=None, max_examples=300)
def test_repeated_messages_are_read_as_the_first(
    message: simulation_pb2.RobotControl, team: int, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    first = ControlReader(LAYOUT)
    data = message.SerializeToString()
    for _ in range(2):  # the second one leaves a template
        first.read(data, team, np.zeros((12, 6), np.float32))
    for command in message.robot_commands:
        for name in ("kick_speed", "kick_angle", "dribbler_speed"):
            if command.HasField(name) and rng.uniform() < 0.5:
                setattr(command, name, rng.uniform(-1.0, 9.0))
        if command.move_command.HasField("local_velocity") and rng.uniform() < 0.5:
            command.move_command.local_velocity.left = rng.uniform(-3.0, 3.0)
    data, previous = message.SerializeToString(), rng.uniform(0.0, 1.0, (12, 6)).astype(np.float32)
    kept, new = (reader.read(data, team, previous) for reader in (first, ControlReader(LAYOUT)))
    assert (kept is None) == (new is None)
    if kept is not None and new is not None:
        for found, expected in zip(kept, new, strict=True):
            np.testing.assert_array_equal(found, expected)


def test_templates_are_used_and_other_messages_of_their_length_are_not_misread() -> None:
    reader = ControlReader(LAYOUT)

    def message(numbers: list[int], speed: float) -> bytes:
        control = simulation_pb2.RobotControl()
        for number in numbers:
            command = control.robot_commands.add(id=number, kick_speed=speed, kick_angle=0.0)
            command.dribbler_speed = 716.0
            local = command.move_command.local_velocity
            local.forward, local.left, local.angular = speed, -speed, 2 * speed
        return control.SerializeToString()

    previous = np.full((12, 6), 0.25, np.float32)
    for speed in (1.0, 2.0, 3.0):
        read = reader.read(message([0, 4], speed), BLUE, previous)
        assert read is not None
        np.testing.assert_allclose(read[0][[0, 4]], [[speed, -speed, 2 * speed, speed, 0, 0.5]] * 2)
        assert (np.delete(read[0], [0, 4], axis=0) == 0.25).all()
        assert np.flatnonzero(read[1]).tolist() == np.flatnonzero(read[2]).tolist() == [0, 4]
    assert any(kind.template for kind in reader._kinds.values())
    other = reader.read(message([1, 5], 4.0), BLUE, previous)
    assert other is not None
    assert np.flatnonzero(other[1]).tolist() == [1, 5]
    assert reader.read(message([1, 9], 4.0), BLUE, previous) is None, "no such robot"
    for wrong in (np.nan, -1.0, np.inf):
        assert reader.read(message([0, 4], wrong), BLUE, previous) is None


@pytest.mark.parametrize(
    ("field", "number", "is_read"),
    [
        ("forward", np.nextafter(np.float32(-1e9), np.float32(0.0)), True),
        ("forward", 1e9, False),
        ("left", -1e9, False),
        ("kick_speed", -0.0, True),
        ("kick_speed", -1e-45, False),
        ("kick_angle", -0.0, True),
        ("kick_angle", 1e-45, False),
        ("dribbler_speed", -0.0, True),
        ("dribbler_speed", -1e-45, False),
        ("dribbler_speed", 1e8, True),
    ],
)
def test_limits_of_numbers_in_templates(field: str, number: float, is_read: bool) -> None:
    message = simulation_pb2.RobotControl()
    command = message.robot_commands.add(id=2, kick_speed=1.0, kick_angle=0.0, dribbler_speed=1.0)
    local = command.move_command.local_velocity
    local.forward, local.left, local.angular = 1.0, 2.0, 3.0
    data = message.SerializeToString()
    template = MessageTemplate(message, data, {2: 2}, 12)
    setattr(local if field in ("forward", "left") else command, field, float(number))
    data, previous = message.SerializeToString(), np.full((12, 6), 0.25, np.float32)
    read = template.read(data, previous)
    assert (read is not None) is is_read
    if read is not None:
        expected = ControlReader(LAYOUT).read(data, BLUE, previous)
        assert expected is not None
        assert read.tobytes() == expected.commands.tobytes()


def test_clients_with_a_packet_for_each_robot_have_a_template_for_each(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    built: list[bytes] = []

    def counted(*args: Any) -> MessageTemplate:  # noqa: ANN401
        built.append(args[1])
        return MessageTemplate(*args)

    monkeypatch.setattr(control_reader, "MessageTemplate", counted)
    reader, previous = ControlReader(LAYOUT), np.zeros((12, 6), np.float32)
    for nth in range(60):
        message = simulation_pb2.RobotControl()
        message.robot_commands.add(id=nth % 6, kick_speed=nth)
        read = reader.read(message.SerializeToString(), BLUE, previous)
        assert read is not None
        assert read[0][nth % 6, 3] == nth
    assert len(built) == 6


def test_messages_that_no_template_fits_are_not_learned_again_and_again(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    built: list[bytes] = []

    def counted(*args: Any) -> MessageTemplate:  # noqa: ANN401
        built.append(args[1])
        raise ValueError("another encoder")

    monkeypatch.setattr(control_reader, "MessageTemplate", counted)
    reader, previous = ControlReader(LAYOUT), np.zeros((12, 6), np.float32)
    message = simulation_pb2.RobotControl()
    message.robot_commands.add(id=1, kick_speed=2.0)
    for _ in range(100):
        assert reader.read(message.SerializeToString(), BLUE, previous) is not None
    assert 0 < len(built) < 20


def test_common_messages_are_read_fast() -> None:
    message = simulation_pb2.RobotControl()
    for number in range(6):
        command = message.robot_commands.add(id=number, kick_speed=4.0, kick_angle=30.0)
        local = command.move_command.local_velocity
        local.forward, local.left, local.angular = 1.0, 2.0, 3.0
        command.dribbler_speed = 10_000.0
    read = READER.read(message.SerializeToString(), YELLOW, np.zeros((12, 6), np.float32))
    assert read is not None
    expected = [1.0, 2.0, 3.0, 4.0 * math.cos(math.pi / 6), 2.0, 1.0]
    np.testing.assert_allclose(read[0][6:], [expected] * 6, rtol=1e-6)
    assert read[1].tolist() == [False] * 6 + [True] * 6


@pytest.mark.parametrize("which", [[], [0, 2]])
def test_answers_are_those_of_the_protocol(which: list[int]) -> None:
    frame = Frame.empty(1, 6, 6)
    frame.robots.infrared[0, [2, 8]] = 1.0
    frame.robots.absent[0, 5] = 1.0
    given_robots = np.zeros(12, np.bool_)
    given_robots[which] = True
    expected = to_robot_control_response(LAYOUT, frame, 0, BLUE, given_robots if which else None)
    for _ in range(2):
        data = READER.answer(frame, BLUE, given_robots)
        assert simulation_pb2.RobotControlResponse.FromString(data) == expected
