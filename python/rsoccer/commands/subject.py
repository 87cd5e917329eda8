"""The policy and the task of a command: their options, and what is played without them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from tyro.conf import arg

from rsoccer import policies, registry
from rsoccer.commands.task_options import named_task
from rsoccer.lineup import DEFAULT_TASK, TAKER_SCRIPT, script_of, task_for
from rsoccer.policies import trained
from rsoccer.policies.own_code import short_name
from rsoccer.policies.policy_file import SUFFIX, SUFFIXES
from rsoccer.replay.replay import SUFFIX as REPLAY_SUFFIX
from rsoccer.task import Task

_SUBJECT_HELP = (
    "a policy: a name that `rsoccer list` prints, or the path of a policy file, which plays as it "
    "was trained unless :mean, :sample or :lookahead follows, or module:name of code of your own; "
    "or a task, whose policy --policy names"
)
SUBJECT = arg(metavar="POLICY|TASK", help=_SUBJECT_HELP, help_behavior_hint="")
SUBJECT_OR_REPLAY = arg(
    metavar="POLICY|TASK|REPLAY",
    help=f"{_SUBJECT_HELP}; or a replay (.rsr)",
    help_behavior_hint="(default: best in VSSSelfPlay-v0)",
)
POLICY = arg(
    metavar="POLICY", help_behavior_hint="(default: best, or a script where there is none)"
)
DEFAULT_TASK_HINT = "(default: the one that the policy was trained on, or VSSSelfPlay-v0)"
DEFAULT_OPPONENT_HINT = "(default: the task's own, or ou where that team learns)"


def policy_and_task(
    subject: str | None, policy: str | None, task: str | None, options: Mapping[str, Any]
) -> tuple[str, Task]:
    """Return the policy and the task of a command, whose first word names either.

    Args:
        subject: first word: a policy or a task.
        policy: value of `--policy`.
        task: value of `--task`.
        options: value of `--task-options`.

    Raises:
        ValueError: two policies, two tasks, an unknown task, or options without a task or that it
            refuses.
    """
    if subject is not None and registry.is_task_name(subject) and not Path(subject).exists():
        if task is not None:
            raise ValueError(f"task: expected one task, got {subject} and {task}")
        task = subject
    elif subject is not None:
        if policy is not None:
            raise ValueError(f"policy: expected a task before --policy {policy}, got {subject}")
        policy = subject
    check_policy_names([] if policy is None else [policy])
    made = named_task(task, options)
    if made is None:
        made = registry.make_task(DEFAULT_TASK) if policy is None else task_for(policy)
    return policy or _default_policy(made), made


def check_policy_names(names: Iterable[str | None]) -> None:
    """Refuse words whose ending is that of another file than a policy's.

    Args:
        names: words in the place of policies; None where none is given.

    Raises:
        ValueError: a replay, or a file that is neither a replay nor a policy.
    """
    for name in names:
        ending = "" if name is None else Path(name).suffix
        if name is None or not ending or any(end in name for end in SUFFIXES):
            continue
        if policies.is_registered(name) or policies.is_module_text(name):
            continue
        if ending == REPLAY_SUFFIX:
            raise ValueError(
                f"policy: expected a policy, got the replay {name}: rsoccer watch plays it"
            )
        raise ValueError(
            f"policy: expected the name of a policy or a task, a policy file (*{SUFFIX}, *.onnx), "
            f"module:name of code, or in rsoccer watch a replay (*{REPLAY_SUFFIX}), got {name}"
        )


def _default_policy(task: Task) -> str:
    """The policy that was trained on a task, or a script that plays in the place of one."""
    script = script_of(task)
    if script == TAKER_SCRIPT:  # the policy of keepaway has learned to keep the ball
        return script
    try:
        trained.load_best(task)
    except ValueError:
        return script
    return trained.BEST


def team_name(player: str) -> str:
    """Return the name of a policy on the scoreboard: for a file its folder's name.

    Args:
        player: name of a policy, path of its file, or "module:name" of code.
    """
    if policies.is_registered(player):
        return player.upper()
    if policies.is_module_text(player):
        return short_name(player).upper()
    path = Path(player)
    return (path.parent.name or path.stem if path.suffix else player).upper()
