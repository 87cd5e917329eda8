"""Settings of the policy network and of the value network."""

from __future__ import annotations

from dataclasses import dataclass

from rsoccer.policies.shield import SHIELDS
from rsoccer.train.setting_types import Count, Natural, Positive, Signed, convert_fields, expect


# The docstrings of the fields are the help of `rsoccer train`.
@dataclass(frozen=True)
class NetworkSettings:
    """Policy and value network.

    Raises:
        ValueError: a value of another type or outside its range.
    """

    hidden_sizes: tuple[Count, ...] = (128, 128)
    """widths of the hidden layers of both networks"""
    central_critic: bool = False
    """value network reads the state of the match, as in MAPPO"""
    robot_units: Natural = 0
    """units for each other robot, with weights shared by a team"""
    action_std: Positive = 0.6
    """standard deviation of actions at first; 1 is full speed"""
    final_action_std: Positive = 0.1
    """standard deviation of actions at the end of the run"""
    initial_action: tuple[Signed, ...] = ()
    """mean action at first, from -1 to 1; 0 for components without a number"""
    masked_observations: tuple[str, ...] = ()
    """blocks read as 0 in ablations, as in shot opponents:2,3"""
    initial_policy: str | None = None
    """policy whose weights it begins with: best, a policy file, or another task for its best"""
    shield: str | None = None
    """vsss or ssl_attack keeps robots from fouls, in training and play"""
    play_action_repeat: Count | None = None
    """control steps for which the saved policy holds a decision; None is as in training"""

    def __post_init__(self) -> None:
        """Convert and check the values."""
        convert_fields(self, "network.")
        expect(
            "network.shield",
            self.shield in (None, *SHIELDS),
            f"one of {', '.join(SHIELDS)}",
            self.shield,
        )
        expect("network.hidden_sizes", bool(self.hidden_sizes), "one or more widths", ())
