"""Motion in the numbers of an observation: metres by field size, speeds by a robot's top speed."""

import numpy as np

from rsoccer._core import BALL_COLUMNS, ROBOT_COLUMNS, SimConfig
from rsoccer.frame import Floats, span
from rsoccer.view import View

PLANE = span(ROBOT_COLUMNS, "x", "y", "cos", "sin", "v_x", "v_y", "v_theta")
WITH_BEAM = span(ROBOT_COLUMNS, "x", "y", "cos", "sin", "v_x", "v_y", "v_theta", "infrared")
BALL = span(BALL_COLUMNS, "x", "y", "z", "v_x", "v_y", "v_z")


class Scales:
    """Scales of one field and one robot model."""

    def __init__(self, config: SimConfig) -> None:
        """Half the field's length is 1, and so is a robot's top speed."""
        robot = config.robot
        self.per_metre = np.float32(1.0 / config.field.half_length)
        self.per_speed = np.float32(1.0 / robot.top_speed)
        self.per_turn = np.float32(1.0 / robot.top_turn_rate)
        place, speed = [self.per_metre] * 2, [self.per_speed] * 2
        plane = [*place, 1.0, 1.0, *speed, self.per_turn]
        slots = config.n_robots + max(config.n_blue, config.n_yellow)
        # All slots' side by side, so that one long product does them all.
        self._plane = np.tile(np.array(plane, np.float32), slots)
        self._with_beam = np.tile(np.array([*plane, 1.0], np.float32), slots)
        self._ball = np.array([self.per_metre] * 3 + [self.per_speed] * 3, np.float32)

    def robots(self, view: View, *, beam: bool = False) -> Floats:
        """Poses and motion of all slots, (n, seers, slots, 7); with the break beam, 8."""
        columns, scale = (WITH_BEAM, self._with_beam) if beam else (PLANE, self._plane)
        n, seers, slots = view.robots.data.shape[:3]
        motion = view.robots.data[..., columns].reshape(n, seers, -1)
        return (motion * scale[: motion.shape[2]]).reshape(n, seers, slots, -1)

    def ball(self, view: View) -> Floats:
        """Where the ball is and goes in the plane, (n, seers, 4)."""
        position, velocity = view.ball.position, view.ball.velocity
        return np.concatenate([position * self.per_metre, velocity * self.per_speed], axis=-1)

    def ball_in_space(self, view: View) -> Floats:
        """Place x, y, z and velocity, (n, seers, 6)."""
        return view.ball.data[..., BALL] * self._ball
