"""A training run in its folder: its begin, its end by a signal, and the match of its policy."""

from __future__ import annotations

import sys
from contextlib import closing
from pathlib import Path

from rsoccer.lineup import lineup, opponents_of
from rsoccer.policies import trained_on
from rsoccer.replay.recorder import record_replay
from rsoccer.train.args import Args
from rsoccer.train.run import folder
from rsoccer.train.run.callback import Callback
from rsoccer.train.run.checkpoint import Checkpoint
from rsoccer.train.run.folder import MATCH_FILES, POLICY_FILE
from rsoccer.train.run.loop import Loop
from rsoccer.train.run.state import restore
from rsoccer.train.run.stop_signal import Interrupted, Stopped, StopSignal
from rsoccer.train.run.trainer import Trainer

MATCH_SECONDS = 30.0
"""Duration of that match, s."""
UNTRAINED_FILE = "untrained.safetensors"
"""Name of the policy from before the first update in a run's folder."""


def run_training(args: Args, callback: Callback | None = None) -> Path:
    """Start or resume a run and save its policy: the implementation of `rsoccer.train.train`.

    Args:
        args: settings of the run.
        callback: called after each update, see `rsoccer.train.run.callback`; None for none.

    Returns:
        Path of the policy file.

    Raises:
        ValueError: a task, an option of it, or a folder that cannot be used; see `train`.
        Interrupted: a signal ended the run after it was saved.
    """
    trainer = Trainer(args)  # refuses the task or its options before a file changes
    with closing(trainer):
        policy_files = folder.policy_digests(args)
        with folder.opened(args, policy_files) as saved:
            _train(Loop(trainer, policy_files, callback), saved)
            if args.run.match_page and not args.is_on_network:
                _write_match(trainer)
    return args.out / POLICY_FILE


def _train(loop: Loop, saved: Checkpoint | None) -> None:
    """Train until the samples are used up; a signal saves the run and raises `Interrupted`."""
    trainer, args, log_size = loop.trainer, loop.trainer.args, 0
    if saved is None:
        trainer.network().save(args.out / UNTRAINED_FILE)
    else:
        restore(trainer, saved)
        log_size = saved.info["log_size"]
    with StopSignal() as stop:
        try:
            loop.run(stop, log_size)
        except Stopped:
            sys.stderr.write(
                f"{stop.name}: saved after {trainer.samples:,} of {args.samples:,} samples in "
                f"{args.out}; continue with --resume\n"
            )
            raise Interrupted(stop.exit_status) from None


def _write_match(trainer: Trainer) -> None:
    """Play a match of the trained policy, and write its replay and its page."""
    args, network = trainer.args, trainer.network()
    task = trained_on(network)  # without options for training alone
    assert task is not None, "the network names its task"
    names = ("TRAINED", " ".join(opponents_of(task)).upper())
    controllers = lineup(task, network)
    replay = record_replay(
        task,
        controllers,
        args.seed,
        MATCH_SECONDS,
        names=names,
        simulator=args.simulator,
        sensing=args.sensing,
        randomization=args.randomization,
    )
    replay_name, page_name = MATCH_FILES
    replay.save(args.out / replay_name)
    replay.save_html(args.out / page_name)
