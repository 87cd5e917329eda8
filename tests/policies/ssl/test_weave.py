import numpy as np
import pytest

from rsoccer import Matches, policies
from rsoccer.tasks import SslDribbling, SslGoToBall
from tests.policies.ssl.ssl_policies import (
    expect_independent_worlds,
    expect_view_needed,
    mean_metric,
)


@pytest.mark.parametrize("velocity_frame", ["field", "robot"])
def test_it_carries_the_ball_through_all_gates(velocity_frame: str) -> None:
    task = SslDribbling(velocity_frame=velocity_frame)
    matches = Matches(task, 1, controllers={"blue_0": "weave"}, autoreset="disabled")
    matches.reset()
    for _ in range(1500):
        outcome = matches.step(np.zeros((1, 0, 5), np.float32))
        if outcome.ended[0]:
            break
    assert outcome.metrics["gates"][0] == 7.0


def test_it_takes_a_lost_ball_again_and_continues() -> None:
    """The ball starts away from the robot, before the first gate."""
    task = SslDribbling()
    worlds = 12
    matches = Matches(task, worlds, controllers={"blue_0": "weave"}, autoreset="disabled")
    matches.reset()
    rows = matches.frame.rows.copy()
    rng = np.random.default_rng(0)
    rows[:, 0] = rng.uniform(-0.3, 0.5, worlds)
    rows[:, 1] = rng.uniform(0.35, 0.7, worlds)
    matches.reset(rows=rows)
    gates = np.zeros(worlds)
    for _ in range(2000):
        outcome = matches.step(np.zeros((worlds, 0, 5), np.float32))
        gates = np.maximum(gates, outcome.metrics["gates"])
        if matches.done.all():
            break
    assert (gates == 7.0).mean() >= 0.7, gates


def test_worlds_are_independent() -> None:
    expect_independent_worlds("weave", SslDribbling(scenario="official"))


def test_it_needs_gates_and_a_view() -> None:
    expect_view_needed("weave", SslDribbling())
    with pytest.raises(ValueError, match="task: weave needs gates, got"):
        policies.make_policy("weave", SslGoToBall())


def test_it_finishes_the_official_course_in_time() -> None:
    assert (
        mean_metric(
            SslDribbling(scenario="official", max_steps=1200), "gates", blue="weave", yellow="zero"
        )
        == 6.0
    )
