"""Folder of a run: one process at a time, and what a new or a resumed run may find in it."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any

from rsoccer.files import write_atomically
from rsoccer.policies import file_of
from rsoccer.train.args import SETTINGS_FILE, Args
from rsoccer.train.run import checkpoint
from rsoccer.train.run.checkpoint import Checkpoint
from rsoccer.train.run.log import FILE_NAME as LOG_FILE

try:
    import fcntl
except ImportError:  # Windows: nothing keeps a second process out of the folder
    fcntl = None  # type: ignore[assignment]

POLICY_FILE = "policy.safetensors"
"""Name of the policy."""
MATCH_FILES = ("match.rsr", "match.html")
"""Names of the replay and the page of a match at the end of the run."""
LOCK_FILE = "run.lock"
"""Name of the file that a process locks while it trains."""


@contextmanager
def opened(args: Args, policy_files: dict[str, str]) -> Iterator[Checkpoint | None]:
    """Check and prepare the folder of a run, and keep other processes out of it.

    Args:
        args: settings of the run.
        policy_files: digests of the policies that play beside the learners, from `policy_digests`.

    Yields:
        The checkpoint to continue from; None for a new run.

    Raises:
        ValueError: no checkpoint to resume, one of other settings or policies, a folder that holds
            a run, that another process trains in, or that cannot be written.
    """
    path = args.out / checkpoint.FILE_NAME
    if args.resume:
        checkpoint.load(path)  # before the folder changes
    checkpoint.prepare_folder(args.out)
    with (args.out / LOCK_FILE).open("w") as lock:
        if not _try_lock(lock):
            raise ValueError(f"out: another process trains in {args.out}")
        saved = checkpoint.load(path) if args.resume else None
        if saved is not None:
            _check_same(args, policy_files, path, saved.info)
        elif not args.overwrite:
            _check_empty(args.out)
        else:
            for name in MATCH_FILES:  # they would show the policy of another run
                (args.out / name).unlink(missing_ok=True)
        settings = json.dumps(args.to_json(), indent=2)
        write_atomically(args.out / SETTINGS_FILE, settings.encode())
        yield saved


def policy_digests(args: Args) -> dict[str, str]:
    """Return the SHA-256 digests of the policy files that a run names, by their names.

    Args:
        args: settings of the run.
    """
    players = args.make_task().default_controllers().values()
    own = (player for player in players if isinstance(player, str))
    names = {*args.opponents.fixed, *own}
    files = {name: file_of(name) for name in sorted(names)}
    return {
        name: hashlib.sha256(path.read_bytes()).hexdigest()
        for name, path in files.items()
        if path is not None
    }


def _check_same(args: Args, policy_files: dict[str, str], path: Path, info: dict[str, Any]) -> None:
    """Raise ValueError unless a checkpoint is of the same settings and policies."""
    if changed := args.differences(info["args"]):
        raise ValueError(f"{path} is of a run with other settings: {'; '.join(changed)}")
    before = info.get("policy_files", policy_files)
    if changed := [name for name, digest in policy_files.items() if before.get(name) != digest]:
        raise ValueError(
            f"{path} is of a run with other policies: the content of {', '.join(changed)} has "
            "changed since it began"
        )


def _check_empty(folder: Path) -> None:
    """Raise ValueError if a folder has files of a run, even of one without a checkpoint."""
    names = (checkpoint.FILE_NAME, POLICY_FILE, SETTINGS_FILE, LOG_FILE)
    if found := [name for name in names if (folder / name).exists()]:
        raise ValueError(
            f"out: {folder} holds a run ({', '.join(found)}); set resume, overwrite, or another "
            "folder"
        )


def _try_lock(file: IO[str]) -> bool:
    """Lock a file until it is closed; False if another process has locked it."""
    if fcntl is None:
        return True
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True
