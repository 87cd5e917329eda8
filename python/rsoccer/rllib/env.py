"""One match as RLlib's `MultiAgentEnv`, and a callback that reports the metrics of its task."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

from gymnasium.spaces import Dict, Space
from ray.rllib.callbacks.callbacks import RLlibCallback
from ray.rllib.env.multi_agent_env import MultiAgentEnv

from rsoccer.arrays import Array, Floats
from rsoccer.controllers import Controllers
from rsoccer.envs import agent_dicts
from rsoccer.envs.env_matches import EnvMatches
from rsoccer.envs.options import learner_controllers, reset_options
from rsoccer.matches import Matches
from rsoccer.randomization import Ranges
from rsoccer.registry import resolve_task
from rsoccer.sources import SensingSource, SimulatorSource
from rsoccer.task import Task

METRICS: Final = "task_metrics"
"""Key of the metrics under `env_runners` in the results of `train`."""

RESULTS: Final = "results_against"
"""Key of blue's results against frozen modules and fixed policies of yellow, beside `METRICS`."""

WIN_RATES: Final = "win_rates"
"""Key of blue's win rates against past selves, in runners' states and episodes' `custom_data`."""

WINDOW: Final = 100
"""Episodes over which `MetricsCallback` averages."""

RUNNER_SETTINGS: Final = ("action_repeat", "fixed", "frozen", "shield")
"""Keys of an `env_config` that `MatchesEnvRunner` alone reads."""

ByAgent = dict[str, Any]
Spaces = dict[str, Space[Any]]


class SoccerMultiAgentEnv(MultiAgentEnv):
    """One match with a dictionary entry for each learner.

    A match ends for all robots at once, so only `"__all__"` is True in `terminateds` (the task's
    end, such as a goal) or in `truncateds` (the time limit). RLlib bootstraps the value at a time
    limit only then: an environment that reports each agent too, as `ParallelPettingZooEnv` does,
    gets every end recorded as terminated.

    Infos: empty, except for the last step. Then each agent's info holds the metrics of the task,
    such as `goal_score`, and `steps`, as numbers; `MetricsCallback` reports them.

    `MatchesEnvRunner` steps many matches faster, with the same `env_config`.

    Attributes:
        matches: the match, a batch of one.
        possible_agents: names of the learners; all of them play at all times.
        agents: the same.
        observation_spaces: Box (o,) float32 by agent.
        action_spaces: Box (action,) float32 from -1 to 1 by agent, or Discrete.
        observation_space: Dict of the spaces of all agents.
        action_space: Dict of the spaces of all agents.
    """

    def __init__(self, config: Mapping[str, Any]) -> None:
        """Prepare a match; `reset` begins it.

        Args:
            config: RLlib's `env_config`: `task`, a task or the name of a registered one; optional
                `controllers`, `threads`, `simulator`, `sensing`, `randomization`, `history` and
                `max_steps` as for `Matches`, and `learner`, the only robot that learns; other keys
                are options of the task.
                Worker processes make a simulator and a sensor model from a function or from a text
                "module:name". `frozen`, `fixed`, `action_repeat` and `shield` are for
                `MatchesEnvRunner`, and ignored here.

        Raises:
            ImportError: a text "module:name" whose module or name does not exist.
            TypeError: a config that is no mapping, or an option of the wrong type or unknown.
            ValueError: no task, or a value that `Matches` refuses.
        """
        super().__init__()
        self.matches = new_matches(config, 1, None, "disabled")
        self.possible_agents = list(self.matches.agents)
        self.agents = list(self.possible_agents)
        self.observation_spaces, self.action_spaces = spaces_by_agent(self.matches)
        self.observation_space = Dict(self.observation_spaces)
        self.action_space = Dict(self.action_spaces)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[ByAgent, ByAgent]:
        """Begin an episode.

        Args:
            seed: seed of the match, as for `Matches.reset`; None continues the random streams.
            options: None or empty: there are none.

        Returns:
            Observations (o,) by agent, and empty infos.

        Raises:
            ValueError: an option.
        """
        reset_options(options)
        return self._by_agent(self.matches.reset(seed)), {}

    def step(
        self, action_dict: Mapping[str, Array]
    ) -> tuple[ByAgent, ByAgent, ByAgent, ByAgent, ByAgent]:
        """Advance the match by one control step.

        Args:
            action_dict: an action (action,) from -1 to 1, or an index of the `action_table`, by
                agent.

        Returns:
            Observations, rewards, `terminateds`, `truncateds` and infos by agent; the ends have
            `"__all__"` only.

        Raises:
            KeyError: an agent without an action.
            TypeError: an action of the wrong type. Nothing has changed.
            ValueError: an action with a wrong shape or value. Nothing has changed.
        """
        task = self.matches.task
        try:
            outcome = self.matches.step(agent_dicts.stack_actions(action_dict, self.agents, task))
        except (LookupError, TypeError, ValueError):
            agent_dicts.check_actions(action_dict, self.agents, task)
            raise
        infos: ByAgent = {}
        if (episodes := outcome.episodes) is not None:
            infos = {agent: episodes.info() for agent in self.agents}
        return (
            self._by_agent(outcome.final_observations),
            dict(zip(self.agents, outcome.rewards[0].tolist(), strict=True)),
            {"__all__": bool(outcome.terminated[0])},
            {"__all__": bool(outcome.truncated[0])},
            infos,
        )

    def close(self) -> None:
        """Close the simulator; may be repeated."""
        super().close()
        self.matches.close()

    def _by_agent(self, observations: Floats) -> ByAgent:
        """Observations of the match by agent."""
        return dict(zip(self.agents, observations[0], strict=True))


