"""A simulator over a network: policies play where packets tell the poses, and nothing else.

`NetworkSimulator` speaks a protocol of its own with a pretend server. A real one, such as grSim or
FIRASim, differs in its messages. `CompletedSimulator` derives what the packets lack: velocities,
touches, the lines that the ball crosses.
"""

import json

import numpy as np

import rsoccer
from rsoccer import Frame, Simulator
from rsoccer.completed import CompletedSimulator


class PretendServer:
    """The other end: takes packets with commands in SI units, and answers with poses."""

    def __init__(self, config):
        self.config, self.simulator = config, Simulator(config)
        self.rows = np.zeros((1, config.row_size), np.float32)
        self.seconds = 0.0

    def request(self, packet):
        message, everything = json.loads(packet), np.ones(1, np.bool_)
        if "place" in message:
            rows = np.array([message["place"]], np.float32)
            self.simulator.place(everything, rows, self.rows)
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

    def __init__(self, config, request):
        self.config, self.request = config, request

    def step(self, commands, out, active=None):
        return self._receive(self.request(json.dumps({"commands": commands[0].tolist()})), out)

    def place(self, worlds, rows, out, params=None):
        return self._receive(self.request(json.dumps({"place": rows[0].tolist()})), out)

    restart = place  # this server knows no difference

    def reposition_balls(self, worlds, balls, out):
        rows = out.copy()
        rows[:, : balls.shape[1]] = balls
        return self.place(worlds, rows, out)

    def _receive(self, packet, out):
        message = json.loads(packet)
        frame = Frame(out, self.config.n_blue, self.config.n_yellow)
        frame.ball.position[0], frame.ball.height[0] = message["ball"][:2], message["ball"][2]
        x, y, angle = np.array(message["robots"]).T
        frame.robots.position[0] = np.column_stack([x, y])
        frame.robots.heading[0] = np.column_stack([np.cos(angle), np.sin(angle)])
        return np.array([message["time"]])


task = rsoccer.make_task("VSSSelfPlay-v0")
server = PretendServer(task.config)
simulator = CompletedSimulator(NetworkSimulator(task.config, server.request), task.config)
teams = {"blue": "best", "yellow": "scripted"}
matches = rsoccer.Matches(task, seed=3, controllers=teams, simulator=simulator)
matches.reset()
for _ in range(1200):
    outcome = matches.step(np.zeros((1, 0, task.action_size), np.float32))
    if outcome.ended[0]:
        score = outcome.episodes.metrics["goal_score"][0]
        print(f"goal score {score:+.0f} after {matches.play.times[0]:.1f} s on the server's clock")
        break
