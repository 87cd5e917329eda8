"""Audit of whole matches: clocks, scores and statistics add up, and no match is stuck."""

from typing import Final

import numpy as np

from rsoccer._core import OFFENSES
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.game import BLUE, NOBODY, YELLOW, Command, EventKind, Stage
from rsoccer.matches import Matches
from rsoccer.tasks.match import Match

IDLE_SECONDS: Final = 15.0
"""Longest time in which nothing happens, s."""
MOVED: Final = np.float32(0.1)
"""Way of the ball that is something that happens, m."""
RUNNING: Final = (
    Command.NORMAL_START,
    Command.FORCE_START,
    Command.DIRECT_FREE_BLUE,
    Command.DIRECT_FREE_YELLOW,
)
"""Commands in which a stopped clock counts."""
PLACEMENTS: Final = (Command.BALL_PLACEMENT_BLUE, Command.BALL_PLACEMENT_YELLOW)
PLAYED: Final = {
    Stage.NORMAL_FIRST_HALF: "half_seconds",
    Stage.NORMAL_SECOND_HALF: "half_seconds",
    Stage.EXTRA_FIRST_HALF: "extra_half_seconds",
    Stage.EXTRA_SECOND_HALF: "extra_half_seconds",
}
"""Stages with a clock, and the rule that says how long they last."""
BY_STATISTIC: Final = {
    "score": (EventKind.GOAL,),
    "passes": (EventKind.PASS,),
    "red_cards": (EventKind.MULTIPLE_CARDS,),
    "cards": (EventKind.MULTIPLE_FOULS,),
}
"""Events whose number is a number of the match; a red card is announced as one more card."""
ROUNDING: Final = 1e-3
"""More than the rounding of a team's way in a step, m."""


class AuditError(AssertionError):
    """Something does not add up; the message names worlds and steps."""


