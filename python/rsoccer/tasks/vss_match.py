"""`VSSMatch-v0`: whole matches of VSSS teams under a referee."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Final

from rsoccer import rewards
from rsoccer._core import HAND_ERROR, Field, RobotModel
from rsoccer.arrays import Floats, Mask
from rsoccer.task import Play
from rsoccer.tasks.match import Match
from rsoccer.tasks.vss_base import VssBase

MIN_PASS_LENGTH: Final = 0.2
"""Least length of a pass, m: more than two robots side by side."""


@dataclass(frozen=True)
class VssMatch(Match, VssBase):
    """Match of two VSSS teams under the league's referee, in which all robots learn.

    Actions are those of `VssBase`; observations, rewards, end and metrics those of `Match`. On a
    field with two areas, as "vss_5v5", the rules are those of five a side. At restarts robots are
    put by hand, up to 1 cm from their places (`placement_error` of the rules).

    Source: the league's referee (VSSSLeague/VSSReferee) for rules and positions.
    """

    n_yellow: int = 3
    """Robots of team yellow, 1 to 5."""
    field: str | Field = VssBase.field
    """VSSS field: "vss_3v3", "vss_5v5", a .json file or a `Field`, for any team sizes."""
    robot: str | RobotModel = VssBase.robot
    """Robot model with a differential drive: a preset's name, a .json file or a `RobotModel`."""

    FEWEST_YELLOW: ClassVar[int] = 1
    """Fewest robots of team yellow."""
    LEAGUE_PRESET: ClassVar[str] = "vsss_3v3"
    """Rules of one of the fields."""
    REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "goal": 10.0,
        "ball_to_goal": 10.0,
        "approach": 3.0,
        "energy": 0.0002,
        "fouls": 0.5,
        "cards": 0.0,
    }
    """Default weight of each reward term. VSSS has no cards."""
    PAPER_REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = REWARD_WEIGHTS
    """The default weights: the paper has no such task."""

    @property
    def preset(self) -> str:
        """Rules of five a side on a field with two areas, else of three a side."""
        return "vsss_5v5" if self.config.field.inner_area_depth > 0.0 else "vsss_3v3"

    @property
    def referee_values(self) -> dict[str, Any]:
        """Numbers and switches of the rules that the options give, by name."""
        return {"placement_error": HAND_ERROR, **super().referee_values}

    @property
    def min_pass_length(self) -> float:
        """Least length of a pass, m."""
        return MIN_PASS_LENGTH

    def approach(self, play: Play, nearest: Mask) -> Floats:
        """Return the progress of each robot toward the point just behind the ball, m."""
        return rewards.approach_behind_ball(play, self.config.field)
