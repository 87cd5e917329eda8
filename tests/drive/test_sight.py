"""From frames of vision and trackers to states."""

from __future__ import annotations

import numpy as np
import pytest

from rsoccer import SimConfig
from rsoccer.drive.sight import FAR_BALLS, FAR_ROBOTS, OLDER_FRAMES, UNCONFIRMED_FRAMES
from rsoccer.drive.state_sight import FiraSight, make_sight
from rsoccer.frame import Frame
from rsoccer.game import BLUE, YELLOW
from rsoccer.protocols import fira, tracker, vision
from rsoccer.protocols.cameras import Camera
from rsoccer.protocols.errors import MessageError
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.schemas import vision_pb2

CONFIG = SimConfig("ssl_b", 2, 1)
WHOLE = SimConfig("ssl_b", 4, 2)
VSS = SimConfig("vss_3v3", 3, 3)


def state(config: SimConfig, shift: float = 0.0) -> Frame:
    frame = Frame.empty(1, config.n_blue, config.n_yellow)
    frame.ball.position[0] = 0.3 + shift, -0.2
    for slot in range(config.n_robots):
        frame.robots.position[0, slot] = 0.4 * slot - 1.0 + shift, 0.7
        angle = 0.5 * slot
        frame.robots.heading[0, slot] = np.cos(angle), np.sin(angle)
    frame.ball.velocity[0] = 0.6, 0.0
    frame.robots.velocity[0] = 0.6, 0.0
    return frame


def read(sight: object, config: SimConfig) -> Frame:
    row = np.full((1, config.row_size), np.nan, np.float32)
    sight.read(row)  # type: ignore[attr-defined]
    return Frame(row, config.n_blue, config.n_yellow)


def packet(layout: WireLayout, frame: Frame, number: int, time: float, **others: object) -> bytes:
    message = vision.to_packet(
        layout,
        frame,
        frame_number=number,
        t_capture=time,
        t_sent=time,
        **others,  # type: ignore[arg-type]
    )
    data: bytes = message.SerializeToString()
    return data


@pytest.mark.parametrize("exchanged", [False, True])
@pytest.mark.parametrize("positive", [False, True])
@pytest.mark.parametrize("source", ["vision", "tracker"])
def test_the_state_is_that_of_the_sender(source: str, positive: bool, exchanged: bool) -> None:
    numbers = {"blue_on_positive_half": positive, "colors_exchanged": exchanged}
    layout = WireLayout(CONFIG, blue_ids=(7, 3), **numbers)  # type: ignore[arg-type]
    sight = make_sight(layout, "ssl", source)
    for number in range(60):
        time = 50.0 + number / 60
        frame = state(CONFIG, 0.01 * number)
        if source == "vision":
            data = packet(layout, frame, number, time)
        else:
            message = tracker.to_packet(
                layout, frame, frame_number=number, timestamp=time, uuid="one"
            )
            data = message.SerializeToString()
        assert sight.take(data)
    found, expected = read(sight, CONFIG), state(CONFIG, 0.59)
    np.testing.assert_allclose(found.ball.position, expected.ball.position, atol=2e-3)
    np.testing.assert_allclose(found.robots.position, expected.robots.position, atol=2e-3)
    np.testing.assert_allclose(found.robots.heading, expected.robots.heading, atol=2e-3)
    np.testing.assert_allclose(found.ball.velocity, expected.ball.velocity, atol=0.02)
    np.testing.assert_allclose(found.robots.velocity, expected.robots.velocity, atol=0.02)
    assert sight.numbers(YELLOW if exchanged else BLUE) == [3, 7]
    assert sight.clock.now == pytest.approx(59 / 60)


def test_robots_of_no_match_are_strangers() -> None:
    sight = make_sight(WireLayout(CONFIG), "ssl", "vision")
    sight.take(packet(WireLayout(WHOLE), state(WHOLE), 0, 1.0))
    assert sight.strangers == [(BLUE, 2), (BLUE, 3), (YELLOW, 1)]
    assert sight.in_sight.all()


