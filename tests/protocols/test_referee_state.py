"""From matches and replays to what the referee tells."""

import numpy as np

import rsoccer
from rsoccer.game import BLUE, YELLOW, Command, Stage
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.referee_state import status_of_game, status_of_recorded
from rsoccer.render.referee_state import referee_of, referee_state


def test_a_running_match_is_reported() -> None:
    matches = rsoccer.Matches("SSLMatch-v0", worlds=2)
    matches.reset(seed=0)
    rule = referee_of(matches.task)
    assert rule is not None
    game, layout = matches.play.game, WireLayout(matches.task.config)
    status = status_of_game(layout, game, 1, rule.rules, names=("a", "b"), goalkeepers=(3, 4))
    assert status.command in (Command.PREPARE_KICKOFF_BLUE, Command.PREPARE_KICKOFF_YELLOW)
    assert status.stage is Stage.NORMAL_FIRST_HALF_PRE
    assert status.next_command is Command.NORMAL_START
    assert (status.seconds_left, status.action_seconds_left) == (None, None)
    assert [team.name for team in status.teams] == ["a", "b"]
    assert [team.goalkeeper for team in status.teams] == [3, 4]
    assert [team.max_robots for team in status.teams] == [6, 6]


def test_numbers_of_a_match_are_reported() -> None:
    matches = rsoccer.Matches("SSLMatch-v0", worlds=2)
    matches.reset(seed=0)
    rule = referee_of(matches.task)
    assert rule is not None
    game, layout, step = matches.play.game, WireLayout(matches.task.config), 0.025
    game.score[1] = (2, 5)
    game.fouls[1], game.red_cards[1], game.yellow_cards[1] = (4, 1), (1, 0), (3, 2)
    game.yellow_steps_left[1] = (400, 0, 800, 1200)
    game.placement_failures[1] = (5, -1)
    game.seconds_left[1] = 123.5
    row = {name: i for i, name in enumerate(rsoccer._core.GAME_COLUMNS)}
    game.referee[1, row["stage"]] = Stage.NORMAL_FIRST_HALF
    game.referee[1, row["command"]] = Command.DIRECT_FREE_BLUE
    game.referee[1, row["command_steps"]] = 40
    status = status_of_game(layout, game, 1, rule.rules)
    blue, yellow = status.teams
    assert (blue.score, yellow.score) == (2, 5)
    assert (blue.fouls, yellow.fouls, blue.red_cards, yellow.yellow_cards) == (4, 1, 1, 2)
    assert np.allclose(blue.yellow_card_seconds, (400 * step,))
    assert np.allclose(yellow.yellow_card_seconds, (800 * step, 1200 * step))
    assert (blue.max_robots, yellow.max_robots) == (4, 4)
    assert (blue.may_place, yellow.may_place, yellow.placement_failures) == (False, True, 0)
    assert status.seconds_left == 123.5
    assert status.action_seconds_left == rule.rules.free_kick_seconds - 1.0


def test_teams_of_equal_columns_are_reported_as_themselves() -> None:
    matches = rsoccer.Matches("SSLMatch-v0", worlds=2)
    matches.reset(seed=0)
    rule = referee_of(matches.task)
    assert rule is not None
    game, layout = matches.play.game, WireLayout(matches.task.config)
    for score, names in ((1, ("a", "b")), (2, ("b", "a"))):
        game.score[:] = score
        status = status_of_game(layout, game, 0, rule.rules, names=names, goalkeepers=(score, 0))
        assert [team.name for team in status.teams] == list(names)
        assert [team.score for team in status.teams] == [score, score]
        assert [team.goalkeeper for team in status.teams] == [score, 0]
    once = rule.rules.replaced(placement_failures=0)
    for rules, may_place in ((rule.rules, True), (once, False)):
        status = status_of_game(layout, game, 0, rules)
        assert [team.may_place for team in status.teams] == [may_place, may_place]


def test_times_left_for_actions() -> None:
    matches = rsoccer.Matches("SSLMatch-v0")
    matches.reset(seed=0)
    rule = referee_of(matches.task)
    assert rule is not None
    game, layout = matches.play.game, WireLayout(matches.task.config)
    row = {name: i for i, name in enumerate(rsoccer._core.GAME_COLUMNS)}

    def left(command: Command, kick: Command, *, in_play: bool = False) -> float | None:
        for name, value in (("command", command), ("kick", kick), ("in_play", in_play)):
            game.referee[0, row[name]] = value
        game.referee[0, row["wait_steps"]], game.referee[0, row["command_steps"]] = 1200, 80
        return status_of_game(layout, game, 0, rule.rules).action_seconds_left

    assert left(Command.BALL_PLACEMENT_BLUE, Command.DIRECT_FREE_BLUE) == 28.0
    assert left(Command.NORMAL_START, Command.PREPARE_KICKOFF_BLUE) == 8.0
    assert left(Command.NORMAL_START, Command.PREPARE_PENALTY_YELLOW) == 8.0
    assert left(Command.NORMAL_START, Command.PREPARE_KICKOFF_BLUE, in_play=True) is None
    assert left(Command.STOP, Command.PREPARE_KICKOFF_BLUE) is None
    assert left(Command.NORMAL_START, Command.DIRECT_FREE_BLUE) is None


def test_placements_name_their_place_and_recordings_tell_the_same() -> None:
    matches = rsoccer.Matches("SSLMatch-v0")
    matches.reset(seed=0)
    rule, game = referee_of(matches.task), matches.play.game
    assert rule is not None
    layout = WireLayout(matches.task.config)
    game.designated_position[0] = (1.0, -2.0)
    for command in (Command.BALL_PLACEMENT_YELLOW, Command.STOP):
        game.referee[0, 0] = command
        live = status_of_game(layout, game, 0, rule.rules)
        state = referee_state(matches.task, matches.play)
        assert state is not None
        recorded = status_of_recorded(state)
        placed = command is Command.BALL_PLACEMENT_YELLOW
        assert live.designated_position == ((1.0, -2.0) if placed else None)
        assert recorded.designated_position == live.designated_position
        assert (recorded.command, recorded.stage) == (live.command, live.stage)
        for team in (BLUE, YELLOW):
            assert recorded.teams[team].score == live.teams[team].score
