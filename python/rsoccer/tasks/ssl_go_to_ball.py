"""`SSLGoToBall-v0`: drive to the ball and take it into the mouth."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Final

import numpy as np

from rsoccer import checks, rewards, spawn
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import Frame
from rsoccer.markers import Marker, Target
from rsoccer.rng import WorldRng
from rsoccer.task import LEARN, Learn, Play
from rsoccer.tasks.ssl import Ssl

MIN_START_DISTANCE: Final = 0.2
"""Least distance between centers in the initial state, m."""
MAX_OPPONENTS: Final = 6


@dataclass(frozen=True)
class SslGoToBall(Ssl):
    """SSL task in which blue_0 drives to the ball and brings it into its break beam.

    Goal of the task: bring the ball into the break beam of blue_0's mouth, so blue_0 has to
    approach facing the ball.

    Initial state: ball and robots at uniform random positions, at rest, with random headings. The
    opponents do not move.

    Reward terms, unweighted:

    ============  ==================================================================  ========
    Term          Meaning                                                             Unit
    ============  ==================================================================  ========
    reached       1 if the ball has been in the break beam for `hold_steps`, else 0   episodes
    approach      decrease of the distance between the ball and the mouth             m
    left_field    1 if blue_0 is off the field, else 0                                episodes
    energy        negative mean magnitude of the action                               steps
    ============  ==================================================================  ========

    Termination: the ball reached; blue_0 off the field. Truncation: after `max_steps`.

    Metrics: `reached`, 1 or 0; `seconds`, duration of the episode.

    With `hold_steps` 1, which is the paper's task, fast policies ram the ball: it touches the beam,
    and springs off after the episode. A larger number asks for an arrival at which the ball stays.

    Source: the rSoccer paper (2021); there is no official challenge. rsoccer-gym's variant
    with the break beam and six opponents is the alias `SSLGoToBallIR-v0`.
    """

    n_opponents: int = 0
    """Opponents at rest as obstacles, 0 to 6."""
    hold_steps: int = 1
    """Control steps in a row in which the ball has to be in the break beam, at least 1."""

    success = "reached"
    """Metric that measures the success of an episode."""

    REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "reached": 5.0,
        "approach": 1.0,
        "left_field": -2.0,
        "energy": 0.0005,
    }
    """Default weight of each reward term."""
    PAPER_REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "reached": 1.0,
        "approach": 0.14,  # the paper divides by the field's diagonal
        "left_field": 0.0,
        "energy": 0.0001,
    }
    """Weights of the rSoccer paper (2021) in these terms."""

    def __post_init__(self) -> None:
        """Validate the options."""
        checks.integer_in_range("n_opponents", self.n_opponents, 0, MAX_OPPONENTS)
        checks.integer("hold_steps", self.hold_steps, 1)
        super().__post_init__()

    def team_sizes(self) -> tuple[int, int]:
        """Return one robot and the number of opponents of the option."""
        return 1, self.n_opponents

    def default_controllers(self) -> dict[str, str | Learn]:
        """Return `LEARN` for blue_0 and "zero" for opponents."""
        return dict.fromkeys(self.robots, "zero") | {"blue_0": LEARN}

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        """Draw random positions and headings."""
        return spawn.random_frame(rng, self.config, MIN_START_DISTANCE)

    def new_memory(self, n: int) -> dict[str, Array]:
        """Create `held`, (n,) control steps since which the ball is in the break beam.

        None is kept with `hold_steps` 1.
        """
        return {"held": np.zeros(n, np.int64)} if self.hold_steps > 1 else {}

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        """Compute the reward terms of the class's table; ball reached or field left terminates."""
        if self.hold_steps > 1:
            held = play.memory["held"]
            held += 1
            held[play.frame.blue.infrared[:, 0] < 0.5] = 0
        reached = self._reached(play)
        left = self.is_off_field(play.frame.blue.position[:, 0])
        terms = {
            "reached": rewards.of_blue(play, reached),
            "approach": rewards.approach_mouth(play, self.config),
            "left_field": rewards.of_blue(play, left),
            "energy": rewards.energy(play),
        }
        return rewards.weighted_terms(terms, self.term_weights), reached | left

    def markers(self, play: Play, world: int) -> tuple[Marker, ...]:
        """Return the ball as a target."""
        x, y = play.frame.ball.position[world].tolist()
        return (Target((x, y), 3.0 * self.config.ball.radius),)

    def metrics(self, play: Play) -> dict[str, Floats]:
        """Compute `reached`, 1 or 0, and `seconds` since the start; each (n,)."""
        return {
            "reached": self._reached(play).astype(np.float32),
            "seconds": play.steps.astype(np.float32) * np.float32(self.config.time_step),
        }

    def _reached(self, play: Play) -> Mask:
        """(n,) whether the ball has been in the break beam of blue_0 for long enough."""
        if self.hold_steps > 1:
            return np.greater_equal(play.memory["held"], self.hold_steps)
        return np.greater(play.frame.blue.infrared[:, 0], 0.5)
