"""RLlib's environment runner on `Matches`: steps arrays, and cuts them into episodes."""

from __future__ import annotations

import secrets
import time
from collections import Counter, defaultdict
from collections.abc import Collection, Mapping
from contextlib import ExitStack
from typing import Any, Final

import numpy as np
import torch
from gymnasium.spaces import Dict, Discrete
from ray.rllib.callbacks.callbacks import RLlibCallback
from ray.rllib.callbacks.utils import make_callback
from ray.rllib.core.columns import Columns
from ray.rllib.env.env_context import EnvContext
from ray.rllib.env.multi_agent_env_runner import MultiAgentEnvRunner
from ray.rllib.env.multi_agent_episode import MultiAgentEpisode
from ray.rllib.env.vector.vector_multi_agent_env import VectorMultiAgentEnv
from ray.rllib.utils import metrics as keys

from rsoccer import checks
from rsoccer.arrays import Array, Floats
from rsoccer.envs.robot_rows import RobotRows
from rsoccer.frame import team_of
from rsoccer.matches import Matches, Outcome
from rsoccer.policies.shield import Shield, check_shield
from rsoccer.rllib.decisions import FixedTeams, play_decision
from rsoccer.rllib.env import METRICS, RESULTS, WIN_RATES, new_matches, spaces_by_agent
from rsoccer.rllib.episodes import Rollout, Running

EVALUATION_SEED: Final = 2**40
"""Offset of the seeds of runners that evaluate."""

_UNCALLED: Final = ("on_episode_created", "on_episode_start", "on_episode_step")


