"""`SSLPassEndurance-v0`: one pass to a robot that waits for it. Hardware challenge 4, single."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from rsoccer import rewards
from rsoccer.frame import Array, Floats, Frame, Mask
from rsoccer.task import LEARN, Learn, Play
from rsoccer.tasks.ssl_pass import FREE, SslPass


@dataclass(frozen=True)
class SslPassEndurance(SslPass):
    """blue_0 passes, blue_1 turns to the ball and takes it. One pass, received or failed."""

    max_steps: int = 120  # 3 s

    success = "received"

    REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "received": 5.0,
        "ball_to_teammate": 1.0,
        "failed": -1.0,
        "energy": 0.0005,
    }
    PAPER_REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "received": 1.0,
        "ball_to_teammate": 1.11,  # the paper's scale: 0.9014 m
        "failed": -1.0,
        "energy": 0.0,
    }

    def default_controllers(self) -> dict[str, str | Learn]:
        """blue_0 learns, blue_1 receives."""
        return {"blue_0": LEARN, "blue_1": "receive"}

    def new_memory(self, n: int) -> dict[str, Array]:
        """`kicked`: whether the ball has left the passer's mouth."""
        return {"kicked": np.zeros(n, np.bool_)}

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        """The pass received counts most; the ball nearer to the teammate is paid."""
        distance, last = self.to_ball(play.frame), self.to_ball(play.last_frame)
        kicked = play.memory["kicked"]
        kicked |= distance[:, 0] > self.reach + FREE
        received = self._received(play.frame)
        missed = kicked & self.missed(play.frame, play.frame.blue.position[:, 1])
        failed = (missed | self.is_off_field(play.frame.ball.position)) & ~received
        terms = {
            "received": received[:, None].astype(np.float32),
            "ball_to_teammate": (last - distance)[:, 1:],
            "failed": failed[:, None].astype(np.float32),
            "energy": rewards.energy(play),
        }
        return rewards.weighted(terms, self.reward_weights), received | failed

    def metrics(self, play: Play) -> dict[str, Floats]:
        """`received`: 1 or 0; `inverse_distance`: per metre between ball and teammate, the paper's."""
        distance: Floats = np.maximum(self.to_ball(play.frame)[:, 1], self.reach)
        return {
            "received": self._received(play.frame).astype(np.float32),
            "inverse_distance": (1.0 / distance).astype(np.float32),
        }

    def _received(self, frame: Frame) -> Mask:
        return np.greater(frame.blue.infrared[:, 1], 0.5)
