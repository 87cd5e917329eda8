"""Whole matches of both leagues under a referee: options, rewards, metrics, ends, saved states."""

import json
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer import LEARN, Matches
from rsoccer._core import GAME_FEATURES
from rsoccer.arrays import Floats
from rsoccer.frame import Frame
from rsoccer.game import BLUE, YELLOW, Command, EventKind, Stage
from rsoccer.matches import Outcome
from rsoccer.tasks import SslMatch, VssMatch
from rsoccer.tasks.match import TEAMS, Match
from rsoccer.testing import check_task
from rsoccer.testing.pressure import Pressing
from tests.games import begin_play, exchange_kickoffs, set_game
from tests.helpers import same, zeros
from tests.test_view import rotated

MAX_YELLOW_CARDS = 2  # of a team at once; another one is a red card
SHORT: dict[str, Any] = {"half_seconds": 2.0, "halves": 1}
BOTH: list[Match] = [VssMatch(), SslMatch()]
both = pytest.mark.parametrize("task", BOTH, ids=["vsss", "ssl"])


def in_play(task: Match, rows: Floats | None = None, worlds: int = 1) -> Matches:
    """Matches with the ball in play, which do not begin anew by themselves."""
    matches = Matches(task, worlds, controllers={"all": LEARN}, autoreset="disabled")
    matches.reset(rows=rows)
    begin_play(matches)
    return matches


def shot(task: Match, side: float, speed: float = 2.0) -> Floats:
    """A ball that rolls into the goal at +x (side 1) or -x (-1), past robots along a touch line."""
    frame = Frame.empty(1, task.n_blue, task.n_yellow)
    field = task.config.field
    robots = task.n_blue + task.n_yellow
    frame.robots.position[0, :, 0] = np.linspace(-0.5, 0.5, robots) * field.half_length
    frame.robots.position[0, :, 1] = -0.8 * field.half_width
    frame.ball.position[0] = side * (field.half_length - 0.1), 0.05
    frame.ball.velocity[0] = side * speed, 0.0
    return frame.rows


def stepped(matches: Matches, until: Callable[[Outcome], bool], limit: int = 2000) -> Outcome:
    """The outcome that fulfills a condition, without any action before."""
    for _ in range(limit):
        outcome = matches.step(zeros(matches))
        if until(outcome):
            return outcome
    raise AssertionError("it did not happen")


# -- Options ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("options", "error", "message"),
    [
        ({"half_seconds": 0.0}, ValueError, "half_seconds: expected .*, got 0"),
        ({"half_seconds": "long"}, TypeError, "half_seconds: expected a number, got 'long'"),
        ({"halves": 0}, ValueError, "halves: expected at least 1, got 0"),
        ({"halves": 3}, ValueError, "halves: expected 1 or 2, got 3"),
        ({"clock": "slow"}, ValueError, "^clock: expected one of .*, got 'slow'"),
        ({"knockout": 1}, TypeError, "knockout: expected True or False, got 1"),
        ({"referee": 3}, TypeError, "referee: expected values by name, got 3"),
        ({"referee": {"speed": 3}}, ValueError, "^referee: expected one of .*, got 'speed'"),
        ({"referee": {"ball_speed": -1}}, ValueError, "^ball_speed: expected .*, got -1"),
        ({"referee": {"off": ["OFFSIDE"]}}, ValueError, "^off: expected names of .*'OFFSIDE'"),
        ({"referee": {1: 2}}, TypeError, "^referee: expected names as text, got 1$"),
        ({"referee": {"half_seconds": 5}}, ValueError, "^referee: 'half_seconds' is an option"),
        ({"referee": {"halves": 2}}, ValueError, "option of the task: give halves=...$"),
        ({"referee": {"clock": "running"}}, ValueError, "^referee: 'clock' is an option"),
        ({"referee": {"shootout_kicks": 3}}, ValueError, "'shootout_kicks' holds with knockout"),
        (
            {"referee": {"extra_half_seconds": 5}},
            ValueError,
            "^referee: 'extra_half_seconds' holds",
        ),
        ({"referee": {"early_end_goals": 1.5}}, ValueError, "^early_end_goals: expected a whole"),
        ({"n_blue": 0}, ValueError, "n_blue: expected at least 1, got 0"),
        ({"n_yellow": 0}, ValueError, "n_yellow: expected at least 1, got 0"),
    ],
)
@both
def test_a_wrong_option_is_named(
    task: Match, options: dict[str, Any], error: type, message: str
) -> None:
    with pytest.raises(error, match=message):
        replace(task, **options)


