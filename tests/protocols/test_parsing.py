"""From bytes to messages."""

import math

import pytest
from google.protobuf.message import Message

from rsoccer.protocols.errors import Code, MessageError
from rsoccer.protocols.parsing import MAX_SIZE, check_finite, parse
from rsoccer.protocols.schemas import fira_pb2, referee_pb2, simulation_pb2, tracker_pb2, vision_pb2


def delimited(number: int, data: bytes) -> bytes:
    """A field of bytes on the wire."""
    return varint(number * 8 + 2) + varint(len(data)) + data


def varint(value: int) -> bytes:
    return bytes([value]) if value < 128 else bytes([value % 128 + 128]) + varint(value // 128)


def refused(kind: type[Message], data: bytes, text: str) -> Code:
    with pytest.raises(MessageError, match=text) as error:
        parse(kind, data)
    return error.value.code


def test_garbage_is_refused() -> None:
    text = "^message: expected a rsoccer.vision.Packet"
    assert refused(vision_pb2.Packet, b"\xff\xff\xff", text) is Code.UNREADABLE


def test_messages_without_required_fields_are_refused() -> None:
    data = simulation_pb2.RobotControl()
    data.robot_commands.add(kick_speed=1.0)
    text = r"^message: expected .*id"
    code = refused(simulation_pb2.RobotControl, data.SerializePartialToString(), text)
    assert code is Code.UNREADABLE


def test_messages_longer_than_a_datagram_are_refused() -> None:
    text = f"^message: expected at most {MAX_SIZE} bytes, got {MAX_SIZE + 1}"
    assert refused(fira_pb2.Packet, bytes(MAX_SIZE + 1), text) is Code.TOO_LARGE


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 1e9, -2e9, 1e300])
def test_wild_numbers_are_refused_at_any_depth(value: float) -> None:
    message = fira_pb2.Packet()
    message.replace.robots.add().position.x = value
    text = r"^Robot.x: expected a finite number below 1e\+09"
    assert refused(fira_pb2.Packet, message.SerializeToString(), text) is Code.NOT_FINITE
    message.replace.robots[0].position.x = 1.0
    assert parse(fira_pb2.Packet, message.SerializeToString()) == message


def test_times_may_be_large_but_finite() -> None:
    frame = tracker_pb2.TrackedFrame(frame_number=1, timestamp=1.8e9)
    packet = tracker_pb2.Packet(uuid="a", tracked_frame=frame)
    assert parse(tracker_pb2.Packet, packet.SerializeToString()) == packet
    packet.tracked_frame.timestamp = math.nan
    text = "^TrackedFrame.timestamp: expected a finite number"
    assert refused(tracker_pb2.Packet, packet.SerializeToString(), text) is Code.NOT_FINITE


def test_events_that_contain_each_other_are_refused_beyond_a_depth() -> None:
    data = b""
    for _ in range(200):
        data = b"\x08\x02" + delimited(2, data)  # MultipleFouls: its team and its cause
        data = delimited(34, data)  # GameEvent.multiple_fouls
    assert refused(referee_pb2.GameEvent, data, "^message: expected") is Code.UNREADABLE


def test_messages_without_numbers_need_no_check() -> None:
    check_finite(simulation_pb2.Response())


def test_unknown_fields_are_ignored() -> None:
    command = simulation_pb2.RobotCommand(id=1)
    assert parse(simulation_pb2.RobotCommand, command.SerializeToString() + b"\xf8\x01\x01").id == 1
