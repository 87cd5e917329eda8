"""All that the rest of a run depends on, as arrays and plain values, and back."""

from __future__ import annotations

from typing import TYPE_CHECKING

import torch
from torch import Tensor

from rsoccer.frame import Array
from rsoccer.train.checkpoint import Arrays, Checkpoint, owned, prefixed

if TYPE_CHECKING:
    from rsoccer.train.trainer import Trainer


def capture(trainer: Trainer, log_size: int) -> Checkpoint:
    """The run as it is between two updates, in memory of its own."""
    run = {
        "returns": trainer.returns.copy(),
        "observations": trainer.observations.copy(),
        "generator": trainer.generator.get_state().numpy().copy(),
    }
    model = {name: part.numpy().copy() for name, part in trainer.model.state_dict().items()}
    arrays = {
        **prefixed("run", run),
        **prefixed("model", model),
        **prefixed("adam", _capture_optimiser(trainer.optimiser)),
        **prefixed("obs_rms", trainer.obs_rms.state_dict()),
        **prefixed("return_rms", trainer.return_rms.state_dict()),
        **prefixed("worlds", trainer.matches.state_dict()),
        **prefixed("pool", {} if trainer.pool is None else trainer.pool.state_dict()),
    }
    info = {
        "args": trainer.args.to_json(),
        "samples": trainer.samples,
        "updates": trainer.updates,
        "elapsed": trainer.elapsed,
        "is_solo": trainer.is_solo,
        "log_size": log_size,
    }
    return Checkpoint(arrays, info)


def restore(trainer: Trainer, saved: Checkpoint) -> None:
    """Become the run that was captured, bit for bit; ValueError if it does not fit this one."""
    try:
        _restore(trainer, saved)
    except (KeyError, RuntimeError, TypeError, ValueError) as error:
        raise ValueError(f"checkpoint does not fit this task and version: {error}") from error


def _restore(trainer: Trainer, saved: Checkpoint) -> None:
    arrays, info = saved.arrays, saved.info
    if trainer.is_solo and not info["is_solo"]:
        trainer.start_self_play()
    model = {name: torch.tensor(part) for name, part in owned("model", arrays).items()}
    trainer.model.load_state_dict(model)
    _restore_optimiser(trainer.optimiser, owned("adam", arrays))
    trainer.obs_rms.load_state_dict(owned("obs_rms", arrays))
    trainer.return_rms.load_state_dict(owned("return_rms", arrays))
    trainer.matches.load_state_dict(owned("worlds", arrays))
    run = owned("run", arrays)
    trainer.returns, trainer.observations = run["returns"].copy(), run["observations"].copy()
    trainer.generator.set_state(torch.tensor(run["generator"]))
    trainer.samples, trainer.updates = info["samples"], info["updates"]
    trainer.elapsed = info["elapsed"]
    if trainer.pool is not None:
        trainer.pool.latest = trainer.network()
        trainer.pool.load_state_dict(owned("pool", arrays), trainer.pool.latest.metadata)


def _capture_optimiser(optimiser: torch.optim.Optimizer) -> Arrays:
    """What Adam remembers of each parameter, by `<parameter>.<name>`."""
    return {
        f"{index}.{name}": part.numpy().copy()
        for index, parts in optimiser.state_dict()["state"].items()
        for name, part in parts.items()
    }


def _restore_optimiser(optimiser: torch.optim.Optimizer, arrays: dict[str, Array]) -> None:
    state: dict[int, dict[str, Tensor]] = {}
    for name, array in arrays.items():
        index, key = name.split(".", 1)
        state.setdefault(int(index), {})[key] = torch.tensor(array)
    groups = optimiser.state_dict()["param_groups"]
    optimiser.load_state_dict({"state": state, "param_groups": groups})