class MetricsCallback(RLlibCallback):
    """Callback that reports metrics of ended matches, for RLlib's own runner.

    `result["env_runners"]["task_metrics"]["goal_score"]` then is the mean over the last 100
    matches. `MatchesEnvRunner` reports them without it.
    """

    def on_episode_end(self, *, episode: Any, metrics_logger: Any, **kwargs: Any) -> None:  # noqa: ANN401
        """Log the metrics of an episode.

        Args:
            episode: the episode that ended.
            metrics_logger: the runner's logger.
            **kwargs: ignored.
        """
        robot = next(iter(episode.agent_episodes.values()))
        for name, value in robot.get_infos(-1).items():
            metrics_logger.log_value((METRICS, name), value, window=WINDOW)


def spaces_by_agent(matches: Matches) -> tuple[Spaces, Spaces]:
    """Return the observation and action spaces of the learners, by name.

    Args:
        matches: the matches.
    """
    observation_space: Space[Any] = matches.observation_space
    action_space: Space[Any] = matches.action_space
    agents = matches.agents
    return dict.fromkeys(agents, observation_space), dict.fromkeys(agents, action_space)


def new_matches(
    config: Mapping[str, Any], worlds: int, seed: int | None, autoreset: str
) -> EnvMatches:
    """Return the matches that an `env_config` describes.

    Args:
        config: as for `SoccerMultiAgentEnv`.
        worlds: number of matches, at least 1.
        seed: seed of the first match, at least 0; None for a random one.
        autoreset: as for `Matches`.

    Raises:
        ImportError: a text "module:name" whose module or name does not exist.
        TypeError: a config that is no mapping, or an option of the wrong type or unknown.
        ValueError: no task, or a value that `Matches` refuses.
    """
    if not isinstance(config, Mapping):
        raise TypeError(f"env_config: expected values by name, with a 'task', got {config!r}")
    given = {name: value for name, value in config.items() if name not in RUNNER_SETTINGS}
    if "task" not in given:
        raise ValueError(f"env_config: expected a 'task', got {sorted(given)}")
    task, settings = _settings(**given)
    return EnvMatches(task, worlds, seed, autoreset=autoreset, **settings)


def _settings(
    task: Task | str,
    learner: str | None = None,
    controllers: Controllers | None = None,
    threads: int = 1,
    simulator: SimulatorSource | None = None,
    sensing: SensingSource | None = None,
    randomization: Ranges | None = None,
    history: int = 1,
    max_steps: int | None = None,
    **options: Any,  # noqa: ANN401  (fields of the task, checked by the registry)
) -> tuple[Task, dict[str, Any]]:
    """Task of an `env_config`, and further arguments of `Matches`."""
    found = resolve_task(task, max_steps, options, _settings)
    return found, {
        "controllers": learner_controllers(found, learner, controllers),
        "threads": threads,
        "simulator": simulator,
        "sensing": sensing,
        "randomization": randomization,
        "history": history,
    }
