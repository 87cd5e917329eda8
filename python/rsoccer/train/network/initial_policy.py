"""Weights of a trained policy as the beginning of a run.

A policy that has learned a task on the true state needs few samples to learn it with late or noisy
senses. Inputs that it does not have, those of a history, begin with weights of 0, so at first the
run plays as the policy does.
"""

from __future__ import annotations

from pathlib import Path
from typing import Final

import numpy as np
import torch

from rsoccer.arrays import Array, Floats
from rsoccer.history import ObservationStack
from rsoccer.policies import make_policy
from rsoccer.policies.base import Policy
from rsoccer.policies.network import Network
from rsoccer.policies.other_task import fitted
from rsoccer.policies.policy_file import SUFFIX
from rsoccer.policies.trained import list_trained
from rsoccer.task import Task
from rsoccer.train.network.actor_critic import ActorCritic

ROWS: Final = 1_000_000
"""Observations that the policy's normalization counts for in the running one. With few of them the
inputs of the policy would change before it has learned anything."""


def load_for_task(name: str, task: Task, stack: ObservationStack) -> Network:
    """Load the policy that a run of the trainer begins with, perhaps one of another task.

    Args:
        name: the name `best`, the path of a policy file, or the name of a task with a trained
            policy, whose weights are taken along by the names of observation blocks.
        task: the task to train on.
        stack: what the networks observe of it.

    Returns:
        The policy.

    Raises:
        ValueError: as `load`, or a policy of the other league.
    """
    trained = list_trained()
    is_other = name in trained and name != task.name
    if not is_other and not (name.endswith(SUFFIX) and Path(name).exists()):
        return load(name, task, stack)
    try:
        policy = Network.load(trained[name] if is_other else name)
        if policy.metadata.get("layout") != task.layout.text:
            policy = fitted(policy, task)
        policy.check_fits(task, task.layout.size)
    except ValueError as error:
        raise ValueError(f"network.initial_policy: {error}") from error
    return _checked(policy, name, task, stack, "network.initial_policy")


def load(
    name: str, task: Task, stack: ObservationStack, argument: str = "network.initial_policy"
) -> Network:
    """Load a policy of a task.

    Args:
        name: the name `best`, or the path of a policy file.
        task: the task to train on.
        stack: what the networks observe of it.
        argument: name of the setting, for errors.

    Returns:
        The policy.

    Raises:
        ValueError: no such policy, one without weights, or one that does not fit the task or has a
            longer history, or other activations or another head than the trainer's.
    """
    try:
        policy = make_policy(name, task)
    except (FileNotFoundError, ValueError) as error:
        raise ValueError(f"{argument}: {error}") from error
    return _checked(policy, name, task, stack, argument)


def _checked(
    policy: Policy, name: str, task: Task, stack: ObservationStack, argument: str
) -> Network:
    """The policy, if it is a network as the trainer has them."""
    if not isinstance(policy, Network):
        raise ValueError(
            f"{argument}: expected a trained policy, got {name!r}, which has no weights"
        )
    if policy.activation != "tanh" or policy.head.kind != "gaussian" or policy.head.deviation:
        raise ValueError(
            f"{argument}: expected a policy with tanh layers and a Gaussian of constant deviation, "
            f"as the trainer has them, got {policy.activation} layers and the head "
            f"{policy.head.kind!r}"
        )
    if policy.history > stack.history:
        raise ValueError(
            f"{argument}: expected a policy with at most the run's history of {stack.history}, got "
            f"one of {policy.history}"
        )
    return policy


@torch.no_grad()
def copy_weights(policy: Network, stack: ObservationStack, model: ActorCritic) -> None:
    """Give the actor the weights of a policy, and weights of 0 for inputs that it does not read.

    Args:
        policy: the policy, from `load`.
        stack: what the networks observe.
        model: the networks; the value network stays as it is.

    Raises:
        ValueError: the policy has layers of other sizes.
    """
    parameters = list(model.actor.parameters())
    given = [part for layer in widened_layers(policy, stack) for part in layer]
    if [tuple(part.shape) for part in parameters] != [part.shape for part in given]:
        sizes = [len(bias) for _, bias in policy.layers]
        wanted = [len(bias) for bias in parameters[1::2]]
        raise ValueError(
            f"network.initial_policy: expected layers of {wanted} units, as hidden_sizes and "
            f"robot_units of the network say, got {sizes}; None begins with random weights"
        )
    for parameter, part in zip(parameters, given, strict=True):
        parameter.copy_(torch.tensor(part))
    model.clear_masked_weights()  # training does not change them, and a policy file has no mask


def statistics(policy: Network, stack: ObservationStack) -> dict[str, Array]:
    """Return statistics of observations that a run begins with, those of a policy.

    Args:
        policy: the policy, from `load`.
        stack: what the networks observe.

    Returns:
        Arrays as `RunningMeanStd.load_state_dict` takes them.
    """
    mean, std = (part.astype(np.float64) for part in widened_normalization(policy, stack))
    return {"count": np.array([ROWS]), "mean": mean, "variance": std**2}


def widened_layers(policy: Network, stack: ObservationStack) -> list[tuple[Floats, Floats]]:
    """Return weight and bias of each layer, with weights of 0 for inputs that a policy lacks.

    Args:
        policy: the policy, of at most the history of the stack.
        stack: what the layers observe.
    """
    (weight, bias), *others = policy.layers
    first = np.zeros((len(weight), stack.size), np.float32)
    first[:, _columns(policy, stack)] = weight
    return [(first, bias), *others]


def widened_normalization(policy: Network, stack: ObservationStack) -> tuple[Floats, Floats]:
    """Return mean and standard deviation of stacked observations, (o,) each.

    Past observations have those of the policy's current one. Past actions, which it lacks, have 0
    and 1, as they are within these bounds.

    Args:
        policy: the policy, of at most the history of the stack.
        stack: what is observed.
    """
    size, columns = stack.observation_size, _columns(policy, stack)
    mean = stack.join(policy.mean[:size], np.zeros(stack.action_size, np.float32))
    std = stack.join(policy.std[:size], np.ones(stack.action_size, np.float32))
    mean[columns], std[columns] = policy.mean, policy.std
    return mean, std


def _columns(policy: Network, stack: ObservationStack) -> Array:
    """Columns of the stacked observation that a policy of an equal or a shorter history reads."""
    observation, action = np.arange(stack.observation_size), np.arange(stack.action_size)
    return stack.columns(policy.history, observation, action)
