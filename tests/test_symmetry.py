"""A match on the field rotated by half a turn, with the teams swapped, is the same match."""

import numpy as np
import pytest

import rsoccer
from rsoccer import LEARN, Frame, Matches
from rsoccer.arrays import Floats
from rsoccer.rng import WorldRng
from rsoccer.tasks import VssSelfPlay
from tests.games import begin_play
from tests.helpers import Crowd, touches
from tests.parallel_matches import VSS_TASKS
from tests.test_view import rotated

TEAMS = np.array([3, 4, 5, 0, 1, 2])


SSL = "SSLSelfPlay-v0"
# Tasks of three against three that can start anywhere.
SYMMETRIC = [*VSS_TASKS, SSL]


def both(rows: Floats, worlds: int, name: str = "VSSSelfPlay-v0") -> tuple[Matches, Matches]:
    """Matches and the same matches rotated by half a turn, with all robots learning."""
    task = rsoccer.make_task(name)
    ours, theirs = (
        Matches(task, worlds, controllers={"all": LEARN}, autoreset="disabled") for _ in range(2)
    )
    ours.reset(rows=rows)
    theirs.reset(rows=rotated(Frame(rows, 3, 3)).rows)
    for matches in (ours, theirs):
        begin_play(matches)
    return ours, theirs


def spread_out(worlds: int, name: str = "VSSSelfPlay-v0") -> Floats:
    """Initial states without contacts: robots in two rows, the ball rolling between them."""
    frame = Frame.empty(worlds, 3, 3)
    rng = np.random.default_rng(0)
    for team, y in ((frame.blue, -0.4), (frame.yellow, 0.4)):
        team.position[..., 0] = [-0.4, 0.0, 0.4]
        team.position[..., 1] = y
        angle = rng.uniform(-np.pi, np.pi, (worlds, 3))
        team.heading[:] = np.stack([np.cos(angle), np.sin(angle)], -1)
    frame.ball.velocity[:] = rng.uniform(-0.2, 0.2, (worlds, 2))
    frame.ball.velocity[:, 1] *= 0.2
    if name == SSL:  # its robots are larger and faster, its field is larger
        frame.robots.position[:] *= 2.5
    return frame.rows


@pytest.mark.parametrize("name", SYMMETRIC)
def test_without_contact_the_rotated_match_is_exactly_the_same(name: str) -> None:
    worlds = 6
    ours, theirs = both(spread_out(worlds, name), worlds, name)
    size = ours.action_size
    rng = np.random.default_rng(1)
    moved = ours.frame.rows.copy()
    for _ in range(12):
        actions = rng.uniform(-1.0, 1.0, (worlds, 6, size)).astype(np.float32)
        a, b = ours.step(actions), theirs.step(actions[:, TEAMS])
        assert touches(ours.frame, ours.task.config) == 0
        assert np.array_equal(rotated(ours.frame).rows, theirs.frame.rows)
        assert np.array_equal(a.observations[:, TEAMS], b.observations)
        assert np.array_equal(a.rewards[:, TEAMS], b.rewards)
        assert np.array_equal(a.ended, b.ended)
    assert np.abs(ours.frame.robots.position - Frame(moved, 3, 3).robots.position).max() > 0.05


def test_through_one_contact_the_rotated_match_stays_the_same() -> None:
    frame = Frame(spread_out(1), 3, 3)
    frame.ball.position[:] = [[0.0, -0.25]]
    frame.ball.velocity[:] = 0.0
    frame.blue.heading[:, 1] = [0.6, 0.8]
    frame.blue.position[:, 1] = [-0.12, -0.4]
    ours, theirs = both(frame.rows, 1)
    actions = np.zeros((1, 6, 2), np.float32)
    actions[:, 1] = 0.8
    for _ in range(30):
        ours.step(actions)
        theirs.step(actions[:, TEAMS])
    assert np.abs(ours.frame.ball.position[0] - [0.0, -0.25]).max() > 0.05, "the ball was hit"
    assert np.abs(rotated(ours.frame).rows - theirs.frame.rows)[:, :2].max() < 1e-4


def test_a_goal_counts_for_the_right_team_on_both_sides() -> None:
    frame = Frame(spread_out(2), 3, 3)
    frame.ball.position[:] = [[0.6, 0.0], [-0.6, 0.0]]
    frame.ball.velocity[:] = [[1.5, 0.0], [-1.5, 0.0]]
    ours, theirs = both(frame.rows, 2)
    scores = []
    for matches in (ours, theirs):
        total = np.zeros(2)
        for _ in range(20):
            outcome = matches.step(np.zeros((2, 6, 2), np.float32))
            total += np.where(outcome.terminated, outcome.metrics["goal_score"], 0.0)
            if outcome.terminated.any():
                goal = outcome.terms["goal"][outcome.terminated]
                assert (goal[:, :3] == -goal[:, 3:]).all()
        scores.append(total.tolist())
    assert scores == [[1.0, -1.0], [-1.0, 1.0]]


def test_both_teams_win_equally_often() -> None:
    worlds, steps = 150, 400
    matches = Matches(VssSelfPlay(), worlds, seed=5, controllers={"all": "chase"}, threads=2)
    matches.reset()
    wins = np.zeros(2)
    no_actions = np.zeros((worlds, 0, 2), np.float32)
    for _ in range(steps):
        outcome = matches.step(no_actions)
        score = outcome.metrics["goal_score"][outcome.terminated]
        wins += [(score > 0).sum(), (score < 0).sum()]
    assert wins.sum() > 50
    assert abs(wins[0] - wins[1]) < 3.0 * wins.sum() ** 0.5


def test_chase_acts_symmetrically() -> None:
    rows = Crowd().get_initial_positions_frame(WorldRng.seeded(0, 8)).rows
    views = []
    for start in (rows, rotated(Frame(rows, 3, 3)).rows):
        matches = Matches(VssSelfPlay(), 8, controllers={"all": "chase"})
        matches.reset(rows=start)
        matches.step(np.zeros((8, 0, 2), np.float32))
        views.append(matches.play.actions)
    assert np.array_equal(views[0][:, TEAMS], views[1])
    assert np.abs(views[0]).max() > 0.5
