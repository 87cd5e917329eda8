"""Ids of tasks in the registries of Gymnasium and PettingZoo, such as `rsoccer/VSS-v0`."""

import gymnasium
import pettingzoo


def register_ids(name: str, learners: int | None) -> None:
    """Register a task as `rsoccer/{name}`.

    Gymnasium and PettingZoo (1.27 and later) get tasks with any number of learners. With several,
    `gymnasium.make` needs the option `learner`, and the rows of `gymnasium.make_vec` are robots.
    Entry points are registered as text, so registration imports no environment.

    Args:
        name: name of the task, such as "VSS-v0".
        learners: number of robots that learn by default. 0, and None for a task whose options have
            no defaults, register nothing.
    """
    env_id = f"rsoccer/{name}"
    if learners:
        robots = "rsoccer.envs.robots_vector:robots_vector_env"
        gymnasium.registry.pop(env_id, None)
        gymnasium.register(
            env_id,
            entry_point="rsoccer.envs.single:single_env",
            vector_entry_point="rsoccer.envs.vector:vector_env" if learners == 1 else robots,
            kwargs={"task": name},
        )
    if learners and hasattr(pettingzoo, "register"):  # since 1.27
        pettingzoo.parallel_registry.pop(env_id, None)
        pettingzoo.aec_registry.pop(env_id, None)
        kwargs = {"task": name}
        pettingzoo.register("parallel", env_id, "rsoccer.envs.parallel:parallel_env", kwargs=kwargs)
        pettingzoo.register("aec", env_id, "rsoccer.envs.aec:env", kwargs=kwargs)