class MatchesEnvRunner(MultiAgentEnvRunner):
    """A `MultiAgentEnvRunner` that steps n matches as arrays.

    `config.env_runners(env_runner_cls=MatchesEnvRunner, num_envs_per_env_runner=n)` selects it;
    `env_config` is that of `SoccerMultiAgentEnv`. RLlib's own runner handles each robot of each
    step by itself. This one asks each policy once a step for the actions of all of its robots in
    all matches, steps `Matches`, and cuts the arrays into episodes at the end of `sample`.

    Equal to RLlib's runner: episodes that span several calls of `sample`, the value at time limits
    and at cuts, the policy mapping at the start of each episode, weights, checkpoints, metrics,
    and the callbacks `on_environment_created`, `on_episode_end` and `on_sample_end`.

    Different:

    - Observations reach the modules as they are, and Gaussian actions are clipped to [-1, 1] by
      `Matches`. Connectors of one's own between environment and module are refused, and so are
      recurrent modules and callbacks at each step. Learner connectors are not affected.
    - `env_config["frozen"]` is a collection of modules that play but do not learn, such as past
      selves; their robots are not part of the returned episodes, which saves half of the data in
      self-play. `policies_to_train` still has to leave them out.
    - `env_config["fixed"]` has the names or files of policies of the package, by names that the
      policy mapping may return in place of modules. Such a policy plays a whole team, and is
      frozen: `{"fixed_0": "chase"}`.
    - `env_config["action_repeat"]` is the number of control steps for which an action is held, 1
      by default. A step of an episode then is a decision, whose reward is the sum over them.
    - `env_config["shield"]`, such as "vsss", names a shield of `rsoccer.policies.shield`, which
      changes the actions that are played, and not those that are learned from.
    - Metrics of the task are in `result["env_runners"]["task_metrics"]`, and the results of blue
      against each frozen opponent in `result["env_runners"]["results_against"]`: `matches` and
      `points`, which are 1 for a win and 0.5 for a draw.
    - An episode's `custom_data["win_rates"]` has blue's win rates against past selves when the
      policy mapping is asked. They are a part of the runner's state, which `League` sets.
    - Runner k of a run with the seed s plays with the seeds `s + k * n` to `s + k * n + n - 1`.

    Attributes:
        matches: the matches; absent where RLlib creates no environment.
        win_rates: blue's win rates against the past selves of a league in order of their slots.
    """

    def __init__(self, config: Any, **kwargs: Any) -> None:  # noqa: ANN401  (RLlib's own)
        """Create the matches and the modules.

        Args:
            config: RLlib's `AlgorithmConfig`.
            **kwargs: as for `MultiAgentEnvRunner`.

        Raises:
            TypeError: an `env_config` with an option of the wrong type or unknown.
            ValueError: connectors, callbacks or modules that this runner cannot serve, or an
                `env_config` that `Matches` refuses.
        """
        for name in ("env_to_module_connector", "module_to_env_connector"):
            if getattr(config, f"_{name}") is not None:
                raise ValueError(f"{name}: MatchesEnvRunner runs no connectors; leave it None")
        self.env: Any = None  # what `stop` closes
        self.win_rates: list[float] = []
        with ExitStack() as on_error:
            on_error.callback(self.stop)
            super().__init__(config=config, **kwargs)
            self._check_callbacks()
            on_error.pop_all()
        self._observations: Floats = np.empty(0, np.float32)
        self._running: list[Running] = []
        self._ended: list[tuple[Any, ...]] = []
        self._earlier_parts: dict[str, list[Any]] = defaultdict(list)

    def make_env(self) -> None:
        """Create new matches from `config.env_config`, and close those before them."""
        self.stop()
        settings: Mapping[str, Any] = self.config.env_config
        fixed: Mapping[str, str] = settings.get("fixed", {})
        self._frozen = frozenset((*settings.get("frozen", ()), *fixed))
        self._action_repeat = checks.integer("action_repeat", settings.get("action_repeat", 1), 1)
        shield = settings.get("shield")
        self._shield = None if shield is None else Shield(shield)
        self.num_envs = self.config.num_envs_per_env_runner
        self.matches = new_matches(settings, self.num_envs, self._first_seed(), "disabled")
        if self._shield is not None and self.matches.task.action_table is not None:
            raise ValueError(f"shield: expected a task with continuous actions, got {shield!r}")
        check_shield("shield", shield, self.matches.task)
        streams = secrets.randbits(63) if (seed := self._first_seed()) is None else seed
        self._fixed = FixedTeams(self.matches, fixed, streams)
        self._robots = RobotRows.of(self.matches)
        self.env = _MatchesEnvs(self.matches)
        self._needs_initial_reset = True
        context = EnvContext(settings, worker_index=self.worker_index or 0)
        make_callback(
            "on_environment_created",
            callbacks_objects=self._callbacks,
            callbacks_functions=self.config.callbacks_on_environment_created,
            kwargs={
                "env_runner": self,
                "metrics_logger": self.metrics,
                "env": self.env,
                "env_context": context,
            },
        )

    def make_module(self) -> None:
        """Create the modules, which must not be recurrent.

        Raises:
            ValueError: a recurrent module.
        """
        super().make_module()
        for name, module in self.module.items():
            if module.is_stateful():
                raise ValueError(f"module {name!r}: MatchesEnvRunner serves no recurrent modules")

    def get_state(
        self,
        components: str | Collection[str] | None = None,
        *,
        not_components: str | Collection[str] | None = None,
        **kwargs: Any,  # noqa: ANN401
    ) -> dict[str, Any]:
        """Return the state that RLlib saves, and that runners in the place of failed ones get.

        Args:
            components: names of the parts; None for all.
            not_components: names of parts that are left out.
            **kwargs: as for `MultiAgentEnvRunner`.
        """
        state = super().get_state(components, not_components=not_components, **kwargs)
        if self._check_component(WIN_RATES, components, not_components):
            state[WIN_RATES] = list(self.win_rates)
        return dict(state)

    def set_state(self, state: Mapping[str, Any]) -> None:
        """Set parts of the state.

        Args:
            state: parts by name.
        """
        super().set_state(state)
        self.win_rates = list(state.get(WIN_RATES, self.win_rates))

    def get_metrics(self) -> Any:  # noqa: ANN401  (RLlib's own)
        """Return the metrics since the last call, in RLlib's form."""
        for episode in self._ended:
            self._log_episode_metrics(*episode)
        self._ended.clear()
        return self.metrics.reduce()

    def _sample(
        self,
        *,
        num_timesteps: int | None = None,
        num_episodes: int | None = None,
        explore: bool,
        random_actions: bool = False,
        force_reset: bool = False,
    ) -> list[Any]:
        """Play as many steps or episodes as asked for, at least; `sample` calls it."""
        if force_reset or num_episodes is not None or self._needs_initial_reset:
            self._begin()
        self._needs_initial_reset = num_episodes is not None
        for module in self.module.values():
            # `forward_exploration` would do so at each step, for a quarter of the time.
            module.eval()
        by_agent = self.config.count_steps_by != "env_steps"
        per_call = self.num_envs * (len(self.matches.agents) if by_agent else 1)
        rollout = Rollout(self._observations, self.matches.agents, self._agent_spaces())
        ended = 0
        while (
            len(rollout) * per_call < num_timesteps
            if num_timesteps is not None
            else ended < (num_episodes or 0)
        ):
            observed = rollout.observations
            columns = (
                self._random() if random_actions else self._act(observed, len(rollout), explore)
            )
            outcome = self._play(observed, columns[Columns.ACTIONS])
            rollout.add(columns, outcome)
            ended += self._end_episodes(rollout, outcome)
        self._observations = rollout.observations
        mapping = self.config.policy_mapping_fn
        returned, module_steps = [], Counter[str]()
        for part, episode in rollout.episodes(self._running, self._frozen, mapping):
            self._report_end(part.world, episode)
            for module in part.episode.modules.values():
                module_steps[module] += part.end - part.first
            if episode.agent_episodes and (num_episodes is None or episode.is_done):
                returned.append(episode)
        self._log_sampled(len(rollout), ended, module_steps)
        return returned

    def _begin(self) -> None:
        """Begin episodes in all matches; the seed counts only for the first time."""
        self._observations = self.matches.reset()
        self._earlier_parts.clear()
        agents = self.matches.agents
        self._module_of = np.zeros((self.num_envs, len(agents)), np.object_)
        self._rows: dict[str, torch.Tensor | None] | None = None
        self._running = [self._new_episode_of(world) for world in range(self.num_envs)]

    def _new_episode_of(self, world: int) -> Running:
        """A new episode of a match, with a module for each agent."""
        head = MultiAgentEpisode(
            observation_space=self.env.observation_spaces,
            action_space=self.env.action_spaces,
            agent_to_module_mapping_fn=self.config.policy_mapping_fn,
        )
        head.custom_data[WIN_RATES] = self.win_rates
        modules = {agent: head.module_for(agent) for agent in self.matches.agents}
        chosen = list(modules.values())
        if chosen != self._module_of[world].tolist():
            self._module_of[world] = chosen
            self._rows = None
        self._fixed.begin(world, modules)
        return Running(modules, head.id_)

    def _play(self, observations: Floats, actions: Array) -> Outcome:
        """Outcome of a decision in all matches."""
        return play_decision(
            self.matches, observations, actions, self._action_repeat, self._shield, self._fixed
        )

    def _end_episodes(self, rollout: Rollout, outcome: Outcome) -> int:
        """Cut the episodes that ended in a step, and begin new ones; return their number."""
        if (episodes := outcome.episodes) is None:
            return 0
        now = time.perf_counter()
        for index, world in enumerate(episodes.worlds.tolist()):
            info = episodes.info(index)
            length = -(-int(episodes.lengths[index]) // self._action_repeat)  # decisions
            running = self._running[world]
            rollout.end(world, running, outcome, info)
            returns = dict(zip(self.matches.agents, episodes.returns[index].tolist(), strict=True))
            by_module: dict[str, float] = defaultdict(float)
            for agent, module in running.modules.items():
                by_module[module] += returns[agent]
            steps = dict.fromkeys(returns, length)
            total = sum(returns.values())
            self._ended.append((length, total, now - running.began, returns, by_module, steps))
            window = max(1, self.config.metrics_num_episodes_for_smoothing)
            self.metrics.log_dict({METRICS: info}, window=window)
            self._log_result(running, info)
            self._running[world] = self._new_episode_of(world)
        return len(episodes.worlds)

    def _log_result(self, running: Running, info: Mapping[str, float]) -> None:
        """Count the result of a match against a frozen module or a fixed policy of yellow."""
        rivals = {name for agent, name in running.modules.items() if team_of(agent) == "yellow"}
        success = self.matches.task.success or ""
        if success not in info or len(rivals) != 1 or not rivals <= self._frozen:
            return
        (rival,) = rivals
        points = (float(np.sign(info[success])) + 1.0) / 2.0
        for name, value in {"matches": 1.0, "points": points}.items():
            self.metrics.log_value((RESULTS, rival, name), value, reduce="sum")

    def _act(self, observations: Floats, steps: int, explore: bool) -> dict[str, Array]:
        """Outputs of the modules for all agents by column, (n, agents, ...), actions included."""
        flat = torch.from_numpy(self._robots.flat(observations)).to(self._device)
        runners = self.config.num_env_runners or 1
        t = self.num_env_steps_sampled_lifetime + steps * self.num_envs * runners
        columns: dict[str, Array] = {}
        for name, rows in self._rows_by_module().items():
            outputs = self._forward(name, flat if rows is None else flat[rows], explore, t)
            for column, values in outputs.items():
                if rows is None:
                    columns[column] = values
                    continue
                if column not in columns:
                    columns[column] = np.zeros((len(flat), *values.shape[1:]), values.dtype)
                columns[column][rows.numpy()] = values
        return {name: self._robots.by_match(values) for name, values in columns.items()}

    def _forward(
        self, name: str, observations: torch.Tensor, explore: bool, t: int
    ) -> dict[str, Array]:
        """Outputs of one module for some agents, (k, ...) by column, actions included."""
        module, batch = self.module[name], {Columns.OBS: observations}
        with torch.no_grad(), self.metrics.log_time(keys.RLMODULE_INFERENCE_TIMER):
            if explore:
                outputs = dict(module._forward_exploration(batch, t=t))
                distribution = module.get_exploration_action_dist_cls
            else:
                outputs = dict(module._forward_inference(batch))
                distribution = module.get_inference_action_dist_cls
            if Columns.ACTIONS not in outputs:
                drawn_from = distribution().from_logits(outputs[Columns.ACTION_DIST_INPUTS])
                drawn_from = drawn_from if explore else drawn_from.to_deterministic()
                outputs[Columns.ACTIONS] = actions = drawn_from.sample()
                if Columns.ACTION_LOGP not in outputs:
                    outputs[Columns.ACTION_LOGP] = drawn_from.logp(actions)
        return {
            column: values.numpy(force=True) if isinstance(values, torch.Tensor) else values
            for column, values in outputs.items()
        }

    def _rows_by_module(self) -> dict[str, torch.Tensor | None]:
        """Indices among all agents (n x agents) of those of each module; None for all of them."""
        if self._rows is None:
            modules = self._robots.flat(self._module_of)
            names = sorted(set(modules.tolist()))
            self._rows = {
                name: None if len(names) == 1 else torch.from_numpy(np.flatnonzero(modules == name))
                for name in names
                if name not in self._fixed.modules
            }
        return self._rows

    def _random(self) -> dict[str, Array]:
        """Uniform random actions of all agents."""
        shape = (self.num_envs, len(self.matches.agents))
        space = self.matches.action_space
        if isinstance(space, Discrete):
            return {Columns.ACTIONS: np.random.randint(space.n, size=shape)}  # noqa: NPY002
        draw = np.random.uniform(-1.0, 1.0, (*shape, *space.shape))  # noqa: NPY002
        return {Columns.ACTIONS: draw.astype(np.float32)}

    def _log_sampled(self, steps: int, ended: int, module_steps: Mapping[str, int]) -> None:
        """Count the steps that were sampled; `train` waits for their number."""
        total, log = steps * self.num_envs, self.metrics.log_value
        if not total:
            return
        log(keys.NUM_ENV_STEPS_SAMPLED, total, reduce="sum")
        lifetime = keys.NUM_ENV_STEPS_SAMPLED_LIFETIME
        log(lifetime, total, reduce="lifetime_sum", with_throughput=True)
        log(keys.NUM_EPISODES, ended, reduce="sum")
        log(keys.NUM_EPISODES_LIFETIME, ended, reduce="lifetime_sum")
        for agent in self.matches.agents:
            log((keys.NUM_AGENT_STEPS_SAMPLED, agent), total, reduce="sum")
            log((keys.NUM_AGENT_STEPS_SAMPLED_LIFETIME, agent), total, reduce="lifetime_sum")
        for module, count in module_steps.items():
            log((keys.NUM_MODULE_STEPS_SAMPLED, module), count, reduce="sum")
            log((keys.NUM_MODULE_STEPS_SAMPLED_LIFETIME, module), count, reduce="lifetime_sum")
        self._log_env_steps(metric=self._metrics_num_env_steps_sampled, num_steps=total)

    def _report_end(self, world: int, episode: Any) -> None:  # noqa: ANN401
        """Call `on_episode_end` with all parts of an episode, if anyone asks for it."""
        if not self._has_end_callback:
            return
        if not episode.is_done:
            self._earlier_parts[episode.id_].append(episode)
            return
        make_callback(
            "on_episode_end",
            callbacks_objects=self._callbacks,
            callbacks_functions=self.config.callbacks_on_episode_end,
            kwargs={
                "episode": episode,
                "prev_episode_chunks": self._earlier_parts.pop(episode.id_, []),
                "env_runner": self,
                "metrics_logger": self.metrics,
                "env": self.env,
                "env_index": world,
                "rl_module": self.module,
            },
        )

    def _check_callbacks(self) -> None:
        """Refuse callbacks at each step, and find out about those at ends."""

        def given(name: str) -> bool:
            default = getattr(RLlibCallback, name)
            own = any(getattr(type(one), name) is not default for one in self._callbacks)
            return own or bool(getattr(self.config, f"callbacks_{name}"))

        uncalled = [name for name in _UNCALLED if given(name)]
        if uncalled:
            raise ValueError(f"callbacks: MatchesEnvRunner does not call {', '.join(uncalled)}")
        self._has_end_callback = given("on_episode_end")

    def _first_seed(self) -> int | None:
        """Seed of the first match of this runner; None for a random one."""
        if self.config.seed is None:
            return None
        runner: int = (self.worker_index or 0) * self.num_envs
        return int(self.config.seed) + runner + EVALUATION_SEED * bool(self.config.in_evaluation)

    def _agent_spaces(self) -> dict[str, Any]:
        """Spaces of one agent, by the names that RLlib's episodes have for them."""
        return {
            "observation_space": self.matches.observation_space,
            "action_space": self.matches.action_space,
        }


class _MatchesEnvs(VectorMultiAgentEnv):
    """The spaces of some matches, which RLlib asks its environments for, and their closing."""

    def __init__(self, matches: Matches) -> None:
        self._matches = matches
        self.num_envs = matches.worlds
        self.possible_agents = list(matches.agents)
        self.observation_spaces, self.action_spaces = spaces_by_agent(matches)
        self.observation_space = self.single_observation_space = Dict(self.observation_spaces)
        self.action_space = self.single_action_space = Dict(self.action_spaces)

    def close_extras(self, **kwargs: Any) -> None:  # noqa: ANN401  (RLlib's own)
        """Close the simulator.

        Args:
            **kwargs: ignored.
        """
        self._matches.close()
