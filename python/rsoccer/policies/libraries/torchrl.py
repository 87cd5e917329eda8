"""Actors of TorchRL as policies."""

from __future__ import annotations

from collections.abc import Iterator
from math import log
from typing import Any, Final

import numpy as np

from rsoccer.policies.heads import Deviation
from rsoccer.policies.libraries.parts import Actor, Normalization, chain, conditions_of, task_of
from rsoccer.policies.network import Network
from rsoccer.task import Task

LARGEST: Final = 80.0
"""Logarithm of a standard deviation that is never reached."""
_HEADS: Final = {
    "TanhNormal": "squashed",
    "TanhDelta": "squashed",
    "IndependentNormal": "gaussian",
    "Normal": "gaussian",
    "Delta": "gaussian",
    "Categorical": "categorical",
    "OneHotCategorical": "categorical",
}


def from_torchrl(
    actor: Any,  # noqa: ANN401  (a module of torch)
    task: Task | str | None = None,
    *,
    env: Any = None,  # noqa: ANN401
    agent: int = 0,
    **settings: Any,  # noqa: ANN401
) -> Network:
    """Return the policy of an actor of TorchRL.

    Known are `ProbabilisticActor` with `TanhNormal`, `IndependentNormal`, `Categorical`,
    `OneHotCategorical`, `Delta` or `TanhDelta`, of modules with `MLP`, `MultiAgentMLP` or an
    `nn.Sequential`, followed by `NormalParamExtractor` or `AddStateIndependentNormalScale`. Other
    modules are deterministic, with actions that are clipped. Mode "mean" is
    `ExplorationType.DETERMINISTIC`.

    Args:
        actor: the actor.
        task: the task of the training, or its name; None for that of `env`.
        env: the environment; transforms `ObservationNorm` of it give the normalization. An actor
            does not hold it: without `env` the policy plays without normalization, and nothing
            warns of it.
        agent: index among the robots of a `MultiAgentMLP` without shared parameters, whose network
            is meant.
        **settings: further arguments of `Network.from_layers`, such as `action_repeat`, or `mean`,
            `std` and `clip` of a normalization.

    Returns:
        A network with a copy of the weights.

    Raises:
        TypeError: an unknown setting.
        ValueError: no task, a distribution or a module that cannot be kept, a `MultiAgentMLP` that
            reads all robots' observations, or an actor that does not fit the task.
    """
    found = task_of(task, env)
    head, layers, scales = "gaussian", [], []
    for part in _parts(actor):
        name = type(part).__name__
        if hasattr(part, "distribution_class"):
            head = _head(part)
        elif name in ("NormalParamExtractor", "AddStateIndependentNormalScale"):
            scales.append(part)
        elif hasattr(part, "get_stateful_net"):
            layers += _of_agent(part, agent)
        else:
            layers.append(part)
    if len(scales) > 1:
        raise ValueError(f"actor: expected one standard deviation, got {len(scales)}")
    std, deviation = _deviation(scales[0]) if scales else (None, None)
    described = Actor(layers, head, std, deviation)
    return described.network(found, _normalization(env), {**conditions_of(env), **settings})


def _parts(module: Any) -> Iterator[Any]:  # noqa: ANN401
    """Modules of an actor in the order in which they run."""
    if hasattr(module, "distribution_class"):
        yield module
    elif type(module).__name__ in ("MLP", "Sequential") or hasattr(module, "in_keys"):
        inner = module.module if hasattr(module, "module") else module
        if hasattr(inner, "__iter__"):
            for part in inner:
                yield from _parts(part)
        elif inner is module:  # such as exploration modules, which are refused as layers
            yield module
        else:
            yield from _parts(inner)
    else:
        yield module


