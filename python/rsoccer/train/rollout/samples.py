"""Decisions of a rollout, from which advantages and samples are made."""

from __future__ import annotations

from dataclasses import dataclass

from torch import Tensor


@dataclass(frozen=True)
class Rollout:
    """Decisions of all learners; robots is worlds x agents."""

    observations: Tensor
    """(horizon, robots, o) normalized observations before the decisions."""
    actions: Tensor
    """(horizon, robots, action) drawn actions, not clipped."""
    log_probs: Tensor
    """(horizon, robots) log densities of the actions under the policy that drew them."""
    rewards: Tensor
    """(horizon, robots) scaled rewards."""
    next_critic_inputs: Tensor
    """(horizon, robots, s + o) inputs of the value network after the decisions; those at the end of
    the episode where it ended."""
    terminated: Tensor
    """(horizon, robots) bool, the task ended the episode."""
    ended: Tensor
    """(horizon, robots) bool, the episode terminated or was truncated."""
    central_inputs: Tensor | None = None
    """(horizon, robots, s + o) inputs of a centralized critic before the decisions; None if the
    critic reads the observations."""

    @property
    def critic_inputs(self) -> Tensor:
        """Inputs of the value network before the decisions."""
        return self.observations if self.central_inputs is None else self.central_inputs

    def __len__(self) -> int:
        """Return the number of decisions of single robots."""
        return self.rewards.numel()
