"""Trained policies in the package: `best` plays the one of the task.

The files of this folder are policy files, networks (`rsoccer.policies.policy_file`) or tactics of
scripts (`rsoccer.policies.evolved`), one for each task that has one,
`<task>.safetensors`. Some tasks have a second one, `<task>.robust.safetensors`, for late
and noisy senses and varied numbers: `best:robust` plays it. Their metadata say
how they were made and what they score. `tools.ship_policy` writes them.
"""

from __future__ import annotations

from pathlib import Path
from typing import Final

from rsoccer.policies import policy_file, training_conditions
from rsoccer.policies.base import Policy
from rsoccer.policies.evolved import Evolved, is_tactics
from rsoccer.policies.lookahead import Lookahead
from rsoccer.policies.network import MODES, Network
from rsoccer.policies.other_task import fitted
from rsoccer.policies.policy_file import LOOKAHEAD, Score
from rsoccer.registry import nearest_name, task_with_options
from rsoccer.task import Task

BEST: Final = "best"
"""Name of the trained policy of the task that is played."""
ROBUST: Final = "robust"
"""Word after the colon for the policy for late and noisy senses."""
OPPONENTS: Final = "opponents"
"""Word in the names of files for tasks that have opponents by an option, `n_opponents`: `best`
plays these tasks with them."""
TEAM_TASK: Final = "VSSMulti-v0"
"""Task whose policy also plays tasks without a file of their own that have its observations.

These are tasks derived from `VSSSelfPlay-v0`, in which whole teams play.
"""
SKILLS: Final = {"VSSMatch-v0": ("VSSSelfPlay-v0", "VSSMulti-v0", "VSS-v0")}
"""Tasks that the policies of other tasks play, see `rsoccer.policies.other_task`; `best` is that of
the first.

Trainings of 5 to 8 million samples in matches that began with it made it worse
(docs/learning-tried.md); the shield of its file is what it needs there.
"""
FOLDER = Path(__file__).parent
"""Folder of the files."""


def file_name(task: str, variant: str | None = None) -> str:
    """Return the name of a file in `FOLDER`.

    Args:
        task: name of the task.
        variant: "robust" or "opponents"; None for the policy that knows the true state.
    """
    return f"{task}{_ending(variant)}"


def list_trained(variant: str | None = None) -> dict[str, Path]:
    """Return the files by the task that they were made for, in alphabetical order.

    Args:
        variant: "robust" for those for late and noisy senses, "opponents" for those against
            opponents that a task has by an option; None for those that know the true state.
    """
    ending = _ending(variant)
    found = {path.name.removesuffix(ending): path for path in sorted(FOLDER.glob(f"*{ending}"))}
    return {task: path for task, path in found.items() if "." not in task}


def load_best(task: Task, detail: str | None = None) -> Network | Evolved:
    """Load the trained policy of a task.

    Args:
        task: the task that is played.
        detail: "robust" for the policy for late and noisy senses, "sample" or "mean" for a mode, or
            both, as in "robust:mean"; None is the policy that knows the true state, as in
            training.

    Returns:
        The policy of the task's own file, of that of its skills in `SKILLS`, or of `TEAM_TASK`
        where its observations are equal.

    Raises:
        ValueError: no policy for this task, one that does not fit its options, or an unknown
            variant or mode.
    """
    variant, mode = _variant_and_mode(detail)
    name, path = _best_file(task, variant)
    return _loaded(name, path, mode, task)


def make_best(task: Task, detail: str | None = None) -> Policy:
    """Return the trained policy of a task, with a lookahead if the detail says so.

    Args:
        task: the task that is played.
        detail: as for `load_best`, or "lookahead" or "robust:lookahead".

    Raises:
        ValueError: see `load_best`, or a policy that cannot play with a lookahead.
    """
    variant, mode = _variant_and_mode(detail)
    if mode != LOOKAHEAD:
        return load_best(task, detail)
    name, path = _best_file(task, variant)
    return load_lookahead(name, path, task)


def load_lookahead(name: str, path: Path, task: Task | None) -> Lookahead:
    """Load the network of a file, to play it with a lookahead.

    Args:
        name: what the user called the policy.
        path: the file.
        task: the task that is played; None for that of the training.

    Returns:
        The network with a lookahead.

    Raises:
        FileNotFoundError: no such file.
        ValueError: a file without a network, or one that cannot play with a lookahead.
    """
    try:
        if path.exists() and _has_tactics(path):
            raise ValueError(f"{LOOKAHEAD}: expected a network, but {path.name} has tactics")
        network = Network.load(path)
        own = task_with_options(network.task_name, network.task_options) if task is None else task
        return Lookahead(network, own)
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from error


