"""Policies, and their construction from names and files.

`zero`, `uniform` and `ou` ignore the game, `best` is trained, the other names are scripts:

| name | league | behaviour |
| --- | --- | --- |
| `best` | any | the trained policy of the task, where the package has one |
| `zero` | any | stands still |
| `uniform` | any | independent uniform random actions |
| `ou` | any | actions of an Ornstein-Uhlenbeck process |
| `chase` | VSSS | the robot nearest to the ball drives it at the goal |
| `scripted` | VSSS | keeper, attacker and support; a skill may follow, as in `scripted:0.5` |
| `fetch` | SSL | takes the ball into the mouth |
| `hold` | SSL | stands with the dribbler on |
| `receive` | SSL | stands with the dribbler on and faces the ball |
| `passer` | SSL | passes to its teammate and receives passes |
| `strike` | SSL | wins the ball, and shoots past the opponents |
| `weave` | SSL | dribbles through the gates of the dribbling task |
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Final

from rsoccer.policies.base import Policy, PolicyInput
from rsoccer.policies.noise import OrnsteinUhlenbeck, Uniform, Zero
from rsoccer.policies.policy_file import SUFFIX
from rsoccer.policies.ssl.fetch import Fetch
from rsoccer.policies.ssl.hold import Hold, Receive
from rsoccer.policies.ssl.passer import Passer
from rsoccer.policies.ssl.strike import Strike
from rsoccer.policies.ssl.weave import Weave
from rsoccer.policies.vss.chase import Chase
from rsoccer.policies.vss.scripted import Scripted
from rsoccer.registry import make_task
from rsoccer.task import Learn, Task

if TYPE_CHECKING:
    from rsoccer.policies.network import Network

__all__ = ["Policy", "PolicyInput", "list_policies", "list_policies_with_skill"]
__all__ += ["PolicyLike", "check_policy_like", "file_of", "is_built_in", "make_policy", "name_of"]
__all__ += ["trained_on"]

PolicyLike = str | os.PathLike[str] | Policy
"""A policy, its name (`zero`, `ou`, ...), or the path of its file."""

_MAKERS: Final[dict[str, Callable[[Task], Policy]]] = {
    "best": lambda task: _make_best(task, None),
    "chase": Chase,
    "fetch": Fetch,
    "hold": Hold,
    "ou": lambda task: OrnsteinUhlenbeck(),
    "passer": Passer,
    "receive": Receive,
    "scripted": Scripted,
    "strike": Strike,
    "uniform": lambda task: Uniform(),
    "weave": Weave,
    "zero": lambda task: Zero(),
}

_MAKERS_WITH_SKILL: Final[dict[str, Callable[[Task, float], Policy]]] = {"scripted": Scripted}


def list_policies() -> list[str]:
    """Return the names that `make_policy` takes, sorted."""
    return sorted(_MAKERS)


def list_policies_with_skill() -> list[str]:
    """Return the names that a skill from 0 to 1 may follow, as in "scripted:0.5", sorted.

    Without a skill the policy plays at skill 1.
    """
    return sorted(_MAKERS_WITH_SKILL)


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


def is_built_in(policy: PolicyLike) -> bool:
    """Return whether a policy is given by a name that `make_policy` takes, with or without a skill.

    Args:
        policy: a policy, its name, or the path of its file.
    """
    return not isinstance(policy, Policy) and _text(policy).partition(":")[0] in _MAKERS


def make_policy(policy: PolicyLike, task: Task) -> Policy:
    """Make a policy for the robots of a task.

    Args:
        policy: a policy, which is returned as it is; a name; or the path of a policy file.
            "best" is the trained policy of the task, see `rsoccer.policies.trained`.
            "scripted:0.5" sets a skill. "policy.safetensors:mean" and "best:sample" choose how a
            network acts; the default is as in training.
        task: the task that is played.

    Returns:
        A policy that fits the task.

    Raises:
        FileNotFoundError: no such policy file.
        TypeError: not a `PolicyLike`.
        ValueError: an unknown name, a wrong skill or mode, or a policy that does not fit the task.

    Example:
        >>> import rsoccer
        >>> from rsoccer import policies
        >>> policy = policies.make_policy("scripted:0.5", rsoccer.make_task("VSSSelfPlay-v0"))
    """
    if not isinstance(policy, Policy):
        text = _text(policy)
        name, colon, detail = text.partition(":")
        if name not in _MAKERS:
            policy = _load(text)
        else:
            policy = _with_detail(name, detail, task) if colon else _MAKERS[name](task)
    policy.check_fits(task, task.layout.size)
    return policy


def trained_on(policy: PolicyLike) -> Task | None:
    """Return the task that a policy was trained on, without options that matter in training alone.

    It is None for scripts and noise, and for `best`, which has a policy for each of several tasks.

    Args:
        policy: a policy, its name, or the path of its file.

    Raises:
        FileNotFoundError: no such policy file.
        TypeError: not a `PolicyLike`.
        ValueError: an unknown name, or a task or an option of it that does not exist.
    """
    if is_built_in(policy):
        return None
    if not isinstance(policy, Policy):
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
    for player in task.default_controllers().values():
        path = None if isinstance(player, Learn) else file_of(player)
        if path is not None and not path.exists():
            raise ValueError(
                f"policy: trained beside the policy {player}, which does not exist here; name a "
                "task for it to play"
            )
    return task


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


def _with_detail(name: str, detail: str, task: Task) -> Policy:
    """A policy from its name and the text of its skill, or of its mode."""
    return _make_best(task, detail) if name == "best" else _with_skill(name, detail, task)


def _make_best(task: Task, mode: str | None) -> Network:
    """The trained policy of a task."""
    from rsoccer.policies.trained import load_best

    return load_best(task, mode)


def _with_skill(name: str, skill: str, task: Task) -> Policy:
    """A policy from its name and the text of its skill."""
    if name not in _MAKERS_WITH_SKILL:
        raise ValueError(
            f"policy {name!r} has no skill: expected {name!r}, got {f'{name}:{skill}'!r}; "
            f"policies with a skill are {list_policies_with_skill()}"
        )
    try:
        number = float(skill)
    except ValueError:
        raise ValueError(f"{name}: expected a skill from 0 to 1, got {skill!r}") from None
    return _MAKERS_WITH_SKILL[name](task, number)


def file_of(policy: str) -> Path | None:
    """Return the file that a name stands for; None for a policy of the package.

    Args:
        policy: a name, or the path of a file, which a mode may follow.
    """
    return None if is_built_in(policy) else Path(_split_mode(policy)[0])


def _load(text: str) -> Network:
    """A trained policy from its path, which a mode may follow."""
    path, mode = _split_mode(text)
    if not (path.endswith(SUFFIX) or os.path.exists(path)):
        raise ValueError(
            f"unknown policy {text!r}: expected one of {list_policies()} or "
            "the path of a policy file"
        )
    from rsoccer.policies.network import Network  # scripts do not need the file format

    return Network.load(path, mode)


def _split_mode(text: str) -> tuple[str, str | None]:
    """Path and mode of a policy file; a colon may also be part of the path."""
    from rsoccer.policies.network import MODES

    path, colon, mode = text.rpartition(":")
    if not colon or os.path.exists(text) or text.endswith(SUFFIX):
        return text, None
    known = mode in MODES or path.endswith(SUFFIX)
    return (path, mode) if known else (text, None)
