"""All that is checked, by topic."""

from functools import cache

from tools.physics import (
    air,
    bounces,
    crashes,
    differential,
    dribbler,
    floor,
    kicker,
    mirror,
    omni,
    parameters,
    placing,
    presets,
    pushing,
    shots,
    skids,
    squeezes,
)
from tools.physics.check import Check

MODULES = (
    floor,
    air,
    bounces,
    omni,
    differential,
    skids,
    kicker,
    dribbler,
    pushing,
    squeezes,
    crashes,
    shots,
    mirror,
    placing,
    parameters,
    presets,
)
TOPICS = {module.TOPIC: module.checks for module in MODULES}


@cache
def checks(topic: str) -> tuple[Check, ...]:
    """What is measured of a topic; measured once."""
    return tuple(TOPICS[topic]())
