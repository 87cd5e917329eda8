"""Fields, balls and robots of rSim (rc-robosim 1.2), as models for this physics.

Numbers: robocin/rSim at b413932 (release 1.2), as its `get_field_params` reports them or as its
behavior was measured.
"""

import math
from typing import Final

from rsoccer._core import BallModel, Field, RobotModel

# In the current rules the end walls of division A stand further back (since 2026), and the goals
# for five a side are deeper.
VSS_FIELDS: Final = (Field("vss_3v3"), Field("vss_5v5", goal_depth=0.10))
SSL_FIELDS: Final = (Field("ssl_a", goal_line_margin=0.3), Field("ssl_b"), Field("ssl_challenge"))

VSS_BALL: Final = BallModel("vss_rsim", radius=0.0215, mass=0.043)
SSL_BALL: Final = BallModel("grsim", mass=0.043)

VSS_ROBOT: Final = RobotModel("vss_440rpm")  # same as in rSim: 440 rpm, 120 g, wheels of 15 g each

SSL_ROBOT: Final = RobotModel(
    "ssl_generic",
    radius=0.09,
    front_distance=0.081,
    height=0.15,
    mass=2.42,  # body 2.2, four wheels of 0.05, kicker 0.02 kg
    wheel_radius=0.02475,
    wheel_distance=0.09,
    max_wheel_speed=163.04868,  # 1557 rpm
    # rSim limits the wheels only, which reach their limit before these: 5.7 m/s, 44.8 rad/s.
    max_speed=6.0,
    max_angular_velocity=50.0,
    # Measured step responses, forward; sideways rSim reaches 2.41 m/s².
    max_acceleration=3.33,
    max_deceleration=3.80,
    max_angular_acceleration=96.0,
    max_angular_deceleration=96.0,
    mouth_width=0.08,
    beam_distance=0.01,
    # rSim has no limit; this is the strongest kicker of the league.
    max_kick_speed=10.0,
    max_chip_speed=10.0,
)

KICKER_THICKNESS: Final = (
    0.005  # m; reported only: `front` is the distance to the face of the kicker
)


def vss_parameters(field: Field) -> dict[str, float]:
    """Return the result of `get_field_params` for VSS.

    Args:
        field: one of `VSS_FIELDS`.

    Returns:
        Parameters by rSim's names, meters, degrees and turns per minute; -1 for those of parts
        that VSS robots do not have.
    """
    return {
        **_field_parameters(field, VSS_BALL),
        "rbt_distance_center_kicker": -1.0,
        "rbt_kicker_thickness": -1.0,
        "rbt_kicker_width": -1.0,
        **_wheel_parameters([90.0, 270.0, -1.0, -1.0], VSS_ROBOT),
        "rbt_radius": VSS_ROBOT.side_length / 2,
    }


def ssl_parameters(field: Field) -> dict[str, float]:
    """Return the result of `get_field_params` for SSL.

    Args:
        field: one of `SSL_FIELDS`.

    Returns:
        Parameters by rSim's names, meters, degrees and turns per minute.
    """
    return {
        **_field_parameters(field, SSL_BALL),
        "rbt_distance_center_kicker": SSL_ROBOT.front_distance,
        "rbt_kicker_thickness": KICKER_THICKNESS,
        "rbt_kicker_width": SSL_ROBOT.mouth_width,
        **_wheel_parameters(SSL_ROBOT.wheel_angles, SSL_ROBOT),
        "rbt_radius": SSL_ROBOT.radius,
    }


def _field_parameters(field: Field, ball: BallModel) -> dict[str, float]:
    return {
        "length": field.length,
        "width": field.width,
        "penalty_length": field.goal_area_depth,
        "penalty_width": field.goal_area_width,
        "goal_width": field.goal_width,
        "goal_depth": field.goal_depth,
        "ball_radius": ball.radius,
    }


def _wheel_parameters(angles: list[float], robot: RobotModel) -> dict[str, float]:
    return {
        **{f"rbt_wheel{i}_angle": angle for i, angle in enumerate(angles)},
        "rbt_wheel_radius": robot.wheel_radius,
        "rbt_motor_max_rpm": round(robot.max_wheel_speed * 30.0 / math.pi, 3),
    }
