"""Registry of tasks by name, and tasks as functions take them: by name or as objects."""

from rsoccer.registry.arguments import (
    as_task,
    copied,
    is_registered,
    options_of,
    resolve_task,
    task_with_options,
    with_max_steps,
)
from rsoccer.registry.names import (
    Alias,
    alias,
    is_task_name,
    list_aliases,
    list_options,
    list_tasks,
    make_task,
    nearest_name,
    register,
    register_removed,
    task_class,
)
from rsoccer.registry.overrides import check_overrides

__all__ = ["Alias", "alias", "is_task_name", "list_aliases", "list_options", "list_tasks"]
__all__ += ["make_task", "register", "register_removed", "task_class"]
__all__ += [
    "as_task",
    "check_overrides",
    "copied",
    "is_registered",
    "nearest_name",
    "options_of",
    "resolve_task",
    "task_with_options",
    "with_max_steps",
]
