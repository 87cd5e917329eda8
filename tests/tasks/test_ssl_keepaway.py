"""`SSLKeepaway-v0`: ends of episodes, rewards of both teams, options."""

from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer import LEARN, Matches, policies
from rsoccer.game import YELLOW
from rsoccer.rng import WorldRng
from rsoccer.tasks import SslKeepaway
from tests.tasks.ssl_scenes import DRIBBLE, KICK, STAND, play, run, scene

TASK = SslKeepaway(learners="both")
MOUTH = float(TASK.mouth_offset)
AWAY = {"blue_1": (1.5, 1.5), "blue_2": (1.5, -1.5), "yellow_0": (-1.5, 1.5), "yellow_1": (-2, -2)}
"""Places of all robots but blue_0, away from the center."""


@pytest.mark.parametrize("options", [{}, {"n_keepers": 4, "n_takers": 3}, {"area_width": 2.0}])
def test_keepers_start_on_a_ring_with_the_ball_and_takers_within(options: dict[str, Any]) -> None:
    task = SslKeepaway(**options)
    frame = task.get_initial_positions_frame(WorldRng.seeded(3, 50))
    share = np.abs(frame.blue.position / task.half_area).max(axis=-1)
    assert share == pytest.approx(0.75, abs=1e-5)
    assert np.abs(frame.yellow.position / task.half_area).max() <= 0.3 + 1e-5
    gap = np.linalg.norm(frame.ball.position - frame.blue.position[:, 0], axis=-1)
    assert gap == pytest.approx(MOUTH, abs=1e-5)
    assert (np.abs(frame.ball.position) < task.half_area).all()
    toward_center = -(frame.blue.position * frame.blue.heading).sum(axis=-1)
    assert toward_center.min() > -1e-5
    assert len(np.unique(frame.ball.position[:, 0])) == 50


def test_a_ball_outside_the_area_is_lost_though_it_is_in_the_field() -> None:
    start = scene(TASK, ball=(2.3, 0.0, 3.0, 0.0), blue_0=(0.0, 0.0), **AWAY)
    outcome, matches = run(TASK, start)
    assert outcome.terminated[0]
    assert 2.5 < matches.frame.ball.position[0, 0] < 2.7 < TASK.config.field.half_length
    assert (outcome.metrics["left_area"][0], outcome.metrics["lost"][0]) == (1.0, 1.0)
    assert (outcome.metrics["taken"][0], outcome.metrics["no_pass"][0]) == (0.0, 0.0)


def test_takers_have_the_ball_after_a_quarter_of_a_second_in_a_mouth() -> None:
    poses = {**AWAY, "yellow_0": (0.0, 0.0)}
    start = scene(TASK, ball=(MOUTH, 0.0), blue_0=(-1.5, 0.0), **poses)
    outcome, matches = run(TASK, start, DRIBBLE)
    assert outcome.terminated[0]
    assert outcome.metrics["taken"][0] == 1.0
    assert 10 <= matches.play.steps[0] <= 12
    observed = matches.task.frame_to_observations(matches.play)["possession"][0]
    assert (observed[:, 0] == 1.0).all()
    # Zero-sum: what the keepers lose the takers win.
    for term, size in (("kept", 0.025), ("lost", -2.0)):
        assert outcome.terms[term][0] == pytest.approx([size] * 3 + [-size] * 2)


def test_a_taker_needs_longer_with_another_option() -> None:
    task = SslKeepaway(learners="both", taking_seconds=1.0)
    poses = {**AWAY, "yellow_0": (0.0, 0.0)}
    start = scene(task, ball=(MOUTH, 0.0), blue_0=(-1.5, 0.0), **poses)
    _, matches = run(task, start, DRIBBLE)
    assert 40 <= matches.play.steps[0] <= 42


def test_a_pass_has_to_arrive_in_time() -> None:
    task = SslKeepaway(learners="both", pass_seconds=1.0)
    start = scene(task, ball=(MOUTH, 0.0), blue_0=(0.0, 0.0), **AWAY)
    outcome, matches = run(task, start, DRIBBLE)
    assert outcome.metrics["no_pass"][0] == 1.0
    assert matches.play.steps[0] == 41


