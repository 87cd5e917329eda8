"""The tasks' ids in Gymnasium's and PettingZoo's registries: `rsoccer/VSS-v0`."""

from collections.abc import Callable

import gymnasium
import pettingzoo

from rsoccer.task import Task


def announce(name: str, make: Callable[[], Task]) -> None:
    """Let Gymnasium make a task with one learner, and PettingZoo one with any, by its id.

    Entry points are names, so that nothing is imported before somebody asks.
    """
    ident = f"rsoccer/{name}"
    try:
        learners = len(make().agents)
    except (TypeError, ValueError):
        return  # there is no such task unless options say which
    if learners == 1:
        gymnasium.registry.pop(ident, None)
        gymnasium.register(
            ident,
            entry_point="rsoccer.single:single_env",
            vector_entry_point="rsoccer.vector:vector_env",
            kwargs={"task": name},
        )
    if learners and hasattr(pettingzoo, "register"):  # since 1.27
        pettingzoo.parallel_registry.pop(ident, None)
        pettingzoo.aec_registry.pop(ident, None)
        kwargs = {"name": name}
        pettingzoo.register("parallel", ident, "rsoccer.parallel:parallel_env", kwargs=kwargs)
        pettingzoo.register("aec", ident, "rsoccer.parallel:env", kwargs=kwargs)
