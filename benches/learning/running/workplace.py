"""Folder of a run while it is worked on: whose files it has, its lock, its policy."""

from __future__ import annotations

import fcntl
import json
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any, Final

from benches.learning.experiments import Run
from benches.learning.run_files import Folders, load
from rsoccer.files import write_atomically

IDENTITY_FILE: Final = "identity.json"
LEARNED_FILE: Final = "learned"
"""Empty file in the folder of a run whose learning has ended."""
LOCK_SECONDS: Final = 1.0
IDENTITY: Final = ("settings", "physics", "needs")
"""Fields of a result that decide what a run learns."""


def is_same(folder: Path, identity: Mapping[str, Any]) -> bool:
    """Return whether the files in a run's folder are of a run with the same identity.

    Args:
        folder: Folder of the run.
        identity: All that decides the result, as JSON values.
    """
    path = folder / IDENTITY_FILE
    return path.is_file() and json.loads(path.read_text()) == json.loads(json.dumps(identity))


def set_identity(folder: Path, identity: Mapping[str, Any]) -> None:
    """Write what decides the result of the run whose files the folder will hold."""
    write_atomically(folder / IDENTITY_FILE, (json.dumps(identity) + "\n").encode())


def keeps_policy(folders: Folders, key: str) -> bool:
    """Return whether the work folder has the policy of a finished run, not one under way.

    Args:
        folders: Folders of the study.
        key: Key of the run.
    """
    result, folder = load(folders, key), folders.workplace(key)
    if result is None or not (folder / LEARNED_FILE).is_file():
        return False
    return is_same(folder, {name: result[name] for name in IDENTITY})


@contextmanager
def lock(folders: Folders, key: str) -> Iterator[bool]:
    """Hold the lock of a run, which the system releases if the process dies.

    `is_running` holds it for a moment, so this tries for `LOCK_SECONDS`.

    Yields:
        True if the lock is held; False if another process has it.
    """
    folders.workplace(key).mkdir(parents=True, exist_ok=True)
    with _lock_file(folders, key).open("w") as file:
        deadline = time.monotonic() + LOCK_SECONDS
        held = _try_lock(file)
        while not held and time.monotonic() < deadline:
            time.sleep(LOCK_SECONDS / 20)
            held = _try_lock(file)
        yield held


def is_running(folders: Folders, key: str) -> bool:
    """Return whether a process holds the lock of a run."""
    path = _lock_file(folders, key)
    if not path.exists():
        return False
    with path.open() as file:
        return not _try_lock(file)


def _lock_file(folders: Folders, key: str) -> Path:
    return folders.workplace(key) / "lock"


def _try_lock(file: IO[str]) -> bool:
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True


def reference(folders: Folders, name: str, run: Run) -> Path:
    """Return the policy of another experiment, "@group/name", with the seed of a run.

    Raises:
        ValueError: It is not in the work folder.
    """
    key = f"{name.removeprefix('@')}/seed-{run.seed}"
    if not keeps_policy(folders, key):
        raise ValueError(
            f"{run.key} needs the policy of {key} in {folders.work}, got none of a finished run; "
            f"`python -m benches.learning --again --only {key}` learns it"
        )
    return folders.policy(key)