@pytest.mark.parametrize("action", [(0.3, 0.0, 0.0, -1.0, -1.0), (0.5, 0.0, 0.0, 0.1, -1.0)])
def test_a_keeper_that_plays_the_ball_ahead_passes_to_nobody(action: tuple[float, ...]) -> None:
    """Without this, robots have learned to keep the ball alone, by short kicks that they follow."""
    task = SslKeepaway(learners="both", pass_seconds=1.0)
    start = scene(task, ball=(MOUTH, 0.0), blue_0=(0.0, 0.0), **AWAY)
    outcome, matches = run(task, start, action)
    assert np.linalg.norm(matches.frame.ball.position[0]) > 0.3
    assert (outcome.metrics["no_pass"][0], outcome.metrics["passes"][0]) == (1.0, 0.0)


def test_a_hand_over_is_no_pass() -> None:
    task = SslKeepaway(learners="both", pass_seconds=1.0)
    poses = {**AWAY, "blue_1": (0.45, 0.0, np.pi)}
    start = scene(task, ball=(MOUTH, 0.0), blue_0=(0.0, 0.0), **poses)
    matches = Matches(task, autoreset="disabled")
    matches.reset(rows=start.rows)
    actions = np.tile(np.array(DRIBBLE, np.float32), (1, 5, 1))
    actions[0, 0] = (0.0, 0.0, 0.0, 0.1, -1.0)
    has_it = []
    while not matches.done[0]:
        outcome = matches.step(actions)
        has_it.append(bool(matches.frame.blue.infrared[0, 1]))
    assert any(has_it), "the other keeper gets the ball"
    assert (outcome.metrics["no_pass"][0], outcome.metrics["passes"][0]) == (1.0, 0.0)


def test_a_pass_begins_the_time_anew_and_counts() -> None:
    task = SslKeepaway(learners="both", reward_weights={"passes": 1.0})
    poses = {**AWAY, "blue_1": (1.5, 0.0, np.pi)}
    start = scene(task, ball=(MOUTH, 0.0), blue_0=(0.0, 0.0), **poses)
    matches = Matches(task, autoreset="disabled")
    matches.reset(rows=start.rows)
    actions = np.tile(np.array(DRIBBLE, np.float32), (1, 5, 1))
    waited, rewarded = [], np.zeros(5)
    for step in range(60):
        waits = DRIBBLE if step < 20 else STAND
        actions[0, 0] = (*KICK[:3], 0.4, -1.0) if step in (20, 21) else waits
        outcome = matches.step(actions)
        rewarded += outcome.terms["passes"][0]
        waited.append(int(matches.play.memory["since_pass"][0]))
    assert waited[:25] == list(range(1, 26))
    assert waited.count(0) == 1 and waited[-1] == 59 - waited.index(0)
    assert outcome.metrics["passes"][0] == 1.0
    assert rewarded.tolist() == [1.0, 1.0, 1.0, 0.0, 0.0]


def test_a_taker_that_catches_a_pass_intercepts_it() -> None:
    poses = {**AWAY, "yellow_0": (1.5, 0.0, np.pi)}
    start = scene(TASK, ball=(MOUTH, 0.0), blue_0=(0.0, 0.0), **poses)
    matches = Matches(TASK, autoreset="disabled")
    matches.reset(rows=start.rows)
    actions = np.tile(np.array(DRIBBLE, np.float32), (1, 5, 1))
    for step in range(80):
        actions[0, 0] = (*KICK[:3], 0.4, -1.0) if step < 2 else STAND
        outcome = matches.step(actions)
        if outcome.ended[0]:
            break
    assert (outcome.metrics["interceptions"][0], outcome.metrics["taken"][0]) == (1.0, 1.0)
    assert matches.play.game.interceptions[0].tolist() == [0, 1]
    assert outcome.metrics["passes"][0] == 0.0


