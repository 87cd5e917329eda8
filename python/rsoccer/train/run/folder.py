"""Folder of a run: one process at a time, and what a new or a resumed run may find in it."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any

from rsoccer.files import write_atomically
from rsoccer.policies import file_of
from rsoccer.task import Task
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
    with locked(args.out):
        saved = checkpoint.load(path) if args.resume else None
        if saved is not None:
            _check_same(args, policy_files, path, saved.info)
        elif not args.overwrite:
            check_empty(args.out)
        else:
            for name in MATCH_FILES:  # they would show the policy of another run
                (args.out / name).unlink(missing_ok=True)
        settings = json.dumps(args.to_json(), indent=2)
        write_atomically(args.out / SETTINGS_FILE, settings.encode())
        yield saved


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Make the folder of a run, and keep other processes out of it.

    Args:
        folder: created with its parents if it does not exist.

    Yields:
        Nothing, while this process has the folder.

    Raises:
        ValueError: the folder cannot be written, or another process trains in it.
    """
    checkpoint.prepare_folder(folder)
    with (folder / LOCK_FILE).open("w") as lock:
        if not _try_lock(lock):
            raise ValueError(f"out: another process trains in {folder}")
        yield


def policy_digests(args: Args) -> dict[str, str]:
    """Return the SHA-256 digests of the policy files that a run names, by their names.

    Args:
        args: settings of the run.
    """
    return digests_of(args.make_task(), args.opponents.fixed)


def digests_of(task: Task, policies: Iterable[str]) -> dict[str, str]:
    """Return the SHA-256 digests of policy files, and of those beside the learners, by their names.

    Args:
        task: the task, which may have policies beside the learners.
        policies: names and files of policies; those without a file are left out.
    """
    own = (p for p in task.default_controllers().values() if isinstance(p, str))
    names = {*policies, *own}
    files = {name: file_of(name) for name in sorted(names)}
    return {
        name: hashlib.sha256(path.read_bytes()).hexdigest()
        for name, path in files.items()
        if path is not None
    }


def _check_same(args: Args, policy_files: dict[str, str], path: Path, info: dict[str, Any]) -> None:
    """Raise ValueError unless a checkpoint is of the same settings and policies."""
    if changed := args.differences(info["args"]):
        reason = f"{path} is of a run with other settings: {'; '.join(changed)}"
        if not _has_settings(path.parent):
            reason += f". {SETTINGS_FILE} beside it is missing or damaged: give the run's settings"
        raise ValueError(reason)
    before = info.get("policy_files", policy_files)
    if changed := [name for name, digest in policy_files.items() if before.get(name) != digest]:
        raise ValueError(
            f"{path} is of a run with other policies: the content of {', '.join(changed)} has "
            "changed since it began"
        )


def _has_settings(folder: Path) -> bool:
    """Whether the file of settings in a folder can be read."""
    try:
        return bool(json.loads((folder / SETTINGS_FILE).read_bytes()))
    except (OSError, ValueError):
        return False


def check_empty(folder: Path, settings: str = "resume, overwrite") -> None:
    """Refuse a folder that has files of a run, even of one without a checkpoint.

    Args:
        folder: the folder.
        settings: settings with which a run may have such a folder, for the error.

    Raises:
        ValueError: it has.
    """
    names = (checkpoint.FILE_NAME, POLICY_FILE, SETTINGS_FILE, LOG_FILE)
    if found := [name for name in names if (folder / name).exists()]:
        raise ValueError(
            f"out: {folder} holds a run ({', '.join(found)}); set {settings}, or another folder"
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
