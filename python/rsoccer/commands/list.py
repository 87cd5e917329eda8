"""`rsoccer list`: the tasks with their options, and the policies."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from rsoccer import plugins, policies, registry
from rsoccer.commands.imports import Imports
from rsoccer.commands.output import write
from rsoccer.policies import trained
from rsoccer.policies.policy_file import Score


@dataclass(frozen=True)
class List(Imports):
    """Print the tasks with their options, and the policies."""

    def run(self) -> None:
        """Print the lists."""
        for name in registry.list_tasks():
            try:
                write(_description(name))
            except ImportError as error:
                write(f"{error}\n")
        for name, (task_name, options) in registry.list_aliases().items():
            values = [f"{option}={value!r}" for option, value in options.items()]
            write(f"{name}: {', '.join([task_name, *values])}")
        write(f"policies: {', '.join(_usable_policies())}, or the path of a policy file")
        write("best is the trained policy of the task; its mean scores, with 95% intervals:")
        _write_trained(None)
        _write_trained(trained.OPPONENTS)
        write("best:robust is made for late and noisy senses, and scores:")
        _write_trained(trained.ROBUST)
        examples = (f"{name}:0.5" for name in policies.list_policies_with_skill())
        write("best and files play as they were trained; :mean or :sample may follow the name, and")
        write(":lookahead, if they have a value network: then they try actions before they act")
        write(f"a skill from 0 to 1 may follow, as in {', '.join(examples)}")


def _write_trained(variant: str | None) -> None:
    """Print the facts of the trained policies of a variant."""
    suffix = " with n_opponents" if variant == trained.OPPONENTS else ""
    for name, path in trained.list_trained(variant).items():
        write("\n".join(f"    {name}{suffix}: {fact}" for fact in _facts(path)))


def _usable_policies() -> list[str]:
    """Names of policies, without entry points that cannot be loaded, whose errors are printed."""
    names = []
    for name in sorted({*policies.list_policies(), *plugins.list_names(plugins.POLICIES)}):
        try:
            if policies.is_registered(name):
                names.append(name)
        except ImportError as error:
            write(str(error))
    return names


def _facts(path: Path) -> list[str]:
    """Scores of a trained policy, and the senses and varied numbers for which it is made."""
    scores = [_score_text(score) for score in trained.list_scores(path)] or ["not measured"]
    conditions = trained.describe_training(path)
    return [*scores, f"made for matches with {conditions}"] if conditions else scores


def _score_text(score: Score) -> str:
    """A score in one line."""
    opponent = "" if score.opponent == "-" else f" against {score.opponent}"
    senses = f" with sensing {score.sensing}" if score.sensing else ""
    return (
        f"{score.metric} {score.score:.3f} ({score.low:.3f} to {score.high:.3f}){opponent}"
        f"{senses}, {score.matches} matches"
    )


def _description(name: str) -> str:
    """Name and summary of a task, and its options for `make_task`, each with its default."""
    task_class = registry.task_class(name)
    summary = (task_class.__doc__ or "").strip().split("\n")[0]
    try:
        task = registry.make_task(name)
    except TypeError:  # an option has no default
        options = registry.list_options(task_class)
    else:
        names = registry.list_options(task_class)
        options = [f"{option}={getattr(task, option)!r}" for option in names]
    return "\n".join([f"{name}: {summary}", *(f"    {option}" for option in options), ""])
