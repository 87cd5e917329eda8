"""A script that gets the ball and shoots it past the others into the goal."""

from typing import Final, Literal

import numpy as np

from rsoccer._core import Field
from rsoccer.frame import Floats, Mask, length
from rsoccer.policies.base import Memory, Policy, PolicyInput
from rsoccer.policies.ssl import motion, steal
from rsoccer.policies.ssl.paths import Ground, around, clearance, others
from rsoccer.policies.vectors import inverse
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from rsoccer.view import View

FASTEST: Final = 1.5  # m/s
CARRYING: Final = 0.8  # m/s, with the ball on the dribbler
TURN: Final = 4.0  # rad/s, likewise
EXACT: Final = np.float32(0.01)  # sine of the angle that it may be off when it kicks
CALM: Final = np.float32(0.2)  # rad/s that it may still turn then
STANDS: Final = np.float32(0.1)  # m/s that it may still drive then
ROOM: Final = 0.1  # metres that its centre keeps from lines, so that the ball stays inside
EDGE: Final = 0.02  # metres likewise where it wins the ball
AREA: Final = 0.05  # metres that it keeps from the opponents' area
SWING: Final = np.float32(0.23)  # metres to robots in which it can turn with the ball
POST: Final = 0.08  # metres that shots keep from the posts
SPARE: Final = np.float32(0.03)  # metres that shots keep from robots
ENOUGH: Final = np.float32(0.15)  # metres from robots, from which more is no better
STRICT: Final = np.float32(0.02)  # metres more that a place to go to must offer
BLOCKED: Final = np.float32(10.0)  # metres of way that a place without a free shot counts for
WAITS: Final = np.float32(0.7)  # metres from the ball at which teammates wait

AIMS: Final = 9  # places in the goal that it may shoot at
PLACES: Final = (8, 11)  # along x and y, from which it may shoot