def test_wrong_options_of_ssl_matches_are_named() -> None:
    with pytest.raises(ValueError, match=r"division: expected one of \('A', 'B'\), got 'C'"):
        SslMatch(division="C")
    with pytest.raises(ValueError, match=r"^placement: expected one of .*teleport.*, got 'hand'"):
        SslMatch(placement="hand")


@pytest.mark.parametrize("name", ["ball_speed", "free_ball"])
def test_options_of_tasks_that_end_with_a_goal_are_unknown(name: str) -> None:
    with pytest.raises(TypeError, match=name):
        rsoccer.make_task("VSSMatch-v0", **{name: 1})


@both
def test_options_are_numbers_of_the_rules(task: Match) -> None:
    changed = replace(task, half_seconds=60, halves=1, clock="running", referee={"stop_seconds": 1})
    rules = changed.referee_config
    assert (rules.half_seconds, rules.halves, rules.clock) == (60.0, 1.0, "running")
    assert rules.stop_seconds == 1.0
    assert rules.goal_stop_seconds == task.referee_config.goal_stop_seconds
    assert (task.referee_config.extra_half_seconds, task.referee_config.shootout_kicks) == (0, 0)
    knockout = replace(task, knockout=True).referee_config
    assert knockout.extra_half_seconds > 0.0
    assert knockout.shootout_kicks > 0.0
    kicks = replace(task, knockout=True, referee={"shootout_kicks": 3}).referee_config
    assert kicks.shootout_kicks == 3.0


