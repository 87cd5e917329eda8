"""Parts of a policy that all libraries have: the task, the history, the normalization."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import ArrayLike

from rsoccer.history import ObservationStack
from rsoccer.policies.network import Network
from rsoccer.registry import as_task
from rsoccer.task import Task

if TYPE_CHECKING:
    from rsoccer.policies.heads import Deviation
    from rsoccer.policies.layers import Layers

NO_CLIP: Final = 1e9
"""Bound of normalized observations that is never reached."""
_WRAPPED: Final = ("venv", "env", "base_env", "_env")
"""Attributes under which wrappers of the libraries hold what they wrap."""


@dataclass(frozen=True)
class Normalization:
    """Normalization of observations: clip((x - mean) / std, -clip, clip)."""

    mean: ArrayLike = 0.0
    """(o,) mean"""
    std: ArrayLike = 1.0
    """(o,) standard deviation, above 0"""
    clip: float = NO_CLIP
    """bound of a normalized observation, above 0"""


@dataclass(frozen=True)
class Actor:
    """Layers and head of a model, without its library."""

    layers: Layers
    """linear layers and activations, from the observation to the outputs of the head"""
    head: str = "gaussian"
    """see `rsoccer.policies.heads`"""
    action_std: ArrayLike | None = None
    """(action,) standard deviation; None where the layers compute it, and without noise"""
    deviation: Deviation | None = None
    """standard deviation as a function of the second half of the outputs"""
    activation: str | None = None
    """activation between layers that are arrays"""

    def network(
        self, task: Task, normalization: Normalization, settings: Mapping[str, Any]
    ) -> Network:
        """Return a network that plays.

        Args:
            task: the task of the training.
            normalization: that of the observations.
            settings: further arguments of `Network.from_layers`, which go before those of the
                model and of the normalization.

        Raises:
            TypeError: an unknown setting.
            ValueError: a model that does not fit the task, or layers that cannot be kept.
        """
        from rsoccer.policies.layers import read_layers

        pairs, activation = read_layers(self.layers, self.activation)
        given: dict[str, Any] = {
            "history": history_of(task, int(pairs[0][0].shape[1])),
            "mean": normalization.mean,
            "std": normalization.std,
            "clip": normalization.clip,
            **settings,
        }
        return Network.from_layers(
            task,
            pairs,
            self.action_std,
            activation=activation,
            head=self.head,
            deviation=self.deviation,
            **given,
        )


def chain(env: object) -> Iterator[Any]:
    """Yield an environment and what it wraps, the outermost first.

    Args:
        env: an environment of any library, or None.
    """
    while env is not None:
        yield env
        # `vars` alone: wrappers pass on unknown attributes to what they wrap.
        held = (getattr(env, name, None) for name in _WRAPPED if name in _own_names(env))
        env = next((inner for inner in held if inner is not None), None)


def _own_names(env: object) -> set[str]:
    """Names of the attributes and submodules of an object itself."""
    own = getattr(env, "__dict__", {})
    return {*own, *own.get("_modules", {})}


def task_of(task: Task | str | None, env: object) -> Task:
    """Return the task of a training.

    Args:
        task: the task or its name; None for that of the environment.
        env: environment of the model, or None.

    Raises:
        TypeError: neither a task nor its name.
        ValueError: no task, and no environment of this package.
    """
    if task is not None:
        return as_task(task)
    found = _environment(env)
    if found is None:
        raise ValueError(
            "task: expected the task of the training or its name, as the model holds no "
            "environment of rsoccer, got None"
        )
    own: Task = found.task
    return own


def conditions_of(env: object) -> dict[str, Any]:
    """Return what robots knew in a training, and which numbers varied.

    Args:
        env: environment of the model, or None.

    Returns:
        Arguments of `Network.from_layers`; none without an environment of this package.
    """
    matches = getattr(_environment(env), "matches", None)
    if matches is None:
        return {}
    return {"sensing": matches.sensing, "randomization": matches.randomization}


def _environment(env: object) -> Any:  # noqa: ANN401  (of any library)
    """The environment of this package that an environment wraps, or None."""
    for each in chain(env):
        for candidate in [each, *getattr(each, "envs", [])[:1]]:
            found = getattr(candidate, "unwrapped", candidate)
            if isinstance(getattr(found, "task", None), Task):
                return found
    return None


def history_of(task: Task, size: int) -> int:
    """Return how many observations are in a stacked one.

    Args:
        task: the task of the training.
        size: numbers in an observation of the model.

    Raises:
        ValueError: no history has this size.
    """
    stack = ObservationStack.of(task, 1)
    history, rest = divmod(size + stack.action_size, stack.observation_size + stack.action_size)
    if rest or history < 1:
        raise ValueError(
            f"the model takes observations of {size} numbers, but task {task.name!r} has "
            f"{stack.observation_size}, and {ObservationStack.of(task, 2).size} with a history of "
            f"2: the observations of the task are {task.layout.text}"
        )
    return history


def running_normalization(
    mean: ArrayLike, variance: ArrayLike, epsilon: float, clip: float
) -> Normalization:
    """Return the normalization of running statistics: clip((x - mean) / sqrt(variance + epsilon)).

    Args:
        mean: (o,) mean.
        variance: (o,) variance.
        epsilon: added to the variance, at least 0.
        clip: bound of a normalized observation, above 0.
    """
    std = np.sqrt(np.asarray(variance, np.float64) + epsilon)
    return Normalization(np.asarray(mean, np.float64), std, clip)
