"""Weights shared by robots whose order means nothing, such as six opponents.

A perceptron has to learn for each slot of its observation anew that a robot there is in the way.
With shared weights it learns so for all slots at once, and the order of the robots changes nothing
(Zaheer et al., "Deep Sets", 2017). The first layer then has some units for each other robot, with
equal weights, and the second layer adds them up. Shared weights are entries of the usual matrices
that stay equal, so an exported policy is an ordinary perceptron.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn

from rsoccer.history import ObservationStack
from rsoccer.task import Task
from rsoccer.train.network.perceptron import Perceptron

Indices = NDArray[np.intp]
"""Indices of columns, units or parameters."""


def robot_slots(task: Task, stack: ObservationStack) -> list[Indices]:
    """Return the columns of the stacked observation that describe other robots.

    Args:
        task: the task, which defines the blocks.
        stack: the observations that are stacked.

    Returns:
        Columns (slots, k) for the teammates and for the opponents of a blue robot, where they are
        two or more; a slot is a robot's place in each block with numbers of robots, of the
        current observation and of the past ones.

    Raises:
        ValueError: a task without such a team.

    Example:
        >>> from rsoccer import make_task
        >>> task = make_task("VSSMulti-v0")
        >>> stack = ObservationStack.of(task, 2)
        >>> [columns.shape for columns in robot_slots(task, stack)]
        [(2, 18), (3, 18)]
    """
    found, first = [], 1  # the first row of "body_positions" is the ball
    for name, robots in (("teammates", task.n_blue - 1), ("opponents", task.n_yellow)):
        slots = task.layout.blocks[name].shape[0] if name in task.layout.blocks else 0
        if robots > 1:  # further slots are empty
            parts = [_columns(task, name), _columns(task, "body_positions")[first : first + slots]]
            if name == "opponents" and "nearness" in task.layout.blocks:
                parts.append(_columns(task, "nearness"))
            starts = range(0, stack.history * stack.observation_size, stack.observation_size)
            found.append(np.concatenate([part + s for s in starts for part in parts], axis=1))
        first += slots
    if not found:
        raise ValueError(
            f"network.robot_units must be 0, as {task.name} has no team of two or more other robots"
        )
    return found


def _columns(task: Task, name: str) -> Indices:
    """Columns of a block of the flat observation, in the block's shape."""
    block = task.layout.blocks[name]
    return np.arange(task.layout.size)[block.columns].reshape(block.shape)


class WeightSharing:
    """Groups of parameters of a policy and its value network that stay equal."""

    def __init__(
        self, slots: Sequence[Indices], units: int, observation_size: int, model: nn.Module
    ) -> None:
        """Find the groups; `tie` makes their parameters equal.

        Args:
            slots: columns of the observation, from `robot_slots`.
            units: units for each slot, which are the last ones of a network's first layer.
            observation_size: numbers in an observation, the last inputs of each network.
            model: holds networks with two or more layers, and no other parameters.
        """
        networks = [child for child in model.children() if isinstance(child, Perceptron)]
        orbits = [
            _orbits(parameter.shape, swaps)
            for network in networks
            for parameter, swaps in _swapped_parameters(network, slots, units, observation_size)
        ]
        labels, start = [], 0
        for part in orbits:
            labels.append(part.reshape(-1) + start)
            start += part.size
        self._labels = torch.tensor(np.concatenate(labels))
        self._counts = torch.bincount(self._labels, minlength=start).clamp(min=1).float()

    @torch.no_grad()
    def tie(self, model: nn.Module) -> None:
        """Make the parameters of each group equal to the group's first one.

        Args:
            model: the model of the constructor, or a copy.
        """
        vector = nn.utils.parameters_to_vector(model.parameters())
        nn.utils.vector_to_parameters(vector[self._labels], model.parameters())

    def average(self, gradient: Tensor) -> Tensor:
        """Return gradients of which those of a group are replaced by their mean, (size,).

        Args:
            gradient: (size,) gradients of the parameters.
        """
        sums = torch.zeros_like(gradient)
        if gradient.device.type == "cpu":
            sums.index_add_(0, self._labels, gradient)
        else:  # a GPU adds in a fixed order only here, where it sorts the labels first
            sums.index_put_((self._labels,), gradient, accumulate=True)
        return sums.div_(self._counts)[self._labels]

    def move(self, device: torch.device) -> None:
        """Move the groups to the device of the gradients.

        Args:
            device: device of the updates.
        """
        self._labels, self._counts = self._labels.to(device), self._counts.to(device)


Swap = tuple[Indices | None, Indices | None]
"""New order of the rows and of the columns of a matrix; None for the same order."""


def _swapped_parameters(
    network: Perceptron, slots: Sequence[Indices], units: int, observation_size: int
) -> Iterator[tuple[Tensor, list[Swap]]]:
    """Parameters of a network, each with the swaps of two robots that must not change it."""
    weight, bias, *others = network.parameters()
    hidden, inputs = weight.shape
    swaps: list[tuple[Indices, Indices]] = []
    unit = hidden - units * sum(len(columns) for columns in slots)
    for columns in slots:
        for slot in range(len(columns)):
            if slot > 0:
                order = np.arange(inputs)
                _swap(order, *(columns[slot - 1 : slot + 1] + inputs - observation_size))
                rows = np.arange(hidden)
                _swap(rows, np.arange(unit - units, unit), np.arange(unit, unit + units))
                swaps.append((rows, order))
            unit += units
    yield weight, list(swaps)
    yield bias, [(rows, None) for rows, _ in swaps]
    yield others[0], [(None, rows) for rows, _ in swaps]
    for parameter in others[1:]:
        yield parameter, []


def _swap(order: Indices, first: Indices, second: Indices) -> None:
    """Exchange two sets of entries."""
    order[first], order[second] = order[second], order[first]


def _orbits(shape: Sequence[int], swaps: Sequence[Swap]) -> Indices:
    """Least index of the entries onto which the swaps can move each entry, in the given shape."""
    labels = np.arange(math.prod(shape)).reshape(shape)
    while True:
        before = labels
        for rows, columns in swaps:
            moved = labels if rows is None else labels[rows]
            moved = moved if columns is None else moved[:, columns]
            labels = np.minimum(labels, moved)
        if np.array_equal(labels, before):
            return labels
