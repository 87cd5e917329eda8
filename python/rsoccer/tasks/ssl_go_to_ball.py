"""`SSLGoToBall-v0`: drive to the ball and take it into the mouth."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from rsoccer import checks, rewards, spawn
from rsoccer.frame import Floats, Frame, Mask
from rsoccer.markers import Marker, Target
from rsoccer.rng import WorldRng
from rsoccer.task import LEARN, Learn, Play
from rsoccer.tasks.ssl import Ssl

APART = 0.2  # metres between centres at the start
MAX_OPPONENTS = 6


@dataclass(frozen=True)
class SslGoToBall(Ssl):
    """blue_0 is to cut its own beam with the ball, so it has to come from the right side.

    The ball lies anywhere, and so do up to six opponents that do not move. Leaving the field ends it.
    """

    n_opponents: int = 0  # robots that stand in the way

    success = "reached"

    REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "reached": 5.0,
        "approach": 1.0,
        "left_field": -2.0,
        "energy": 0.0005,
    }
    PAPER_REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "reached": 1.0,
        "approach": 0.14,  # the paper's is by the field's diagonal
        "left_field": 0.0,
        "energy": 0.0001,
    }

    def __post_init__(self) -> None:
        """Refuse options that make no task, by name."""
        checks.within("n_opponents", self.n_opponents, 0, MAX_OPPONENTS)
        super().__post_init__()

    def team_sizes(self) -> tuple[int, int]:
        """One against those that stand."""
        return 1, self.n_opponents

    def default_controllers(self) -> dict[str, str | Learn]:
        """blue_0 learns, opponents stand."""
        return dict.fromkeys(self.robots, "zero") | {"blue_0": LEARN}

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        """Ball and robots anywhere, apart, facing anywhere."""
        return spawn.anywhere(rng, self.config, APART)

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        """The ball in the mouth counts most; coming nearer to that is paid, leaving costs."""
        reached = self._reached(play.frame)
        left = self.is_off_field(play.frame.blue.position[:, 0])
        terms = {
            "reached": reached[:, None].astype(np.float32),
            "approach": rewards.to_mouth(play, self.config),
            "left_field": left[:, None].astype(np.float32),
            "energy": rewards.energy(play),
        }
        return rewards.weighted(terms, self.reward_weights), reached | left

    def markers(self, play: Play, world: int) -> tuple[Marker, ...]:
        """The ball as the target."""
        x, y = play.frame.ball.position[world].tolist()
        return (Target((x, y), 3.0 * self.config.ball.radius),)

    def metrics(self, play: Play) -> dict[str, Floats]:
        """`reached`: 1 if blue_0 has the ball, else 0; `seconds` that it took."""
        return {
            "reached": self._reached(play.frame).astype(np.float32),
            "seconds": play.steps.astype(np.float32) * np.float32(self.config.time_step),
        }

    def _reached(self, frame: Frame) -> Mask:
        return np.greater(frame.blue.infrared[:, 0], 0.5)
