"""Modules of RLlib as policies."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from rsoccer.policies.heads import Deviation
from rsoccer.policies.libraries.parts import NO_CLIP, Actor, Normalization, task_of
from rsoccer.policies.network import Network
from rsoccer.registry import list_aliases, list_options, make_task, task_class
from rsoccer.task import Task

_HEADS: Final = {
    "TorchDiagGaussian": "gaussian",
    "TorchSquashedGaussian": "squashed",
    "TorchCategorical": "categorical",
}
UNBOUNDED: Final = 80.0
"""Bound of the logarithm of a standard deviation that is never reached."""


def from_rllib(
    algorithm: Any,  # noqa: ANN401  (types only where it is installed)
    task: Task | str | None = None,
    *,
    module: str | None = None,
    agent: str | None = None,
    **settings: Any,  # noqa: ANN401
) -> Network:
    """Return the policy of a module of RLlib (its new API stack, with torch).

    The default modules of PPO, APPO, IMPALA and SAC are known. Mode "sample" draws as exploration
    does.

    Args:
        algorithm: the `Algorithm`, or its `RLModule`. A module does not hold the statistics of a
            `MeanStdFilter`: of a module alone the policy plays without normalization, and nothing
            warns of it.
        task: the task of the training, or its name; None for that of the algorithm's `env_config`.
        module: name of the module, such as "shared"; None for the only one.
        agent: robot whose statistics of a `MeanStdFilter` apply, such as "blue_0"; None for the
            only ones.
        **settings: further arguments of `Network.from_layers`, such as `action_repeat`, or `mean`,
            `std` and `clip` of a normalization.

    Returns:
        A network with a copy of the weights.

    Raises:
        TypeError: an unknown setting.
        ValueError: no task, no or several modules of that name, a module of another form, or one
            that does not fit the task.
    """
    config = getattr(algorithm, "config", None)
    rl_module = _module(algorithm, module)
    found = _task(task, config)
    actor = _actor(rl_module)
    used = getattr(config, "env_config", None) or {}
    conditions = {name: used[name] for name in ("sensing", "randomization") if name in used}
    return actor.network(found, _normalization(algorithm, agent), {**conditions, **settings})


def _task(task: Task | str | None, config: Any) -> Task:  # noqa: ANN401
    """The task that is given, or that of an `env_config`."""
    settings = getattr(config, "env_config", None) or {}
    named = settings.get("task")
    if task is not None or named is None:
        return task_of(task, None)
    if isinstance(named, Task):
        return named
    registered, _ = list_aliases().get(named, (named, {}))
    names = list_options(task_class(registered))
    return make_task(named, **{name: settings[name] for name in names if name in settings})


def _module(algorithm: Any, name: str | None) -> Any:  # noqa: ANN401
    """The module of a name."""
    if hasattr(algorithm, "get_module"):
        names = sorted(algorithm.config.policies) or ["default_policy"]
        if name is None and len(names) > 1:
            raise ValueError(f"module: expected one of {names}, got None")
        found = algorithm.get_module(names[0] if name is None else name)
        if found is None:
            raise ValueError(f"module: expected one of {names}, got {name!r}")
        return found
    if hasattr(algorithm, "keys"):  # a MultiRLModule
        names = sorted(algorithm.keys())
        if name not in names and not (name is None and len(names) == 1):
            raise ValueError(f"module: expected one of {names}, got {name!r}")
        return algorithm[names[0] if name is None else name]
    return algorithm


def _actor(module: Any) -> Actor:  # noqa: ANN401
    """The actor of a module."""
    encoder = getattr(module, "pi_encoder", None) or getattr(module, "encoder", None)
    for part in ("actor_encoder", "encoder"):
        encoder = getattr(encoder, part, None) or encoder
    head: Any = getattr(module, "pi", None)
    parts: list[Any] = [
        getattr(getattr(part, "net", None), "mlp", None) for part in (encoder, head)
    ]
    if None in parts:
        raise ValueError(
            "module: expected an encoder and a policy head of linear layers, as PPO and SAC have "
            f"them by default, got {type(module).__name__}"
        )
    name = module.get_exploration_action_dist_cls().__name__
    if name.startswith("TorchPartial") or name.endswith("Partial"):
        name = module.get_exploration_action_dist_cls().__mro__[1].__name__
    kind = next((known for known in _HEADS if known in name), None)
    if kind is None:
        raise ValueError(f"module: expected a distribution of {', '.join(_HEADS)}, got {name}")
    layers = [*parts[0], *parts[1]]
    if kind == "TorchCategorical":
        return Actor(layers, "categorical")
    if hasattr(head, "log_std"):
        log_std = head.log_std.detach().cpu().numpy()
        if head.clip_log_std:
            bound = float(head.log_std_clip_param_const)
            log_std = np.clip(log_std, -bound, bound)
        return Actor(layers, _HEADS[kind], action_std=np.exp(log_std))
    return Actor(layers, _HEADS[kind], deviation=_deviation(head, kind))


def _deviation(head: Any, kind: str) -> Deviation:  # noqa: ANN401
    """Standard deviation of the second half of the outputs."""
    low, high = -UNBOUNDED, UNBOUNDED
    if getattr(head, "clip_log_std", False):
        high = float(head.log_std_clip_param_const)
        low = -high
    if kind == "TorchSquashedGaussian":
        from ray.rllib.utils.numpy import MAX_LOG_NN_OUTPUT, MIN_LOG_NN_OUTPUT

        low, high = max(low, MIN_LOG_NN_OUTPUT), min(high, MAX_LOG_NN_OUTPUT)
    return Deviation("exp", (float(low), float(high)))


def _normalization(algorithm: Any, agent: str | None) -> Normalization:  # noqa: ANN401
    """Normalization by a `MeanStdFilter` between environment and module."""
    runner = getattr(algorithm, "env_runner", None)
    pipeline = getattr(runner, "_env_to_module", None)
    for connector in getattr(pipeline, "connectors", []):
        if type(connector).__name__ != "MeanStdFilter":
            continue
        filters = connector._filters or {}
        names = sorted(str(name) for name in filters)
        if agent is None and len(filters) > 1:
            raise ValueError(
                f"agent: expected one of {names}, as each has statistics of its own, got None"
            )
        if agent is not None and agent not in filters and None not in filters:
            raise ValueError(f"agent: expected one of {names}, got {agent!r}")
        return _of_filter(filters[agent] if agent in filters else next(iter(filters.values())))
    return Normalization()


def _of_filter(given: Any) -> Normalization:  # noqa: ANN401
    """Normalization of one filter."""
    from ray.rllib.utils.numpy import SMALL_NUMBER

    statistics = given.running_stats
    return Normalization(
        statistics.mean if given.demean else 0.0,
        statistics.std + SMALL_NUMBER if given.destd else 1.0,
        float(given.clip) if given.clip else NO_CLIP,
    )
