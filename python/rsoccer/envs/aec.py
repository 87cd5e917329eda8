"""One match for PettingZoo as an AECEnv: agents act in turn."""

from __future__ import annotations

from typing import Any

from pettingzoo import AECEnv
from pettingzoo.utils.conversions import parallel_to_aec_wrapper
from pettingzoo.utils.wrappers import OrderEnforcingWrapper

from rsoccer.arrays import Floats
from rsoccer.envs.parallel import SoccerParallelEnv, parallel_env
from rsoccer.task import Task


def env(
    task: Task | str,
    render_mode: str | None = None,
    **options: Any,  # noqa: ANN401  (those of parallel_env)
) -> AECEnv[str, Floats, Floats | None]:
    """Return a task as a PettingZoo AECEnv: one match, agents act in turn.

    The match advances by one control step after the last agent's action.

    Args:
        task: a `Task`, or the name of a registered one; see `rsoccer.list_tasks()`.
        render_mode: "rgb_array", "human" or None, as for `parallel_env`.
        **options: further arguments of `parallel_env`: `controllers`, `simulator`, `sensing`,
            `randomization`, `history`, `max_steps`, `max_cycles` and the options of a registered
            task.

    Returns:
        An environment to `reset`, within PettingZoo's `OrderEnforcingWrapper`. Spaces, infos and
        ends are those of `SoccerParallelEnv`.

    Raises:
        TypeError: an argument of the wrong type, an unknown option, or options for a `Task`
            object.
        ValueError: an unknown task, controller or render mode, a value out of range, or no
            robot that learns.

    Example:
        >>> import rsoccer
        >>> env = rsoccer.env("VSSSelfPlay-v0")
        >>> env.reset(seed=0)
        >>> for agent in env.agent_iter():
        ...     observation, reward, terminated, truncated, info = env.last()
        ...     ended = terminated or truncated
        ...     env.step(None if ended else env.action_space(agent).sample())
    """
    return OrderEnforcingWrapper(SoccerAECEnv(parallel_env(task, render_mode, **options)))


class SoccerAECEnv(parallel_to_aec_wrapper[str, Floats, Any]):
    """One match of a task in which agents act in turn; `env` creates it."""

    def __init__(self, match: SoccerParallelEnv) -> None:
        """Wrap a match.

        Args:
            match: environment in which all agents act at once.
        """
        super().__init__(match)
        self._match = match

    def step(self, action: Any) -> None:  # noqa: ANN401  (an element of the agent's space)
        """Set the action of the agent in turn; the last agent's action advances the match.

        Args:
            action: element of the agent's action space; None for an agent that is terminated or
                truncated.

        Raises:
            ClosedEnvironmentError: the environment is closed.
            RuntimeError: the match is inconsistent after a failure.
            TypeError: an action of the wrong type.
            ValueError: an action with a wrong shape or value.
        """
        self._match.check_open("step")
        super().step(action)
