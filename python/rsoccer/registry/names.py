"""Names of tasks: their registration, aliases and removed names, and creation by name."""

import inspect
import re
from collections.abc import Mapping, Sequence
from typing import Any, Final, NamedTuple

from rsoccer import ids, option_values, plugins
from rsoccer.registry.overrides import check_overrides
from rsoccer.task import Task


class Alias(NamedTuple):
    """Registered task and options that an alias stands for."""

    task: str
    """Registered name of a task."""
    options: Mapping[str, Any]
    """Options of the task; explicit options of `make_task` take precedence."""


_TASKS: Final[dict[str, type[Task]]] = {}
_ALIASES: Final[dict[str, Alias]] = {}
_REMOVED: Final[dict[str, str]] = {}
_NAME: Final = re.compile(r"[A-Za-z][A-Za-z0-9_]*-v[0-9]+")


def is_redefined(before: object, now: object) -> bool:
    """Return whether code that was defined before has been defined anew: in a notebook, say.

    Lambdas, and what functions make, have names that do not tell them apart, so they are others.

    Args:
        before: class or function.
        now: another one.
    """

    def place(each: object) -> tuple[object, object]:
        return getattr(each, "__module__", None), getattr(each, "__qualname__", None)

    module, name = place(now)
    if type(before) is not type(now) or module is None or "<" in str(name):
        return False
    return place(before) == (module, name)


def register(name: str, task_class: type[Task]) -> None:
    """Register a task class and set its `name`.

    PettingZoo's and Gymnasium's registries get the id "rsoccer/<name>". Neither gets it where no
    robot learns or an option has no default. Use `alias` for a second name.

    Args:
        name: letters, digits and underscores with a version, such as "MyTask-v0".
        task_class: a subclass of `Task`.

    Raises:
        TypeError: `name` is no text, `task_class` is not a subclass of `Task`, or its options keep
            the defaults of its parent, see `rsoccer.registry.overrides`.
        ValueError: `name` has no version or is taken, or the class is registered already. A class
            that is defined anew, as in a cell of a notebook that runs again, replaces the former.
        Exception: any error of creating the task, where all its options have defaults.
    """
    _check_name(name)
    if not (isinstance(task_class, type) and issubclass(task_class, Task)):
        raise TypeError(f"task_class: expected a subclass of Task, got {task_class!r}")
    check_overrides(task_class)
    before = _TASKS.get(name, task_class)
    if before is not task_class and not is_redefined(before, task_class):
        raise ValueError(f"name: {name!r} is already taken by {before.__qualname__}")
    if name in _ALIASES:
        raise ValueError(f"name: {name!r} is already taken, for {_ALIASES[name].task}")
    known = next((n for n, registered in _TASKS.items() if registered is task_class), name)
    if known != name:
        raise ValueError(
            f"task_class: {task_class.__qualname__} is known as {known!r} already; "
            f"registry.alias({name!r}, {known!r}) gives it another name"
        )
    learners = None if _has_required_options(task_class) else len(task_class().agents)
    task_class.name = name
    _TASKS[name] = task_class
    ids.register_ids(name, learners)


def alias(name: str, task: str, **options: Any) -> None:  # noqa: ANN401  (the task's own)
    """Register another name for a task with preset options.

    The alias gets ids like a task. `Task.name` of the created task remains the task's own name.

    Args:
        name: the new name, with a version, such as "MyTask-v0".
        task: a registered name or an alias.
        **options: preset options of the task.

    Raises:
        TypeError: an unknown option, or an option's value of the wrong type.
        ValueError: `name` has no version or is taken, or `make_task` refuses the task or a value.
    """
    _check_name(name)
    if name in _TASKS or _ALIASES.get(name, (task, options)) != (task, options):
        raise ValueError(f"name: {name!r} is already taken")
    learners = len(make_task(task, **options).agents)  # raises for invalid options
    _ALIASES[name] = Alias(task, options)
    ids.register_ids(name, learners)


def register_removed(name: str, hint: str) -> None:
    """Register a removed name with a hint, with which `make_task` raises.

    Args:
        name: the former name.
        hint: replacement to suggest, as the rest of the error message.

    Raises:
        ValueError: `name` has no version or is in use.
    """
    _check_name(name)
    if name in _TASKS or name in _ALIASES:
        raise ValueError(f"name: {name!r} is still in use")
    _REMOVED[name] = hint


def list_tasks() -> list[str]:
    """Return the names of all tasks in alphabetical order, without aliases.

    They are the registered ones and those of entry points, which are not loaded. A warning names
    entry points that are ignored, because the package has a task of that name.
    """
    own = (name for name, each in _TASKS.items() if each.__module__.startswith("rsoccer."))
    plugins.warn_of_taken_names(plugins.TASKS, {*own, *_ALIASES, *_REMOVED})
    return sorted({*_TASKS, *plugins.list_names(plugins.TASKS)} - {*_ALIASES, *_REMOVED})


