"""Policies by name: what can drive a robot that does not learn."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Final

from rsoccer.policies.base import Policy, PolicyInput
from rsoccer.policies.noise import OrnsteinUhlenbeck, Uniform, Zero
from rsoccer.policies.ssl.fetch import Fetch
from rsoccer.policies.ssl.hold import Hold, Receive
from rsoccer.policies.ssl.passer import Passer
from rsoccer.policies.ssl.strike import Strike
from rsoccer.policies.ssl.weave import Weave
from rsoccer.policies.vss.chase import Chase
from rsoccer.policies.vss.scripted import Scripted
from rsoccer.task import Task

if TYPE_CHECKING:
    from rsoccer.policies.network import Network

__all__ = ["Policy", "PolicyInput", "make", "name_of", "names", "names_with_skill"]
__all__ += ["Player", "check_player", "trained_on"]

Player = str | os.PathLike[str] | Policy
"""A policy by name (`zero`, `ou`, ...), by the path of its file, or itself."""

FILE_ENDING: Final = ".safetensors"

_MAKERS: Final[dict[str, Callable[[Task], Policy]]] = {
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

_WITH_SKILL: Final[dict[str, Callable[[Task, float], Policy]]] = {"scripted": Scripted}


def names() -> list[str]:
    """Names that `make` knows; it also takes the path of a trained policy's file."""
    return sorted(_MAKERS)


def names_with_skill() -> list[str]:
    """Names that a skill from 0 to 1 may follow, as in "scripted:0.5"; without one it is 1."""
    return sorted(_WITH_SKILL)


def check_player(name: str, value: object) -> None:
    """TypeError, which calls it `name`, unless it is a `Player`, known or not."""
    if not isinstance(value, str | os.PathLike | Policy):
        raise TypeError(f"{name}: expected a policy, its name or its file, got {value!r}")


def make(policy: Player, task: Task) -> Policy:
    """A policy fit for the robots of `task`, from its name, its file, or itself.

    A file plays as it was trained; "policy.safetensors:mean" and ":sample" say how it shall.
    """
    if not isinstance(policy, Policy):
        given = _text(policy)
        name, colon, skill = given.partition(":")
        if name not in _MAKERS:
            policy = _load(given)
        else:
            policy = _with_skill(name, skill, task) if colon else _MAKERS[name](task)
    policy.check_fits(task, task.observation_size)
    return policy


def trained_on(policy: Player) -> str | None:
    """Name of the task that a policy was trained on; None for scripts and noise."""
    if isinstance(policy, Policy):
        return policy.task_name
    given = _text(policy)
    return None if given.partition(":")[0] in _MAKERS else _load(given).task_name


def name_of(policy: Player) -> str:
    """What to call a policy in tables: its name or file, or its class if it has neither."""
    return type(policy).__name__ if isinstance(policy, Policy) else _text(policy)


def _text(policy: str | os.PathLike[str]) -> str:
    """A name, or the path of a file, as text."""
    check_player("policy", policy)
    return os.fspath(policy)


def _with_skill(name: str, skill: str, task: Task) -> Policy:
    """A policy by its name and the text of its skill."""
    if name not in _WITH_SKILL:
        raise ValueError(
            f"policy {name!r} has no skill: expected {name!r}, got {f'{name}:{skill}'!r}; "
            f"those with a skill are {names_with_skill()}"
        )
    try:
        number = float(skill)
    except ValueError:
        raise ValueError(f"{name}: expected a skill from 0 to 1, got {skill!r}") from None
    return _WITH_SKILL[name](task, number)


def _load(given: str) -> Network:
    """A trained policy from its file, or an error that says what could have been meant."""
    path, play = _path_and_play(given)
    if not (path.endswith(FILE_ENDING) or os.path.exists(path)):
        raise ValueError(
            f"unknown policy {given!r}: expected one of {names()} or the path of a policy file"
        )
    from rsoccer.policies.network import Network  # a script needs no file format

    return Network.load(path, play)


def _path_and_play(given: str) -> tuple[str, str | None]:
    """A file's path, and what follows its last colon, if that is no part of the path."""
    from rsoccer.policies.network import PLAYS

    path, colon, play = given.rpartition(":")
    if not colon or os.path.exists(given) or given.endswith(FILE_ENDING):
        return given, None
    known = play in PLAYS or path.endswith(FILE_ENDING)
    return (path, play) if known else (given, None)
