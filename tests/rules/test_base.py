"""Restarts that rules decide: their effect on the matches, their precedence, invalid ones."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest

from rsoccer import Matches, Simulator
from rsoccer.arrays import Floats, Mask
from rsoccer.play import Play
from rsoccer.rules import Restart, Rule
from rsoccer.tasks import VssSelfPlay
from tests.helpers import begun, same, zeros
from tests.rules.listed import Listed, ListedVss, balls, line_ups, vss_matches

CORNERS = [(0.6, 0.5), (-0.6, 0.5), (0.6, -0.5), (-0.6, -0.5)]


def corner_start(worlds: int) -> Floats:
    """Robots in a line at y = 0, so that all corners are free."""
    return line_ups(*[0.0] * worlds)


def started(worlds: int = 4, **settings: Any) -> tuple[Matches, list[Any]]:  # noqa: ANN401
    matches, results = vss_matches(worlds, **settings)
    matches.reset(rows=corner_start(worlds))
    return matches, results


def test_worlds_in_any_order_get_their_own_states() -> None:
    matches, results = vss_matches()
    control = begun(ListedVss(), 4)
    results.append(Restart(np.array([3, 0]), rows=line_ups(0.3, -0.2)))
    matches.step(zeros(matches) + 0.5)
    control.step(zeros(control) + 0.5)
    assert same(matches.frame.rows[[0, 3]], line_ups(-0.2, 0.3))
    assert same(matches.frame.rows[1:3], control.frame.rows[1:3])
    assert matches.play.steps.tolist() == [1, 1, 1, 1]


def test_worlds_in_any_order_get_their_own_balls() -> None:
    """Formerly rows were used in the order of the result, but worlds in the order of a mask."""
    matches, results = started()
    before = matches.frame.robots.position.copy()
    worlds = [3, 0, 2]
    results.append(Restart(np.array(worlds), balls=balls(*[CORNERS[i] for i in worlds])))
    matches.step(zeros(matches))
    for world in worlds:
        assert matches.frame.ball.position[world] == pytest.approx(CORNERS[world])
    assert not same(matches.frame.ball.position[1], np.array(CORNERS[1], np.float32))
    assert matches.frame.robots.position == pytest.approx(before, abs=1e-3), "no robot moved"


@pytest.mark.parametrize("kind", ["rows", "balls"])
def test_last_frame_and_views_equal_the_new_ones_only_in_these_worlds(kind: str) -> None:
    matches, results = started()
    matches.step(zeros(matches) + 0.5)
    new = {"rows": line_ups(0.3, -0.2), "balls": balls(CORNERS[2], CORNERS[0])}
    results.append(Restart(np.array([2, 0]), **{kind: new[kind]}))
    matches.step(zeros(matches) + 0.5)
    play, moved = matches.play, np.array([True, False, True, False])
    assert same(play.view.ball.data[moved], play.last_view.ball.data[moved])
    for now, last in (
        (play.frame.rows, play.last_frame.rows),
        (play.view.robots.data, play.last_view.robots.data),
    ):
        assert same(now[moved], last[moved])
        assert not any(same(now[world], last[world]) for world in np.flatnonzero(~moved))
    fresh = matches._viewpoint.new_view(4)
    matches._viewpoint.fill(play.frame, fresh)
    assert same(fresh.ball.data, play.view.ball.data)
    assert same(fresh.robots.data, play.view.robots.data)


@dataclass(frozen=True)
class Looking(ListedVss):
    """A task whose reward is computed from the views of the robots."""

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        terms, done = super().calculate_reward_and_done(play)
        moved = play.view.ball.position - play.last_view.ball.position
        return terms | {"moved": np.linalg.norm(moved, axis=-1)}, done


def test_views_that_a_reward_has_read_show_the_state_after_the_restart() -> None:
    task = Looking()
    matches = begun(task, 2)
    task.rule.results.append(Restart(np.array([1]), rows=line_ups(0.3)))
    outcome = matches.step(zeros(matches) + 0.5)
    play = matches.play
    assert play.view.ball.position[1, 0] == pytest.approx((-0.5, 0.3))
    assert same(play.view.ball.data[1], play.last_view.ball.data[1])
    ball = matches.task.layout.blocks["ball"].columns
    assert outcome.observations[1, 0, ball][1] == pytest.approx(0.3 / 0.75)


def test_observations_show_the_state_after_the_restart() -> None:
    matches, results = started()
    results.append(Restart(np.array([1]), rows=line_ups(0.3)))
    outcome = matches.step(zeros(matches) + 0.5)
    expected = matches.task.layout.observe(matches.play)
    assert same(outcome.observations, expected)
    ball = matches.task.layout.blocks["ball"].columns
    assert outcome.observations[1, 0, ball][1] == pytest.approx(0.3 / 0.75)


@pytest.mark.parametrize("kind", ["rows", "balls"])
def test_waiting_worlds_keep_their_state(kind: str) -> None:
    matches, results = started(autoreset="disabled")
    matches._done[1] = True
    before = matches.frame.rows.copy()
    new = {"rows": line_ups(0.3, -0.2), "balls": balls(CORNERS[1], CORNERS[0])}
    results.append(Restart(np.array([1, 0]), **{kind: new[kind]}))
    matches.step(zeros(matches))
    assert same(matches.frame.rows[1], before[1])
    assert not same(matches.frame.ball.position[0], before[0, :2])
    rows = np.empty_like(before)
    simulator = matches._simulator
    assert isinstance(simulator, Simulator)
    simulator.read(rows)
    assert same(rows[1, :2], before[1, :2])
    assert matches.play.game.judged.tolist() == [1, 0, 1, 1]


@pytest.mark.parametrize("autoreset", ["same_step", "disabled"])
def test_an_episode_that_ends_is_not_restarted(autoreset: str) -> None:
    """Its final observation is of the state that the physics left."""
    task = ListedVss(max_steps=1)
    matches, control = begun(task, 2, autoreset=autoreset), begun(ListedVss(max_steps=1), 2)
    for each in (matches, control):
        each.reset(seed=5)
    task.rule.results.append(Restart(np.array([0]), rows=line_ups(0.3)))
    ours, theirs = matches.step(zeros(matches) + 0.5), control.step(zeros(control) + 0.5)
    assert ours.truncated.all()
    assert same(ours.final_observations, theirs.final_observations)


def test_drives_continue_where_only_the_ball_is_moved() -> None:
    """Formerly all bodies were placed again, so accelerating robots lost a step of their drives."""
    matches, results = started(2)
    control, _ = started(2)
    for step in range(6):
        if step % 3 == 2:
            results.append(Restart(np.array([1]), balls=balls(CORNERS[step % 4])))
        matches.step(zeros(matches) + 0.3)
        control.step(zeros(control) + 0.3)
    ours, theirs = matches.frame.robots, control.frame.robots
    assert same(ours.data, theirs.data), "no robot touched a ball, so nothing else may differ"
    assert np.abs(ours.velocity).max() > 0.1
    assert not same(matches.frame.ball.position[1], control.frame.ball.position[1])


def test_rules_begin_where_play_begins() -> None:
    matches, results = started()
    rule = matches.task.rules[1]
    assert isinstance(rule, Listed)
    rule.begun.clear()
    results.append(Restart(np.array([3, 1]), rows=line_ups(0.3, -0.2)))
    matches.step(zeros(matches))
    assert rule.begun == [[1, 3]], "after a restart"
    matches.reset(mask=np.array([False, False, True, False]))
    assert rule.begun[1:] == [[0]], "one new episode, in a part with one world"


@dataclass(frozen=True)
class TwoRules(VssSelfPlay):
    """A task with two listed rules."""

    first: Listed = field(default_factory=lambda: Listed([]))
    second: Listed = field(default_factory=lambda: Listed([]))

    @property
    def rules(self) -> Sequence[Rule]:
        return self.first, Second(self.second.results)


class Second(Listed):
    """A rule with other columns than the first one."""

    def columns(self, n: int) -> dict[str, Any]:
        return {}


def test_a_restart_of_worlds_that_wait_does_not_hold_up_those_of_other_rules() -> None:
    task = TwoRules()
    matches = begun(task, 3, autoreset="disabled")
    matches.reset(rows=corner_start(3))
    matches._done[0] = True
    task.first.results.append(Restart(np.array([0]), balls=balls(CORNERS[0])))
    task.second.results.append(Restart(np.array([1]), rows=line_ups(0.3)))
    matches.step(zeros(matches))
    assert same(matches.frame.rows[[0, 1]], line_ups(0.0, 0.3))


def test_of_two_restarts_of_a_world_the_first_counts() -> None:
    task = TwoRules()
    matches = begun(task, 3)
    matches.reset(rows=corner_start(3))
    task.first.results.append(Restart(np.array([2]), balls=balls(CORNERS[0])))
    task.second.results.append(Restart(np.array([2, 1]), rows=line_ups(0.3, -0.2)))
    matches.step(zeros(matches))
    assert matches.frame.ball.position[2] == pytest.approx(CORNERS[0])
    assert matches.frame.robots.position[2, 0, 1] == pytest.approx(0.0), "its robots stayed"
    assert same(matches.frame.rows[1:2], line_ups(-0.2))


def test_rules_may_not_share_the_name_of_a_column() -> None:
    @dataclass(frozen=True)
    class Doubled(VssSelfPlay):
        @property
        def rules(self) -> Sequence[Rule]:
            return Listed([]), Listed([])

    with pytest.raises(ValueError, match="Listed: the name 'judged' is taken"):
        Matches(Doubled())


def test_no_rule_may_replace_the_score() -> None:
    class Scorer(Listed):
        def columns(self, n: int) -> dict[str, Any]:
            return {"score": np.zeros((n, 2), np.int64)}

    @dataclass(frozen=True)
    class Scored(VssSelfPlay):
        @property
        def rules(self) -> Sequence[Rule]:
            return (Scorer([]),)

    with pytest.raises(ValueError, match="Scorer: the name 'score' is taken"):
        Matches(Scored())


def test_a_column_has_a_row_for_each_world() -> None:
    class Single(Listed):
        def columns(self, n: int) -> dict[str, Any]:
            return {"judged": np.zeros(1)}

    @dataclass(frozen=True)
    class Wrong(VssSelfPlay):
        @property
        def rules(self) -> Sequence[Rule]:
            return (Single([]),)

    with pytest.raises(ValueError, match=r"Single: expected \(3, ...\) for 'judged', got \(1,\)"):
        Matches(Wrong(), 3)


BALL, BALLS, ROW = balls(CORNERS[0]), balls(*CORNERS[:2]), line_ups(0.0)
INVALID: list[tuple[object, str]] = [
    (Restart(np.array([4]), rows=ROW), r"Listed.judge: expected worlds 0 to 3, got \[4\]"),
    (Restart(np.array([-1]), balls=BALL), r"expected worlds 0 to 3, got \[-1\]"),
    (Restart(np.array([0, 4]), balls=BALLS), r"expected worlds 0 to 3, got \[0, 4\]"),
    (Restart(np.array([2, -1]), balls=BALLS), r"expected worlds 0 to 3, got \[2, -1\]"),
    (Restart(np.array([1, 1]), rows=line_ups(0.0, 0.0)), r"expected each world once, got \[1, 1\]"),
    (Restart(np.array([2, 0, 2]), balls=balls(*CORNERS[:3])), r"once, got \[0, 2, 2\]"),
    (Restart(np.array([0.0]), rows=ROW), "expected whole numbers"),
    (Restart(np.array([True]), balls=BALL), "expected whole numbers"),
    (Restart(np.array([[0]]), balls=BALL), r"expected whole numbers \(k,\)"),
    (Restart(np.array([0]), rows=line_ups(0.0, 0.0)), r"Listed.judge: rows: expected shape \(1, "),
    (Restart(np.array([0]), balls=balls(*CORNERS)), r"balls: expected shape \(1, 17\)"),
    (Restart(np.array([0]), rows=line_ups(np.nan)), "rows: expected finite"),
    (Restart(np.array([0]), balls=balls((np.nan, 0))), "balls: expected finite"),
    (Restart(np.array([0]), rows=line_ups(9.0)), "world 0: ball is outside the field"),
    (Restart(np.array([0]), balls=balls((9, 9))), "world 0: ball is outside the field"),
    (Restart(np.array([0])), "either balls or rows"),
    (Restart(np.array([0]), balls=BALL, rows=ROW), "either balls or rows"),
    (ROW, "expected a Restart or None"),
]


@pytest.mark.parametrize(("result", "message"), INVALID)
def test_invalid_restarts_are_named(result: object, message: str) -> None:
    matches, results = vss_matches()
    results.append(result)
    with pytest.raises((TypeError, ValueError), match=message):
        matches.step(zeros(matches))


@pytest.mark.parametrize("none", [np.zeros(0, np.intp), [], ()])
def test_a_restart_may_concern_no_world(none: Any) -> None:  # noqa: ANN401
    """Formerly an empty list was refused as an array of floats."""
    matches, results = vss_matches()
    control = begun(ListedVss(), 4)
    results.append(Restart(none, balls=balls()))
    assert same(
        matches.step(zeros(matches)).observations, control.step(zeros(control)).observations
    )


def test_the_simulator_gets_worlds_and_balls_in_order() -> None:
    calls: list[tuple[list[bool], Floats]] = []

    class Recording:
        def __init__(self) -> None:
            self.own = Simulator(ListedVss().config, 3)
            self.place, self.restart, self.step = self.own.place, self.own.restart, self.own.step

        def reposition_balls(self, worlds: Mask, balls: Floats, out: Floats) -> None:
            calls.append((worlds.tolist(), balls.copy()))
            self.own.reposition_balls(worlds, balls, out)

    task = ListedVss()
    matches = Matches(task, 3, simulator=Recording())
    matches.reset(rows=corner_start(3))
    task.rule.results.append(Restart(np.array([2, 1]), balls=balls(CORNERS[2], CORNERS[1])))
    matches.step(zeros(matches))
    [(mask, received)] = calls
    assert mask == [False, True, True]
    assert same(received, balls(CORNERS[1], CORNERS[2]))
