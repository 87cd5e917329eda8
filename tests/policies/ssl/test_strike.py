import numpy as np
import pytest

from rsoccer import Matches
from rsoccer.task import Task
from rsoccer.tasks import (
    SslContestedPossession,
    SslGoToBall,
    SslPassEndurance,
    SslSelfPlay,
    SslStaticDefenders,
)
from tests.policies.ssl.ssl_policies import (
    expect_independent_worlds,
    expect_view_needed,
    mean_metric,
)

# tests/tasks check that it scores past standing robots and steals the ball from an opponent.


def test_it_scores_with_velocities_in_the_robot_frame() -> None:
    assert (
        mean_metric(SslStaticDefenders(velocity_frame="robot"), "goal_score", blue_0="strike")
        >= 0.9
    )


@pytest.mark.parametrize(("blue", "yellow"), [("strike", "hold"), ("hold", "strike")])
def test_it_plays_for_either_side(blue: str, yellow: str) -> None:
    task = (
        SslSelfPlay(n_blue=1, n_yellow=2) if yellow == "hold" else SslSelfPlay(n_blue=2, n_yellow=1)
    )
    score = mean_metric(task, "goal_score", blue=blue, yellow=yellow)
    assert score * (1.0 if blue == "strike" else -1.0) >= 0.8


def test_only_the_nearest_of_a_team_goes() -> None:
    matches = Matches(SslSelfPlay(), 6, 3, controllers={"blue": "strike", "yellow": "zero"})
    matches.reset()
    for _ in range(60):
        matches.step(np.zeros((6, 0, 5), np.float32))
    to_ball = matches.frame.blue.position - matches.frame.ball.position[:, None]
    distance = np.sort(np.linalg.norm(to_ball, axis=-1), axis=1)
    assert (distance[:, 0] < 0.5).mean() > 0.6
    assert (distance[:, 1] > 0.4).all()


@pytest.mark.parametrize("task", [SslStaticDefenders(), SslContestedPossession(), SslSelfPlay()])
def test_worlds_are_independent(
    task: SslStaticDefenders | SslContestedPossession | SslSelfPlay,
) -> None:
    expect_independent_worlds("strike", task, 120)


@pytest.mark.parametrize("task", [SslGoToBall(), SslPassEndurance(), SslSelfPlay(n_yellow=0)])
def test_it_plays_without_opponents(task: Task) -> None:
    matches = Matches(task, 4, 0, controllers={"all": "strike"})
    matches.reset()
    start = matches.frame.robots.position.copy()
    for _ in range(40):
        matches.step(np.zeros((4, 0, 5), np.float32))
    assert np.abs(matches.frame.robots.position - start).max() > 0.1


def test_it_needs_a_view() -> None:
    expect_view_needed("strike", SslStaticDefenders())
