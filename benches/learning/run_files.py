"""Files of a study: the result of each finished run, and the folders of unfinished runs."""

from __future__ import annotations

import fcntl
import hashlib
import json
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any, Final

from benches.learning.experiments import Run
from benches.result_files import RESULTS, ROOT
from rsoccer.files import write_atomically

POLICY: Final = "policy.safetensors"
IDENTITY_FILE: Final = "identity.json"
LEARNED_FILE: Final = "learned"
"""Empty file in the folder of a run whose learning has ended."""
DIGEST_DIGITS: Final = 12
LOCK_SECONDS: Final = 1.0
IDENTITY: Final = ("settings", "physics", "needs")
"""Fields of a result that decide what a run learns."""
FIELDS: Final = {
    *("run", "task", "algorithm", "settings", "physics", "needs", "protocol", "machine"),
    *("samples", "seconds", "evaluation_seconds", "curve", "evaluations"),
}
"""Fields that every result has; `worker.execute` writes them."""


@dataclass(frozen=True)
class Folders:
    """Folders of a study."""

    results: Path = RESULTS / "learning"
    """Committed: one small file per finished run, in `runs`."""
    work: Path = ROOT / "out" / "learning"
    """Not committed: checkpoints, logs and policies."""

    def result(self, key: str) -> Path:
        """Return the path of a run's result."""
        return self.results / "runs" / f"{key}.json"

    def workplace(self, key: str) -> Path:
        """Return the folder of a run's checkpoint, log and policy."""
        return self.work / key

    def policy(self, key: str) -> Path:
        """Return the path of a run's policy."""
        return self.workplace(key) / POLICY


def load(folders: Folders, key: str) -> dict[str, Any] | None:
    """Return the result of a run; None if it has not finished.

    Raises:
        ValueError: The file is damaged.
    """
    path = folders.result(key)
    if not path.is_file():
        return None
    try:
        result = json.loads(path.read_text())
    except ValueError as error:
        raise ValueError(f"{path} is damaged: {error}") from error
    if not isinstance(result, dict) or (missing := sorted(FIELDS - set(result))):
        lacks = "no JSON object" if not isinstance(result, dict) else f"without {missing}"
        raise ValueError(f"{path} is damaged: {lacks}")
    return result


def save(folders: Folders, key: str, result: dict[str, Any]) -> Path:
    """Write the result of a finished run in one step, and return its path."""
    path = folders.result(key)
    path.parent.mkdir(parents=True, exist_ok=True)
    write_atomically(path, (_json(result) + "\n").encode())
    return path


def _json(value: dict[str, Any]) -> str:
    """JSON with a line for each entry of the first two levels: short files, readable changes."""
    lines = []
    for name, part in value.items():
        if isinstance(part, dict) and part:
            inner = ",\n".join(f"  {json.dumps(k)}: {json.dumps(v)}" for k, v in part.items())
            text = f"{{\n{inner}\n }}"
        elif isinstance(part, list) and part:
            text = "[\n" + ",\n".join(f"  {json.dumps(item)}" for item in part) + "\n ]"
        else:
            text = json.dumps(part)
        lines.append(f" {json.dumps(name)}: {text}")
    return "{\n" + ",\n".join(lines) + "\n}"


def needs(folders: Folders, run: Run) -> dict[str, str]:
    """Return digests of what decided the results that a run needs, by key.

    Without such a result the digest is empty.
    """
    found = {need.key: load(folders, need.key) for need in run.needs}
    return {key: "" if result is None else digest(result) for key, result in found.items()}


def digest(result: Mapping[str, Any]) -> str:
    """Return a digest of the settings and the physics of a result, 12 hexadecimal digits."""
    text = json.dumps([result["settings"], result["physics"]], sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:DIGEST_DIGITS]


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
