"""Recommended settings by task, where they differ from the defaults of `Args`.

`rsoccer train --task` and `Args.for_task` start from them; a setting that is given replaces the
recommended one as a whole. Values are results of measurements.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

from rsoccer.registry import list_aliases

TASK_SETTINGS: Final[Mapping[str, Mapping[str, Any]]] = {}
"""Fields of `Args` with their values, by the name of the task."""


def recommended_settings(task: str) -> dict[str, Any]:
    """Return the recommended settings for a task; {} where the defaults are.

    Args:
        task: a registered name or an alias, which has the settings of its task unless
            `TASK_SETTINGS` has some for the alias.
    """
    alias = list_aliases().get(task)
    if task not in TASK_SETTINGS and alias is not None:
        return recommended_settings(alias.task)
    return dict(TASK_SETTINGS.get(task, {}))
