"""A script that passes to its teammate and takes passes."""

from typing import Final, Literal

import numpy as np

from rsoccer.frame import Floats, length
from rsoccer.policies.base import Memory, Policy, PolicyInput
from rsoccer.policies.ssl import motion
from rsoccer.policies.ssl.paths import Ground
from rsoccer.policies.vectors import inverse
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from rsoccer.view import View

ARRIVAL: Final = np.float32(1.8)  # m/s of a pass that arrives: the dribbler stops it
FAR: Final = np.float32(3.0)  # metres from which a pass is to be faster, to arrive in time
HASTE: Final = np.float32(0.3)  # m/s faster, per metre from there on
TURN: Final = 5.0  # rad/s, with the ball on the dribbler
EXACT: Final = np.float32(0.008)  # sine of the angle that it may be off when it kicks
CALM: Final = np.float32(0.15)  # rad/s that it may still turn then
STANDS: Final = np.float32(0.1)  # m/s of a teammate that can be passed to
COMES: Final = np.float32(0.3)  # m/s of a ball that is on its way
APART: Final = np.float32(2.0)  # metres to its teammate, at least
ROOM: Final = 0.3  # metres that it keeps from the lines
FASTEST: Final = 2.0  # m/s


class Passer(Policy):
    """Turns the ball to its teammate and kicks it there; without the ball it takes what comes."""

    observes: Literal["nothing", "view", "observation"] = "view"

    def __init__(self, task: Task) -> None:
        """Learn the field, the robot and the ball of `task`."""
        super().__init__(task)
        self._mover = motion.Mover("passer", task)
        if task.n_blue < 2:
            raise ValueError(f"passer needs a teammate, and in {task.name} it has none")
        self._ground = Ground.field(task.config.field, ROOM)
        ball = task.config.ball
        share = ball.rolling_share**2
        # A kick slides until it has slowed to the share, then rolls: v² = a k² - 2 d s.
        self._slides = np.float32((1.0 - share) / (2.0 * ball.sliding_deceleration))
        self._rolls = np.float32(2.0 * ball.rolling_deceleration)
        self._share = np.float32(share)

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """(n, robots, 5)."""
        if inputs.view is None:
            raise ValueError("passer needs a view, got none")
        view, mover = inputs.view, self._mover
        ego, ball = view.ego, view.ball
        to_x, to_y = (ball.position[..., i] - ego.position[..., i] for i in (0, 1))
        has = mover.has(view)
        pass_x, pass_y = (
            view.teammates.position[:, :, 0, i] - ego.position[..., i] for i in (0, 1)
        )
        v_x, v_y = self._waiting(view)
        spin = motion.turning(ego, np.where(has, pass_x, to_x), np.where(has, pass_y, to_y), TURN)
        kick = np.where(has, self._kick(view), np.float32(0.0))
        v_x, v_y = np.where(has, np.float32(0.0), v_x), np.where(has, np.float32(0.0), v_y)
        return mover.actions(ego, v_x, v_y, spin, kick)

    def _kick(self, view: View) -> Floats:
        """m/s where it faces its teammate, else 0."""
        ego, ball, teammate = view.ego, view.ball, view.teammates
        x, y = (teammate.position[:, :, 0, i] - ball.position[..., i] for i in (0, 1))
        ahead, left = motion.bearing(ego, x, y)
        exact = (ahead > 0.0) & (np.abs(left) < EXACT) & (np.abs(ego.spin) < CALM)
        # A ball that still comes is not received yet.
        exact &= (ego.infrared > 0.5) & (
            length(ball.velocity[..., 0], ball.velocity[..., 1]) < COMES
        )
        teammate_velocity = teammate.velocity[:, :, 0]
        exact &= length(teammate_velocity[..., 0], teammate_velocity[..., 1]) < STANDS
        way = np.maximum(length(x, y) - self._mover.reach, np.float32(0.0))
        arrival = ARRIVAL + HASTE * np.maximum(way - FAR, np.float32(0.0))
        square = arrival * arrival + self._rolls * way
        square = square / (self._share + self._rolls * self._slides)
        return np.where(exact, np.sqrt(square), np.float32(0.0))

    def _waiting(self, view: View) -> tuple[Floats, Floats]:
        """Velocity (m/s) onto the line of a ball that comes, else off from its teammate if too near."""
        ego, ball, teammate = view.ego.position, view.ball, view.teammates.position[:, :, 0]
        speed = length(ball.velocity[..., 0], ball.velocity[..., 1])
        per = inverse(speed, COMES)
        u_x, u_y = ball.velocity[..., 0] * per, ball.velocity[..., 1] * per
        ahead, left = motion.along(
            ego[..., 0] - ball.position[..., 0], ego[..., 1] - ball.position[..., 1], u_x, u_y
        )
        comes = (speed > COMES) & (ahead > 0.0)
        x, y = ego[..., 0] + left * u_y, ego[..., 1] - left * u_x
        on_x, on_y = motion.driving(ego, x, y, FASTEST)
        off_x, off_y = ego[..., 0] - teammate[..., 0], ego[..., 1] - teammate[..., 1]
        apart = length(off_x, off_y)
        per = APART * inverse(apart)
        off = self._ground.inside(teammate[..., 0] + off_x * per, teammate[..., 1] + off_y * per)
        off_x, off_y = motion.driving(ego, *off, 1.0)
        near = apart < APART
        zero = np.float32(0.0)
        return (
            np.where(comes, on_x, np.where(near, off_x, zero)),
            np.where(comes, on_y, np.where(near, off_y, zero)),
        )
