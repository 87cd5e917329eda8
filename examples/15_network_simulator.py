"""A simulator over a network: policies play where packets tell the poses, and nothing else.

`NetworkSimulator` speaks a protocol of its own with a pretend server. A real one, such as grSim or
FIRASim, differs in its messages. `CompletedSimulator` derives what the packets lack: velocities,
touches, the lines that the ball crosses.
"""

import json
from collections.abc import Callable

import numpy as np

import rsoccer
from rsoccer import Frame, SimConfig, Simulator
from rsoccer.arrays import Doubles, Floats, Mask
from rsoccer.completed import CompletedSimulator


class PretendServer:
    """The other end: takes packets with commands in SI units, and answers with poses."""

    def __init__(self, config: SimConfig) -> None:
        """Start the simulator."""
        self.config, self.simulator = config, Simulator(config)
        self.rows = np.zeros((1, config.row_size), np.float32)
        self.seconds = 0.0

    def request(self, packet: str) -> str:
        """Return the answer to a packet."""
        message, everything = json.loads(packet), np.ones(1, np.bool_)
        if "place" in message:
            self.simulator.place(everything, np.array([message["place"]], np.float32), self.rows)
        else:
            self.simulator.step(np.array([message["commands"]], np.float32), self.rows)
            self.seconds += self.config.time_step
        frame = Frame(self.rows, self.config.n_blue, self.config.n_yellow)
        angles = np.arctan2(frame.robots.heading[0, :, 1], frame.robots.heading[0, :, 0])
        poses = np.column_stack([frame.robots.position[0], angles])
        ball = [*frame.ball.position[0].tolist(), float(frame.ball.height[0])]
        return json.dumps({"time": self.seconds, "ball": ball, "robots": poses.tolist()})


class NetworkSimulator:
    """A stepper and placer of one world: rows with poses, and their time stamps."""

    def __init__(self, config: SimConfig, request: Callable[[str], str]) -> None:
        """Talk to a server by `request`, which sends a packet and returns the answer."""
        self.config, self.request = config, request

    def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> Doubles:
        """Send the commands of a control step, and receive the poses."""
        return self._receive(self.request(json.dumps({"commands": commands[0].tolist()})), out)

    def place(
        self, worlds: Mask, rows: Floats, out: Floats, parameters: Floats | None = None
    ) -> Doubles:
        """Place all bodies."""
        return self._receive(self.request(json.dumps({"place": rows[0].tolist()})), out)

    def restart(self, worlds: Mask, rows: Floats, out: Floats) -> Doubles:
        """Place all bodies: to this server it is the same."""
        return self.place(worlds, rows, out)

    def reposition_balls(self, worlds: Mask, balls: Floats, out: Floats) -> Doubles:
        """Place the ball; the robots stay where they are."""
        rows = out.copy()
        rows[:, : balls.shape[1]] = balls
        return self.place(worlds, rows, out)

    def _receive(self, packet: str, out: Floats) -> Doubles:
        message = json.loads(packet)
        frame = Frame(out, self.config.n_blue, self.config.n_yellow)
        frame.ball.position[0], frame.ball.height[0] = message["ball"][:2], message["ball"][2]
        x, y, angle = np.array(message["robots"]).T
        frame.robots.position[0] = np.column_stack([x, y])
        frame.robots.heading[0] = np.column_stack([np.cos(angle), np.sin(angle)])
        return np.array([message["time"]])


task = rsoccer.make_task("VSSSelfPlay-v0")
network = NetworkSimulator(task.config, PretendServer(task.config).request)
simulator = CompletedSimulator(network, task.config)
teams = {"blue": "best", "yellow": "scripted"}
matches = rsoccer.Matches(task, seed=3, controllers=teams, simulator=simulator)
matches.reset()
for _ in range(1200):
    outcome = matches.step(np.zeros((1, 0, task.action_size), np.float32))
    if outcome.episodes is not None:
        print("goal score", outcome.episodes.metrics["goal_score"][0])
        print("time stamp", matches.play.times, "s on the server's clock")
        break
