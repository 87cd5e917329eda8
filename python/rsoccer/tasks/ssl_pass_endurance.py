"""`SSLPassEndurance-v1`: one pass to a waiting teammate. Hardware challenge 4, single robot."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from rsoccer import rewards
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.game import BLUE, EventKind
from rsoccer.task import Learn, Play
from rsoccer.tasks.ssl_pass import SslPass


@dataclass(frozen=True)
class SslPassEndurance(SslPass):
    """SSL task in which blue_0 passes once to blue_1, which turns to the ball and receives it.

    Goal of the task: one pass, as `SslPass` defines it. A ball that is carried to blue_1 is none.

    Initial state: that of `SslPass`.

    Reward terms, unweighted:

    ================  ==============================================================  ========
    Term              Meaning                                                         Unit
    ================  ==============================================================  ========
    received          1 if the pass arrived, else 0                                   episodes
    ball_to_teammate  decrease of the distance between the ball and blue_1 while it   m
                      is out of reach of blue_0
    failed            1 if the pass failed, else 0                                    episodes
    energy            negative mean magnitude of the action                           steps
    ================  ==============================================================  ========

    Termination: pass received; pass failed, that is, the released ball stopped or moves away from
    blue_1, blue_1 got the ball without a pass, opponents had the ball in a mouth for 0.25 s in a
    row, or the ball is off the field. Truncation: after `max_steps`.

    Metrics: `received`, 1 or 0; `inverse_distance`, 1/m, of the distance between ball and blue_1,
    the paper's; `possession`, time for which blue touched the ball last, s; `interceptions`, passes
    that an opponent caught.

    Source: SSL hardware challenges 2021, challenge 4, and the rSoccer paper (2021).
    """

    max_steps: int = 120
    """Control steps of 25 ms until truncation, at least 1; 120 are 3 s."""

    success = "received"
    """Metric that measures the success of an episode."""

    REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "received": 5.0,
        "ball_to_teammate": 1.0,
        "failed": -1.0,
        "energy": 0.0005,
    }
    """Default weight of each reward term."""
    PAPER_REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "received": 1.0,
        "ball_to_teammate": 1.11,  # the paper's scale: 0.9014 m
        "failed": -1.0,
        "energy": 0.0,
    }
    """Weights of the rSoccer paper (2021) in these terms."""

    def default_controllers(self) -> dict[str, str | Learn]:
        """Return `LEARN` for blue_0, "receive" for blue_1, and `opponent` for yellow robots."""
        return {**super().default_controllers(), "blue_1": "receive"}

    def new_memory(self, n: int) -> dict[str, Array]:
        """Create `released`, (n,) whether the ball has left the reach of blue_0."""
        return {**super().new_memory(n), "released": np.zeros(n, np.bool_)}

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        """Compute the reward terms of the class's table; pass received or failed terminates."""
        distance = self._ball_distances(play.frame)
        last_distance = self._ball_distances(play.last_frame)
        received = play.events.by_team(EventKind.PASS)[:, BLUE] > 0
        out_of_reach = self._is_released(play, np.zeros(len(received), np.intp))
        released = play.memory["released"]
        released |= out_of_reach
        missed = released & self._has_missed(play.frame, play.frame.blue.position[:, 1])
        handed_over = play.frame.blue.infrared[:, 1] > 0.5
        failed = missed | handed_over | self.is_off_field(play.frame.ball.position)
        failed |= self._has_been_taken(play)
        failed &= ~received
        terms = {
            "received": rewards.of_blue(play, received),
            # A ball that is carried earns nothing: robots would walk up to each other.
            "ball_to_teammate": rewards.of_blue(
                play, (last_distance - distance)[:, 1] * out_of_reach
            ),
            "failed": rewards.of_blue(play, failed),
            "energy": rewards.energy(play),
        }
        return rewards.weighted_terms(terms, self.term_weights), received | failed

    def metrics(self, play: Play) -> dict[str, Floats]:
        """Compute the metrics of the class's documentation, each (n,)."""
        distance: Floats = np.maximum(self._ball_distances(play.frame)[:, 1], self.mouth_offset)
        return {
            "received": play.game.passes[:, BLUE].astype(np.float32),
            "inverse_distance": (1.0 / distance).astype(np.float32),
            **self._possession_metrics(play),
        }
