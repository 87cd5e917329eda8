"""Policies by name: those of the package, and those that users register."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable
from typing import Any, Final

from rsoccer import plugins
from rsoccer.policies.base import Policy
from rsoccer.policies.noise import OrnsteinUhlenbeck, Uniform, Zero
from rsoccer.policies.ssl.fetch import Fetch
from rsoccer.policies.ssl.hold import Hold, Receive
from rsoccer.policies.ssl.keep import Keep
from rsoccer.policies.ssl.passer import Passer
from rsoccer.policies.ssl.strike import Strike
from rsoccer.policies.ssl.take import Take
from rsoccer.policies.ssl.team import ScriptedSsl
from rsoccer.policies.ssl.weave import Weave
from rsoccer.policies.vss.chase import Chase
from rsoccer.policies.vss.scripted import Scripted
from rsoccer.registry.names import is_redefined
from rsoccer.task import Task

Maker = Callable[..., Policy]
"""Class or function that makes a policy for a task. Names whose maker has a parameter `skill` may
be followed by a skill."""

RESERVED: Final = ("LEARN", "all", "blue", "latest", "past", "yellow")
"""Names that stand for learners, robots or opponents of self-play."""
_NAME: Final = re.compile(r"[A-Za-z][A-Za-z0-9_]*")


def _scripted(task: Task, skill: float = 1.0) -> Policy:
    """The team script of the league of a task."""
    is_omni = "dribbler" in task.config.command_columns
    return ScriptedSsl(task, skill) if is_omni else Scripted(task, skill)


def _best(task: Task) -> Policy:
    """The trained policy of a task."""
    from rsoccer.policies.trained import load_best

    return load_best(task)


_MAKERS: Final[dict[str, Maker]] = {
    "best": _best,
    "chase": Chase,
    "fetch": Fetch,
    "hold": Hold,
    "keep": Keep,
    "ou": lambda task: OrnsteinUhlenbeck(),
    "passer": Passer,
    "receive": Receive,
    "scripted": _scripted,
    "strike": Strike,
    "take": Take,
    "uniform": lambda task: Uniform(),
    "weave": Weave,
    "zero": lambda task: Zero(),
}
_BUILT_IN: Final = frozenset(_MAKERS)
"""Names of the package's own policies, whose makers name them in errors."""


def register_policy(name: str, maker: Maker) -> None:
    """Register a policy, so that its name stands for it wherever a policy is named.

    Args:
        name: letters, digits and underscores, such as "spin".
        maker: a subclass of `Policy`, or a function, that takes the task that is played and returns
            a policy. With a second parameter `skill` a skill from 0 to 1 may follow the name, as
            in "spin:0.5"; its default is the skill without one.

    Raises:
        TypeError: `maker` is no class of policies and no function, or takes other arguments.
        ValueError: a name of another form, or one that is taken. A maker that is defined anew, as
            in a cell of a notebook that runs again, replaces the former one.

    Example:
        >>> from rsoccer import register_policy
        >>> register_policy("beginner", lambda task: Scripted(task, 0.2))  # doctest: +SKIP
        >>> rsoccer.evaluate("beginner", "ou")  # doctest: +SKIP
    """
    if not isinstance(name, str):
        raise TypeError(f"name: expected text, got {name!r}")
    if not _NAME.fullmatch(name):
        raise ValueError(f"name: expected letters, digits and underscores, got {name!r}")
    before = _MAKERS.get(name, maker)
    if name in RESERVED or (before is not maker and not is_redefined(before, maker)):
        raise ValueError(f"name: {name!r} is already taken")
    check_maker(maker)
    _MAKERS[name] = maker


def list_policies() -> list[str]:
    """Return the registered names, sorted; without those of entry points that were not used yet.

    A warning names entry points that are ignored, because the package has a policy of that name.
    """
    plugins.warn_of_taken_names(plugins.POLICIES, _BUILT_IN)
    return sorted(_MAKERS)


def list_policies_with_skill() -> list[str]:
    """Return the names that a skill from 0 to 1 may follow, as in "scripted:0.5", sorted.

    Without a skill the policy plays at skill 1.
    """
    return sorted(name for name, maker in _MAKERS.items() if _has_skill(maker))


