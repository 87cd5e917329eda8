"""The `weave` policy: dribble the ball through the gates of the dribbling task."""

from typing import Final

import numpy as np

from rsoccer.arrays import Array, Floats, Mask
from rsoccer.policies.base import Memory, Observes, Policy, PolicyInput
from rsoccer.policies.ssl import motion
from rsoccer.policies.ssl.approach import PRESS_DEPTH
from rsoccer.policies.ssl.path_planning import Obstacles, next_waypoint, other_robots
from rsoccer.policies.ssl.region import Region
from rsoccer.policies.ssl.robot_control import RobotControl, require_ssl
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from rsoccer.tasks.courses import Course
from rsoccer.tasks.ssl_dribbling import SslDribbling
from rsoccer.vectors import TINY, XY, norm, rotate_into_body

DRIBBLE_SPEED: Final = 0.8  # m/s, with the ball on the dribbler
MAX_ANGULAR_VELOCITY: Final = 2.0  # rad/s, with the ball on the dribbler
MAX_ACCELERATION: Final = np.float32(2.5)  # m/s², with the ball; more could pull the ball off
WAYPOINT_OFFSET: Final = np.float32(0.35)  # m between the line of gates and the waypoints
ARRIVAL_DISTANCE: Final = np.float32(0.06)  # m from a waypoint at which the next one follows
ROBOT_CLEARANCE: Final = np.float32(0.22)  # m to the centers of the standing robots
BOUNDS_MARGIN: Final = 0.12  # m between the robot's center and the bounds of the course
RUN_UP: Final = np.float32(0.1)  # m behind a lost ball from which it is taken again


