"""Base class of the match tasks of both leagues: the referee, what robots see of it, metrics."""

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from dataclasses import field as dataclass_field
from functools import cached_property
from typing import Any, ClassVar, Final

import numpy as np

from rsoccer import checks, rewards
from rsoccer._core import GAME_FEATURES, OFFENSES
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import Frame
from rsoccer.game import EventKind, Stage
from rsoccer.reflection import Reflection, Symmetry
from rsoccer.rng import WorldRng
from rsoccer.rules import PassesInPlay, Rule
from rsoccer.rules.referee import PLACEMENT_SEEDS, RefereeRule
from rsoccer.rules.referee_config import RefereeConfig
from rsoccer.task import Play
from rsoccer.tasks.soccer import Soccer

GAME_BLOCK: Final = "game"
"""Name of the observation block with the state of the match."""
GAME_LIMIT: Final = 3.0
"""Bound of that block: times up to 30 s, in units of 10 s."""
TEAMS: Final = ("blue", "yellow")
_COUNTED: Final = "goals shots passes possession distance fouls yellow_cards red_cards"
_TEAM_METRICS: Final = tuple(f"{team}_{name}" for name in _COUNTED.split() for team in TEAMS)
"""Metrics that both teams have, in the order of `Match.metrics`."""
_AFTER_A_DRAW: Final = ("extra_half_seconds", "shootout_kicks", "max_shootout_kicks")
"""Numbers of the rules that hold with the option `knockout` only."""


