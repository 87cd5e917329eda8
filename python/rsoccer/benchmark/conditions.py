"""Senses and varied numbers under which policies are evaluated for their robustness."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

from rsoccer._core import Sensing
from rsoccer.registry import make_task

VARIED: Final = 0.1
"""Largest deviation of masses and frictions, as a part of them."""
BALL: Final = (
    *("mass", "sliding_deceleration", "rolling_deceleration"),
    *("robot_friction", "wall_friction"),
)
"""Numbers of the ball's model that are masses or frictions."""
ROBOTS: Final = ("mass", "traction")
"""Factors of robots that are masses or frictions."""


@dataclass(frozen=True)
class Condition:
    """Knowledge of the robots, and differences between the episodes of an evaluation."""

    text: str
    """description for tables"""
    preset: str = "none"
    """preset of `Sensing`"""
    numbers: Mapping[str, float] = field(default_factory=dict)
    """numbers of `Sensing` that differ from the preset"""
    varies: bool = False
    """whether masses and frictions vary"""

    def sensing(self, changes: Mapping[str, float]) -> Sensing | None:
        """Return the senses; None for the true state.

        Args:
            changes: numbers that a policy needs in all conditions, such as a forecast.
        """
        found = Sensing(self.preset, **{**self.numbers, **changes})
        return None if found.is_off else found

    def randomization(self, task: str) -> dict[str, tuple[float, float]]:
        """Return the distributions of numbers.

        Args:
            task: registered task, whose ball is the middle of the distributions.
        """
        if not self.varies:
            return {}
        ball = make_task(task).config.ball
        middles = {f"ball.{name}": float(getattr(ball, name)) for name in BALL}
        middles |= {f"robot.{name}": 1.0 for name in ROBOTS}
        return {
            name: ((1.0 - VARIED) * middle, (1.0 + VARIED) * middle)
            for name, middle in middles.items()
        }


TRUTH: Final = "truth"
"""Name of the condition in which robots know the true state."""
CONDITIONS: Final = {
    TRUTH: Condition("the true state"),
    "friendly": Condition("`friendly`", "friendly"),
    "rc2021": Condition("`rc2021`", "rc2021"),
    "realistic": Condition("`realistic`", "realistic"),
    "rc2021-100ms": Condition(
        "`rc2021`, commands 55 ms late: 100 ms in all", "rc2021", {"command_delay": 0.055}
    ),
    "noise-25mm": Condition(
        "noise of 25 mm",
        numbers={"ball_position_noise": 0.025, "robot_position_noise": 0.025},
    ),
    "delay-90ms": Condition("frames 90 ms late", numbers={"delay": 0.09}),
    "commands-100ms": Condition("commands 100 ms late", numbers={"command_delay": 0.1}),
    "loss-5": Condition("5% of commands lost", numbers={"command_loss": 0.05}),
    "varied-10": Condition("masses and frictions varied by 10%", varies=True),
}
"""Conditions by name, in the order of the tables."""