class Weave(Policy):
    """A script that keeps its heading and drives sideways, so that the ball is never swung.

    It follows a list of waypoints, one before and one behind each gate. If it loses the ball, it
    takes the ball again from behind and continues before the next gate.
    """

    observes: Observes = "view"
    forecasts = True

    def __init__(self, task: Task) -> None:
        """Prepare the script for a task.

        Args:
            task: an `SslDribbling` task.

        Raises:
            ValueError: another task.
        """
        super().__init__(task)
        self._control = RobotControl(require_ssl("weave", task))
        if not isinstance(task, SslDribbling):
            raise ValueError(f"task: weave needs gates, got {task.name}")
        course = task.course
        self._course = course
        self._heading = np.float32(np.cos(course.start[2])), np.float32(np.sin(course.start[2]))
        (x_min, y_min), (x_max, y_max) = course.bounds
        low = (x_min + BOUNDS_MARGIN, y_min + BOUNDS_MARGIN)
        self._region = Region(low, (x_max - BOUNDS_MARGIN, y_max - BOUNDS_MARGIN))
        self._time_step = np.float32(task.config.time_step)
        # Robot and ball together are longer than the robot, so their middle lies ahead of its
        # center. A waypoint centers the two between the sides of a gate.
        ball, robot = task.config.ball, task.config.robot
        ahead = 0.5 * (robot.front_distance + 2.0 * ball.radius - robot.bounding_radius)
        self._waypoints = _waypoints(course, ahead)

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        """Return progress on the course, last ball positions and commanded velocities.

        | array | shape | content |
        | --- | --- | --- |
        | `passed` | (n, robots) | gates that the ball has crossed |
        | `waypoint` | (n, robots) | index of the next waypoint |
        | `ball` | (n, robots, 2) | last position of the ball, m; NaN at first |
        | `velocity` | (n, robots, 2) | last commanded velocity, m/s |
        """
        return {
            "passed": np.zeros(shape[:2], np.int64),
            "waypoint": np.zeros(shape[:2], np.int64),
            "ball": np.full((*shape[:2], 2), np.nan, np.float32),
            "velocity": np.zeros((*shape[:2], 2), np.float32),
        }

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Return actions, (n, robots, 5)."""
        view = inputs.required_view("weave")
        ego, ball = view.ego, view.ball
        to_x, to_y = (ball.position[..., i] - ego.position[..., i] for i in (0, 1))
        ahead, left = rotate_into_body(to_x, to_y, ego.heading)
        has_ball = self._control.has_ball(view)
        x, y = self._next_waypoint(ego.position, ball.position, has_ball, memory)
        behind_x, behind_y = self._behind_ball(ball.position, ahead, left)
        target = np.where(has_ball, x, behind_x), np.where(has_ball, y, behind_y)
        robots = other_robots(view)
        obstacles = Obstacles(*robots, np.broadcast_to(ROBOT_CLEARANCE, robots[0].shape))
        next_x, next_y, path = next_waypoint(ego.position, target, obstacles, self._region)
        v_x, v_y = motion.velocity_to(ego.position, next_x, next_y, DRIBBLE_SPEED, path)
        v_x, v_y = self._limit_acceleration(v_x, v_y, has_ball, memory["velocity"])
        cos, sin = (np.broadcast_to(part, target[0].shape) for part in self._heading)
        angular_velocity = motion.angular_velocity_to(ego, cos, sin, MAX_ANGULAR_VELOCITY)
        return self._control.actions(ego, v_x, v_y, angular_velocity)

    def _next_waypoint(self, position: Floats, ball: Floats, has_ball: Mask, memory: Memory) -> XY:
        """Next waypoint of the course, m; counts crossed gates in `memory`."""
        passed, waypoint, last = memory["passed"], memory["waypoint"], memory["ball"]
        table = self._course.table
        gate = table[np.minimum(passed, len(table) - 1)].reshape(-1, 3)
        before = np.where(np.isnan(last), ball, last).reshape(-1, 2)
        right, _ = self._course.crossed(gate, before, ball.reshape(-1, 2))
        passed += right.reshape(passed.shape)
        last[:] = ball
        # A robot without the ball starts again before the next gate.
        waypoint[:] = np.where(has_ball, waypoint, 2 * passed)
        at = self._waypoint(waypoint)
        distance = norm(at[..., 0] - position[..., 0], at[..., 1] - position[..., 1])
        arrived = distance < ARRIVAL_DISTANCE
        # It waits behind a gate until the ball has crossed it.
        following = np.minimum(waypoint + 1, 2 * passed + 1)
        waypoint[:] = np.where(arrived & has_ball, following, waypoint)
        at = self._waypoint(waypoint)
        return at[..., 0], at[..., 1]

    def _waypoint(self, index: Array) -> Floats:
        """Waypoints (..., 2) by index, m; the last one beyond the end."""
        at: Floats = self._waypoints[np.minimum(index, len(self._waypoints) - 1)]
        return at

    def _behind_ball(self, ball: Floats, ahead: Floats, left: Floats) -> XY:
        """Target for a lost ball, m: the run-up behind it, then straight into it."""
        cos, sin = self._heading
        runs = (np.abs(left) < np.float32(0.02)) & (ahead > 0.0)
        distance = self._control.mouth_distance + np.where(runs, -PRESS_DEPTH, RUN_UP)
        return ball[..., 0] - cos * distance, ball[..., 1] - sin * distance

    def _limit_acceleration(self, v_x: Floats, v_y: Floats, has_ball: Mask, last: Floats) -> XY:
        """Velocities close to the last commanded ones, for robots with the ball."""
        change_x, change_y = v_x - last[..., 0], v_y - last[..., 1]
        max_change = np.where(has_ball, MAX_ACCELERATION * self._time_step, np.float32(10.0))
        scale = np.minimum(max_change / np.maximum(norm(change_x, change_y), TINY), 1.0)
        last[..., 0] += change_x * scale
        last[..., 1] += change_y * scale
        return last[..., 0].copy(), last[..., 1].copy()


def _waypoints(course: Course, ahead: float) -> Floats:
    """Waypoints (2 gates, 2), m: before and behind each gate, in the order of the course."""
    waypoints = np.empty((len(course.gates), 2, 2), np.float32)
    heading = np.cos(course.start[2]), np.sin(course.start[2])
    for i, (first, last, way) in enumerate(course.gates):
        middle = 0.5 * (first + last) - ahead * heading[1 - course.crosses]
        waypoints[i, :, 1 - course.crosses] = middle
        waypoints[i, 0, course.crosses] = course.line - way * WAYPOINT_OFFSET
        waypoints[i, 1, course.crosses] = course.line + way * WAYPOINT_OFFSET
    return waypoints.reshape(-1, 2)
