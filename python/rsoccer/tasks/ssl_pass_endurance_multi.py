"""`SSLPassEnduranceMulti-v0`: two learners pass to and fro. Hardware challenge 4, multi."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Final

import numpy as np

from rsoccer import rewards
from rsoccer.frame import Array, Floats, Frame, Mask, length
from rsoccer.task import Play
from rsoccer.tasks.ssl_pass import FREE, SslPass

LONG: Final = np.float32(1.5)
"""Metres between kick and reception from which a pass counts: neighbours farm nothing."""


@dataclass(frozen=True)
class SslPassEnduranceMulti(SslPass):
    """Both robots learn; as many passes as they can in 30 s. One that does not arrive ends it."""

    success = "passes"
    full_success = None

    REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "passes": 5.0,
        "ball_to_teammate": 0.5,
        "approach": 0.5,
        "failed": -1.0,
        "energy": 0.0005,
    }
    PAPER_REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "passes": 10.0,
        "ball_to_teammate": 1.11,  # the paper's scale: 0.9014 m
        "approach": 0.0,
        "failed": -1.0,
        "energy": 0.0001,
    }

    def new_memory(self, n: int) -> dict[str, Array]:
        """Who had the ball last, where it was then, whether it is on its way, passes so far."""
        return {
            "holder": np.zeros(n, np.int64),
            "left_at": np.zeros((n, 2), np.float32),
            "on_its_way": np.zeros(n, np.bool_),
            "passes": np.zeros(n, np.int64),
        }

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        """Passes count most; a ball that nears the teammate and a teammate that nears it are paid."""
        worlds, memory = np.arange(len(play.frame)), play.memory
        begun = play.steps == 1  # where it may have been kicked at once
        memory["left_at"][begun] = play.last_frame.ball.position[begun]
        teammate = 1 - memory["holder"]
        distance, last = self.to_ball(play.frame), self.to_ball(play.last_frame)
        nearer = (last - distance)[worlds, teammate]
        waits = teammate[:, None] == play.observers  # (n, observers) who does not have the ball
        passed = self._passed(play.frame, memory, worlds, teammate)
        far = distance[worlds, memory["holder"]] > self.reach + FREE
        memory["on_its_way"] |= far
        receiver = play.frame.blue.position[worlds, 1 - memory["holder"]]
        missed = memory["on_its_way"] & self.missed(play.frame, receiver)
        failed = missed | self.is_off_field(play.frame.ball.position)
        terms = {
            "passes": passed[:, None].astype(np.float32),
            "ball_to_teammate": nearer[:, None],
            "approach": rewards.to_mouth(play, self.config) * waits,
            "failed": failed[:, None].astype(np.float32),
            "energy": rewards.energy(play),
        }
        return rewards.weighted(terms, self.reward_weights), failed

    def receiver(self, play: Play, world: int) -> int:
        """Who did not have the ball last."""
        return 1 - int(play.memory["holder"][world])

    def metrics(self, play: Play) -> dict[str, Floats]:
        """`passes`: how many counted."""
        return {"passes": play.memory["passes"].astype(np.float32)}

    def _passed(
        self, frame: Frame, memory: dict[str, Array], worlds: Array, teammate: Array
    ) -> Mask:
        """(n,) whether the teammate has received a pass that counts; who holds the ball is noted."""
        holds = frame.blue.infrared > 0.5  # (n, 2)
        received = holds[worlds, teammate]
        way = frame.ball.position - memory["left_at"]
        passed: Mask = received & memory["on_its_way"] & (length(way[:, 0], way[:, 1]) >= LONG)
        memory["passes"] += passed
        memory["holder"][:] = np.where(received, teammate, memory["holder"])
        held = holds.any(axis=1)
        memory["on_its_way"] &= ~held
        memory["left_at"][held] = frame.ball.position[held]
        return passed