@pytest.mark.parametrize(
    ("source", "how"), [("vision", "far"), ("vision", "turned"), ("tracker", "far")]
)
def test_robots_that_are_not_believed_are_out_of_sight(source: str, how: str) -> None:
    layout, frame = WireLayout(CONFIG), state(CONFIG)
    sight = make_sight(layout, "ssl", source)
    for number in range(60):
        time = number / 60
        if source == "vision":
            data = packet(layout, frame, number, time)
            message = vision_pb2.Packet.FromString(data)
            if number > 20 and how == "far":
                message.detection.robots_blue[1].x = 1e6
                message.detection.balls[0].x = 1e6
            elif number > 20:
                message.detection.robots_blue[1].ClearField("orientation")
            sight.take(message.SerializeToString())
        else:
            tracked = tracker.to_packet(
                layout, frame, frame_number=number, timestamp=time, uuid="one"
            )
            if number > 20:
                tracked.tracked_frame.robots[1].pos.x = 1e3
                tracked.tracked_frame.balls[0].pos.x = 1e3
            sight.take(tracked.SerializeToString())
        np.testing.assert_allclose(
            read(sight, CONFIG).ball.position, frame.ball.position, atol=2e-3
        )
    assert sight.in_sight.tolist() == [True, False, True]
    assert read(sight, CONFIG).robots.absent[0].tolist() == [0.0, 1.0, 0.0]
    assert sight.numbers(BLUE) == [0]
    assert not sight.strangers
    unturned = {"robots: without orientation": 39}
    expected = {"far": {FAR_ROBOTS: 39, FAR_BALLS: 39}, "turned": unturned}
    assert sight.counts == expected[how]


def test_frames_and_their_copies_are_counted_once_for_all_cameras() -> None:
    layout = WireLayout(CONFIG)
    sight = make_sight(layout, "ssl", "vision")
    counts = []
    for number, camera in [(0, 0), (0, 1), (1, 0), (1, 1), (1, 0), (1, 1), (2, 1)]:
        message = vision.to_packet(
            layout, state(CONFIG), frame_number=number, t_capture=number / 60, t_sent=0.0
        )
        message.detection.camera_id = camera
        sight.take(message.SerializeToString())
        counts.append(sight.frames)
    assert counts == [1, 1, 2, 2, 3, 3, 4]


@pytest.mark.parametrize("offset", [-0.004, 0.004])
def test_all_cameras_count_whose_stamps_are_offset(offset: float) -> None:
    layout = WireLayout(CONFIG)
    sight = make_sight(layout, "ssl", "vision")
    for number in range(60):
        frame, time = state(CONFIG, 0.01 * number), 1.0 + number / 60
        for camera, robots in ((0, [True, False, True]), (1, [False, True, False])):
            message = vision.to_packet(
                layout,
                frame,
                frame_number=number,
                t_capture=time + camera * offset,
                t_sent=time,
                robots=np.array(robots),
                ball=camera == 1,
            )
            message.detection.camera_id = camera
            sight.take(message.SerializeToString())
    assert sight.has_ball
    assert sight.in_sight.all()
    assert not sight.counts
    found, expected = read(sight, CONFIG), state(CONFIG, 0.59)
    np.testing.assert_allclose(found.ball.position, expected.ball.position, atol=6e-3)
    np.testing.assert_allclose(found.robots.position, expected.robots.position, atol=6e-3)
    np.testing.assert_allclose(found.robots.velocity, expected.robots.velocity, atol=0.03)


def test_frames_that_are_late_are_counted() -> None:
    sight = make_sight(WireLayout(CONFIG), "ssl", "vision")
    for number, time in enumerate((1.0, 1.02, 1.01, 500.0)):
        assert sight.take(packet(WireLayout(CONFIG), state(CONFIG), number, time)) == (number < 2)
    assert sight.counts == {OLDER_FRAMES: 1, UNCONFIRMED_FRAMES: 1}


