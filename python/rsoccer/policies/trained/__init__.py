"""Trained policies in the package: `best` plays the one of the task.

The files of this folder are policy files (`rsoccer.policies.policy_file`), one for each task that
has one, `<task>.safetensors`. Their metadata say how they were made and what they score.
`tools.ship_policy` writes them.
"""

from __future__ import annotations

from pathlib import Path
from typing import Final

from rsoccer.policies import policy_file, training_conditions
from rsoccer.policies.network import MODES, Network
from rsoccer.policies.policy_file import Score
from rsoccer.task import Task

BEST: Final = "best"
"""Name of the trained policy of the task that is played."""
TEAM_TASK: Final = "VSSMulti-v0"
"""Task whose policy also plays tasks without a file of their own that have its observations.

These are tasks derived from `VSSSelfPlay-v0`, in which whole teams play.
"""
FOLDER = Path(__file__).parent
"""Folder of the files."""


def list_trained() -> dict[str, Path]:
    """Return the files by the task that they were made for, in alphabetical order."""
    return {path.stem: path for path in sorted(FOLDER.glob(f"*{policy_file.SUFFIX}"))}


def load_best(task: Task, mode: str | None = None) -> Network:
    """Load the trained policy of a task.

    Args:
        task: the task that is played.
        mode: "sample" or "mean"; None is as in training.

    Returns:
        The network of the task's own file, or of `TEAM_TASK` where its observations are equal.

    Raises:
        ValueError: no policy for this task, one that does not fit its options, or an unknown mode.
    """
    if mode not in (None, *MODES):
        raise ValueError(f"{BEST}: expected one of {MODES} after the colon, got {mode!r}")
    files = list_trained()
    if task.name in files:
        network = Network.load(files[task.name], mode)
        try:
            network.check_fits(task, task.layout.size)
        except ValueError as error:
            raise ValueError(f"{BEST}: {error}") from error
        return network
    names = list(files)
    if TEAM_TASK in files:
        network = Network.load(files[TEAM_TASK], mode)
        if network.metadata.get("layout") == task.layout.text:
            return network
        names[names.index(TEAM_TASK)] += " (and tasks with its observations)"
    raise ValueError(
        f"{BEST}: expected a task with a trained policy, got {task.name}; "
        f"there are policies for {', '.join(names) or 'no task'}"
    )


def list_scores(path: Path) -> list[Score]:
    """Return the scores in the metadata of a policy file.

    Args:
        path: the file.

    Raises:
        ValueError: the file is not a policy file, or its scores are not as documented.
    """
    return policy_file.read_scores(policy_file.read_file(path)[1])


def describe_training(path: Path) -> str:
    """Return the senses and the varied numbers of the training of a policy file, in a line.

    Args:
        path: the file.

    Returns:
        The line; empty if robots knew the true state and no numbers varied.

    Raises:
        ValueError: the file is not a policy file, or its metadata are not as documented.
    """
    return training_conditions.describe(policy_file.read_file(path)[1])
