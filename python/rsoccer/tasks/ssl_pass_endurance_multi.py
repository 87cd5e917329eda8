"""`SSLPassEnduranceMulti-v1`: two learners pass to each other. Hardware challenge 4."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from rsoccer import checks, rewards
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import Frame
from rsoccer.game import BLUE, EventKind
from rsoccer.rng import WorldRng
from rsoccer.task import Play
from rsoccer.tasks.ssl import ball_at_mouth
from rsoccer.tasks.ssl_pass import SslPass


@dataclass(frozen=True)
class SslPassEnduranceMulti(SslPass):
    """SSL task in which blue_0 and blue_1 both learn to pass to each other, for up to 30 s.

    Goal of the task: as many passes as possible, as `SslPass` defines them.

    Initial state: that of `SslPass`; with `random_holder` blue_1 has the ball in half of all
    episodes.

    Reward terms, unweighted:

    ================  ==============================================================  ========
    Term              Meaning                                                         Unit
    ================  ==============================================================  ========
    passes            1 for a pass that counts, to both robots                        passes
    ball_to_teammate  decrease of the distance between the ball and the receiver,     m
                      to both robots, while the ball is on its way
    approach          decrease of the distance between the ball and the receiver's    m
                      mouth, to the receiver, while the ball is on its way
    failed            1 if the pass failed, to both robots                            episodes
    energy            negative mean magnitude of the action                           steps
    ================  ==============================================================  ========

    Termination: a pass failed, that is, the passed ball stopped or moves away from the receiver,
    or the ball is off the field; opponents had the ball in a mouth for 0.25 s in a row. Truncation:
    after `max_steps`.

    Metrics: `passes`, the number of passes that counted; `possession`, time for which blue touched
    the ball last, s; `interceptions`, passes that an opponent caught.

    Source: SSL hardware challenges 2021, challenge 4, and the rSoccer paper (2021).
    """

    random_holder: bool = False
    """True: either robot starts with the ball, so that one learner sees both parts in training."""

    training_options = (*SslPass.training_options, "random_holder")
    """Options that change how a policy learns, not how it plays."""
    success = "passes"
    """Metric that measures the success of an episode."""
    full_success = None
    """There is no greatest number of passes."""

    REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "passes": 5.0,
        "ball_to_teammate": 0.5,
        "approach": 0.5,
        "failed": -1.0,
        "energy": 0.0005,
    }
    """Default weight of each reward term."""
    PAPER_REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "passes": 10.0,
        "ball_to_teammate": 1.11,  # the paper's scale: 0.9014 m
        "approach": 0.0,
        "failed": -1.0,
        "energy": 0.0001,
    }
    """Weights of the rSoccer paper (2021) in these terms."""

    def __post_init__(self) -> None:
        """Validate the options."""
        checks.boolean("random_holder", self.random_holder)
        super().__post_init__()

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        """Draw random positions and headings, and place the ball in the mouth of its holder."""
        frame = super().get_initial_positions_frame(rng)
        if self.random_holder:
            with_ball = ball_at_mouth(frame, 1, self.mouth_offset)
            moved = rng.uniform(0.0, 1.0) < 0.5
            frame.ball.position[moved] = with_ball[moved]
        return frame

    def start_episode(self, play: Play) -> None:
        """Find the holder of the ball."""
        distance = self._ball_distances(play.frame)
        play.memory["holder"][:] = distance[:, 1] < distance[:, 0]

    def new_memory(self, n: int) -> dict[str, Array]:
        """Create the state of the current pass.

        `holder` (n,) is the index of the last robot with the ball, `on_its_way` (n,) whether the
        ball has left its reach.
        """
        return {
            **super().new_memory(n),
            "holder": np.zeros(n, np.int64),
            "on_its_way": np.zeros(n, np.bool_),
        }

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        """Compute the reward terms of the class's table; a failed pass terminates."""
        worlds, memory = np.arange(len(play.frame)), play.memory
        receiver, was_on_its_way = 1 - memory["holder"], memory["on_its_way"].copy()
        distance = self._ball_distances(play.frame)
        last_distance = self._ball_distances(play.last_frame)
        # A ball that is carried earns nothing: robots would walk up to each other.
        progress = (last_distance - distance)[worlds, receiver] * was_on_its_way
        # Robots that are rewarded for going to a ball that is held walk up to each other.
        receives = was_on_its_way[:, None] & (receiver[:, None] == play.observers)
        passed = play.events.by_team(EventKind.PASS)[:, BLUE] > 0
        self._update_holder(play, receiver)
        # From here on the holder may be the former receiver.
        next_receiver = play.frame.blue.position[worlds, 1 - memory["holder"]]
        missed = memory["on_its_way"] & self._has_missed(play.frame, next_receiver)
        failed = missed | self.is_off_field(play.frame.ball.position) | self._has_been_taken(play)
        terms = {
            "passes": rewards.of_blue(play, passed),
            "ball_to_teammate": rewards.of_blue(play, progress),
            "approach": rewards.approach_mouth(play, self.config) * receives,
            "failed": rewards.of_blue(play, failed),
            "energy": rewards.energy(play),
        }
        return rewards.weighted_terms(terms, self.term_weights), failed

    def metrics(self, play: Play) -> dict[str, Floats]:
        """Compute the metrics of the class's documentation, each (n,)."""
        passes = play.game.passes[:, BLUE].astype(np.float32)
        return {"passes": passes, **self._possession_metrics(play)}

    def _receiver(self, play: Play, world: int) -> int:
        """Index of the robot other than the last holder."""
        return 1 - int(play.memory["holder"][world])

    def _update_holder(self, play: Play, receiver: Array) -> None:
        """Find the robot that has the ball, and whether it has left its reach."""
        memory, in_mouth = play.memory, play.frame.blue.infrared > 0.5  # (n, 2)
        received = in_mouth[np.arange(len(receiver)), receiver]
        memory["holder"][:] = np.where(received, receiver, memory["holder"])
        memory["on_its_way"] &= ~in_mouth.any(axis=1)
        memory["on_its_way"] |= self._is_released(play, memory["holder"])