def list_aliases() -> dict[str, Alias]:
    """Return all aliases by name, in alphabetical order."""
    return dict(sorted(_ALIASES.items()))


def task_class(name: str) -> type[Task]:
    """Return the class of a task.

    Args:
        name: a registered name, or one that a package offers; no alias.

    Raises:
        ImportError: a package that offers the task cannot be loaded.
        ValueError: an unknown name.
    """
    _find(name)
    if name not in _TASKS:
        raise ValueError(f"name: expected no alias, got {name!r}")
    return _TASKS[name]


def is_task_name(name: str) -> bool:
    """Return whether a text has the form of a task's name, registered or not.

    Args:
        name: the text.
    """
    return _NAME.fullmatch(name) is not None


def make_task(name: str, **options: Any) -> Task:  # noqa: ANN401  (each task has its own options)
    """Create a task by name.

    Args:
        name: a registered name or an alias.
        **options: options of the task, the parameters of its class; see `list_options`. Values
            from `options_of`, which JSON can hold, are decoded.

    Returns:
        The task.

    Raises:
        ImportError: a package that offers the task cannot be loaded, see `rsoccer.plugins`.
        TypeError: an unknown option, or an option's value of the wrong type.
        ValueError: an unknown name, or an option's value that the task refuses.

    Example:
        >>> import rsoccer
        >>> rsoccer.make_task("VSSMulti-v0", n_blue=2, opponent="chase").agents
        ('blue_0', 'blue_1')
    """
    return make_named(name, options, ())


def make_named(name: str, options: Mapping[str, Any], arguments: Sequence[str]) -> Task:
    """Return a new task, for a caller that got its options beside arguments of its own.

    Args:
        name: a registered name or an alias.
        options: options of the task, by name.
        arguments: names of those arguments, which the error for an unknown option lists, too.

    Raises:
        ImportError: a package that offers the task cannot be loaded.
        TypeError: an unknown option, or an option's value of the wrong type.
        ValueError: an unknown name, or an option's value that the task refuses.
    """
    _find(name)
    if name in _ALIASES:
        task, preset = _ALIASES[name]
        return make_named(task, {**preset, **options}, arguments)
    task_class = _TASKS[name]
    valid = list_options(task_class)
    unknown = sorted(set(options) - set(valid))
    if unknown:
        # Python's own words: TorchRL probes for options and reads them.
        names = ", ".join(map(repr, unknown))
        own = f"the arguments {list(arguments)} and the task's options " if arguments else ""
        raise TypeError(
            f"{name}: got an unexpected keyword argument {names}; valid are {own}{valid}"
        )
    return task_class(**{name: option_values.decoded(name, v) for name, v in options.items()})


def _find(name: str) -> None:
    """Register a task of an entry point or of a parent's modules; ValueError for an unknown one."""
    if name in _TASKS or name in _ALIASES:
        return
    if name not in _REMOVED:
        plugins.import_inherited()
        if name not in _TASKS and name not in _ALIASES:
            _register_entry_point(name)
    if name not in _TASKS and name not in _ALIASES:
        hint = _REMOVED.get(
            name,
            f"expected one of {list_tasks()}; a task of your own is known after the import of the "
            "module that registers it, as with --import MODULE",
        )
        raise ValueError(f"unknown task {name!r}: {hint}")


def nearest_name(task: Task) -> str:
    """Return the registered name of a task, or of the nearest parent of its class that has one.

    Args:
        task: the task.

    Returns:
        The name; the task's own where no parent is registered either.
    """
    registered = {each: name for name, each in _TASKS.items()}
    return next((registered[each] for each in type(task).__mro__ if each in registered), task.name)


def _register_entry_point(name: str) -> None:
    """Register the task class that an installed package offers under a name, if one does."""
    task_class = plugins.load(plugins.TASKS, name)
    if task_class is None or name in _TASKS:
        return
    try:
        register(name, task_class)
    except Exception as error:
        raise ImportError(
            f"{name!r}: the entry point in {plugins.TASKS!r} names no task: {error}"
        ) from error


def list_options(task_class: type[Task]) -> list[str]:
    """Return the names of a task's options, in the order of its parameters.

    Args:
        task_class: the class of the task.
    """
    return list(inspect.signature(task_class).parameters)


def _has_required_options(task_class: type[Task]) -> bool:
    """Whether an option has no default."""
    variadic = (inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.VAR_KEYWORD)
    parameters = inspect.signature(task_class).parameters.values()
    return any(p.default is p.empty and p.kind not in variadic for p in parameters)


def _check_name(name: str) -> None:
    if not isinstance(name, str):
        raise TypeError(f"name: expected text, got {name!r}")
    if not _NAME.fullmatch(name):
        raise ValueError(f"name: expected letters and a version, like 'MyTask-v0', got {name!r}")
