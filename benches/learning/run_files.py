"""Files of a study: the result of each finished run, and the folders of unfinished runs."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from benches.learning.experiments import Run
from benches.result_files import RESULTS, ROOT
from rsoccer.files import write_atomically

POLICY: Final = "policy.safetensors"
DIGEST_DIGITS: Final = 12
LOST_STARTS: Final = "lost_starts.json"
"""Result of `running.lost_starts`, beside the runs."""
TOURNAMENT: Final = "tournament.json"
"""Result of `running.trained_tournament`, beside the runs."""
TOURNAMENT_PICTURE: Final = ROOT / "docs" / "learning_tournament.png"
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
