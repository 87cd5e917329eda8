"""Finished runs that have learned nothing, for tests."""

from pathlib import Path
from typing import Any

from benches.learning.run_files import FIELDS, Folders, save
from benches.learning.running.workplace import LEARNED_FILE, set_identity


def finish(folders: Folders, key: str) -> Path:
    """Write the files of a finished run, and return the path of its empty policy."""
    identity: dict[str, Any] = {"settings": {}, "physics": 1, "needs": {}}
    save(folders, key, dict.fromkeys(FIELDS) | identity | {"run": key})
    path = folders.policy(key)
    path.parent.mkdir(parents=True, exist_ok=True)
    set_identity(path.parent, identity)
    (path.parent / LEARNED_FILE).touch()
    path.touch()
    return path
