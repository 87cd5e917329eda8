"""`SSLMatch-v0`: whole matches of SSL teams under a referee."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Final

from rsoccer import checks, rewards
from rsoccer._core import Field, RobotModel
from rsoccer.arrays import Floats, Mask
from rsoccer.task import Play
from rsoccer.tasks.match import Match
from rsoccer.tasks.ssl import Ssl
from rsoccer.tasks.ssl_self_play import MIN_PASS_LENGTH

DIVISIONS: Final = {"A": "ssl_a", "B": "ssl_b"}
"""Fields of the divisions."""


@dataclass(frozen=True)
class SslMatch(Match, Ssl):
    """Match of two SSL teams under the rules of 2026, in which all robots learn.

    Actions are those of `Ssl`; observations, rewards, end and metrics those of `Match`. The first
    robot of each team is its keeper.

    Source: the rules of the Small Size League (RoboCup-SSL/ssl-rules, 2026).
    """

    division: str = "B"
    """Division, "A" or "B": field and rules."""
    n_blue: int = 6
    """Robots of team blue, 1 to 11."""
    n_yellow: int = 6
    """Robots of team yellow, 1 to 11."""
    field: str | Field = "division"
    """Field: "division" for that of the division, a preset's name, a .json file or a `Field`."""
    robot: str | RobotModel = Ssl.robot
    """Robot model with an omnidirectional drive: a preset's name, a .json file or a
    `RobotModel`."""
    placement: str = "teleport"
    """Way of the ball to the place of the next kick: "teleport" (at once, with the robots that
    stand too near) or "robots" (a team carries it there)."""
    chip_kick: bool = True
    """True: actions have a sixth number, above 0 for a chip kick."""

    LEAGUE_PRESET: ClassVar[str] = "ssl_2026_b"
    """Rules of one of the divisions."""
    REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "goal": 10.0,
        "ball_to_goal": 2.0,
        "approach": 0.5,
        "energy": 0.0002,
        "fouls": 0.5,
        "cards": 2.0,
    }
    """Default weight of each reward term."""
    PAPER_REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = REWARD_WEIGHTS
    """The default weights: the paper has no such task."""

    def __post_init__(self) -> None:
        """Validate the options."""
        if self.division not in DIVISIONS:
            raise ValueError(f"division: expected one of {tuple(DIVISIONS)}, got {self.division!r}")
        checks.integer("n_blue", self.n_blue, 1)
        checks.integer("n_yellow", self.n_yellow, 1)
        if self.field == "division":
            object.__setattr__(self, "field", DIVISIONS[self.division])
        super().__post_init__()

    def team_sizes(self) -> tuple[int, int]:
        """Return the team sizes of the options."""
        return self.n_blue, self.n_yellow

    @property
    def preset(self) -> str:
        """Rules of the division."""
        return f"ssl_2026_{self.division.lower()}"

    @property
    def referee_values(self) -> dict[str, Any]:
        """Numbers and switches of the rules that the options give, by name."""
        return {"placement": self.placement, **super().referee_values}

    @property
    def min_pass_length(self) -> float:
        """Least length of a pass, m."""
        return MIN_PASS_LENGTH

    def approach(self, play: Play, nearest: Mask) -> Floats:
        """Return the progress of the nearest robot of each team toward the ball, m."""
        return rewards.approach_mouth(play, self.config) * nearest