@pytest.mark.parametrize(
    ("task", "value", "message"),
    [
        (VssMatch(), {"off": ["BOT_PUSHED_BOT"]}, "^off: expected names of GOAL, .*BOT_PUSHED"),
        (VssMatch(), {"dribble_distance": 1.0}, "^referee: expected one of .*'dribble_distance'"),
        (VssMatch(), {"placement": "robots"}, "^referee: expected one of .*got 'placement'"),
        (VssMatch(), {"fouls_per_card": 3}, "^referee: expected one of .*got 'fouls_per_card'"),
        (SslMatch(), {"contest_distance": 0.2}, "^referee: expected one of .*'contest_distance'"),
        (SslMatch(), {"fouls_per_card": 1.5}, "^fouls_per_card: expected a whole number, got 1.5"),
        (SslMatch(), {"placement": "robots"}, "^referee: 'placement' is an option of the task"),
    ],
)
def test_values_that_only_the_other_league_or_another_option_has_are_refused(
    task: Match, value: dict[str, Any], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        replace(task, referee=value)


@both
def test_numbers_of_numpy_are_kept_as_those_of_python(task: Match) -> None:
    given = {
        "stop_seconds": np.float32(2),
        "early_end_goals": np.int64(3),
        "off": [np.str_("GOAL")],
    }
    options: dict[str, Any] = {
        "half_seconds": np.int64(60),
        "halves": np.int64(2),
        "knockout": np.bool_(True),
    }
    changed = replace(task, **options, referee=given)
    values = {"stop_seconds": 2.0, "early_end_goals": 3, "off": ["GOAL"]}
    plain = replace(task, half_seconds=60, halves=2, knockout=True, referee=values)
    assert changed == plain
    assert repr(changed) == repr(plain)
    assert changed.referee_config == plain.referee_config
    assert json.dumps(changed.referee) == json.dumps(plain.referee)
    kicks = SslMatch(referee={"aimless_kick": np.bool_(True)})
    assert kicks.referee["aimless_kick"] is True


def test_field_and_rules_follow_from_division_and_table() -> None:
    for division, field in (("A", "ssl_a"), ("B", "ssl_b")):
        task = SslMatch(division=division)
        assert task.config.field.name == field
        assert task.referee_config.preset == f"ssl_2026_{division.lower()}"
    elsewhere = SslMatch(division="A", field="ssl_b")
    assert (elsewhere.config.field.name, elsewhere.preset) == ("ssl_b", "ssl_2026_a")
    assert SslMatch(placement="robots").referee_config.placement == "robots"
    assert VssMatch().referee_config.preset == "vsss_3v3"
    assert VssMatch(field="vss_5v5").referee_config.preset == "vsss_5v5"


def test_no_two_vsss_matches_of_the_same_scripts_are_alike() -> None:
    task = VssMatch(half_seconds=60.0)
    matches = Matches(task, 4, controllers={"all": "chase"}, autoreset="disabled")
    matches.reset()
    spread = np.ptp(matches.frame.robots.position, axis=0)
    assert ((spread > 0.0) & (spread <= 2.0 * task.referee_config.placement_error + 1e-6)).all()
    kickoffs: dict[int, Floats] = {}  # places at the first kick-off after a goal
    prepared = (Command.PREPARE_KICKOFF_BLUE, Command.PREPARE_KICKOFF_YELLOW)
    for _ in range(4000):
        matches.step(zeros(matches))
        game = matches.play.game
        for world in np.flatnonzero(np.isin(game.command, prepared) & game.score.any(axis=1)):
            kickoffs.setdefault(int(world), matches.frame.robots.position[world].copy())
        if len(kickoffs) == 4:
            break
    assert len(kickoffs) == 4
    spread = np.ptp(np.stack(list(kickoffs.values())), axis=0)
    assert (spread > 0.0).all()
    exact = VssMatch(referee={"placement_error": 0.0})
    matches = Matches(exact, 4, controllers={"all": "chase"})
    matches.reset()
    assert not np.ptp(matches.frame.robots.position, axis=0).any()


def test_the_defaults_are_those_of_the_leagues() -> None:
    vss, ssl = BOTH
    assert (vss.n_blue, vss.n_yellow, ssl.n_blue, ssl.n_yellow) == (3, 3, 6, 6)
    for task in BOTH:
        rules = task.referee_config
        assert (rules.half_seconds, rules.halves, rules.clock) == (300.0, 2.0, "stopped")
        assert task.two_sided
        assert task.success == "goal_score"
        assert len(task.agents) == task.n_blue + task.n_yellow


# -- Course of a match ------------------------------------------------------------------------


@both
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_goal_pays_and_play_goes_on(task: Match, side: float) -> None:
    matches = in_play(task, shot(task, side))
    outcome = stepped(matches, lambda _: bool(matches.play.game.score.any()), 40)
    scorer = BLUE if side > 0 else YELLOW
    signs = np.where(matches.play.viewpoint.teams == scorer, 1.0, -1.0)
    assert outcome.terms["goal"][0].tolist() == (10.0 * signs).tolist()
    assert not outcome.ended[0]
    assert outcome.metrics["goal_score"][0] == side
    assert [outcome.metrics[f"{team}_goals"][0] for team in TEAMS] == [side > 0, side < 0]
    assert matches.play.events.by_team(EventKind.GOAL)[0, scorer] == 1
    game = matches.play.game
    kickoff = Command.PREPARE_KICKOFF_YELLOW if side > 0 else Command.PREPARE_KICKOFF_BLUE
    assert (game.command[0], game.next_command[0]) == (Command.STOP, kickoff)
    after = stepped(matches, lambda _: game.command[0] == Command.NORMAL_START)
    assert not after.terms["goal"].any()
    assert not after.ended[0]
    assert np.abs(matches.frame.ball.position[0]).max() < 1e-3, "the ball is at the center"
    assert outcome.metrics["goal_score"][0] == side


@both
def test_a_match_ends_as_a_termination_with_its_time(task: Match) -> None:
    matches = in_play(replace(task, half_seconds=1.0, halves=1))
    set_game(matches, stage_steps_left=40)
    steps = 0
    while not matches.done[0]:
        outcome = matches.step(zeros(matches))
        steps += 1
        assert steps < 1000
    assert outcome.terminated[0] and not outcome.truncated[0]
    assert matches.play.game.stage[0] == Stage.POST_GAME
    assert outcome.metrics["in_play"][0] >= 0.9


def test_a_match_is_truncated_after_its_steps() -> None:
    matches = in_play(VssMatch(max_steps=3))
    outcomes = [matches.step(zeros(matches)) for _ in range(3)]
    assert [bool(outcome.truncated[0]) for outcome in outcomes] == [False, False, True]
    assert not outcomes[-1].terminated[0]


@both
def test_halves_and_clocks_make_the_length_of_a_match(task: Match) -> None:
    seconds = {}
    for halves, clock in ((1, "stopped"), (2, "stopped"), (2, "running")):
        short = replace(task, half_seconds=1.5, halves=halves, clock=clock)
        matches = Matches(short, 4, seed=2, autoreset="disabled")
        pressing = Pressing(short)
        matches.reset()
        while not matches.done.all():
            matches.step(pressing.actions(matches))
            assert matches.play.steps.max() < 8000
        seconds[halves, clock] = matches.play.steps.mean() * short.config.time_step
    assert seconds[1, "stopped"] < seconds[2, "stopped"]
    assert seconds[2, "running"] <= seconds[2, "stopped"]


@both
def test_time_that_is_left_goes_down_in_play(task: Match) -> None:
    matches = in_play(task)
    set_game(matches, stage_steps_left=400)
    matches.step(zeros(matches))
    first = float(matches.play.game.seconds_left[0])
    assert first == pytest.approx(399 * 0.025, abs=1e-4)
    matches.step(zeros(matches))
    assert matches.play.game.seconds_left[0] == pytest.approx(first - 0.025, abs=1e-4)


@pytest.mark.parametrize("knockout", [False, True])
@both
def test_a_drawn_match_goes_on_where_one_team_has_to_win(task: Match, knockout: bool) -> None:
    matches = in_play(replace(task, half_seconds=1.0, halves=1, knockout=knockout))
    set_game(matches, stage_steps_left=1)
    game = matches.play.game
    outcome = stepped(matches, lambda _: game.stage[0] != Stage.NORMAL_FIRST_HALF, 800)
    assert bool(outcome.terminated[0]) is not knockout
    expected = Stage.EXTRA_FIRST_HALF_PRE if knockout else Stage.POST_GAME
    assert game.stage[0] == expected


# -- What robots observe ----------------------------------------------------------------------


def game_block(matches: Matches, observations: Floats) -> dict[str, Floats]:
    """Numbers of the block `game` (n, robots) by name."""
    columns = matches.task.layout.blocks["game"].columns
    return dict(zip(GAME_FEATURES, np.moveaxis(observations[..., columns], -1, 0), strict=True))


@both
def test_the_kickoff_is_seen_from_the_side_of_each_team(task: Match) -> None:
    matches = Matches(task, 16, seed=2)
    seen = game_block(matches, matches.reset())
    has_kickoff = matches.play.game.first_kickoff[:, None] == matches.play.viewpoint.teams
    assert same(seen["own_kickoff"], has_kickoff.astype(np.float32))
    assert same(seen["opponents_kickoff"], (~has_kickoff).astype(np.float32))
    assert not seen["may_touch"].any()
    assert (seen["own_robots"] == 1.0).all()
    commands = np.stack([seen[name] for name in GAME_FEATURES[:12]])
    assert (commands.sum(axis=0) == 1.0).all()


@both
def test_the_rotated_match_is_seen_alike(task: Match) -> None:
    ours, theirs = (Matches(task, 8, seed=4, autoreset="disabled") for _ in range(2))
    ours.reset()
    theirs.reset(rows=rotated(ours.frame).rows)
    exchange_kickoffs(theirs)
    swapped = [*range(task.n_blue, 2 * task.n_blue), *range(task.n_blue)]
    rng = np.random.default_rng(0)
    for _ in range(10):
        actions = rng.uniform(-0.5, 0.5, zeros(ours).shape).astype(np.float32)
        a, b = ours.step(actions), theirs.step(np.ascontiguousarray(actions[:, swapped]))
        assert same(a.observations[:, swapped] + 0, b.observations + 0)


@both
def test_a_robot_that_is_taken_out_is_masked(task: Match) -> None:
    frame = Frame(shot(task, 1.0, 0.0), task.n_blue, task.n_yellow)
    frame.robots.absent[0, 1] = 1.0
    matches = in_play(task, frame.rows)
    outcome = matches.step(zeros(matches))
    blocks = matches.task.layout.blocks
    present = outcome.observations[0, :, blocks["presence"].columns]
    assert present[0].tolist() == [1.0, 0.0] + [1.0] * (present.shape[1] - 2)
    assert not outcome.observations[0, 1, : blocks["action"].columns.start].any()
    seen = game_block(matches, outcome.observations)
    acted = matches.step(np.ones_like(zeros(matches)))
    assert acted.terms["energy"][0, 0] < 0.0
    assert all(acted.terms[name][0, 1] == 0.0 for name in ("energy", "approach", "ball_to_goal"))
    share = 1.0 - 1.0 / task.n_blue
    assert seen["own_robots"][0, 0] == pytest.approx(share)
    assert seen["opponents_robots"][0, -1] == pytest.approx(share)


# -- Rewards and metrics ----------------------------------------------------------------------


def crash(task: SslMatch) -> Floats:
    """A robot of blue that drives into a standing one of yellow, far from the ball."""
    frame = Frame(shot(task, 1.0, 0.0), task.n_blue, task.n_yellow)
    frame.ball.position[0] = -2.0, 1.0
    frame.blue.position[0, 1], frame.yellow.position[0, 1] = (0.9, 1.0), (1.1, 1.0)
    frame.blue.velocity[0, 1] = 3.0, 0.0
    return frame.rows


def test_fouls_and_cards_cost_the_team_at_fault() -> None:
    task = SslMatch()
    for fouls, cards in ((0, 0.0), (2, -2.0)):
        matches = in_play(task, crash(task))
        set_game(matches, fouls_blue=fouls)
        outcome = stepped(matches, lambda found: bool(found.terms["fouls"].any()), 5)
        assert outcome.terms["fouls"][0].tolist() == [-0.5] * 6 + [0.0] * 6
        assert outcome.terms["cards"][0].tolist() == [cards] * 6 + [0.0] * 6
        assert outcome.metrics["blue_fouls"][0] == 1.0
        assert outcome.metrics["yellow_fouls"][0] == 0.0
        assert outcome.metrics["blue_yellow_cards"][0] == (fouls == 2)
        counts = task.offenses(matches.play)
        assert counts["BOT_CRASH_UNIQUE"].tolist() == [[1.0, 0.0]]
        assert sum(float(count.sum()) for count in counts.values()) == 1.0


def test_a_card_takes_a_robot_out_of_the_next_play() -> None:
    task = SslMatch(referee={"removal_seconds": 0.5})
    matches = in_play(task, crash(task))
    set_game(matches, fouls_blue=2)
    stepped(matches, lambda _: bool(matches.frame.robots.absent.any()), 400)
    assert matches.frame.blue.absent.sum() == 1.0
    assert matches.frame.yellow.absent.sum() == 0.0
    outcome = matches.step(zeros(matches))
    own = game_block(matches, outcome.observations)["own_robots"]
    assert own[0, 0] == pytest.approx(5 / 6)
    assert own[0, -1] == 1.0


@both
def test_robots_that_may_not_touch_the_ball_are_not_drawn_to_it(task: Match) -> None:
    matches = in_play(task, shot(task, 1.0, 0.0))
    pressing = Pressing(task)
    for command, pays in ((Command.FORCE_START, True), (Command.STOP, False)):
        set_game(matches, command=command, wait_steps=1000, in_play=pays)
        matches.step(pressing.actions(matches))  # `may_touch` is that at the end of a step
        outcome = matches.step(pressing.actions(matches))
        assert outcome.terms["approach"].any() == pays
        assert matches.play.game.may_touch.all() == pays


@both
def test_metrics_add_up(task: Match) -> None:
    short = replace(task, half_seconds=8.0, halves=1)
    matches = Matches(short, 8, seed=1, controllers={"all": LEARN}, autoreset="disabled")
    pressing, goals, fouls = Pressing(short), np.zeros((8, 2)), np.zeros((8, 2))
    matches.reset()
    while not matches.done.all():
        playing = ~matches.done
        outcome = matches.step(pressing.actions(matches))
        goals[playing] += matches.play.events.by_team(EventKind.GOAL)[playing]
        for kind in short.offenses(matches.play):
            fouls[playing] += matches.play.events.by_team(EventKind[kind])[playing]
    metrics = outcome.metrics
    found = np.stack([metrics[f"{team}_goals"] for team in TEAMS], axis=1)
    assert same(found.astype(np.int64), matches.play.game.score)
    assert found.tolist() == goals.tolist()
    assert same(metrics["goal_score"], metrics["blue_goals"] - metrics["yellow_goals"])
    possession = metrics["blue_possession"] + metrics["yellow_possession"]
    assert (possession <= 1.0 + 1e-6).all() and (possession > 0.1).all()
    seconds = matches.play.steps * short.config.time_step
    assert (metrics["in_play"] > 0.5).all() and (metrics["in_play"] <= seconds + 1e-3).all()
    for i, team in enumerate(TEAMS):
        assert (metrics[f"{team}_distance"] > 1.0).all()
        assert (metrics[f"{team}_fouls"] >= fouls[:, i]).all()  # some are of both teams
        few_cards = metrics[f"{team}_yellow_cards"] < MAX_YELLOW_CARDS
        assert not metrics[f"{team}_red_cards"][few_cards].any()
    assert all(value.dtype == np.float32 for value in metrics.values())


# -- Saved states -----------------------------------------------------------------------------


@both
def test_a_match_that_is_restored_goes_on_alike(task: Match) -> None:
    ours, theirs = (Matches(task, 6, seed, autoreset="same_step") for seed in (1, 2))
    pressing = Pressing(task)
    ours.reset()
    begin_play(ours)
    for _ in range(150):
        ours.step(pressing.actions(ours))
    theirs.reset()
    theirs.load_state_dict(ours.state_dict())
    for _ in range(150):
        actions = pressing.actions(ours)
        a, b = ours.step(actions), theirs.step(actions)
        assert same(a.observations, b.observations)
        assert same(a.rewards, b.rewards)
        assert all(same(a.metrics[name], b.metrics[name]) for name in a.metrics)
    saved, other = ours.state_dict(), theirs.state_dict()
    assert all(same(saved[name], other[name]) for name in saved)
    assert ours.play.game.statistics.any()


@both
def test_tasks_keep_the_promises_of_tasks_in_play(task: Match) -> None:
    check_task(replace(task, **SHORT, referee={"prepare_seconds": 0.1}), worlds=3, steps=120)
