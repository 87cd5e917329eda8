"""Generalized advantage estimation (GAE, Schulman et al. 2016)."""

from __future__ import annotations

import torch
from torch import Tensor

from rsoccer.train.network.evaluator import Evaluator
from rsoccer.train.ppo.batch import Batch
from rsoccer.train.ppo.settings import PpoSettings
from rsoccer.train.rollout.samples import Rollout


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


@torch.no_grad()
def make_batch(
    rollout: Rollout, evaluator: Evaluator, settings: PpoSettings, gamma: float
) -> Batch:
    """Return the samples of a rollout, with their advantages and the targets of their values.

    Args:
        rollout: decisions of all learners.
        evaluator: evaluates the value network.
        settings: settings of PPO.
        gamma: discount factor per decision, 0 to 1.
    """
    values = evaluator.value(rollout.critic_inputs)
    next_values = values.roll(-1, 0)
    next_values[rollout.needs_next] = evaluator.value(rollout.next_inputs)
    advantages = compute_gae(
        rollout.rewards,
        values,
        next_values,
        rollout.terminated if settings.bootstrap_time_limits else rollout.ended,
        rollout.ended,
        gamma,
        settings.gae_lambda,
    )
    parts = [rollout.observations, rollout.actions, rollout.log_probs, advantages]
    parts += [advantages + values]
    parts += [] if rollout.central_inputs is None else [rollout.central_inputs]
    return Batch(*(part.flatten(0, 1) for part in parts))
