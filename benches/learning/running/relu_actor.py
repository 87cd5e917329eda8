"""Actors of DDPG and SAC as policies of the package: perceptrons with ReLU, run in NumPy.

Policy files of the package have tanh layers, so these actors have a file of their own, `.npz`.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Final, Self

import numpy as np

from rsoccer.arrays import Floats
from rsoccer.policies.held_actions import HeldActions
from rsoccer.rng import WorldRng

LOG_STD_RANGE: Final = (-20.0, 2.0)  # as Stable-Baselines3 bounds it

Layer = tuple[Floats, Floats]
"""Weight (out, in) and bias (out,)."""


class ReluActor(HeldActions):
    """Perceptron whose actions are `tanh` of its last layer, held for some control steps."""

    def __init__(
        self, layers: Sequence[Layer], action_repeat: int = 1, log_std: Layer | None = None
    ) -> None:
        """Build the actor.

        Args:
            layers: Layers from the observation to the action before `tanh`.
            action_repeat: Control steps for which an action is held.
            log_std: Layer from the last hidden layer to the logarithm of the standard deviation
                before `tanh`. With it actions are drawn, without it they are deterministic.
        """
        super().__init__()
        self.layers, self.action_repeat, self.log_std = list(layers), action_repeat, log_std

    def mean(self) -> ReluActor:
        """Return the same actor without the spread of its actions."""
        return ReluActor(self.layers, self.action_repeat)

    def choose(self, observations: Floats, rng: WorldRng) -> Floats:
        """Return new actions (n, robots, action) for observations (n, robots, o)."""
        hidden = observations
        for weight, bias in self.layers[:-1]:
            hidden = np.maximum(hidden @ weight.T + bias, 0.0)
        weight, bias = self.layers[-1]
        actions = hidden @ weight.T + bias
        if self.log_std is not None:
            weight, bias = self.log_std
            std = np.exp(np.clip(hidden @ weight.T + bias, *LOG_STD_RANGE))
            actions = actions + std * rng.normal(actions.shape[1:])
        chosen: Floats = np.tanh(actions).astype(np.float32)
        return chosen

    def save(self, path: Path) -> None:
        """Write the actor to a file."""
        layers = [*self.layers, *([] if self.log_std is None else [self.log_std])]
        arrays = {f"{part}{i}": a for i, pair in enumerate(layers) for part, a in zip("wb", pair)}  # noqa: B905
        head = np.array([len(self.layers), self.action_repeat])
        np.savez(path, head=head, **arrays)  # type: ignore[arg-type]

    @classmethod
    def load(cls, path: Path) -> Self:
        """Read an actor that `save` wrote."""
        with np.load(path) as file:
            count, action_repeat = file["head"].tolist()
            layers = [(file[f"w{i}"], file[f"b{i}"]) for i in range(len(file.files) // 2)]
        return cls(layers[:count], action_repeat, layers[count] if len(layers) > count else None)
