"""Messages that the package reads and writes, as the table of fields measures them."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterable, Iterator
from typing import Any, Final, NamedTuple

import numpy as np
from google.protobuf.message import Message

from rsoccer import RobotModel, SimConfig
from rsoccer.arrays import Floats
from rsoccer.frame import Frame
from rsoccer.game import BLUE, YELLOW, Command, Event, EventKind, Stage
from rsoccer.protocols import (
    answers,
    fira,
    grsim,
    referee,
    robot_control,
    simulator_control,
    tracker,
    vision,
    vssref,
)
from rsoccer.protocols.cameras import Camera
from rsoccer.protocols.errors import Code, Problem
from rsoccer.protocols.game_events import ReportedEvent
from rsoccer.protocols.geometry import to_field
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.robot_specs import to_robot_specs
from rsoccer.protocols.schemas import (
    fira_pb2,
    grsim_pb2,
    referee_pb2,
    simulation_pb2,
    tracker_pb2,
    vision_pb2,
    vssref_pb2,
)
from tools.protocols.samples import fill, sample

SSL: Final = WireLayout(SimConfig("ssl_b", 6, 6))
"""Match of the SSL that messages are about."""
VSSS: Final = WireLayout(SimConfig("vss_5v5", 5, 5))
"""Match of VSSS that messages are about."""


class Reader(NamedTuple):
    """A kind of message that the package reads."""

    protocol: str
    """Name of the protocol."""
    kind: type[Message]
    """Class of the message."""
    read: Callable[[Any], tuple[object, Iterable[Problem]]]
    """From a message to what it means, and what is not honored."""


def _state(layout: WireLayout, seed: int) -> Frame:
    """A state with every body at a place of its own, in motion."""
    config, rng = layout.config, np.random.default_rng(seed)
    frame = Frame.empty(1, config.n_blue, config.n_yellow)
    angles = rng.uniform(-3.0, 3.0, config.n_robots)
    frame.robots.position[:] = rng.uniform(-0.5, 0.5, (config.n_robots, 2))
    frame.robots.heading[:] = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    frame.robots.velocity[:] = rng.uniform(-1.0, 1.0, (config.n_robots, 2))
    frame.robots.angular_velocity[:] = rng.uniform(-1.0, 1.0, config.n_robots)
    frame.robots.touched_ball[:] = rng.integers(0, 2, config.n_robots)
    frame.robots.infrared[:] = rng.integers(0, 2, config.n_robots)
    frame.ball.position[:] = rng.uniform(-0.5, 0.5, 2)
    frame.ball.velocity[:] = rng.uniform(-1.0, 1.0, 2)
    frame.ball.height[:], frame.ball.vertical_velocity[:] = rng.uniform(0.1, 1.0, 2)
    return frame


_SSL_STATE: Final = _state(SSL, 1)
_VSSS_STATE: Final = _state(VSSS, 1)


def _read_vision(message: vision_pb2.Packet) -> tuple[object, Iterable[Problem]]:
    seen = vision.to_detections(SSL, message.detection)
    field = to_field(message.geometry) if message.HasField("geometry") else None
    return (seen, field), seen.problems


def _read_vision_2010(message: vision_pb2.Packet2010) -> tuple[object, Iterable[Problem]]:
    seen = vision.to_detections(SSL, message.detection)
    return seen, seen.problems


def _read_tracker(message: tracker_pb2.Packet) -> tuple[object, Iterable[Problem]]:
    tracked = tracker.to_frame(SSL, message.tracked_frame, _SSL_STATE)
    return (message.uuid, tracked), tracked.problems


def _read_referee(message: referee_pb2.Packet) -> tuple[object, Iterable[Problem]]:
    status, problems = referee.read_packet(SSL, message)
    return (status, referee.read_stamp(message)), problems


def _read_command(message: simulation_pb2.Command) -> tuple[object, Iterable[Problem]]:
    result = simulator_control.read_command(SSL, message, _SSL_STATE)
    return result, result.problems


def _read_robot_control(message: simulation_pb2.RobotControl) -> tuple[object, Iterable[Problem]]:
    result = robot_control.read_robot_control(SSL, message, BLUE, _SSL_STATE)
    return result, result.problems


def _read_feedback(
    message: simulation_pb2.RobotControlResponse,
) -> tuple[object, Iterable[Problem]]:
    return (answers.read_feedback(SSL, message, BLUE), answers.read_errors(message)), ()


def _read_response(message: simulation_pb2.Response) -> tuple[object, Iterable[Problem]]:
    return answers.read_errors(message), ()


def _read_grsim(message: grsim_pb2.Packet) -> tuple[object, Iterable[Problem]]:
    commands = grsim.read_commands(SSL, message)
    placement = grsim.read_replacement(SSL, message, _SSL_STATE)
    return (commands, placement), (*commands.problems, *placement.problems)


def _read_grsim_status(message: grsim_pb2.StatusPacket) -> tuple[object, Iterable[Problem]]:
    return grsim.read_status(SSL, message, BLUE), ()


def _read_fira(message: fira_pb2.Packet) -> tuple[object, Iterable[Problem]]:
    commands = fira.read_commands(VSSS, message)
    placement = fira.read_replacement(VSSS, message, _VSSS_STATE)
    return (commands, placement), (*commands.problems, *placement.problems)


def _read_environment(message: fira_pb2.Environment) -> tuple[object, Iterable[Problem]]:
    tracked = fira.read_environment(VSSS, message, _VSSS_STATE)
    return (tracked, fira.read_score(message)), tracked.problems


def _read_vssref(message: vssref_pb2.Command) -> tuple[object, Iterable[Problem]]:
    return vssref.read_command(message), ()


def _read_placement(message: vssref_pb2.Placement) -> tuple[object, Iterable[Problem]]:
    placement = vssref.read_placement(VSSS, message, _VSSS_STATE)
    return placement, placement.problems


READERS: Final = (
    Reader("ssl-vision", vision_pb2.Packet, _read_vision),
    Reader("ssl-vision", vision_pb2.Packet2010, _read_vision_2010),
    Reader("tracker", tracker_pb2.Packet, _read_tracker),
    Reader("game controller", referee_pb2.Packet, _read_referee),
    Reader("simulation protocol", simulation_pb2.Command, _read_command),
    Reader("simulation protocol", simulation_pb2.Response, _read_response),
    Reader("simulation protocol", simulation_pb2.RobotControl, _read_robot_control),
    Reader("simulation protocol", simulation_pb2.RobotControlResponse, _read_feedback),
    Reader("grSim", grsim_pb2.Packet, _read_grsim),
    Reader("grSim", grsim_pb2.StatusPacket, _read_grsim_status),
    Reader("FIRASim", fira_pb2.Packet, _read_fira),
    Reader("FIRASim", fira_pb2.Environment, _read_environment),
    Reader("VSSReferee", vssref_pb2.Command, _read_vssref),
    Reader("VSSReferee", vssref_pb2.Placement, _read_placement),
)
"""All kinds of messages that the package reads."""
UNREAD: Final = (
    ("simulation protocol", simulation_pb2.SyncRequest),
    ("simulation protocol", simulation_pb2.SyncResponse),
)
"""Kinds of messages that the package neither reads nor writes."""


def bases(kind: type[Message], count: int = 8) -> Iterator[Message]:
    """Yield messages with all fields, from which measurements begin.

    Args:
        kind: class of the messages.
        count: number of messages; they differ in their choices. Those of the game controller have
            each kind of event.
    """
    rng = random.Random(0)
    if kind is referee_pb2.Packet:
        yield from _referee_bases(rng)
        return
    geometry = next(iter(_vision())).geometry
    for _ in range(count):
        message = sample(kind, rng)
        if isinstance(message, vision_pb2.Packet):
            message.geometry.field.MergeFrom(geometry.field)
        elif isinstance(message, simulation_pb2.Command):
            _put_specs(message)
        yield message


def _put_specs(message: simulation_pb2.Command) -> None:
    """Replace the random robots in a message by ones that can exist, also if they grow somewhat."""
    model = RobotModel("ssl_generic", radius=0.08, max_speed=3.0)
    for specs in message.config.robot_specs:
        identity = simulation_pb2.RobotId(id=1, team=simulation_pb2.YELLOW)
        specs.CopyFrom(to_robot_specs(model, identity))
        specs.custom.add(type_url="a")


def _referee_bases(rng: random.Random) -> Iterator[referee_pb2.Packet]:
    """Yield packets with an event each, with and without its type."""
    packet = sample(referee_pb2.Packet, rng)
    assert isinstance(packet, referee_pb2.Packet)
    for field in referee_pb2.GameEvent.DESCRIPTOR.oneofs[0].fields:
        for name in ("", field.name.upper()):
            del packet.game_events[:]
            event = packet.game_events.add(id=field.name, created_timestamp=1, origin=["a"])
            content = getattr(event, field.name)
            content.SetInParent()
            fill(content, rng, depth=2)
            if name in referee_pb2.GameEvent.Type.keys():  # noqa: SIM118
                event.type = getattr(referee_pb2.GameEvent, name)
            yield packet


def written() -> Iterator[Message]:
    """Yield messages of all kinds that the package writes, of several states."""
    yield from _vision()
    yield from _tracker()
    yield from _referee()
    yield from _simulation()
    yield from _small()


def _vision() -> Iterator[vision_pb2.Packet]:
    for seed in (1, 2):
        yield vision.to_packet(
            SSL,
            _state(SSL, seed),
            frame_number=seed,
            t_capture=seed + 0.5,
            t_sent=seed + 0.6,
            camera=Camera(seed, (0.1 * seed, 0.2, 4.0 + seed), 300.0 + seed, (700 + seed, 500)),
            geometry=[Camera(seed, (0.1, 0.2 * seed, 4.0 + seed), 300.0 + seed, (700, 500 + seed))],
            source=vision_pb2.SOURCE_OTHER,
        )


def _tracker() -> Iterator[tracker_pb2.Packet]:
    for seed in (1, 2):
        yield tracker.to_packet(
            SSL, _state(SSL, seed), frame_number=seed, timestamp=seed + 0.5, uuid=f"id {seed}"
        )


def _referee() -> Iterator[referee_pb2.Packet]:
    side = WireLayout(SSL.config, blue_on_positive_half=True)
    events = [
        ReportedEvent(Event(kind, team, robot, (0.1 + team, 0.2)), f"{kind}-{team}", 1.0 + team)
        for kind in EventKind
        for team, robot in ((BLUE, 2), (YELLOW, 9))
    ]
    for number, layout in ((1, SSL), (2, side)):
        teams = tuple(
            referee.TeamStatus(
                name=f"{name} {number}",
                score=number,
                goalkeeper=number,
                fouls=number,
                yellow_cards=number,
                yellow_card_seconds=(10.0 * number,),
                red_cards=number,
                max_robots=number,
                placement_failures=number,
                may_place=number == 1,
            )
            for name in ("a", "b")
        )
        status = referee.RefereeStatus(
            command=Command.BALL_PLACEMENT_BLUE if number == 1 else Command.BALL_PLACEMENT_YELLOW,
            stage=Stage(number),
            teams=(teams[0], teams[1]),
            next_command=Command.DIRECT_FREE_BLUE if number == 1 else Command.FORCE_START,
            seconds_left=10.0 * number,
            action_seconds_left=float(number),
            designated_position=(0.1 * number, 0.2 * number),
            events=tuple(events),
        )
        stamp = referee.Stamp(number + 0.5, number, number + 0.25)
        yield referee.to_packet(
            layout,
            status,
            stamp,
            source_identifier=f"id {number}",
            match_type=number,
            status_message=f"text {number}",
        )


def _commands(layout: WireLayout, seed: int) -> Floats:
    rng = np.random.default_rng(seed)
    shape = (layout.config.n_robots, len(layout.config.command_columns))
    return rng.uniform(0.0, 3.0, shape).astype(np.float32)


def _simulation() -> Iterator[Message]:
    problems = [Problem(Code.OUT_OF_RANGE, "text"), Problem(Code.INCOMPLETE, "other")]
    for seed, team in ((1, BLUE), (2, YELLOW)):
        yield robot_control.to_robot_control(SSL, _commands(SSL, seed), team)
        yield answers.to_robot_control_response(SSL, _state(SSL, seed), 0, team, problems=problems)
        identity = simulation_pb2.RobotId(id=seed, team="BLUE" if team == BLUE else "YELLOW")
        model = SSL.config.robots[0]
        specs = to_robot_specs(model, identity)
        yield simulation_pb2.Command(config=simulation_pb2.Config(robot_specs=[specs]))
    yield answers.to_response(problems)


def _small() -> Iterator[Message]:
    for seed, team in ((1, BLUE), (2, YELLOW)):
        commands = _commands(SSL, seed)
        commands[::2, -2:] = 0.0
        yield grsim.to_commands(SSL, commands, team, timestamp=float(seed))
        yield grsim.to_replacement(SSL, _with_absent(_state(SSL, seed)))
        yield grsim.to_status(SSL, _state(SSL, seed), 0, team, commands)
        yield fira.to_commands(VSSS, _commands(VSSS, seed), team)
        yield fira.to_replacement(VSSS, _with_absent(_state(VSSS, seed)))
        yield fira.to_environment(VSSS, _state(VSSS, seed), seconds=seed, score=(seed, 2 * seed))
        yield vssref.to_placement(VSSS, _state(VSSS, seed), 0, team)
        place = (0.1, 0.2) if team == BLUE else (-0.1, 0.2)
        stage = Stage(3 * seed - 2)
        for command in (Command.FREE_BALL, Command.GOAL_KICK_BLUE, Command.GOAL_KICK_YELLOW):
            yield vssref.to_command(VSSS, command, stage, timestamp=float(seed), position=place)


def _with_absent(frame: Frame) -> Frame:
    """The state without one robot."""
    frame.robots.absent[0, 0] = 1.0
    return frame
