"""Policies, and their construction from names and files.

`zero`, `uniform` and `ou` ignore the game, `best` is trained, the other names are scripts:

| name | league | behavior |
| --- | --- | --- |
| `best` | any | the trained policy of the task, where the package has one |
| `best:robust` | any | the one for late and noisy senses, on some tasks |
| `best:lookahead` | VSSS | `best`, which tries actions in a model, on some tasks |
| `zero` | any | stands still |
| `uniform` | any | independent uniform random actions |
| `ou` | any | actions of an Ornstein-Uhlenbeck process |
| `chase` | VSSS | the robot nearest to the ball drives it at the goal |
| `scripted` | VSSS | keeper, attacker and support; a skill may follow, as in `scripted:0.5` |
| `fetch` | SSL | takes the ball into the mouth |
| `hold` | SSL | stands with the dribbler on |
| `receive` | SSL | stands with the dribbler on and faces the ball |
| `keep` | SSL | keeps the ball from the other team by passes |
| `take` | SSL | takes the ball, and blocks passes; a skill may follow, as in `take:0.5` |
| `passer` | SSL | passes to its teammate and receives passes |
| `strike` | SSL | wins the ball, and shoots past the opponents |
| `weave` | SSL | dribbles through the gates of the dribbling task |

"module:name" is code of one's own: a policy, its class, or a function of the task that makes one.
"""

from __future__ import annotations

import os
from pathlib import Path

from rsoccer.policies import names
from rsoccer.policies.base import Policy, PolicyInput, require_observes
from rsoccer.policies.names import list_policies, list_policies_with_skill, register_policy
from rsoccer.policies.own_code import is_module_text, make_from_module
from rsoccer.policies.policy_file import LOOKAHEAD, ONNX_SUFFIX, SUFFIX, SUFFIXES
from rsoccer.registry import as_task, make_task
from rsoccer.task import Task

__all__ = ["Policy", "PolicyInput", "list_policies", "list_policies_with_skill"]
__all__ += ["PolicyLike", "check_policy_like", "file_of", "is_module_text", "is_registered"]
__all__ += ["make_policy", "name_of", "register_policy", "trained_on"]

PolicyLike = str | os.PathLike[str] | Policy
"""A policy, its name (`zero`, `ou`, ...), the path of its file, or "module:name" of code."""


def check_policy_like(name: str, value: object) -> None:
    """Check the type of an argument; an unknown name or path passes.

    Args:
        name: name of the argument, for the error message.
        value: the argument.

    Raises:
        TypeError: not a `PolicyLike`.
    """
    if not isinstance(value, str | os.PathLike | Policy):
        raise TypeError(f"{name}: expected a policy, its name or its file, got {value!r}")


def is_registered(policy: PolicyLike) -> bool:
    """Return whether a policy is given by a name that stands for it, with or without a skill.

    Args:
        policy: a policy, its name, or the path of a policy file.

    Raises:
        ImportError: a package that offers the policy cannot be loaded.
    """
    if isinstance(policy, Policy):
        return False
    return names.find(_text(policy).partition(":")[0]) is not None


def make_policy(policy: PolicyLike, task: Task | str) -> Policy:
    """Make a policy for the robots of a task.

    Args:
        policy: a policy, which is returned as it is; a name; the path of a policy file or of an
            ONNX file; or "module:name" of a policy, its class, or a function of the task that makes
            one.
            "best" is the trained policy of the task, see `rsoccer.policies.trained`.
            "best:robust" is the one for late and noisy senses. "scripted:0.5"
            sets a skill. "policy.safetensors:mean", "best:sample" and "best:robust:mean" choose
            how a network acts; the default is as in training. "best:lookahead" tries actions in a
            model of the match, see `rsoccer.policies.lookahead`.
        task: the task that is played, or its name.

    Returns:
        A policy that fits the task.

    Raises:
        FileNotFoundError: no such policy file.
        ImportError: a package that offers the policy cannot be loaded, see `rsoccer.plugins`; a
            module that a text names does not exist or lacks the name.
        RuntimeError: the maker of a policy of a user raises an error other than ValueError.
        TypeError: not a `PolicyLike`.
        ValueError: an unknown name, a wrong skill or mode, or a policy that does not fit the task
            or does not say what it observes.

    Example:
        >>> import rsoccer
        >>> from rsoccer import policies
        >>> policy = policies.make_policy("scripted:0.5", rsoccer.make_task("VSSSelfPlay-v0"))
    """
    task = as_task(task)
    if not isinstance(policy, Policy):
        text = _text(policy)
        name, colon, detail = text.partition(":")
        if is_module_text(text):
            policy = make_from_module(text, task)
        elif not is_registered(text):
            policy = _load(text, task)
        elif name == "best":
            policy = _make_best(task, detail if colon else None)
        else:
            policy = names.make(name, task, detail if colon else None)
    require_observes(policy)
    policy.check_fits(task, task.layout.size)
    return policy


