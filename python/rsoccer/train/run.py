"""A training run: its folder, its end by a signal, and the match of its policy."""

from __future__ import annotations

import json
import sys
from pathlib import Path

from rsoccer.files import write_atomically
from rsoccer.lineup import lineup, opponents_of
from rsoccer.replay.recorder import record_replay
from rsoccer.train import checkpoint
from rsoccer.train.args import SETTINGS_FILE, Args
from rsoccer.train.checkpoint import Checkpoint
from rsoccer.train.run_state import restore
from rsoccer.train.stop_signal import Interrupted, Stopped, StopSignal
from rsoccer.train.trainer import POLICY_FILE, Trainer

MATCH = "match"
"""Name, without a suffix, of the files of a match in a run's folder."""
MATCH_SECONDS = 30.0
"""Duration of that match, s."""
UNTRAINED_FILE = "untrained.safetensors"
"""Name of the policy from before the first update in a run's folder."""


def run(args: Args) -> Path:
    """Start or resume a run and save its policy: the implementation of `rsoccer.train.train`.

    Args:
        args: settings of the run.

    Returns:
        Path of the policy file.

    Raises:
        ValueError: a task, an option of it, or a folder that cannot be used; see `train`.
        Interrupted: a signal ended the run after it was saved.
    """
    trainer, log_size = Trainer(args), 0  # refuses the task or its options before a file changes
    saved = _open_run(args)
    if saved is None:
        trainer.network().save(args.out / UNTRAINED_FILE)
    else:
        restore(trainer, saved)
        log_size = saved.info["log_size"]
    with StopSignal() as stop:
        try:
            trainer.run(stop, log_size)
        except Stopped:
            sys.stderr.write(
                f"{stop.name}: saved after {trainer.samples:,} of {args.samples:,} samples in "
                f"{args.out}; continue with --resume\n"
            )
            raise Interrupted(stop.exit_status) from None
    if args.match_page:
        _write_match(trainer)
    return args.out / POLICY_FILE


def _write_match(trainer: Trainer) -> None:
    """Play a match of the trained policy, and write its replay and its page."""
    args, task = trainer.args, trainer.task
    names = ("TRAINED", " ".join(opponents_of(task)).upper())
    controllers = lineup(task, trainer.network())
    replay = record_replay(task, controllers, args.seed, MATCH_SECONDS, names=names)
    replay.save(args.out / f"{MATCH}.rsr")
    replay.save_html(args.out / f"{MATCH}.html")


def _open_run(args: Args) -> Checkpoint | None:
    """Check and prepare the folder of a run; the checkpoint to continue from, if any."""
    path = args.out / checkpoint.FILE_NAME
    saved = checkpoint.load(path) if args.resume else None
    if saved is not None and (changed := args.differences(saved.info["args"])):
        raise ValueError(f"{path} is of a run with other settings: {'; '.join(changed)}")
    checkpoint.prepare_folder(args.out)
    if path.exists() and not (args.resume or args.overwrite):
        raise ValueError(f"out: {args.out} holds a run; set resume, overwrite, or another folder")
    settings = json.dumps(args.to_json(), indent=2)
    write_atomically(args.out / SETTINGS_FILE, settings.encode())
    return saved
