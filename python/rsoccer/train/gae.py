"""Generalised advantage estimation (GAE, Schulman et al. 2016)."""

from __future__ import annotations

import torch
from torch import Tensor


def compute_gae(
    rewards: Tensor,
    values: Tensor,
    next_values: Tensor,
    terminated: Tensor,
    ended: Tensor,
    gamma: float,
    gae_lambda: float,
) -> Tensor:
    """Return the advantages of a rollout, (horizon, robots).

    Time limits are bootstrapped: a truncated episode counts the value of its last true
    observation, a terminated episode counts nothing after its end.

    Args:
        rewards: (horizon, robots) rewards of the decisions.
        values: (horizon, robots) values of the observations before the decisions.
        next_values: (horizon, robots) values of the true next observations.
        terminated: (horizon, robots) bool, the episode terminated.
        ended: (horizon, robots) bool, the episode terminated or was truncated.
        gamma: discount factor per decision, 0 to 1.
        gae_lambda: weight of later temporal-difference errors, 0 to 1.
    """
    advantages, gae = torch.zeros_like(rewards), torch.zeros_like(rewards[0])
    for t in reversed(range(len(rewards))):
        bootstrap = gamma * next_values[t] * ~terminated[t]
        delta = rewards[t] + bootstrap - values[t]
        gae = delta + gamma * gae_lambda * gae * ~ended[t]
        advantages[t] = gae
    return advantages
