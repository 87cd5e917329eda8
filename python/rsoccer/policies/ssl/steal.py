"""Stealing the ball from an opponent's mouth: face the opponent, then slide sideways.

Facing it straight, both dribblers pull alike and neither robot wins. From some degrees off the
opponent's axis the two fronts form a wedge. Sliding along the opponent's front then drags the ball
out at the side, in the own mouth.
"""

from typing import Final

import numpy as np

from rsoccer.arrays import Floats
from rsoccer.policies.ssl import motion
from rsoccer.policies.ssl.approach import approach_ball
from rsoccer.policies.ssl.region import Region
from rsoccer.policies.ssl.robot_control import RobotControl
from rsoccer.vectors import XY
from rsoccer.view import View

APPROACH_ANGLE: Final = np.float32(np.radians(20.0))  # rad off the opponent's axis
SLIDE_SPEED: Final = np.float32(0.4)  # m/s along the opponent's front; a crash counts from 0.5 m/s
PRESS_SPEED: Final = np.float32(0.1)  # m/s toward the opponent in the slide, to keep contact
SIDE_THRESHOLD: Final = np.float32(-0.23)  # m inwards from which it slides to the opponent's left
FACING_COSINE: Final = np.float32(-0.8)  # cosine between the headings of robots face to face
MAX_ANGULAR_VELOCITY: Final = 4.0  # rad/s in the slide

_COS: Final = np.cos(APPROACH_ANGLE)
_SIN: Final = np.sin(APPROACH_ANGLE)


def steal_ball(
    control: RobotControl, view: View, robots: XY, region: Region, max_speed: float
) -> tuple[Floats, Floats, Floats]:
    """Return velocities toward the ball that an opponent holds, then along its front.

    Args:
        control: control of the robots.
        view: view of the robots.
        robots: (n, robots, others) positions of other robots, m.
        region: allowed positions.
        max_speed: upper bound of the approach, m/s.

    Returns:
        Velocity along x and y (m/s) and angular velocity (rad/s), (n, robots) each.
    """
    ego, ball = view.ego, view.ball
    holder, (heading_x, heading_y) = _ball_holder(control, view)
    # The slide goes to the opponent's left (1) or right (-1), inwards from the lines. The side
    # follows from the opponent's position, as the ball moves. The threshold is not 0, so that the
    # side does not flicker for an opponent in the middle.
    left_x, left_y = -heading_y, heading_x
    inwards = left_x * (np.float32(0.5) * region.high[0] - holder[0]) - left_y * holder[1]
    side = np.where(inwards > SIDE_THRESHOLD, np.float32(1.0), np.float32(-1.0))
    u_x = left_x * side * _SIN - heading_x * _COS
    u_y = left_y * side * _SIN - heading_y * _COS
    still_ball = ball.position, ball.velocity * np.float32(0.0)
    v_x, v_y, angular_velocity = approach_ball(
        control, ego, still_ball, robots, region, max_speed, (u_x, u_y)
    )
    slides = control.has_ball(view)
    slides &= ego.heading[..., 0] * heading_x + ego.heading[..., 1] * heading_y < FACING_COSINE
    slide_x = left_x * side * SLIDE_SPEED - heading_x * PRESS_SPEED
    slide_y = left_y * side * SLIDE_SPEED - heading_y * PRESS_SPEED
    v_x, v_y = np.where(slides, slide_x, v_x), np.where(slides, slide_y, v_y)
    slide_angular_velocity = motion.angular_velocity_to(ego, u_x, u_y, MAX_ANGULAR_VELOCITY)
    return v_x, v_y, np.where(slides, slide_angular_velocity, angular_velocity)


def _ball_holder(control: RobotControl, view: View) -> tuple[XY, XY]:
    """Position and heading of the opponent with the ball, or of any opponent; (n, robots)."""
    in_mouth = control.opponents_have_ball(view)
    index = np.argmax(in_mouth + view.opponents.infrared, axis=-1)[..., None]

    def select(column: Floats) -> XY:
        x, y = (np.take_along_axis(column[..., i], index, -1)[..., 0] for i in (0, 1))
        return x, y

    return select(view.opponents.position), select(view.opponents.heading)
