"""Timing of `rsoccer serve` with eleven against eleven: `python -m benches.serve`.

Real time: the server and the clients of both teams are processes of their own on the loopback
interface. Each client commands all of its robots for each camera frame. The time between the
stamp of sending and the arrival, less the shortest one, is how late a frame is; a gap in the
numbers of frames is a lost one.

As fast as clients answer: the same with `--speed max`, and again without sockets in one process.
Speeds are simulated seconds in a second.
"""

import argparse
import multiprocessing
import os
import socket
import subprocess
import sys
import time
from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np

from benches.markdown import table
from rsoccer.bridge.server import Server
from rsoccer.bridge.settings import SSL_GROUPS, Settings
from rsoccer.bridge.sockets import LOOPBACK, group_receiver, receiver
from rsoccer.protocols.schemas import simulation_pb2, vision_pb2

LATE: Final = 0.005
"""Delay from which a frame is late, s."""
ROBOTS: Final = 11
NAMES: Final = ("control", "blue", "yellow", "grsim", "vision", "tracker", "referee")
PATIENCE: Final = 20.0
"""Longest wait for a frame, s."""


class Timing(NamedTuple):
    """Frames that a client received."""

    frames: int
    late: int
    lost: int
    latest: float
    """Greatest delay, s."""
    speed: float
    """Simulated seconds in a second."""


def control(turn: float) -> bytes:
    """Return a message that drives all robots of a team.

    Args:
        turn: angular velocity, rad/s.
    """
    message = simulation_pb2.RobotControl()
    for number in range(ROBOTS):
        command = message.robot_commands.add(id=number, dribbler_speed=0.0)
        local = command.move_command.local_velocity
        local.forward, local.left, local.angular = 0.5, 0.1, turn
    data: bytes = message.SerializeToString()
    return data


def play(port: int, vision: int, seconds: float, results: "multiprocessing.Queue[Timing]") -> None:
    """Drive a team for some seconds, and put the timing into a queue.

    Args:
        port: port of the team.
        vision: port of vision.
        seconds: duration from the first frame, s.
        results: queue of results.
    """
    # Made before, so that the speed is that of the server and of sockets.
    commands = [control(turn) for turn in range(-3, 4)]
    arrivals, sent, numbers = [], [], []
    with group_receiver(SSL_GROUPS["vision"], vision, LOOPBACK) as eye, receiver(LOOPBACK, 0) as me:
        eye.settimeout(PATIENCE)
        end = None
        while end is None or time.monotonic() < end:
            detection = vision_pb2.Packet.FromString(eye.recv(65535)).detection
            now = time.monotonic()
            end = now + seconds if end is None else end
            arrivals.append(now)
            sent.append(detection.t_sent)
            numbers.append(detection.frame_number)
            me.sendto(commands[len(numbers) % len(commands)], (LOOPBACK, port))
            drain(me)
    delays = np.array(arrivals) - np.array(sent)
    delays -= delays.min()
    gaps = np.diff(numbers)
    speed = (sent[-1] - sent[0]) / (arrivals[-1] - arrivals[0])
    lost = int(np.maximum(gaps - 1, 0).sum())
    results.put(Timing(len(numbers), int((delays > LATE).sum()), lost, float(delays.max()), speed))


def drain(source: socket.socket) -> None:
    """Read the answers that have come.

    Args:
        source: a socket that does not wait.
    """
    while True:
        try:
            source.recv(65535)
        except BlockingIOError:
            return


def free_ports(count: int) -> list[int]:
    """Return ports of this machine that nobody uses.

    Args:
        count: number of ports.
    """
    probes = [receiver(LOOPBACK, 0) for _ in range(count)]
    ports: list[int] = [probe.getsockname()[1] for probe in probes]
    for probe in probes:
        probe.close()
    return ports


def over_network(speed: str, seconds: float) -> list[Timing]:
    """Return the timing of both clients of a server in a process of its own.

    Args:
        speed: value of `--speed`.
        seconds: duration, s.
    """
    ports = dict(zip(NAMES, free_ports(len(NAMES)), strict=True))
    words = ["serve", "ssl", "--division", "A", "--speed", speed, "--ports"]
    words += [f"{name}={port}" for name, port in ports.items()]
    command = [sys.executable, "-m", "rsoccer", *words]
    context = multiprocessing.get_context("spawn")
    results: multiprocessing.Queue[Timing] = context.Queue()
    clients = [
        context.Process(target=play, args=(ports[team], ports["vision"], seconds, results))
        for team in ("blue", "yellow")
    ]
    with subprocess.Popen(command, stderr=subprocess.DEVNULL) as server:
        try:
            for client in clients:
                client.start()
            timings = [results.get(timeout=seconds + 6 * PATIENCE) for _ in clients]
        finally:
            server.terminate()
            for client in clients:
                client.join()
    return timings


def in_process(frames: int) -> tuple[float, float]:
    """Return the speed without sockets, by the time of the wall and of the processor.

    Args:
        frames: number of camera frames.
    """
    server = Server(Settings(division="A", speed=None))
    blue, yellow = (LOOPBACK, 1), (LOOPBACK, 2)
    message = control(1.0)

    def advance(count: int) -> None:
        for _ in range(count):
            server.receive("blue", message, blue, 0.0)
            server.receive("yellow", message, yellow, 0.0)
            server.advance(0.0)

    server.advance(0.0)
    advance(20)
    simulated = server.session.arena.seconds
    wall, processor = time.perf_counter(), time.process_time()
    advance(frames)
    simulated = server.session.arena.seconds - simulated
    return (
        simulated / (time.perf_counter() - wall),
        simulated / (time.process_time() - processor),
    )


def report(title: str, timings: Sequence[Timing], *, is_timed: bool = True) -> str:
    """Return a table of the clients' timing.

    Args:
        title: the kind of clock.
        timings: timing of each client.
        is_timed: whether frames have a time on the wall at which they are due.
    """
    columns = ("frames", "late", "lost", "latest", "speed")
    shown = [name for name in columns if is_timed or name not in ("late", "latest")]
    rows = []
    for team, timing in zip(("one team", "the other"), timings, strict=True):
        cells = {
            "frames": f"{timing.frames}",
            "late": f"{timing.late} ({timing.late / timing.frames:.2%})",
            "lost": f"{timing.lost}",
            "latest": f"{1000 * timing.latest:.1f} ms",
            "speed": f"{timing.speed:.2f}",
        }
        rows.append((team, *(cells[name] for name in shown)))
    return table((title, *shown), rows)


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure and print all timings.

    Args:
        arguments: words of the command line; None for those of the process.
    """
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=600.0, help="duration in real time")
    parser.add_argument("--fast-seconds", type=float, default=20.0, help="duration at full speed")
    parser.add_argument("--frames", type=int, default=2000, help="frames without sockets")
    given = parser.parse_args(arguments)
    load = f"load of the machine {os.getloadavg()[0]:.1f} on {os.cpu_count()} processors"
    sys.stdout.write(f"{load}\n")
    sys.stdout.write(report("real time", over_network("1", given.seconds)) + "\n")
    sys.stdout.write(
        report("with clients", over_network("max", given.fast_seconds), is_timed=False) + "\n"
    )
    wall, processor = in_process(given.frames)
    sys.stdout.write(f"without sockets: {wall:.1f} by the wall, {processor:.1f} by the processor\n")


if __name__ == "__main__":
    main()
