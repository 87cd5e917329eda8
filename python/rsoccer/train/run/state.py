"""State of a run as a checkpoint, and back: all that the remaining updates depend on."""

from __future__ import annotations

from collections.abc import Mapping

import torch

from rsoccer.train.prefixes import add_prefix, select_prefix
from rsoccer.train.run.checkpoint import Checkpoint
from rsoccer.train.run.trainer import Trainer


def capture(trainer: Trainer, policy_files: Mapping[str, str], log_size: int) -> Checkpoint:
    """Return a copy of the run's state between two updates.

    Args:
        trainer: the run.
        policy_files: digests of the policies that play beside the learners, by name.
        log_size: bytes of the log's CSV file.
    """
    collector = trainer.collector
    run = {
        "discounted_returns": collector.discounted_returns.copy(),
        "observations": collector.observations.copy(),
        "generator": trainer.generator.get_state().numpy().copy(),
    }
    if collector.states is not None:
        run["states"] = collector.states.copy()
    central = {} if collector.central is None else collector.central.rms.state_dict()
    model = {name: part.numpy().copy() for name, part in trainer.model.state_dict().items()}
    arrays = {
        **add_prefix("run", run),
        **add_prefix("model", model),
        **add_prefix("adam", trainer.ppo.optimizer.state_dict()),
        **add_prefix("obs_rms", collector.obs_rms.state_dict()),
        **add_prefix("state_rms", central),
        **add_prefix("return_rms", collector.return_rms.state_dict()),
        **add_prefix("worlds", collector.matches.state_dict()),
        **add_prefix("pool", {} if trainer.pool is None else trainer.pool.state_dict()),
    }
    info = {
        "args": trainer.args.to_json(),
        "policy_files": dict(policy_files),
        "samples": trainer.samples,
        "updates": trainer.updates,
        "elapsed": trainer.elapsed,
        "learning_rate": trainer.learning_rate.value,
        "is_solo": trainer.is_solo,
        "log_size": log_size,
    }
    return Checkpoint(arrays, info)


def restore(trainer: Trainer, saved: Checkpoint) -> None:
    """Give a new run the captured state; its updates then equal the captured run's bit for bit.

    Args:
        trainer: a new run with the settings of the captured one.
        saved: state from `capture`.

    Raises:
        ValueError: a checkpoint that lacks a part, or of another task or version.
    """
    try:
        _restore(trainer, saved)
    except (KeyError, RuntimeError, TypeError, ValueError) as error:
        raise ValueError(f"checkpoint does not fit this task and version: {error}") from error


def _restore(trainer: Trainer, saved: Checkpoint) -> None:
    """Restore every part of a run."""
    arrays, info = saved.arrays, saved.info
    if trainer.is_solo and not info["is_solo"]:
        trainer.start_team()
    collector = trainer.collector
    model = {name: torch.tensor(part) for name, part in select_prefix("model", arrays).items()}
    trainer.model.load_state_dict(model)
    trainer.ppo.optimizer.load_state_dict(select_prefix("adam", arrays))
    collector.obs_rms.load_state_dict(select_prefix("obs_rms", arrays))
    collector.return_rms.load_state_dict(select_prefix("return_rms", arrays))
    collector.matches.load_state_dict(select_prefix("worlds", arrays))
    run = select_prefix("run", arrays)
    if collector.central is not None:
        collector.central.rms.load_state_dict(select_prefix("state_rms", arrays))
        collector.states = run["states"].copy()
    collector.discounted_returns = run["discounted_returns"].copy()
    collector.observations = run["observations"].copy()
    trainer.generator.set_state(torch.tensor(run["generator"]))
    trainer.samples, trainer.updates = info["samples"], info["updates"]
    trainer.elapsed = info["elapsed"]
    trainer.learning_rate.value = info["learning_rate"]
    trainer.show_policy()
    if trainer.pool is not None:
        assert trainer.pool.latest is not None, "the policy was shown"
        metadata = trainer.pool.latest.metadata
        trainer.pool.load_state_dict(select_prefix("pool", arrays), metadata)
