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
    terminated: Tensor
    """(horizon, robots) bool, the task ended the episode."""
    ended: Tensor
    """(horizon, robots) bool, the episode terminated or was truncated."""
    next_inputs: Tensor
    """(k, s + o) inputs of the value network after the decisions of `needs_next`."""
    central_inputs: Tensor | None = None
    """(horizon, robots, s + o) inputs of a centralized critic before the decisions; None if the
    critic reads the observations."""

    @property
    def needs_next(self) -> Tensor:
        """(horizon, robots) bool, decisions after which no other one has the next inputs.

        They are those that end an episode, and the last ones of the rollout.
        """
        mask = self.ended.clone()
        mask[-1] = True
        return mask

    @property
    def critic_inputs(self) -> Tensor:
        """Inputs of the value network before the decisions."""
        return self.observations if self.central_inputs is None else self.central_inputs

    def __len__(self) -> int:
        """Return the number of decisions of single robots."""
        return self.rewards.numel()
