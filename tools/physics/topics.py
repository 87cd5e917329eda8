"""All checks by topic."""

from functools import cache

from tools.physics import (
    ball_bounces,
    ball_flight,
    ball_rolling,
    differential_drive,
    dribbler,
    fast_shots,
    kicker,
    omni_drive,
    parameters,
    placement,
    presets,
    pushing,
    robot_collisions,
    squeezed_ball,
    symmetry,
    wheel_slip,
)
from tools.physics.check import Check

MODULES = (
    ball_rolling,
    ball_flight,
    ball_bounces,
    omni_drive,
    differential_drive,
    wheel_slip,
    kicker,
    dribbler,
    pushing,
    squeezed_ball,
    robot_collisions,
    fast_shots,
    symmetry,
    placement,
    parameters,
    presets,
)
TOPICS = {module.TOPIC: module.checks for module in MODULES}


@cache
def checks(topic: str) -> tuple[Check, ...]:
    """Return the checks of a topic; the first call measures them."""
    return tuple(TOPICS[topic]())