def test_the_likeliest_ball_on_the_field_counts() -> None:
    message = vision_pb2.Packet.FromString(packet(WireLayout(CONFIG), state(CONFIG), 0, 1.0))
    message.detection.balls[0].confidence = 0.4
    far = message.detection.balls.add(confidence=1.0, x=1e8, y=0.0, pixel_x=0.0, pixel_y=0.0)
    other = message.detection.balls.add(confidence=0.9, x=500.0, y=0.0, pixel_x=0.0, pixel_y=0.0)
    sight = make_sight(WireLayout(CONFIG), "ssl", "vision")
    sight.take(message.SerializeToString())
    assert far.confidence > other.confidence > message.detection.balls[0].confidence
    assert read(sight, CONFIG).ball.position[0].tolist() == [0.5, 0.0]


def test_another_tracker_is_refused() -> None:
    layout = WireLayout(CONFIG)
    sight = make_sight(layout, "ssl", "tracker")
    for name in ("one", "two"):
        data = tracker.to_packet(
            layout, state(CONFIG), frame_number=0, timestamp=1.0, uuid=name, source_name=name
        ).SerializeToString()
        if name == "one":
            assert sight.take(data)
            continue
        with pytest.raises(MessageError, match="expected one source, got two too"):
            sight.take(data)


def test_a_tracker_that_starts_again_is_taken() -> None:
    layout, wall = WireLayout(CONFIG), [7.0]
    sight = make_sight(layout, "ssl", "tracker", lambda: wall[0])
    refused = taken = 0
    for number in range(120):
        wall[0] += 1 / 60
        name = "one" if number < 30 else "two"
        data = tracker.to_packet(
            layout, state(CONFIG), frame_number=number, timestamp=number / 60, uuid=name
        ).SerializeToString()
        try:
            taken += sight.take(data)
        except MessageError:
            refused += 1
    assert 29 <= refused <= 31
    # The time of its stamps is confirmed first, if it was silent for that long.
    assert taken >= 120 - 31 - 3
    assert sight.counts["tracker: another source"] == 1
    assert sight.in_sight.all()


def test_a_field_without_a_size_is_none() -> None:
    layout = WireLayout(CONFIG)
    sight = make_sight(layout, "ssl", "vision")
    message = vision_pb2.Packet.FromString(
        packet(layout, state(CONFIG), 0, 50.0, geometry=[Camera()])
    )
    known = (CONFIG.field.length, CONFIG.field.width)
    for size, expected in (((0, 0), None), (None, known), ((0, 9000), known)):
        field = vision_pb2.Packet.FromString(message.SerializeToString())
        if size is not None:
            field.geometry.field.field_length, field.geometry.field.field_width = size
        sight.take(field.SerializeToString())
        assert sight.field_size == (None if expected is None else pytest.approx(expected))


def test_robots_out_of_sight_are_absent() -> None:
    layout = WireLayout(VSS, blue_on_positive_half=True)
    sight = FiraSight(layout)
    for number in range(60):
        frame = state(VSS)
        frame.robots.absent[0, 1] = number > 20
        message = fira.to_environment(layout, frame, seconds=0.016 * number, score=(0, 0))
        sight.take(message.SerializeToString())
    found = read(sight, VSS)
    assert found.robots.absent[0].tolist() == [0.0, 1.0, 0.0, 0.0, 0.0, 0.0]
    assert sight.in_sight.tolist() == [True, False, True, True, True, True]
    assert sight.field_size == pytest.approx((1.5, 1.3))
    np.testing.assert_allclose(found.ball.velocity, [[0.6, 0.0]], atol=1e-6)


def test_other_sides_begin_anew() -> None:
    sight = make_sight(WireLayout(CONFIG), "ssl", "vision")
    other = WireLayout(CONFIG, blue_on_positive_half=True)
    sight.take(packet(WireLayout(CONFIG), state(CONFIG), 0, 1.0))
    sight.turn(other)
    assert not sight.has_ball
    sight.take(packet(other, state(CONFIG), 1, 1.02))
    found = read(sight, CONFIG)
    np.testing.assert_allclose(found.ball.position, state(CONFIG).ball.position, atol=1e-5)
    assert not found.robots.velocity.any()
