"""A script that plays: round the ball until it lies before the goal, then through it."""

from typing import Final, Literal

import numpy as np

from rsoccer.frame import Floats, Mask, length
from rsoccer.policies.base import Memory, Policy, PolicyInput
from rsoccer.policies.vectors import inverse
from rsoccer.policies.vss import driving
from rsoccer.policies.vss.pitch import Pitch, unit
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from rsoccer.view import View

BEHIND: Final = np.float32(0.15)  # metres between the ball and where a run at it starts
ASIDE: Final = np.float32(0.13)  # metres by which it passes the ball on the way there
AHEAD: Final = np.float32(0.15)  # metres ahead on the line to the ball that a run aims at
ALIGNED: Final = np.float32(0.45)  # metres off the line, per metre from the ball, that still do
TURN: Final = np.float32(0.8)  # how hard it turns, per sine of the angle it is off
ROOM: Final = np.float32(0.4)  # metres that teammates leave round the ball
NEAR: Final = np.float32(0.02)  # metres from its target at which it slows down


class Chase(Policy):
    """The nearest of the team goes, its teammates make room. For robots on two wheels.

    It drives backwards as well as forwards. It does not look out for others: where it is stuck,
    it backs off in some curve.
    """

    observes: Literal["nothing", "view", "observation"] = "view"

    def __init__(self, task: Task) -> None:
        """Learn the field and the robot of `task`."""
        super().__init__(task)
        driving.expect_two_wheels(task, "chase")
        field, robot = task.config.field, task.config.robot
        self._pitch = Pitch(task.config)
        clear = driving.room_to_turn(robot)
        self._most_x = np.float32(field.half_length - clear)
        self._most_y = np.float32(field.half_width - clear)
        self._damping = driving.damping(robot)
        self._slow = driving.SLOW * np.float32(robot.top_speed)

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        """Steps (n, robots) that it has been slow for; below 0 while it backs off."""
        return {"slow": np.zeros(shape[:2], np.int64)}

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Powers of the two wheels, (n, robots, 2)."""
        if inputs.view is None:
            raise ValueError("chase needs a view, got none")
        ego, ball = inputs.view.ego, inputs.view.ball.position
        x, y = self._target(ball, ego.position)
        x, y = x - ego.position[..., 0], y - ego.position[..., 1]
        chases, away_x, away_y = _roles(inputs.view)
        x, y = np.where(chases, x, away_x), np.where(chases, y, away_y)
        cos, sin = ego.heading[..., 0], ego.heading[..., 1]
        ahead, left = x * cos + y * sin, y * cos - x * sin
        per = inverse(length(x, y), NEAR)
        forward, turn = ahead * per, left * per * np.sign(ahead) * TURN
        turn = turn - ego.spin * self._damping
        always = np.ones_like(chases)  # who makes room may be stuck too, but then need not push
        backing = driving.backing(ego.velocity, self._slow, always, memory["slow"]) & chases
        forward = np.where(backing, -forward, forward)
        turn = np.where(backing, rng.uniform(-1.0, 1.0, inputs.action_shape[1:2]), turn)
        return driving.wheels(forward, turn)

    def _target(self, ball: Floats, ego: Floats) -> tuple[Floats, Floats]:
        """Where to drive at, (n, robots) metres along x and along y."""
        ball_x, ball_y = ball[..., 0], ball[..., 1]
        u_x, u_y = self._course(ball_x, ball_y)  # (-u_y, u_x) is to its left
        x, y = ego[..., 0] - ball_x, ego[..., 1] - ball_y
        behind, aside = -(x * u_x + y * u_y), y * u_x - x * u_y
        ready = (behind > 0.0) & (np.abs(aside) < ALIGNED * behind)
        beside = behind < np.float32(0.5) * BEHIND
        along = np.where(ready, AHEAD - behind, -BEHIND)
        across = np.where(beside & ~ready, np.copysign(ASIDE, aside), np.float32(0.0))
        target_x = ball_x + along * u_x - across * u_y
        target_y = ball_y + along * u_y + across * u_x
        inside_x = np.minimum(np.maximum(target_x, -self._most_x), self._most_x)
        inside_y = np.minimum(np.maximum(target_y, -self._most_y), self._most_y)
        return np.where(ready, target_x, inside_x), np.where(ready, target_y, inside_y)

    def _course(self, ball_x: Floats, ball_y: Floats) -> tuple[Floats, Floats]:
        """Where to push the ball, a direction: at the goal, or along a wall that it lies at."""
        x, y = self._pitch.half_length - ball_x, -ball_y
        beside, before = self._pitch.walls(ball_x, ball_y)
        y = np.where(beside, np.float32(0.0), y)
        y = np.where(before, np.copysign(y, -ball_y * ball_x), y)
        x = np.where(before & ~beside, np.float32(0.0), x)
        return unit(x, y)


def _roles(view: View) -> tuple[Mask, Floats, Floats]:
    """Whether a robot is its team's nearest to the ball, and the way off for one that is not.

    The way (n, robots) metres along x and y leads straight away from the ball, until there is
    room enough.
    """
    team = slice(0, 1 + view.n_teammates)
    x = view.robots.position[:, :, team, 0] - view.ball.position[..., None, 0]
    y = view.robots.position[:, :, team, 1] - view.ball.position[..., None, 1]
    distance = np.where(view.present[:, team], length(x, y), np.float32(np.inf))
    mine = distance[:, :, 0]
    off = np.maximum(ROOM - mine, np.float32(0.0)) * inverse(mine, NEAR)
    return mine == distance.min(axis=2), x[:, :, 0] * off, y[:, :, 0] * off
