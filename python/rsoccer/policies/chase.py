"""A script that plays: round the ball until it lies before the goal, then through it."""

from typing import Final, Literal

import numpy as np

from rsoccer.frame import Array, Floats, Mask, length
from rsoccer.policies.base import Memory, Policy, Seen
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from rsoccer.view import View

BEHIND: Final = np.float32(0.15)  # metres between the ball and where a run at it starts
ASIDE: Final = np.float32(0.13)  # metres by which it passes the ball on the way there
AHEAD: Final = np.float32(0.15)  # metres ahead on the line to the ball that a run aims at
ALIGNED: Final = np.float32(0.45)  # metres off the line, per metre from the ball, that still do
TURN: Final = np.float32(0.8)  # how hard it turns, per sine of the angle it is off
DAMPING: Final = np.float32(0.3)  # less of that, per share of the fastest turn, not to overshoot
WALL: Final = np.float32(0.03)  # metres between ball and wall in which no robot fits
CLEAR: Final = 0.005  # metres to a wall, beyond what it needs to turn on the spot
ROOM: Final = np.float32(0.4)  # metres that mates leave round the ball
NEAR: Final = np.float32(0.02)  # metres from its target at which it slows down
TINY: Final = np.float32(1e-6)  # metres; not to divide by zero
SLOW: Final = np.float32(0.1)  # share of top speed below which it may be stuck
PATIENCE: Final = 16  # slow steps before it backs off
BACKING: Final = 12  # steps that it backs off for


class Chase(Policy):
    """The nearest of the team goes, its mates make room. For robots on two wheels.

    It drives backwards as well as forwards. It does not look out for others: where it is stuck,
    it backs off in some curve.
    """

    observes: Literal["nothing", "view", "observation"] = "view"

    def __init__(self, task: Task) -> None:
        """Learn the field and the robot of `task`."""
        config = task.config
        if tuple(config.command_columns) != ("left", "right") or task.action_size != 2:
            raise ValueError(f"chase drives two wheels, which the robots of {task.name} have not")
        clear = config.robot.bounding_radius + CLEAR
        self._goal_x = np.float32(config.field.half_length)
        self._wall = np.float32(config.ball.radius + WALL)
        self._half_mouth = np.float32(config.field.goal_width / 2)
        self._half_width = np.float32(config.field.half_width)
        self._most_x = np.float32(config.field.half_length - clear)
        self._most_y = np.float32(config.field.half_width - clear)
        self._damping = DAMPING * np.float32(0.5 * config.robot.track / config.robot.top_speed)
        self._slow = SLOW * np.float32(config.robot.top_speed)

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        """Steps (n, robots) that it has been slow for; below 0 while it backs off."""
        return {"slow": np.zeros(shape[:2], np.int64)}

    def act(self, seen: Seen, rng: WorldRng, memory: Memory) -> Floats:
        """Powers of the two wheels, (n, robots, 2)."""
        if seen.view is None:
            raise ValueError("chase needs a view, got none")
        me, ball = seen.view.me, seen.view.ball.position
        x, y = self._target(ball, me.position)
        x, y = x - me.position[..., 0], y - me.position[..., 1]
        chases, away_x, away_y = _roles(seen.view)
        x, y = np.where(chases, x, away_x), np.where(chases, y, away_y)
        cos, sin = me.heading[..., 0], me.heading[..., 1]
        ahead, left = x * cos + y * sin, y * cos - x * sin
        per = _inverse(length(x, y), NEAR)
        forward, turn = ahead * per, left * per * np.sign(ahead) * TURN
        turn = turn - me.spin * self._damping
        backing = self._backing(me.velocity, memory["slow"]) & chases
        forward = np.where(backing, -forward, forward)
        turn = np.where(backing, rng.uniform(-1.0, 1.0, seen.shape[1:2]), turn)
        return _wheels(forward, turn)

    def _target(self, ball: Floats, me: Floats) -> tuple[Floats, Floats]:
        """Where to drive at, (n, robots) metres along x and along y."""
        ball_x, ball_y = ball[..., 0], ball[..., 1]
        u_x, u_y = self._course(ball_x, ball_y)  # (-u_y, u_x) is to its left
        x, y = me[..., 0] - ball_x, me[..., 1] - ball_y
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
        x, y = self._goal_x - ball_x, -ball_y
        beside = self._half_width - np.abs(ball_y) < self._wall
        y = np.where(beside, np.float32(0.0), y)
        before = self._goal_x - np.abs(ball_x) < self._wall
        before &= np.abs(ball_y) > self._half_mouth
        y = np.where(before, np.copysign(y, -ball_y * ball_x), y)
        x = np.where(before & ~beside, np.float32(0.0), x)
        per = _inverse(length(x, y), TINY)
        return x * per, y * per

    def _backing(self, velocity: Floats, slow: Array) -> Mask:
        """Which robots back off, (n, robots)."""
        speed = np.abs(velocity[..., 0]) + np.abs(velocity[..., 1])
        slow[:] = np.where(slow < 0, slow + 1, np.where(speed < self._slow, slow + 1, 0))
        slow[slow > PATIENCE] = -BACKING
        return np.less(slow, 0)


def _roles(view: View) -> tuple[Mask, Floats, Floats]:
    """Whether a robot is its team's nearest to the ball, and the way off for one that is not.

    The way (n, robots) metres along x and y leads straight away from the ball, until there is
    room enough.
    """
    team = slice(0, 1 + view.n_mates)
    x = view.robots.position[:, :, team, 0] - view.ball.position[..., None, 0]
    y = view.robots.position[:, :, team, 1] - view.ball.position[..., None, 1]
    distance = np.where(view.present[:, team], length(x, y), np.float32(np.inf))
    mine = distance[:, :, 0]
    off = np.maximum(ROOM - mine, np.float32(0.0)) * _inverse(mine, NEAR)
    return mine == distance.min(axis=2), x[:, :, 0] * off, y[:, :, 0] * off


def _inverse(lengths: Floats, least: np.float32) -> Floats:
    """Per metre, of lengths that count as `least` where they are less."""
    inverse: Floats = np.divide(np.float32(1.0), np.maximum(lengths, least))
    return inverse


def _wheels(forward: Floats, turn: Floats) -> Floats:
    """Left and right power; both are scaled alike where one is too much, to keep the curve."""
    most = np.maximum(np.abs(forward) + np.abs(turn), np.float32(1.0))
    return np.stack([(forward - turn) / most, (forward + turn) / most], axis=-1)