def test_the_script_keeps_the_ball_longer_than_robots_that_stand_or_hold_it() -> None:
    task = SslKeepaway(max_steps=400)
    kept = {name: play(task, name, worlds=16).metrics for name in ("keep", "hold", "zero")}
    mean = {name: float(metrics["possession"].mean()) for name, metrics in kept.items()}
    assert mean["keep"] > 2.0 * max(mean["hold"], mean["zero"])
    assert kept["keep"]["passes"].mean() > 1.0
    assert kept["hold"]["taken"].mean() > 0.9, "the takers take the ball"


def test_either_team_learns() -> None:
    keepers, takers = ("blue_0", "blue_1", "blue_2"), ("yellow_0", "yellow_1")
    assert SslKeepaway().agents == keepers
    assert set(SslKeepaway().default_controllers().values()) == {LEARN, "take"}
    other = SslKeepaway(learners="takers")
    assert other.agents == takers
    assert other.default_controllers()["blue_0"] == "keep"
    assert (other.success, other.full_success) == ("lost", 1.0)
    assert TASK.agents == (*keepers, *takers)
    assert SslKeepaway(opponent="ou").default_controllers()["yellow_0"] == "ou"
    assert not TASK.two_sided
    result = rsoccer.evaluate("take", matches=2, task=SslKeepaway(learners="takers", max_steps=40))
    assert result.metric == "lost"


def test_a_limit_reached_is_full_success() -> None:
    task = SslKeepaway(max_steps=7)
    outcome = run(task, task.get_initial_positions_frame(WorldRng.seeded(0, 1)))[0]
    assert outcome.truncated[0]
    assert outcome.metrics["possession"][0] == task.full_success


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"n_keepers": 1}, "n_keepers: expected at least 2, got 1"),
        ({"n_takers": 0}, "n_takers: expected at least 1, got 0"),
        ({"area_length": 9.5}, "area_length: expected .* got 9.5"),
        ({"area_width": 0.5}, "area_width: expected .* got 0.5"),
        ({"field": "ssl_challenge"}, "area_width: expected .* got 5.0"),
        ({"learners": "blue"}, "learners: expected one of .*, got 'blue'"),
        ({"taking_seconds": 0.0}, "taking_seconds: expected .* got 0.0"),
        ({"n_takers": 11, "area_width": 1.0, "area_length": 1.0}, "n_takers, .*: no space"),
    ],
)
def test_wrong_options_are_named(options: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        SslKeepaway(**options)


def test_an_opponent_without_a_name_is_refused() -> None:
    with pytest.raises(ValueError, match="unknown policy ''"):
        Matches(SslKeepaway(opponent=""))


def test_skill_of_the_takers_is_their_speed() -> None:
    task = SslKeepaway()
    start = scene(task, ball=(-2.0, 0.0), blue_0=(2.0, 2.0), **{**AWAY, "yellow_0": (1.0, 0.0)})
    way = []
    for skill in ("take:0", "take:1"):
        matches = Matches(task, controllers={"yellow": skill, "blue": "zero"}, autoreset="disabled")
        matches.reset(rows=start.rows)
        for _ in range(30):
            matches.step(np.zeros((1, 0, 5), np.float32))
        way.append(1.0 - float(matches.frame.yellow.position[0, 0, 0]))
    assert 0.1 < 2.0 * way[0] < way[1]
    with pytest.raises(ValueError, match="take: expected a skill from 0 to 1"):
        policies.make_policy("take:2", task)


def test_possession_of_yellow_is_counted_too() -> None:
    poses = {**AWAY, "yellow_0": (0.0, 0.0)}
    start = scene(TASK, ball=(MOUTH, 0.0), blue_0=(-1.5, 0.0), **poses)
    _, matches = run(TASK, start, DRIBBLE)
    steps = matches.play.game.possession_steps[0]
    assert steps[YELLOW] >= 9
    assert steps.sum() == steps[YELLOW]