def find(name: str) -> Maker | None:
    """Return the maker of a policy; None for an unknown name.

    Args:
        name: name of the policy, without skill or mode.

    Raises:
        ImportError: a package that offers the policy cannot be loaded.
    """
    if name not in _MAKERS and _NAME.fullmatch(name):
        plugins.import_inherited()
        if name not in _MAKERS and (maker := plugins.load(plugins.POLICIES, name)) is not None:
            _register_entry_point(name, maker)
    return _MAKERS.get(name)


def source_of(name: str) -> str | None:
    """Return the file with the code of a policy; None for one of the package, and without a file.

    Args:
        name: name of the policy, without skill or mode.
    """
    maker = find(name)
    if maker is None or name in _BUILT_IN:
        return None
    try:
        return inspect.getsourcefile(maker)
    except TypeError:  # an object of a class of one's own
        return inspect.getsourcefile(type(maker))


def make(name: str, task: Task, skill: str | None = None) -> Policy:
    """Make the policy of a name.

    Args:
        name: a known name.
        task: the task that is played.
        skill: text of a skill from 0 to 1; None without one.

    Returns:
        A new policy; it may not fit the task.

    Raises:
        RuntimeError: a maker of a user raises an error other than ValueError.
        TypeError: the maker returns something else than a policy.
        ValueError: a wrong skill, or one for a policy without skill, or the maker refuses the task.
    """
    maker = _MAKERS[name]
    arguments = {} if skill is None else {"skill": _number(name, maker, skill)}
    return (
        maker(task, **arguments) if name in _BUILT_IN else make_with(name, maker, task, **arguments)
    )


def make_with(name: str, maker: Maker, task: Task, **arguments: float) -> Policy:
    """Make a policy by a maker of a user, whose errors name it.

    Args:
        name: what the user called the maker by.
        maker: a function or a class.
        task: the task that is played.
        **arguments: a skill, if one was given.

    Returns:
        What the maker returns.

    Raises:
        RuntimeError: the maker raises an error other than ValueError.
        TypeError: the maker returns something else than a policy.
        ValueError: the maker refuses the task.
    """
    try:
        policy = maker(task, **arguments)
    except Exception as error:
        kind = ValueError if isinstance(error, ValueError) else RuntimeError
        raise kind(f"policy {name!r}: its maker raises {type(error).__name__}: {error}") from error
    if not isinstance(policy, Policy):
        raise TypeError(f"{name}: expected its maker to return a Policy, got {policy!r}")
    return policy


def _number(name: str, maker: Maker, skill: str) -> float:
    """The number of a skill."""
    if not _has_skill(maker):
        raise ValueError(
            f"policy {name!r} has no skill: expected {name!r}, got {f'{name}:{skill}'!r}; "
            f"policies with a skill are {list_policies_with_skill()}"
        )
    try:
        return float(skill)
    except ValueError:
        raise ValueError(f"{name}: expected a skill from 0 to 1, got {skill!r}") from None


def _register_entry_point(name: str, maker: Any) -> None:  # noqa: ANN401  (whatever it names)
    try:
        register_policy(name, maker)
    except (TypeError, ValueError) as error:
        raise ImportError(
            f"{name!r}: the entry point in {plugins.POLICIES!r} names no policy: {error}"
        ) from error


def check_maker(maker: object) -> None:
    """Refuse what cannot be called with a task to make a policy.

    Args:
        maker: a class or a function.

    Raises:
        TypeError: something else, a class of other objects, or one that takes other arguments.
    """
    wrong_class = isinstance(maker, type) and not issubclass(maker, Policy)
    if not callable(maker) or wrong_class:
        raise TypeError(
            f"maker: expected a subclass of Policy, or a function that returns one, got {maker!r}"
        )
    if inspect.isabstract(maker):
        raise TypeError(f"maker: {maker!r} has no `act` of its own")
    try:
        inspect.signature(maker).bind(None)
    except TypeError as error:
        raise TypeError(f"maker: expected to be called with the task alone: {error}") from error


def _has_skill(maker: Maker) -> bool:
    return "skill" in inspect.signature(maker).parameters
