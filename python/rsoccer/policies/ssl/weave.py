"""A script that carries the ball through the gates of the dribbling task."""

from typing import Any, Final, Literal

import numpy as np

from rsoccer.frame import Array, Floats, Mask, length
from rsoccer.policies.base import Memory, Policy, PolicyInput
from rsoccer.policies.ssl import motion
from rsoccer.policies.ssl.paths import Ground, around, others
from rsoccer.rng import WorldRng
from rsoccer.task import Task

CARRYING: Final = 0.8  # m/s, with the ball on the dribbler
TURN: Final = 2.0  # rad/s, likewise
ACCELERATION: Final = np.float32(2.5)  # m/s², likewise: more could tear it off
ASIDE: Final = np.float32(0.35)  # metres from the line of gates at which it turns to the next
THERE: Final = np.float32(0.06)  # metres from a corner of its way at which it takes the next
KEEP: Final = np.float32(0.22)  # metres to the robots that stand
ROOM: Final = 0.12  # metres that its centre keeps inside the bounds
BEHIND: Final = np.float32(0.1)  # metres behind the ball from which it takes it again


class Weave(Policy):
    """Keeps facing as it started and drives sideways, so that the ball is never swung.

    It goes round each corner of a list: before and behind each gate. Where it loses the ball, it
    takes it again from behind and goes to before the gate that is next.
    """

    observes: Literal["nothing", "view", "observation"] = "view"

    def __init__(self, task: Task) -> None:
        """Learn the course of `task`."""
        super().__init__(task)
        self._mover = motion.Mover("weave", task)
        course: Any = getattr(task, "course", None)
        if course is None:
            raise ValueError(f"weave needs gates, and {task.name} has none")
        self._course = course
        self._heading = np.float32(np.cos(course.start[2])), np.float32(np.sin(course.start[2]))
        (x_min, y_min), (x_max, y_max) = course.bounds
        low, high = (x_min + ROOM, y_min + ROOM), (x_max - ROOM, y_max - ROOM)
        self._ground = Ground(low, high)
        self._step = np.float32(task.config.time_step)
        # Where the robot is when its middle and the ball's are as far from the one side as from
        # the other: the ball sticks out on one.
        ball, robot = task.config.ball, task.config.robot
        ahead = 0.5 * (robot.front + 2.0 * ball.radius - robot.bounding_radius)
        self._corners = _corners(course, ahead)

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        """Gates passed, the next corner, where the ball was (NaN at first), what it drove."""
        return {
            "passed": np.zeros(shape[:2], np.int64),
            "corner": np.zeros(shape[:2], np.int64),
            "ball": np.full((*shape[:2], 2), np.nan, np.float32),
            "velocity": np.zeros((*shape[:2], 2), np.float32),
        }

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """(n, robots, 5)."""
        if inputs.view is None:
            raise ValueError("weave needs a view, got none")
        ego, ball, mover = inputs.view.ego, inputs.view.ball, self._mover
        to_x, to_y = (ball.position[..., i] - ego.position[..., i] for i in (0, 1))
        ahead, left = motion.along(to_x, to_y, ego.heading[..., 0], ego.heading[..., 1])
        has = mover.has(inputs.view)
        x, y = self._next_corner(ego.position, ball.position, has, memory)
        behind_x, behind_y = self._behind(ball.position, ahead, left)
        x, y = np.where(has, x, behind_x), np.where(has, y, behind_y)
        away = others(inputs.view)
        things = away[0], away[1], np.broadcast_to(KEEP, away[0].shape)
        next_x, next_y, far = around(ego.position, x, y, things, self._ground)
        v_x, v_y = motion.driving(ego.position, next_x, next_y, CARRYING, far)
        v_x, v_y = self._gently(v_x, v_y, has, memory["velocity"])
        cos, sin = (np.broadcast_to(part, x.shape) for part in self._heading)
        spin = motion.turning(ego, cos, sin, TURN)
        return mover.actions(ego, v_x, v_y, spin)

    def _next_corner(
        self, ego: Floats, ball: Floats, has: Mask, memory: Memory
    ) -> tuple[Floats, Floats]:
        """Where to carry the ball; notes the gates that it went through."""
        passed, corner, last = memory["passed"], memory["corner"], memory["ball"]
        table = self._course.table
        gate = table[np.minimum(passed, len(table) - 1)].reshape(-1, 3)
        before = np.where(np.isnan(last), ball, last).reshape(-1, 2)
        right, _ = self._course.crossed(gate, before, ball.reshape(-1, 2))
        passed += right.reshape(passed.shape)
        last[:] = ball
        # Without the ball it starts again before the gate that is next.
        corner[:] = np.where(has, corner, 2 * passed)
        at = self._corner(corner)
        there = length(at[..., 0] - ego[..., 0], at[..., 1] - ego[..., 1]) < THERE
        # It does not go on from behind a gate that the ball has not gone through.
        corner[:] = np.where(there & has, np.minimum(corner + 1, 2 * passed + 1), corner)
        at = self._corner(corner)
        return at[..., 0], at[..., 1]

    def _corner(self, corner: Array) -> Floats:
        at: Floats = self._corners[np.minimum(corner, len(self._corners) - 1)]
        return at

    def _behind(self, ball: Floats, ahead: Floats, left: Floats) -> tuple[Floats, Floats]:
        """Where to go for a lost ball: behind it first, then straight into it."""
        cos, sin = self._heading
        ready = (np.abs(left) < np.float32(0.02)) & (ahead > 0.0)
        away = self._mover.reach + np.where(ready, -motion.INTO, BEHIND)
        return ball[..., 0] - cos * away, ball[..., 1] - sin * away

    def _gently(self, v_x: Floats, v_y: Floats, has: Mask, last: Floats) -> tuple[Floats, Floats]:
        """Velocities that differ little from the last ones, with the ball."""
        way_x, way_y = v_x - last[..., 0], v_y - last[..., 1]
        most = np.where(has, ACCELERATION * self._step, np.float32(10.0))
        per = np.minimum(most / np.maximum(length(way_x, way_y), np.float32(1e-6)), 1.0)
        last[..., 0] += way_x * per
        last[..., 1] += way_y * per
        return last[..., 0].copy(), last[..., 1].copy()


def _corners(course: Any, ahead: float) -> Floats:  # noqa: ANN401  (tasks build on policies)
    """(2 gates, 2) places before and behind each gate, in the order of the way."""
    corners = np.empty((len(course.gates), 2, 2), np.float32)
    heading = np.cos(course.start[2]), np.sin(course.start[2])
    for i, (first, last, way) in enumerate(course.gates):
        middle = 0.5 * (first + last) - ahead * heading[1 - course.crosses]
        corners[i, :, 1 - course.crosses] = middle
        corners[i, 0, course.crosses] = course.line - way * ASIDE
        corners[i, 1, course.crosses] = course.line + way * ASIDE
    return corners.reshape(-1, 2)