def _best_file(task: Task, variant: str | None) -> tuple[str, Path]:
    """Name and file of the trained policy of a task."""
    name = BEST if variant is None else f"{BEST}:{variant}"
    known_as = nearest_name(task)
    if variant is None and hasattr(task, "n_opponents") and task.n_opponents:
        against = list_trained(OPPONENTS).get(known_as)
        if against is not None:
            return name, against
    files = list_trained(variant)
    source = known_as if known_as in files else next(iter(SKILLS.get(known_as, ())), None)
    if source in files:
        return name, files[source]
    names = list(files)
    if TEAM_TASK in files:
        layout = policy_file.read_file(files[TEAM_TASK])[1].get("layout")
        if layout == task.layout.text:
            return name, files[TEAM_TASK]
        names[names.index(TEAM_TASK)] += " (and tasks with its observations)"
    kind = "a trained" if variant is None else f"a {variant}"
    raise ValueError(
        f"{name}: expected a task with {kind} policy, got {task.name}; "
        f"there are policies for {', '.join(names) or 'no task'}"
    )


def _loaded(name: str, path: Path, mode: str | None, task: Task) -> Network | Evolved:
    """The policy of a file, which fits a task."""
    try:
        policy = load_file(path, mode, task)
        policy.check_fits(task, task.layout.size)
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from error
    return policy


def load_best_network(task: Task, detail: str | None = None) -> Network:
    """Return the trained policy of a task that is a network.

    Args:
        task: the task that is played.
        detail: as for `load_best`.

    Raises:
        ValueError: see `load_best`, or a policy that is no network.
    """
    policy = load_best(task, detail)
    if not isinstance(policy, Network):
        raise ValueError(f"{BEST}: expected a network for {task.name}, got tactics of a script")
    return policy


def load_file(path: Path, mode: str | None = None, task: Task | None = None) -> Network | Evolved:
    """Load a policy file of either kind.

    Args:
        path: the file.
        mode: "sample" or "mean"; None is as in training, and all that tactics have.
        task: the task that is played; None for that of the training.

    Returns:
        The policy; a network for a task in `SKILLS` has the form that plays it.

    Raises:
        FileNotFoundError: no such file.
        ValueError: the file is not a usable policy file, or mode or task do not fit it.
    """
    if not path.exists():
        raise FileNotFoundError(f"policy: the file {path} does not exist")
    if _has_tactics(path):
        if mode is not None:
            raise ValueError(f"mode: expected none, as {path.name} has tactics, got {mode!r}")
        return Evolved.load(path, task)
    network = Network.load(path, mode)
    return network if task is None else with_skills(network, task)


def _has_tactics(path: Path) -> bool:
    """Whether a file has tactics; their own reader reports errors of other files."""
    try:
        return is_tactics(policy_file.read_file(path)[1])
    except ValueError:
        return False


def with_skills(network: Network, task: Task) -> Network:
    """Return a policy for a task that it was trained on, or has the skills for.

    Args:
        network: the policy.
        task: the task that is played.

    Returns:
        The policy itself; for a task in `SKILLS` that its own task has the skills for, the one with
        its weights.

    Raises:
        ValueError: a policy with other observations than those of its task.
    """
    has_skills = network.task_name in SKILLS.get(nearest_name(task), ())
    return fitted(network, task) if has_skills else network


def _ending(variant: str | None) -> str:
    """End of the names of the files of a variant."""
    return policy_file.SUFFIX if variant is None else f".{variant}{policy_file.SUFFIX}"


def _variant_and_mode(detail: str | None) -> tuple[str | None, str | None]:
    """Variant and mode that follow the name; None for the usual ones."""
    if detail is None:
        return None, None
    first, colon, rest = detail.partition(":")
    variant, mode = (ROBUST, rest if colon else None) if first == ROBUST else (None, detail)
    if mode not in (None, *MODES, LOOKAHEAD):
        expected = (*MODES, LOOKAHEAD, *(() if variant else (ROBUST,)))
        raise ValueError(f"{BEST}: expected one of {expected} after the colon, got {mode!r}")
    return variant, mode


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
