"""State of a run as a checkpoint, and back: all that the remaining updates depend on."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import torch

from rsoccer.arrays import Array
from rsoccer.train.prefixes import add_prefix, select_prefix
from rsoccer.train.run.checkpoint import Checkpoint
from rsoccer.train.run.played import Played
from rsoccer.train.run.trainer import Trainer


def capture(trainer: Trainer, policy_files: Mapping[str, str], log_size: int) -> Checkpoint:
    """Return a copy of the run's state between two updates.

    It has the matches too, unless other simulators or robots play them, which cannot be saved.

    Args:
        trainer: the run.
        policy_files: digests of the policies that play beside the learners, by name.
        log_size: bytes of the log's CSV file.
    """
    collector = trainer.collector
    run = {"generator": trainer.generator.get_state().numpy().copy()}
    worlds: dict[str, Array] = {}
    if collector.matches.can_be_saved:
        worlds = collector.matches.state_dict()
        run["discounted_returns"] = collector.discounted_returns.copy()
        run["observations"] = collector.observations.copy()
        if collector.states is not None:
            run["states"] = collector.states.copy()
    overlap, pending = trainer.args.ppo.overlap, trainer.pending
    if overlap:
        run["minibatch_generator"] = trainer.minibatch_generator.get_state().numpy().copy()
    central = {} if collector.central is None else collector.central.rms.state_dict()
    model = {name: part.numpy().copy() for name, part in trainer.model.state_dict().items()}
    arrays = {
        **add_prefix("run", run),
        **add_prefix("model", model),
        **add_prefix("adam", trainer.ppo.optimizer.state_dict()),
        **add_prefix("obs_rms", collector.obs_rms.state_dict()),
        **add_prefix("state_rms", central),
        **add_prefix("return_rms", collector.return_rms.state_dict()),
        **add_prefix("worlds", worlds),
        **add_prefix("pool", {} if trainer.pool is None else trainer.pool.state_dict()),
        **add_prefix("pending", {} if pending is None else pending.arrays()),
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
    if overlap:
        info["pending"] = None if pending is None else pending.info()
    return Checkpoint(arrays, info)


def restore(trainer: Trainer, saved: Checkpoint) -> None:
    """Give a new run the captured state; its updates then equal the captured run's bit for bit.

    Without saved matches new episodes begin, with random numbers of their own.

    Args:
        trainer: a new run with the settings of the captured one.
        saved: state from `capture`.

    Raises:
        ConnectionError: robots on a network do not answer.
        RuntimeError: a simulator on a network refuses new episodes.
        ValueError: a checkpoint that lacks a part, or of another task or version.
    """
    try:
        has_matches = _restore(trainer, saved)
    except (KeyError, RuntimeError, TypeError, ValueError) as error:
        raise ValueError(f"checkpoint does not fit this task and version: {error}") from error
    if not has_matches:
        seeds = np.random.SeedSequence((trainer.args.seed, trainer.updates))
        trainer.collector.begin_again(int(seeds.generate_state(1)[0]))


def restore_networks(trainer: Trainer, saved: Checkpoint) -> None:
    """Give a run its captured networks and counters; the matches stay as they are.

    Args:
        trainer: the run.
        saved: state from `capture`.
    """
    arrays, info, collector = saved.arrays, saved.info, trainer.collector
    model = {name: torch.tensor(part) for name, part in select_prefix("model", arrays).items()}
    trainer.model.load_state_dict(model)
    trainer.ppo.optimizer.load_state_dict(select_prefix("adam", arrays))
    collector.obs_rms.load_state_dict(select_prefix("obs_rms", arrays))
    collector.return_rms.load_state_dict(select_prefix("return_rms", arrays))
    if collector.central is not None:
        collector.central.rms.load_state_dict(select_prefix("state_rms", arrays))
    trainer.samples, trainer.updates = info["samples"], info["updates"]
    trainer.elapsed = info["elapsed"]
    trainer.learning_rate.value = info["learning_rate"]


def _restore(trainer: Trainer, saved: Checkpoint) -> bool:
    """Restore every part of a run that was saved, and return whether the matches were."""
    arrays, info = saved.arrays, saved.info
    if trainer.is_solo and not info["is_solo"]:
        trainer.start_team()
    restore_networks(trainer, saved)
    collector = trainer.collector
    run, worlds = select_prefix("run", arrays), select_prefix("worlds", arrays)
    has_matches = bool(worlds) or collector.matches.can_be_saved
    if has_matches:
        collector.matches.load_state_dict(worlds)
        collector.discounted_returns = run["discounted_returns"].copy()
        collector.observations = run["observations"].copy()
        if collector.central is not None:
            collector.states = run["states"].copy()
    trainer.generator.set_state(torch.tensor(run["generator"]))
    if trainer.args.ppo.overlap:
        trainer.minibatch_generator.set_state(torch.tensor(run["minibatch_generator"]))
        pending = info["pending"]
        if pending is not None:
            pending = Played.restored(select_prefix("pending", arrays), pending)
        trainer.pending = pending
    trainer.show_policy()
    if trainer.pool is not None:
        assert trainer.pool.latest is not None, "the policy was shown"
        metadata = trainer.pool.latest.metadata
        trainer.pool.load_state_dict(select_prefix("pool", arrays), metadata)
    return has_matches
