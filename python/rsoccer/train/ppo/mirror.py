"""Symmetry augmentation: each sample of a rollout is learned from a second time, reflected.

Data augmentation as in MARLadona (ICRA 2025) and in Mittal et al., "Symmetry Considerations for
Learning Task Symmetric Robot Policies" (2024): a reflected sample has the advantage and the return
of its original. Its log density is that of the policy before the update for the reflected
observation, so an update starts at a probability ratio of 1 for every sample.

A policy is not symmetric by itself. Reflected actions that it would hardly draw have gradients
without bound, as PPO clips the ratio of a bad action from below only: training diverged. Such
samples are left out.
"""

from __future__ import annotations

import math
from typing import Final

import torch
from torch import Tensor

from rsoccer.global_state import StateEncoder
from rsoccer.history import ObservationStack
from rsoccer.reflection import Reflection
from rsoccer.task import Task
from rsoccer.train.network.evaluator import Evaluator
from rsoccer.train.ppo.batch import Batch

MIN_DENSITY_RATIO: Final = 0.5
"""Least density of a reflected action under the policy, relative to that of the original."""


def check_symmetric(task: Task) -> None:
    """Refuse a task that is another one with left and right swapped.

    Args:
        task: the task to train on.

    Raises:
        ValueError: a task that is not symmetric.
    """
    if task.layout.reflection is None:
        raise ValueError(
            f"ppo.mirror_augmentation must be False, as {task.name} is not symmetric, got True"
        )


@torch.no_grad()
def with_reflections(
    batch: Batch, task: Task, stack: ObservationStack, evaluator: Evaluator
) -> Batch:
    """Return a batch of up to twice the size: the samples, then those that can be reflected.

    Reflected actions below `MIN_DENSITY_RATIO` are left out.

    Args:
        batch: samples of one rollout. Their observations are normalized by statistics that the
            reflection does not change.
        task: the task, which is symmetric.
        stack: what the networks observe of it.
        evaluator: evaluates the networks as they are before the update.
    """
    symmetry, found = task.symmetry, stack.reflection(task)
    assert symmetry is not None and found is not None, "a symmetric task"
    reflection: Reflection = found
    model = evaluator.model
    observations, log_probs = torch.empty_like(batch.observations), torch.empty(len(batch))
    order, signs = torch.as_tensor(reflection.order), torch.as_tensor(reflection.signs) * model.mask
    actions = _reflect(batch.actions, symmetry.action)

    @torch.no_grad()
    def reflect(part: slice, thread: int) -> None:
        reflected = observations[part]
        torch.mul(batch.observations[part].index_select(-1, order), signs, out=reflected)
        mean = evaluator.actor(thread).outputs(reflected)
        log_probs[part] = model.log_prob(mean, actions[part])

    evaluator.each_part(len(batch), reflect)
    reflected = Batch(observations, actions, log_probs, batch.advantages, batch.returns)
    if batch.central_inputs is not None:
        states = batch.central_inputs[:, : -stack.size]
        mirrored = _reflect(states, StateEncoder(task.config).reflection)
        reflected.central_inputs = torch.cat([mirrored, observations], dim=-1)
    likely = log_probs >= batch.log_probs + math.log(MIN_DENSITY_RATIO)
    return _joined(batch, reflected, likely.nonzero().squeeze(-1), evaluator)


def _joined(first: Batch, second: Batch, rows: Tensor, evaluator: Evaluator) -> Batch:
    """All samples of a batch, then some rows of another one."""
    size = len(first)
    others = second.parts()
    joined = {
        name: part.new_empty((size + len(rows), *part.shape[1:]))
        for name, part in first.parts().items()
    }

    def copy_first(part: slice, _: int) -> None:
        for name, values in first.parts().items():
            joined[name][part] = values[part]

    def copy_rows(part: slice, _: int) -> None:
        for name, values in others.items():
            torch.index_select(values, 0, rows[part], out=joined[name][size:][part])

    evaluator.each_part(size, copy_first)
    evaluator.each_part(len(rows), copy_rows)
    return Batch(**joined)


def _reflect(vectors: Tensor, reflection: Reflection) -> Tensor:
    """Reflected vectors (..., k)."""
    order = torch.as_tensor(reflection.order)
    return vectors.index_select(-1, order).mul_(torch.as_tensor(reflection.signs))