def _head(part: Any) -> str:  # noqa: ANN401
    """Head of a distribution, whose arguments must be those of actions from -1 to 1."""
    name = part.distribution_class.__name__
    if name not in _HEADS:
        raise ValueError(f"actor: expected a distribution of {', '.join(_HEADS)}, got {name}")
    kwargs = dict(part.distribution_kwargs or {})
    for bound, wanted in (("low", -1.0), ("high", 1.0)):
        value = kwargs.get(bound, wanted)
        if not np.allclose(np.asarray(value.cpu() if hasattr(value, "cpu") else value), wanted):
            raise ValueError(f"actor: expected {bound}={wanted} of {name}, got {value}")
    if kwargs.get("tanh_loc", False):
        raise ValueError(f"actor: expected tanh_loc=False of {name}, got True")
    return _HEADS[name]


def _of_agent(part: Any, agent: int) -> list[Any]:  # noqa: ANN401
    """Modules of one robot in a `MultiAgentMLP`."""
    from torch import nn

    if part.centralized:
        raise ValueError(
            "actor: expected a MultiAgentMLP with centralized=False, as a robot reads its own "
            "observation alone, got centralized=True"
        )
    if not _is_shared(part) and not 0 <= agent < part.n_agents:
        raise ValueError(f"agent: expected 0 to {part.n_agents - 1}, got {agent}")
    modules: list[Any] = []
    for module in part.get_stateful_net():
        if not isinstance(module, nn.Linear):
            modules.append(module)
            continue
        weight, bias = (
            tensor.detach() if _is_shared(part) else tensor.detach()[agent]
            for tensor in (module.weight, module.bias)
        )
        linear = nn.Linear(weight.shape[1], weight.shape[0])
        linear.weight.data, linear.bias.data = weight.clone(), bias.clone()
        modules.append(linear)
    return modules


def _is_shared(part: Any) -> bool:  # noqa: ANN401
    """Whether the robots of a `MultiAgentMLP` share its weights."""
    return bool(part.share_params)


def _deviation(part: Any) -> tuple[Any, Deviation | None]:  # noqa: ANN401
    """Standard deviation of an extractor: an array, or a function of outputs."""
    least = float(part.scale_lb)
    if hasattr(part, "state_independent_scale"):
        from tensordict.nn.utils import mappings

        scale = mappings(part.scale_mapping)(part.state_independent_scale.detach())
        return scale.clamp_min(least).cpu().numpy(), None
    mapping = part.scale_mapping
    name = getattr(mapping, "__name__", type(mapping).__name__)
    if name == "biased_softplus":
        numbers = (float(mapping.bias), float(mapping.min_val), least)
        return None, Deviation("softplus", numbers)
    if name == "softplus":
        return None, Deviation("softplus", (0.0, 0.0, least))
    if name == "exp":
        return None, Deviation("exp", (log(least), LARGEST))
    raise ValueError(f"actor: expected scale_mapping softplus, biased_softplus or exp, got {name}")


def _normalization(env: object) -> Normalization:
    """Normalization by the transforms `ObservationNorm` of an environment."""
    mean, std = np.float64(0.0), np.float64(1.0)
    for each in reversed(list(chain(env))):  # the innermost transforms first
        given: Any = getattr(each, "transform", None)
        transforms: list[Any] = list(given) if hasattr(given, "__getitem__") else [given]
        for transform in transforms:
            name = type(transform).__name__
            if name.startswith("VecNorm"):
                raise ValueError(
                    "env: expected ObservationNorm, got VecNorm; give its mean and std"
                )
            if name != "ObservationNorm":
                continue
            loc, scale = (x.detach().cpu().numpy() for x in (transform.loc, transform.scale))
            if not transform.standard_normal:  # x scale + loc = (x + loc / scale) scale
                loc, scale = -loc / scale, 1.0 / scale
            # A transform after others: ((x - mean) / std - loc) / scale.
            mean, std = mean + std * loc, std * scale
    return Normalization(*(part.reshape(-1) if part.ndim else part for part in (mean, std)))