class Strike(Policy):
    """Fetches the ball or wins it off an opponent, carries it to where a shot is free, and shoots.

    Of a team the nearest goes, its teammates keep off.
    """

    observes: Literal["nothing", "view", "observation"] = "view"

    def __init__(self, task: Task) -> None:
        """Learn the field and the robot of `task`."""
        super().__init__(task)
        self._mover = motion.Mover("strike", task)
        field = task.config.field
        self._goal_x = np.float32(field.half_length)
        half = field.goal_width / 2 - POST
        self._aims = np.linspace(-half, half, AIMS).astype(np.float32)
        self._half_only = bool(getattr(task, "half_only", False))
        self._ground = self._inside(field, ROOM, AREA)
        self._edge = self._inside(field, EDGE, EDGE)
        far_y = field.half_width - EDGE
        front = field.half_length - field.goal_area_depth - ROOM - AREA
        x = np.linspace(0.3, front, PLACES[0])
        y = np.linspace(-far_y + 0.3, far_y - 0.3, PLACES[1])
        self._x, self._y = (part.ravel().astype(np.float32) for part in np.meshgrid(x, y))

    def _inside(self, field: Field, room: float, area: float) -> Ground:
        """Where it may be, with so much room to the lines and to the opponents' area."""
        if not self._half_only:
            return Ground.field(field, room)
        high = field.half_length - room, field.half_width - room
        return Ground((room, -high[1]), high).without_area(field, area)

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """(n, robots, 5)."""
        view = inputs.view
        if view is None:
            raise ValueError("strike needs a view, got none")
        goes = _nearest(view)
        steals = goes & steal.held(view)
        has = goes & ~steals & self._mover.has(view)
        actions = np.zeros(inputs.action_shape, np.float32)
        ways = (goes & ~steals & ~has, self._fetch), (steals, self._steal), (has, self._shoot)
        for mask, way in (*ways, (~goes, self._wait)):
            worlds = np.flatnonzero(mask.any(axis=1))
            if len(worlds):
                part = way(view.take(worlds))
                actions[worlds] = np.where(mask[worlds][..., None], part, actions[worlds])
        return actions

    def _fetch(self, view: View) -> Floats:
        """Go to the ball."""
        moves = view.ball.position, view.ball.velocity
        robots = others(view)
        way = motion.fetching(self._mover, view.ego, moves, robots, self._ground, FASTEST)
        return self._mover.actions(view.ego, *way)

    def _steal(self, view: View) -> Floats:
        """Win the ball off the opponent that has it."""
        way = steal.stealing(self._mover, view, others(view), self._edge, FASTEST)
        return self._mover.actions(view.ego, *way)

    def _wait(self, view: View) -> Floats:
        """Keep off the ball, and face it."""
        ego, ball = view.ego, view.ball.position
        x, y = ego.position[..., 0] - ball[..., 0], ego.position[..., 1] - ball[..., 1]
        off = np.maximum(WAITS * inverse(length(x, y)), np.float32(1.0))
        target = self._edge.inside(ball[..., 0] + x * off, ball[..., 1] + y * off)
        v_x, v_y = motion.driving(ego.position, *target, FASTEST)
        return self._mover.actions(ego, v_x, v_y, motion.turning(ego, -x, -y, TURN))

    def _shoot(self, view: View) -> Floats:
        """Turn and kick where the shot is free, else carry the ball to where it is."""
        ego, robots = view.ego, others(view)
        my_x, my_y = ego.position[..., 0], ego.position[..., 1]
        aim, free = (part[..., 0] for part in self._aim(my_x[..., None], my_y[..., None], robots))
        gaps = length(robots[0] - my_x[..., None], robots[1] - my_y[..., None]).min(axis=-1)
        shoots = (free > SPARE) & (gaps > SWING)
        shoots &= self._ground.outside(my_x, my_y) < np.float32(AREA)
        way_x, way_y = self._goal_x - my_x, aim - my_y
        spin = motion.turning(ego, way_x, way_y, TURN)
        ahead, left = motion.bearing(ego, way_x, way_y)
        exact = shoots & (ahead > 0.0) & (np.abs(left) < EXACT) & (np.abs(ego.spin) < CALM)
        exact &= length(ego.velocity[..., 0], ego.velocity[..., 1]) < STANDS
        zero = np.float32(0.0)
        v_x, v_y = (np.where(shoots, zero, v) for v in self._carry(ego.position, robots))
        kick = np.where(exact, self._mover.kick, zero)
        way = self._mover.gently(ego, v_x, v_y, np.where(shoots, spin, zero))
        return self._mover.actions(ego, *way, kick)

    def _aim(self, x: Floats, y: Floats, robots: tuple[Floats, Floats]) -> tuple[Floats, Floats]:
        """The best places in the goal to shoot at from x, y (n, robots, places), and the room.

        Room is metres between the ball on its way there and the nearest robot.
        """
        start = x[..., None], y[..., None]
        shape = (*x.shape, AIMS)
        end = np.broadcast_to(self._goal_x, shape), np.broadcast_to(self._aims, shape)
        at_x, at_y = (part[:, :, None, None] for part in robots)
        room = clearance(start, end, at_x, at_y) - self._mover.ball_room
        best = np.argmax(np.minimum(room, ENOUGH), axis=-1)[..., None]
        return self._aims[best[..., 0]], np.take_along_axis(room, best, -1)[..., 0]

    def _carry(self, ego: Floats, robots: tuple[Floats, Floats]) -> tuple[Floats, Floats]:
        """Velocity (m/s) to the nearest place with a free shot."""
        shape = (*ego.shape[:2], len(self._x))
        x, y = np.broadcast_to(self._x, shape), np.broadcast_to(self._y, shape)
        _, free = self._aim(x, y, robots)
        gaps = length(
            robots[0][:, :, None] - x[..., None], robots[1][:, :, None] - y[..., None]
        ).min(axis=-1)
        good = (free > SPARE + STRICT) & (gaps > SWING + STRICT)
        way = length(x - ego[..., 0, None], y - ego[..., 1, None])
        best = np.argmin(way + np.where(good, np.float32(0.0), BLOCKED), axis=-1)
        things = robots[0], robots[1], np.broadcast_to(SWING, robots[0].shape)
        next_x, next_y, far = around(ego, self._x[best], self._y[best], things, self._ground)
        return motion.driving(ego, next_x, next_y, CARRYING, far)


def _nearest(view: View) -> Mask:
    """Whether a robot is its team's nearest to the ball, (n, robots)."""
    team = slice(0, 1 + view.n_teammates)
    x = view.robots.position[:, :, team, 0] - view.ball.position[..., None, 0]
    y = view.robots.position[:, :, team, 1] - view.ball.position[..., None, 1]
    distance = np.where(view.present[:, team], length(x, y), np.float32(np.inf))
    nearest: Mask = np.equal(distance[:, :, 0], distance.min(axis=2))
    return nearest