def trained_on(policy: PolicyLike) -> Task | None:
    """Return the task that a policy was trained on, without options that matter in training alone.

    It is None for scripts, noise and code ("module:name"), and for `best`, which has a policy for
    each of several tasks.

    Args:
        policy: a policy, its name, or the path of its file.

    Raises:
        FileNotFoundError: no such policy file.
        TypeError: not a `PolicyLike`.
        ValueError: an unknown name, or a task or an option of it that does not exist.
    """
    if is_registered(policy):
        return None
    if not isinstance(policy, Policy):
        if is_module_text(_text(policy)):
            return None
        policy = _load(_text(policy))
    if policy.task_name is None:
        return None
    task = make_task(policy.task_name)
    options = {
        name: value
        for name, value in policy.task_options.items()
        if name not in task.training_options
    }
    try:
        task = make_task(policy.task_name, **options)
    except TypeError as error:
        raise ValueError(f"policy: trained on a task with other options: {error}") from error
    _check_companions(task)
    return task


def _check_companions(task: Task) -> None:
    """Refuse policies of a task of a policy file that are missing, or that are code."""
    for player in task.default_controllers().values():
        if not isinstance(player, str):
            continue
        if is_module_text(player):  # a file must not decide what runs
            raise ValueError(
                f"policy: trained beside the code {player}; name a task for it to play"
            )
        path = file_of(player)
        if path is not None and not path.exists():
            raise ValueError(
                f"policy: trained beside the policy {player}, which does not exist here; name a "
                "task for it to play"
            )


def name_of(policy: PolicyLike) -> str:
    """Return a policy's name for tables: its name or path, or its class for an object.

    Args:
        policy: a policy, its name, or the path of its file.
    """
    return type(policy).__name__ if isinstance(policy, Policy) else _text(policy)


def _text(policy: str | os.PathLike[str]) -> str:
    """A name or a path as text."""
    check_policy_like("policy", policy)
    return os.fspath(policy)


def _make_best(task: Task, detail: str | None) -> Policy:
    """The trained policy of a task."""
    from rsoccer.policies.trained import make_best

    return make_best(task, detail)


def file_of(policy: str) -> Path | None:
    """Return the file that a name stands for; None for a policy that is registered, and for code.

    Args:
        policy: a name, "module:name", or the path of a file, which a mode may follow.
    """
    if is_registered(policy) or is_module_text(policy):
        return None
    return Path(_split_mode(policy)[0])


def _load(text: str, task: Task | None = None) -> Policy:
    """A trained policy from its path, which a mode may follow."""
    path, mode = _split_mode(text)
    if not (path.endswith(SUFFIXES) or os.path.isfile(path)):
        raise ValueError(f"unknown policy {text!r}: {_expected(path)}")
    # Scripts do not need the formats of files.
    if path.endswith(ONNX_SUFFIX):
        from rsoccer.policies.onnx_policy import OnnxPolicy

        return OnnxPolicy.load(path, mode, task)
    from rsoccer.policies.trained import load_file, load_lookahead

    if mode == LOOKAHEAD:
        return load_lookahead(path, Path(path), task)
    return load_file(Path(path), mode, task)


def _expected(path: str) -> str:
    """Words that name a policy; for a folder with a policy file, that file."""
    inside = Path(path) / f"policy{SUFFIX}"  # of a training run
    if inside.is_file():
        return f"it is a folder; the policy file in it is {inside}"
    return (
        f"expected one of {list_policies()}, the path of a policy file (*{SUFFIX}, "
        f"*{ONNX_SUFFIX}), or MODULE:NAME of your own code; a policy of your own has a name after "
        "the import of the module that registers it, as with --import MODULE"
    )


def _split_mode(text: str) -> tuple[str, str | None]:
    """Path and mode of a policy file; a colon may also be part of the path."""
    from rsoccer.policies.network import MODES

    path, colon, mode = text.rpartition(":")
    if not colon or os.path.exists(text) or text.endswith(SUFFIXES):
        return text, None
    known = mode in (*MODES, LOOKAHEAD) or path.endswith(SUFFIXES)
    return (path, mode) if known else (text, None)
