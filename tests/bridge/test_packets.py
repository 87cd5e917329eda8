"""Packets that are written as rows of bytes are those of the protocols, field by field."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest

from rsoccer import Sensing
from rsoccer.bridge.arena import Arena, CameraFrame
from rsoccer.bridge.match_tasks import make_match
from rsoccer.bridge.message_rows import MessageRows, field_of
from rsoccer.bridge.tracker_packets import SOURCE_NAME, TrackerPackets
from rsoccer.bridge.vision_packets import VisionPackets
from rsoccer.protocols import tracker, vision
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.schemas import tracker_pb2, vision_pb2


@pytest.fixture
def arena() -> Arena:
    """A match in which robots have moved, and one is absent."""
    arena = Arena(make_match("ssl", "A", None, {}), Sensing(frame_rate=0.0, delay=1e-6), 5)
    commands = np.zeros_like(arena.play.commands[0])
    commands[:, :3] = np.random.default_rng(1).uniform(-2.0, 2.0, (22, 3))
    frame = arena.play.frame
    frame.robots.absent[0, 4] = 1.0
    arena.simulator.restart(np.ones(1, np.bool_), frame.rows.copy(), frame.rows)
    for _ in range(60):
        arena.step(commands)
    return arena


@pytest.mark.parametrize("side", [False, True])
def test_vision(arena: Arena, side: bool) -> None:
    layout = WireLayout(arena.config, blue_on_positive_half=side)
    packets = VisionPackets(layout, arena.sensing, 1000.0)
    (seen,) = arena.camera_frames
    (data,) = packets.of(seen, arena.seconds, geometry=True)
    got = vision_pb2.Packet.FromString(data)
    expected = vision.to_packet(
        layout,
        arena.sense(),
        frame_number=seen.number,
        t_capture=1000.0 + seen.seconds,
        t_sent=1000.0 + arena.seconds,
        camera=packets.cameras[0],
        geometry=packets.cameras,
    )
    assert len(got.detection.robots_blue) == 10
    assert len(got.detection.robots_yellow) == 11
    _assert_close(got, expected)


@pytest.mark.parametrize("side", [False, True])
def test_tracker(arena: Arena, side: bool) -> None:
    layout = WireLayout(arena.config, blue_on_positive_half=side)
    frame = arena.sense()
    got = tracker_pb2.Packet.FromString(TrackerPackets(layout, 5.0, "one").of(frame, 7, 2.0))
    expected = tracker.to_packet(
        layout, frame, frame_number=7, timestamp=7.0, uuid="one", source_name=SOURCE_NAME
    )
    assert len(got.tracked_frame.robots) == 21
    _assert_close(got, expected)


def test_each_camera_tells_what_it_saw() -> None:
    arena = Arena(make_match("ssl", "B", None, {}), Sensing("realistic"), 1)
    packets = VisionPackets(WireLayout(arena.config), arena.sensing, 0.0)
    balls = np.array([[0, -1.0, 0.5, 0.0], [1, 1.0, 0.5, 0.0], [1, 2.0, 0.0, 0.0]], np.float32)
    robots = np.array([[0, 3, 1.0, 2.0, 0.0, 1.0], [1, 7, -1.0, 2.0, -1.0, 0.0]], np.float32)
    first, second = (
        vision_pb2.Packet.FromString(data).detection
        for data in packets.of(CameraFrame(9, 1.0, balls, robots), 1.045)
    )
    assert (first.camera_id, second.camera_id) == (0, 1)
    assert [len(each.balls) for each in (first, second)] == [1, 2]
    assert [robot.robot_id for robot in first.robots_blue] == [3]
    assert [robot.robot_id for robot in second.robots_yellow] == [1]
    assert first.robots_blue[0].orientation == pytest.approx(np.pi / 2)
    nothing = CameraFrame(9, 1.0, balls[:0], robots[:0])
    assert len(packets.of(nothing, 1.0)) == 2, "a camera that sees nothing tells so"


@pytest.mark.parametrize("side", [False, True])
def test_cameras_see_what_is_below_them(side: bool) -> None:
    arena = Arena(make_match("ssl", "B", None, {}), Sensing("rc2021"), 1)
    packets = VisionPackets(WireLayout(arena.config, blue_on_positive_half=side), arena.sensing, 0)
    frames = []
    for _ in range(200):
        arena.step(np.zeros_like(arena.play.commands[0]))
        frames += arena.camera_frames
    seen = max(frames, key=lambda frame: len(frame.robots))
    messages = [
        vision_pb2.Packet.FromString(data)
        for data in packets.of(seen, arena.seconds, geometry=True)
    ]
    calibrations = messages[0].geometry.calib
    assert len(calibrations) == len(packets.cameras) == 2
    half = arena.config.field.length / 4 * 1000 + 500  # cameras overlap
    found = 0
    for message, camera, calibration in zip(messages, packets.cameras, calibrations, strict=True):
        detection = message.detection
        assert calibration.camera_id == detection.camera_id == camera.camera_id
        place = calibration.derived_camera_world_tx
        assert place == pytest.approx(1000 * camera.position[0])
        robots: list[Any] = [*detection.robots_blue, *detection.robots_yellow]
        heights = [robot.height / 1000 for robot in robots]
        balls: list[Any] = list(detection.balls)
        heights += [arena.config.ball.radius for _ in balls]
        for each, height in zip([*robots, *balls], heights, strict=True):
            assert abs(each.x - place) < half, "a camera reports what is below it"
            pixels = camera.pixels(np.array([each.x / 1000, each.y / 1000, height]))
            assert (each.pixel_x, each.pixel_y) == pytest.approx(tuple(pixels), abs=0.1)
            assert (each.pixel_x > camera.image_size[0] / 2) == (each.x > place)
            found += 1
    assert found >= 12


def test_rows_are_of_one_length() -> None:
    def make(slot: int, numbers: Sequence[float]) -> vision_pb2.DetectionFrame:
        frame = vision_pb2.DetectionFrame()
        (x,) = numbers
        frame.robots_blue.add(robot_id=200 * slot, x=x)
        return frame

    with pytest.raises(ValueError, match="one length"):
        MessageRows(2, 1, make)


@pytest.mark.parametrize("size", [0, 127, 128, 20_000])
def test_fields_have_their_length(size: int) -> None:
    packet = vision_pb2.Packet()
    packet.detection.robots_blue.add()
    content = b"\x0a" + bytes([0]) if size == 0 else bytes(size)
    data = field_of(2, content)
    assert data.endswith(content)
    length, shift = 0, 0
    for byte in data[1:]:
        length |= (byte & 0x7F) << shift
        shift += 7
        if byte < 0x80:
            break
    assert (data[0], length) == (0x12, len(content))


def _assert_close(got: object, expected: object) -> None:
    """Compare two messages: numbers of single precision differ in the last digits at most."""
    assert type(got) is type(expected)
    names = [field.name for field, _ in got.ListFields()]  # type: ignore[attr-defined]
    assert names == [f.name for f, _ in expected.ListFields()]  # type: ignore[attr-defined]
    for field, value in got.ListFields():  # type: ignore[attr-defined]
        other = getattr(expected, field.name)
        values, others = (list(value), list(other)) if _is_list(value) else ([value], [other])
        assert len(values) == len(others), field.name
        for one, two in zip(values, others, strict=True):
            if hasattr(one, "ListFields"):
                _assert_close(one, two)
            elif isinstance(one, float):
                assert one == pytest.approx(two, rel=1e-5, abs=2e-3), field.name
            else:
                assert one == two, field.name


def _is_list(value: object) -> bool:
    return hasattr(value, "__len__") and not isinstance(value, str | bytes)
