"""Scripts with tactics that were learned, and the file that has them.

`rsoccer evolve` writes a safetensors file with one array:

| array | shape | dtype | content |
| --- | --- | --- | --- |
| `tactics` | (tactics,) | float32 | numbers in the order of the script's `TACTICS` |

The metadata are text:

| key | value | meaning |
| --- | --- | --- |
| `format` | `rsoccer-tactics-1` | version of this format |
| `script` | a name in `SCRIPTS` | the script that plays |
| `names` | names, parted by blanks | names of the numbers; they must be those of the script |
| `task` | a task's name | task of the training, for `make_task` |
| `task_options` | JSON object; optional | options of `make_task` that the training set |
| `sensing` | JSON of a `Sensing`; optional | what robots knew in the training |
| `training` | JSON object; optional | how it was made, as in `rsoccer.policies.policy_file` |
| `scores` | JSON list; optional | results, as in `rsoccer.policies.policy_file` |
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Self

from numpy.typing import ArrayLike

from rsoccer.arrays import Floats
from rsoccer.files import as_path
from rsoccer.policies import policy_file, training_conditions
from rsoccer.policies.base import Memory, Policy, PolicyInput
from rsoccer.policies.ssl.keep import Keep
from rsoccer.policies.ssl.team import ScriptedSsl
from rsoccer.policies.tactics import TacticalPolicy, checked
from rsoccer.registry import task_with_options
from rsoccer.rng import WorldRng
from rsoccer.task import Task

if TYPE_CHECKING:
    from rsoccer._core import Sensing
    from rsoccer.randomization import Ranges
    from rsoccer.sources import SensingSource

FORMAT: Final = policy_file.TACTICS_FORMAT
"""Version of the format."""
SCRIPTS: Final[Mapping[str, type[TacticalPolicy]]] = {"keep": Keep, "scripted": ScriptedSsl}
"""Scripts by the names that they have as policies."""
_ARRAY: Final = "tactics"


class Evolved(Policy):
    """A script with the tactics of a file."""

    def __init__(self, task: Task, tactics: ArrayLike, metadata: Mapping[str, str]) -> None:
        """Prepare the script for a task.

        Args:
            task: the task that is played.
            tactics: (tactics,) numbers by which it plays.
            metadata: text by key, see the table of the module.

        Raises:
            ValueError: a task that the script cannot play, metadata that are not as documented, or
                numbers of another shape or out of their ranges.
        """
        self.metadata = dict(metadata)
        kind = check_metadata(self.metadata)
        self.tactics: Floats = checked(tactics, kind.TACTICS)
        self.script: TacticalPolicy = kind.with_tactics(task, self.tactics)
        self.observes, self.forecasts = self.script.observes, self.script.forecasts

    @classmethod
    def of_training(
        cls,
        script: str,
        task: Task,
        tactics: ArrayLike,
        task_options: Mapping[str, Any],
        sensing: SensingSource | None = None,
        randomization: Ranges | None = None,
    ) -> Self:
        """Return the policy that a training has found.

        Args:
            script: name of the script, one of `SCRIPTS`.
            task: the task of the training.
            tactics: (tactics,) numbers by which it plays.
            task_options: options of the task that the training set.
            sensing: what robots knew in the training.
            randomization: numbers that each episode drew.

        Raises:
            ValueError: see the class.
        """
        metadata = {"format": FORMAT, "script": script, "task": task.name}
        metadata["names"] = names_of(SCRIPTS[script])
        if task_options:
            metadata["task_options"] = json.dumps(dict(task_options), sort_keys=True)
        return cls(task, tactics, metadata | training_conditions.written(sensing, randomization))

    @classmethod
    def load(cls, path: str | os.PathLike[str], task: Task | None = None) -> Self:
        """Return the policy of a file of tactics.

        Args:
            path: the file.
            task: the task that is played; None for that of the training.

        Raises:
            FileNotFoundError: no such file.
            TypeError: no path.
            ValueError: the file is not a usable file of tactics, or the script cannot play the
                task.
        """
        file = as_path("path", path)
        try:
            arrays, metadata = policy_file.read_file(file)
            kind = check_metadata(metadata)
            if set(arrays) != {_ARRAY}:
                raise ValueError(f"expected the array {_ARRAY!r}, got {sorted(arrays)}")
            tactics = checked(arrays[_ARRAY], kind.TACTICS)
            if task is None:
                options = policy_file.read_task_options(metadata)
                task = task_with_options(metadata["task"], options)
        except ValueError as error:
            raise ValueError(f"{os.fspath(path)} is not a usable policy file: {error}") from error
        return cls(task, tactics, metadata)

    @property
    def task_name(self) -> str:
        """Name of the task that it was trained on, for `make_task`."""
        return self.metadata["task"]

    @property
    def task_options(self) -> dict[str, Any]:
        """Options of that task in the training, for `make_task`; {} for the defaults."""
        return policy_file.read_task_options(self.metadata)

    @property
    def sensing(self) -> Sensing | str | None:
        """Senses of the robots in the training, a `Sensing` or "module:name"; None for none."""
        return training_conditions.read_sensing(self.metadata)

    @property
    def randomization(self) -> dict[str, Any]:
        """Numbers that each episode of the training drew, by name; {} for none."""
        return training_conditions.read_randomization(self.metadata)

    def check_fits(self, task: Task, observation_size: int) -> None:
        """Raise ValueError for a task with another field, other robots or other teams."""
        self.script.check_fits(task, observation_size)

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        """Return the memory of the script, see `Policy.new_memory`."""
        return self.script.new_memory(shape, rng)

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Return the actions of the script, (n, robots, action)."""
        return self.script.act(inputs, rng, memory)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the file atomically; equal tactics give equal bytes.

        Args:
            path: the file; an existing one is replaced.

        Raises:
            ImportError: safetensors is not installed.
        """
        policy_file.write_file(Path(path), {_ARRAY: self.tactics}, self.metadata)


def is_tactics(metadata: Mapping[str, str]) -> bool:
    """Return whether metadata are those of a file of tactics, of any version.

    Args:
        metadata: text by key.
    """
    return metadata.get("format", "").startswith("rsoccer-tactics-")


def names_of(script: type[TacticalPolicy]) -> str:
    """Return the names of a script's numbers, parted by blanks.

    Args:
        script: the script.
    """
    return " ".join(tactic.name for tactic in script.TACTICS)


def check_metadata(metadata: Mapping[str, str]) -> type[TacticalPolicy]:
    """Check the metadata of a file.

    Args:
        metadata: text by key, see the table of the module.

    Returns:
        The script.

    Raises:
        ValueError: a missing or wrong value.
    """
    if metadata.get("format") != FORMAT:
        raise ValueError(f"metadata 'format' should be {FORMAT!r}, got {metadata.get('format')!r}")
    script = SCRIPTS.get(metadata.get("script", ""))
    if script is None:
        raise ValueError(
            f"metadata 'script' should be one of {tuple(SCRIPTS)}, got {metadata.get('script')!r}"
        )
    if metadata.get("names") != names_of(script):
        raise ValueError(
            "metadata 'names' should be those of the script, which has changed since, "
            f"got {metadata.get('names')!r}"
        )
    if not metadata.get("task"):
        raise ValueError("metadata 'task' should name the task of the training, got nothing")
    policy_file.read_task_options(metadata)
    policy_file.read_scores(metadata)
    training_conditions.describe(metadata)
    return script
