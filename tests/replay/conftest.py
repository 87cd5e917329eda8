"""Short recorded matches of both leagues."""

from functools import cache

import pytest

from rsoccer.lineup import lineup
from rsoccer.registry import make_task
from rsoccer.replay import Replay, record_replay

GOALS_SEED = 2
"""Seed of a VSSS match with goals in its first eight seconds."""


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


@pytest.fixture(params=[vss, ssl], ids=["VSSS", "SSL"])
def replay(request: pytest.FixtureRequest) -> Replay:
    recorded: Replay = request.param()
    return recorded