@dataclass(frozen=True)
class Match(Soccer):
    """Base class of whole matches under a referee.

    Both teams learn, all robots are agents. A match has halves, and play is stopped and restarted
    as the rules say; a goal pays, and play goes on. The end of the match is a termination.

    The observation has two more blocks than `Soccer`: `presence`, since robots are taken out for
    cards, and `game` (29 numbers): what play is in from the side of the robot's team, what a stop
    waits for, whether the robot may touch the ball, whether it is its team's keeper (the first
    robot), the way that it has dribbled (what the rules allow), the time to act (10 s), the place
    of the next kick relative to the robot (half lengths of the field), the score difference (5
    goals), the share of the half that is left, and the shares of both teams' robots that are on the
    field. `rsoccer._core.GAME_FEATURES` names all numbers.

    Goal of the task: score more goals than the other team, in the goal at +x (blue) or -x (yellow).

    Initial state: both teams lined up for the kick-off, which one of them has by chance.

    Reward terms, unweighted:

    ============  ==================================================================  ========
    Term          Meaning                                                             Unit
    ============  ==================================================================  ========
    goal          1 for a goal of the robot's team, -1 for a goal against it          goals
    ball_to_goal  progress of the ball toward the attacked goal and away from the     m
                  own goal, for each team's robot nearest to the ball
    approach      progress toward the ball, for robots that may touch it: of each     m
                  robot in VSSS, of the nearest one of its team in SSL
    energy        negative mean magnitude of the action; 0 of an absent robot         steps
    fouls         -1 for each foul of the robot's team                                fouls
    cards         -1 for each card of the robot's team                                cards
    ============  ==================================================================  ========

    Termination: the end of the match. Truncation: after `max_steps`.

    Metrics: `goal_score`, goals of blue less those of yellow; `blue_goals`, goals of blue;
    `yellow_goals`, those of yellow; `blue_shots`, balls that leave a robot of blue toward the mouth
    of the goal; `yellow_shots`, those of yellow; `blue_passes`, passes of blue that arrive in play;
    `yellow_passes`, those of yellow; `blue_possession`, share of the time in play in which blue
    touched the ball last; `yellow_possession`, that of yellow; `blue_distance`, way of all robots
    of blue, m; `yellow_distance`, that of yellow; `blue_fouls`, fouls of blue; `yellow_fouls`,
    those of yellow; `blue_yellow_cards`, yellow cards of blue; `yellow_yellow_cards`, those of
    yellow; `blue_red_cards`, red cards of blue; `yellow_red_cards`, those of yellow; `in_play`,
    time with the ball in play, s.
    """

    max_steps: int = 200_000
    """Control steps of 25 ms until truncation, at least 1; 200,000 are 83 minutes, more than a
    match lasts."""
    half_seconds: float = 300.0
    """Playing time of a half, s, above 0."""
    halves: int = 2
    """Number of halves, 1 or 2."""
    clock: str = "stopped"
    """Time that counts: "stopped" (only while a team may play the ball, as the leagues have it) or
    "running" (all time)."""
    knockout: bool = False
    """True: a draw leads to extra time and a shoot-out."""
    referee: Mapping[str, Any] = dataclass_field(default_factory=dict)
    """Numbers and switches of the rules that differ from the league's, see `RefereeConfig`; those
    that are options of the task are given as such."""

    LEAGUE_PRESET: ClassVar[str]
    """A preset of the league's rules: all of a league have the same names."""
    OBSERVES_PRESENCE: ClassVar[bool] = True
    """Robots are taken out for cards."""
    success = "goal_score"
    """Metric that measures the success of an episode."""
    full_success = None
    """There is no greatest goal difference."""

    def __post_init__(self) -> None:
        """Validate the options."""
        checks.number_in_range("half_seconds", self.half_seconds, 1e-3, 1e5)
        if checks.integer("halves", self.halves, 1) > 2:
            raise ValueError(f"halves: expected 1 or 2, got {self.halves}")
        checks.boolean("knockout", self.knockout)
        if not isinstance(self.referee, Mapping):
            raise TypeError(f"referee: expected values by name, got {self.referee!r}")
        for name in self.referee:
            self._check_name(name)
        RefereeConfig(self.LEAGUE_PRESET, **self.referee_values)  # the preset needs the field
        super().__post_init__()

    def _check_name(self, name: object) -> None:
        """Refuse a name in the option `referee` that is no text, or another option's."""
        if not isinstance(name, str):
            raise TypeError(f"referee: expected names as text, got {name!r}")
        if name in {field.name for field in fields(self)}:
            raise ValueError(f"referee: {name!r} is an option of the task: give {name}=...")
        if name in _AFTER_A_DRAW and not self.knockout:
            raise ValueError(f"referee: {name!r} holds with knockout=True only")

    @property
    @abstractmethod
    def preset(self) -> str:
        """Name of the rules' preset."""

    @property
    def referee_values(self) -> dict[str, Any]:
        """Numbers and switches of the rules that the options give, by name."""
        values: dict[str, Any] = {
            "half_seconds": self.half_seconds,
            "halves": self.halves,
            "clock": self.clock,
        }
        if not self.knockout:
            values |= {"extra_half_seconds": 0.0, "shootout_kicks": 0.0}
        return {**values, **self.referee}

    @cached_property
    def referee_config(self) -> RefereeConfig:
        """Numbers and switches of the rules, with those of the options."""
        return RefereeConfig(self.preset, **self.referee_values)

    @cached_property
    def rules(self) -> Sequence[Rule]:
        """The referee, and the definition of a pass in play."""
        return self._referee, PassesInPlay(self.min_pass_length)

    @property
    @abstractmethod
    def min_pass_length(self) -> float:
        """Least length of a pass, m."""

    @cached_property
    def _referee(self) -> RefereeRule:
        return RefereeRule(self.config, self.referee_config)

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        """Line both teams up for the first kick-off."""
        frame = Frame.empty(len(rng), self.n_blue, self.n_yellow)
        self._referee.core.line_up(frame.rows, rng.integers(PLACEMENT_SEEDS).tolist())
        return frame

    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        """Compute the blocks of `Soccer` and the block `game`, each (n, observers, ...)."""
        blue, yellow, observers = play.known_to(0), play.known_to(1), play.observers
        groups = [(blue, observers)]
        if yellow is not blue:
            first_yellow = np.searchsorted(observers, self.n_blue)
            groups = [(blue, observers[:first_yellow]), (yellow, observers[first_yellow:])]
        parts = [
            self._referee.core.features(
                play.game.referee, known.rows, robots.tolist(), play.threads
            )
            for known, robots in groups
        ]
        game = parts[0] if len(parts) == 1 else np.concatenate(parts, axis=1)
        return super().frame_to_observations(play) | {GAME_BLOCK: game}

    def observation_limits(self) -> dict[str, float]:
        """Return the bounds of all blocks."""
        return super().observation_limits() | {GAME_BLOCK: GAME_LIMIT}

    @property
    def symmetry(self) -> Symmetry | None:
        """Return the reflections of actions and of all blocks."""
        symmetry = super().symmetry
        if symmetry is None:
            return None
        signs = [-1 if name == "designated_y" else 1 for name in GAME_FEATURES]
        return Symmetry(symmetry.action, {**symmetry.blocks, GAME_BLOCK: Reflection.of(signs)})

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        """Compute the reward terms of the class's table; the end of the match terminates."""
        may_touch = play.game.may_touch[:, play.observers].astype(np.float32)
        nearest = rewards.nearest_to_ball(play)
        field = self.config.field
        terms = {
            "goal": rewards.goal(play),
            "ball_to_goal": rewards.ball_to_goal(play, field) * nearest,
            "approach": self.approach(play, nearest) * may_touch,
            "energy": rewards.energy(play) * (play.frame.robots.absent[:, play.observers] == 0.0),
            "fouls": -rewards.events_of_team(play, OFFENSES),
            "cards": -rewards.events_of_team(play, (EventKind.MULTIPLE_FOULS,)),
        }
        done: Mask = play.game.stage == Stage.POST_GAME
        return rewards.weighted_terms(terms, self.term_weights), done

    @abstractmethod
    def approach(self, play: Play, nearest: Mask) -> Floats:
        """Return the shaping term that pulls robots to the ball, (n, observers) meters.

        Args:
            play: state of n worlds.
            nearest: (n, observers) whether the robot is its team's nearest to the ball.
        """

    def metrics(self, play: Play) -> dict[str, Floats]:
        """Compute the metrics of the class's documentation, each (n,)."""
        game = play.game
        in_play = game.in_play_steps
        of_teams = (
            game.score,
            game.shots,
            game.passes,
            game.possession_steps / np.maximum(in_play, 1.0)[:, None],
            game.distance,
            game.offenses.reshape(len(in_play), len(TEAMS), -1).sum(axis=2),
            game.yellow_cards,
            game.red_cards,
        )
        table = np.empty((len(of_teams), len(TEAMS), len(in_play)), np.float32)
        for row, values in zip(table, of_teams, strict=True):
            row[:] = values.T
        return {
            "goal_score": rewards.goal_score(play),
            **dict(zip(_TEAM_METRICS, table.reshape(-1, len(in_play)), strict=True)),
            "in_play": in_play * np.float32(self.config.time_step),
        }

    def offenses(self, play: Play) -> dict[str, Array]:
        """Return the offenses since the match began, by kind.

        Args:
            play: state of n worlds.

        Returns:
            (n, 2) of blue and of yellow, by the names of their events.
        """
        counts = play.game.offenses.reshape(len(play.frame), len(TEAMS), -1)
        return {EventKind(kind).name: counts[:, :, nth] for nth, kind in enumerate(OFFENSES)}
