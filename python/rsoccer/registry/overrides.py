"""Check that a task plays the options that its class sets, some of which a dataclass ignores."""

import dataclasses
import inspect
from collections.abc import Callable
from typing import Any, cast

from rsoccer.task import Task


def check_overrides(task_class: type[Task]) -> None:
    """Check that a class overrides no option in a way that its constructor ignores.

    A value without an annotation, or in a class without the decorator, is an attribute of the class
    alone: the constructor still sets the option to the default of the parent.

    Args:
        task_class: class of a task. One with a constructor of its own is its author's affair.

    Raises:
        TypeError: a class whose option keeps the default of its parent.
    """
    if not dataclasses.is_dataclass(task_class):
        return
    options = {field.name: field for field in dataclasses.fields(task_class) if field.init}
    ignored = [field for field in options.values() if _is_ignored(task_class, field)]
    if ignored and set(inspect.signature(task_class).parameters) == set(options):
        raise TypeError(_fault(task_class, ignored[0]))


def _is_ignored(task_class: type[Task], field: "dataclasses.Field[Any]") -> bool:
    """Whether a class has another value of an option than the constructor's default."""
    owner = _owner(task_class, field.name)
    value = field.default if owner is None else vars(owner)[field.name]
    return value is not field.default and not hasattr(value, "__get__")  # as properties have


def _owner(task_class: type, name: str) -> type | None:
    """The class whose attribute of a name a class has."""
    return next((each for each in task_class.__mro__ if name in vars(each)), None)


def _fault(task_class: type[Task], field: "dataclasses.Field[Any]") -> str:
    """The fault of a value of an option, and the line that it should have."""
    name, kind = field.name, getattr(field.type, "__name__", field.type)
    owner = _owner(task_class, name) or task_class
    value = vars(owner)[name]
    line = f"`{name}: {kind} = {value!r:.60}`"
    if "__dataclass_fields__" not in vars(owner):
        return (
            f"{owner.__name__}: expected @dataclass(frozen=True) above the class and {line} in it: "
            f"without them the option {_kept(field)}"
        )
    if vars(owner)["__dataclass_fields__"][name].default is value:  # another parent keeps its own
        owner = task_class
    return (
        f"{owner.__name__}.{name}: expected an annotation, as in {line}: "
        f"without one the option {_kept(field)}"
    )


def _kept(field: "dataclasses.Field[Any]") -> str:
    """The fate of an option whose override is ignored, for errors."""
    if field.default is not dataclasses.MISSING:
        return f"keeps {field.default!r:.60}"
    if field.default_factory is not dataclasses.MISSING:
        return f"keeps {cast(Callable[[], object], field.default_factory)()!r:.60}"
    return "has no default"
