"""The tasks' ids in Gymnasium's and PettingZoo's registries: `rsoccer/VSS-v0`."""

import gymnasium
import pettingzoo


def announce(name: str, learners: int | None) -> None:
    """Let Gymnasium make a task with one learner, and PettingZoo one with any, by its id.

    `learners` is None where only options say how many there are; such a task has no id. Entry
    points are names, so that nothing is imported before somebody asks.
    """
    ident = f"rsoccer/{name}"
    if learners == 1:
        gymnasium.registry.pop(ident, None)
        gymnasium.register(
            ident,
            entry_point="rsoccer.envs.single:single_env",
            vector_entry_point="rsoccer.envs.vector:vector_env",
            kwargs={"task": name},
        )
    if learners and hasattr(pettingzoo, "register"):  # since 1.27
        pettingzoo.parallel_registry.pop(ident, None)
        pettingzoo.aec_registry.pop(ident, None)
        kwargs = {"name": name}
        pettingzoo.register("parallel", ident, "rsoccer.envs.parallel:parallel_env", kwargs=kwargs)
        pettingzoo.register("aec", ident, "rsoccer.envs.parallel:env", kwargs=kwargs)
