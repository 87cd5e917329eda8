"""`rsoccer export`: trained policies as ONNX files, and as policy files."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any

from tyro.conf import Positional, arg

from rsoccer import checks, policies
from rsoccer.commands.imports import Imports
from rsoccer.commands.output import check_output, write
from rsoccer.commands.subject import DEFAULT_TASK_HINT, check_policy_names, policy_and_task
from rsoccer.commands.task_options import TASK_OPTIONS
from rsoccer.policies.evolved import Evolved
from rsoccer.policies.labels import labels
from rsoccer.policies.network import Network
from rsoccer.policies.policy_file import LOOKAHEAD, MAX_ACTION_REPEAT, ONNX_SUFFIX, SUFFIX
from rsoccer.task import Task

_OUT_HINT = "(default: a file of the policy's name in the current folder)"


@dataclass(frozen=True)
class Export(Imports):
    """Write a trained policy as an ONNX file that other programs run, or as a policy file."""

    policy: Annotated[str, Positional, arg(metavar="POLICY")]
    """policy to write: best, or the path of a policy file"""
    onnx: bool = False
    """write an ONNX file, with normalization and head, in place of a policy file"""
    out: Annotated[Path | None, arg(metavar="PATH", help_behavior_hint=_OUT_HINT)] = None
    """file to write, *.onnx or *.safetensors"""
    action_repeat: int | None = None
    """control steps for which a decision of the written policy holds; as in the given one by
    default"""
    task: Annotated[str | None, arg(metavar="TASK", help_behavior_hint=DEFAULT_TASK_HINT)] = None
    """task whose policy is meant, for best"""
    task_options: Annotated[Mapping[str, Any], TASK_OPTIONS] = field(default_factory=dict)
    """options of the task that is named (`rsoccer list` prints them), such as n_opponents=2"""

    def run(self) -> None:
        """Write the file, and print its path.

        Raises:
            ValueError: a policy without weights, one that does not fit the task, a number of
                control steps out of range, or a file of another name, in a folder that does not
                exist, or that is the policy's own.
        """
        check_policy_names([self.policy])
        name, task = policy_and_task(None, self.policy, self.task, self.task_options)
        policy = policies.make_policy(name, task)
        if not isinstance(policy, Network) and (self.onnx or not isinstance(policy, Evolved)):
            raise ValueError(_refusal(name, task, policy))
        if self.action_repeat is not None:
            policy = _repeated(name, task, policy, self.action_repeat)
        suffix = ONNX_SUFFIX if self.onnx else SUFFIX
        registered = policies.is_registered(name)
        stem = name.replace(":", "-") + f"-{task.name}" if registered else _stem(name)
        path = Path(stem + suffix) if self.out is None else self.out
        check_output("out", path, suffix)
        source = None if registered else policies.file_of(name)
        if source is not None and path.exists() and path.samefile(source):
            raise ValueError(f"out: expected another file than the policy's own, got {path}")
        if self.onnx and isinstance(policy, Network):
            policy.save_onnx(path)
        else:
            policy.save(path)
        write(f"policy: {path} ({path.stat().st_size / 1024:.1f} KiB)")


def _repeated(name: str, task: Task, policy: policies.Policy, action_repeat: int) -> Network:
    """The same network, which holds each decision for another number of control steps."""
    if not isinstance(policy, Network):
        raise ValueError(
            f"action_repeat: expected a policy with a network, got {name} of {task.name}, a script "
            "with learned tactics, which decides in every control step"
        )
    checks.integer_in_range("action_repeat", action_repeat, 1, MAX_ACTION_REPEAT)
    metadata = policy.metadata | {"action_repeat": str(action_repeat)}
    if action_repeat != policy.action_repeat:
        metadata.pop("scores", None)  # those of the given policy
    return Network(policy.arrays(), metadata, policy.mode)


def _refusal(name: str, task: Task, policy: policies.Policy) -> str:
    """Reason for which a policy cannot be written."""
    if isinstance(policy, Evolved):
        return (
            f"onnx: expected a policy with a network, got {name} of {task.name}, a script with "
            "learned tactics; without --onnx they are written as a policy file"
        )
    if name.endswith(f":{LOOKAHEAD}"):
        return f"policy: expected {name.rpartition(':')[0]!r}, whose network it plays, got {name!r}"
    return (
        f"policy: expected best or a policy file (*{SUFFIX}), got {name}, which has no weights to "
        "write"
    )


def _stem(name: str) -> str:
    """Name of the file of a policy file, without an ending: that of its folder if it is general."""
    label = labels([name])[0]
    return Path(label.partition(SUFFIX)[0].partition(":")[0]).name