class MatchAudit:
    """Follows matches that are played once, without automatic resets, step by step."""

    def __init__(self, matches: Matches, task: Match) -> None:
        """Begin with matches that were just reset.

        Args:
            matches: the matches.
            task: their task.
        """
        self._matches, self._task = matches, task
        n = matches.worlds
        self._counts = {name: np.zeros((n, 2), np.int64) for name in BY_STATISTIC}
        self._offenses = np.zeros((n, 2, len(OFFENSES)), np.int64)
        self._played = np.zeros((n, len(Stage)), np.int64)
        self._in_play = np.zeros(n, np.int64)
        self._idle = np.zeros(n, np.int64)
        self._anchor = matches.frame.ball.position.copy()
        self.longest_idle = 0.0
        """Longest time in which nothing happened so far, s."""
        self.events: dict[str, int] = {}
        """Number of all events so far, by the name of their kind."""
        self._remember()

    def _remember(self) -> None:
        """Keep the state before a step."""
        game = self._matches.play.game
        self._before = {
            name: np.array(getattr(game, name))
            for name in ("command", "stage", "stage_steps_left", "in_play", "score", "distance")
        }
        self._active = ~self._matches.done

    def step(self) -> None:
        """Check the step that was just played.

        Raises:
            AuditError: something does not add up.
        """
        finite = np.isfinite(self._matches.frame.rows)
        self._check(np.asarray(finite.all(axis=1)), "a number is not finite")
        self._count_events()
        self._check_clock()
        self._check_statistics()
        self._check_idle()
        self._remember()

    def _check(self, holds: Mask, fault: str) -> None:
        """Raise an error where something does not hold in a match that was played."""
        wrong = np.flatnonzero(~holds & self._active)
        if len(wrong):
            steps = self._matches.play.steps[wrong].tolist()
            raise AuditError(f"{fault}: worlds {wrong.tolist()} in their steps {steps}")

    def _count_events(self) -> None:
        """Count the events of the step by team."""
        events = self._matches.play.events
        for world in np.flatnonzero((events.count > 0) & self._active):
            for event in events.of_world(int(world)):
                self.events[event.kind.name] = self.events.get(event.kind.name, 0) + 1
                teams = [BLUE, YELLOW] if event.team == NOBODY else [event.team]
                if event.kind in OFFENSES:
                    self._offenses[world, teams, OFFENSES.index(event.kind)] += 1
                for name, kinds in BY_STATISTIC.items():
                    if event.kind in kinds:
                        self._counts[name][world, teams] += 1

    def _check_clock(self) -> None:
        """The clock goes down by one in each step that counts, and each half has its length."""
        game, before = self._matches.play.game, self._before
        counts = np.isin(before["stage"], list(PLAYED))
        if self._task.clock == "stopped":
            counts &= np.isin(before["command"], RUNNING)
        counts &= self._active
        self._played[np.arange(len(counts)), before["stage"]] += counts
        same_stage = game.stage == before["stage"]
        expected = before["stage_steps_left"] - counts
        self._check((game.stage_steps_left == expected) | ~same_stage, "the clock is wrong")
        for stage, name in PLAYED.items():
            ended = ~same_stage & (before["stage"] == stage) & ~self._ended_early()
            if ended.any():
                self._check_length(ended, self._played[:, stage], name)

    def _check_length(self, ended: Mask, played: Array, name: str) -> None:
        """A half that ends has had its length, or more where it waits for the next stop."""
        rules = self._task.referee_config
        steps = round(getattr(rules, name) / self._task.config.time_step)
        right = played == steps if rules.half_end == "at_once" else played >= steps
        self._check(right | ~ended, "a half has another length")

    def _ended_early(self) -> Mask:
        """Whether a match may have ended by its score."""
        rules, score = self._task.referee_config, self._matches.play.game.score
        lead = np.abs(score[:, BLUE] - score[:, YELLOW]) >= rules.early_end_lead
        early: Mask = (score.max(axis=1) >= rules.early_end_goals) & lead
        early &= rules.early_end_goals > 0.0
        return early

    def _check_statistics(self) -> None:
        """All numbers of the match are those of its events and steps."""
        game, before = self._matches.play.game, self._before
        numbers = {
            "score": game.score,
            "passes": game.passes,
            "red_cards": game.red_cards,
            "cards": game.yellow_cards + game.red_cards,
        }
        for name, values in numbers.items():
            self._check((values == self._counts[name]).all(axis=1), f"{name} differ from events")
        offenses = game.offenses.reshape(self._offenses.shape)
        self._check((offenses == self._offenses).all(axis=(1, 2)), "offenses differ from events")
        self._in_play += (before["in_play"] > 0.0) & self._active
        self._check(game.in_play_steps == self._in_play, "the time in play is wrong")
        possession = game.possession_steps.sum(axis=1)
        self._check(possession <= game.in_play_steps, "possession is longer than play")
        self._check_distance(game.distance)

    def _check_distance(self, distance: Floats) -> None:
        """The way of a team grows by that of its robots, where the referee moves none of them."""
        frame, before = self._matches.frame, self._before
        game = self._matches.play.game
        speeds = np.linalg.norm(frame.robots.velocity, axis=-1) * (frame.robots.absent <= 0.0)
        split = self._task.n_blue
        teams = np.stack([speeds[:, :split].sum(axis=1), speeds[:, split:].sum(axis=1)], axis=1)
        grown = before["distance"] + teams * self._task.config.time_step
        near = np.abs(distance - grown) <= ROUNDING + np.spacing(distance)
        moved = (game.command != before["command"]) | (self._matches.play.events.count > 0)
        self._check(near.all(axis=1) | moved, "the distance is wrong")

    def _check_idle(self) -> None:
        """Something happens before long: an event, a command, a stage, free play, a moving ball."""
        play, before = self._matches.play, self._before
        ball = self._matches.frame.ball.position
        happened = (play.events.count > 0) | (play.game.command != before["command"])
        happened |= play.game.stage != before["stage"]
        happened |= play.game.in_play != before["in_play"]
        happened |= np.linalg.norm(ball - self._anchor, axis=-1) > MOVED
        self._anchor[happened] = ball[happened]
        self._idle = np.where(happened | ~self._active, 0, self._idle + 1)
        seconds = self._idle * self._task.config.time_step
        # A team may take all its time to place the ball; those who are in its way prolong it.
        placed = np.isin(play.game.command, PLACEMENTS)
        placement_seconds = play.game.wait_steps * self._task.config.time_step
        limit = np.where(placed, placement_seconds, IDLE_SECONDS)
        self._check(seconds <= limit, "nothing happens")
        self.longest_idle = max(self.longest_idle, float(seconds[~placed].max(initial=0.0)))
