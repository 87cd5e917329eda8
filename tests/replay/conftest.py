"""Short recorded matches of both leagues."""

from functools import cache
from typing import Any, Final

import pytest

from rsoccer import Sensing
from rsoccer.lineup import lineup
from rsoccer.registry import make_task
from rsoccer.replay import Replay, record_replay

GOALS_SEED = 2
"""Seed of a VSSS match with goals in its first eight seconds."""
MATCH_SEED = 4
"""Seed of a short VSSS match with goals."""
QUICK = {
    "prepare_seconds": 0.5,
    "max_prepare_seconds": 0.5,
    "stop_seconds": 0.5,
    "goal_stop_seconds": 0.5,
}
"""Rules of a referee with short stops."""
RANDOMIZATION: Final[dict[str, Any]] = {
    "robot.mass": (0.8, 1.2),
    "ball.hop": ("normal", 0.5, 0.05),
    "sensing.delay": 0.1,
}
"""Numbers that episodes draw."""


@cache
def vss() -> Replay:
    task = make_task("VSSSelfPlay-v0")
    controllers = lineup(task, "scripted", "chase")
    return record_replay(
        task, controllers, GOALS_SEED, 8.0, names=("A", "B"), snapshot_interval=3.0
    )


@cache
def ssl() -> Replay:
    """Passes between two robots: kicks, and markers that move."""
    task = make_task("SSLPassEnduranceMulti-v1")
    return record_replay(task, lineup(task, "passer"), seconds=4.0)


@cache
def vss_match() -> Replay:
    """A whole match under a referee, with goals, and the beginning of a second one."""
    task = make_task("VSSMatch-v0", half_seconds=5.0, referee=QUICK)
    return record_replay(task, lineup(task, "scripted", "chase"), MATCH_SEED, 20.0)


@cache
def ssl_match() -> Replay:
    """A match with ball placements, cards for all fouls, and robots that are taken out."""
    rules = {"fouls_per_card": 1, "placement_seconds": 2.0, "removal_seconds": 1.0}
    task = make_task("SSLMatch-v0", placement="robots", referee={**QUICK, **rules})
    return record_replay(task, lineup(task, "strike", "strike"), seconds=12.0)


@cache
def sensed_vss() -> Replay:
    """Robots that see late, in episodes with numbers of their own."""
    task = make_task("VSSSelfPlay-v0", max_steps=60)
    return record_replay(
        task,
        lineup(task, "scripted", "chase"),
        seconds=4.0,
        snapshot_interval=1.0,
        sensing="vsss",
        randomization=RANDOMIZATION,
    )


@cache
def sensed_ssl() -> Replay:
    """Robots that see a fifth of a second late; some of them are taken out."""
    rules = {"fouls_per_card": 1, "removal_seconds": 1.0}
    task = make_task("SSLMatch-v0", referee={**QUICK, **rules})
    sensing = Sensing("rc2021", delay=0.2)
    return record_replay(task, lineup(task, "uniform", "strike"), seconds=12.0, sensing=sensing)


@pytest.fixture(params=[vss, ssl, ssl_match], ids=["VSSS", "SSL", "SSL match"])
def replay(request: pytest.FixtureRequest) -> Replay:
    recorded: Replay = request.param()
    return recorded
