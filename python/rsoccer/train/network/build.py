"""Creation of the networks of a run from its settings."""

from __future__ import annotations

import numpy as np
import torch

from rsoccer.history import ObservationStack
from rsoccer.task import Task
from rsoccer.train.network.actor_critic import ActorCritic
from rsoccer.train.network.observation_mask import observation_mask
from rsoccer.train.network.settings import NetworkSettings
from rsoccer.train.network.weight_sharing import WeightSharing, robot_slots


def build_networks(
    settings: NetworkSettings,
    task: Task,
    stack: ObservationStack,
    state_size: int,
    generator: torch.Generator,
) -> tuple[ActorCritic, WeightSharing | None]:
    """Return new networks, and the groups of their parameters that stay equal.

    Args:
        settings: settings of the networks.
        task: the task to train on.
        stack: what the networks observe of it.
        state_size: numbers in a global state, which a centralized critic reads.
        generator: draws the weights.

    Returns:
        Policy and value network, and the shared weights; None without `robot_units`.

    Raises:
        ValueError: settings that do not fit the task.
    """
    slots = robot_slots(task, stack) if settings.robot_units else []
    first, *others = settings.hidden_sizes
    shared_units = settings.robot_units * sum(len(columns) for columns in slots)
    model = ActorCritic(
        stack.size,
        task.action_size,
        (first + shared_units, *others),
        settings.action_std,
        generator,
        state_size=state_size if settings.central_critic else 0,
        mask=stack.join(
            observation_mask(task, settings.masked_observations),
            np.ones(task.action_size, np.float32),
        ),
    )
    sharing: WeightSharing | None = None
    if slots:
        sharing = WeightSharing(slots, settings.robot_units, stack.size, model)
        sharing.tie(model)
    if settings.initial_action:
        model.set_mean_action(settings.initial_action)
    return model, sharing
