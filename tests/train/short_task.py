"""Self-play tasks whose matches end within seconds, by goals and by the time limit."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from rsoccer import register
from rsoccer.arrays import Floats, Mask
from rsoccer.frame import Frame
from rsoccer.rng import WorldRng
from rsoccer.task import Play
from rsoccer.tasks import VssSelfPlay
from rsoccer.train import Args
from rsoccer.train.args import PARTS

NAME = "ShortSelfPlay-v0"
FORWARD = "Forward-v0"


@dataclass(frozen=True)
class ShortSelfPlay(VssSelfPlay):
    """The ball starts in front of a goal, often rolling toward it."""

    max_steps: int = 25

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        """Place robots in two columns, so that the path to the goal is free."""
        frame = Frame.empty(len(rng), self.n_blue, self.n_yellow)
        side = np.where(rng.uniform(-1.0, 1.0) < 0, -1.0, 1.0)
        frame.ball.position[:, 0] = 0.6 * side
        frame.ball.velocity[:, 0] = rng.uniform(0.0, 1.0) * side
        frame.robots.position[..., 0] = np.repeat([-0.3, 0.3], 3)
        frame.robots.position[..., 1] = np.tile([-0.3, 0.0, 0.3], 2)
        return frame


@dataclass(frozen=True)
class Forward(ShortSelfPlay):
    """The reward is the wheel speed ahead alone, so the task is easy to learn."""

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        """Return the mean of both wheel commands as the reward."""
        _, done = super().calculate_reward_and_done(play)
        return {"forward": play.actions[:, play.observers].clip(-1, 1).mean(axis=2)}, done


def register_all() -> None:
    """Register both tasks; not on import, since tests of all registered tasks would play them."""
    register(NAME, ShortSelfPlay)
    register(FORWARD, Forward)


TINY = {
    "task": NAME,
    "solo_fraction": 0.34,  # three updates
    "worlds": 6,
    "horizon": 8,
    "samples": 6 * 3 * 8 * 6,
    "hidden_sizes": (16,),
    "n_epochs": 2,
    "n_minibatches": 2,
    "random_truncation": 0.01,  # three in a run
    "threads": 1,
    "latest_fraction": 0.4,
    "past_fraction": 0.4,
    "ladder_interval": 4,
    "ladder_matches": 8,
    "progress": False,
    "match_page": False,
}
"""Settings of a run of six updates that takes about a second."""


def by_name(settings: dict[str, Any]) -> dict[str, Any]:
    """Return settings with their parts before their names, which are unique over all parts."""
    parts = {name: part for part in PARTS for name in vars(getattr(Args(), part))}
    return {f"{parts[k]}.{k}" if k in parts else k: value for k, value in settings.items()}


def tiny(out: Path, **changes: Any) -> Args:  # noqa: ANN401  (any field)
    """Return the settings `TINY` with changes, by names without their parts."""
    return Args.from_json(by_name({**TINY, "out": out, **changes}))


UPDATES = 25
"""Updates of `easy`."""


def easy(out: Path, **changes: Any) -> Args:  # noqa: ANN401  (any field)
    """Return settings with which `UPDATES` updates learn `Forward`, with changes as in `tiny`."""
    shape = {"task": FORWARD, "worlds": 32, "samples": UPDATES * 32 * 3 * 8}
    return tiny(out, **{**shape, "n_epochs": 8, "learning_rate": 5e-3, **changes})
