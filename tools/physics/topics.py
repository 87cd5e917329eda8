"""All checks by topic."""

from collections.abc import Iterator
from functools import cache

from benches.scenarios import DEFAULT_ENGINE, ENGINES
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
    robot_rows,
    single_contacts,
    squeezed_ball,
    symmetry,
    wheel_slip,
)
from tools.physics.check import Check
from tools.physics.scene import contact_engine

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
    robot_rows,
    fast_shots,
    symmetry,
    placement,
    parameters,
    presets,
    single_contacts,
)
TOPICS = {module.TOPIC: module.checks for module in MODULES}
MEASURED_ONCE = {presets.TOPIC: DEFAULT_ENGINE, single_contacts.TOPIC: single_contacts.COMPARED}
"""Contact engine of topics that do not depend on it, or that compare one with the other."""


def engines_of(topic: str) -> tuple[str, ...]:
    """Return the contact engines that measure a topic, the default first."""
    return (MEASURED_ONCE[topic],) if topic in MEASURED_ONCE else ENGINES


@cache
def checks(topic: str, engine: str | None = None) -> tuple[Check, ...]:
    """Return the checks of a topic under a contact engine; the first call measures them.

    Without an engine it is the first of `engines_of`.
    """
    if engine is None:
        return checks(topic, engines_of(topic)[0])
    with contact_engine(engine):
        return tuple(TOPICS[topic]())


def all_checks() -> Iterator[tuple[str, Check]]:
    """Yield every check with the contact engine that it is measured with."""
    for topic in TOPICS:
        for engine in engines_of(topic):
            yield from ((engine, check) for check in checks(topic, engine))
