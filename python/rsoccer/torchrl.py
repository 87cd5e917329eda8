"""TorchRL: many matches of a task as one batched environment.

>>> from rsoccer.torchrl import SoccerEnv  # doctest: +SKIP
>>> env = SoccerEnv("VSSSelfPlay-v0", worlds=64, state=True)  # doctest: +SKIP
>>> env.rollout(100, break_when_any_done=False)["blue", "observation"].shape  # doctest: +SKIP
torch.Size([64, 100, 3, 80])

It needs TorchRL: `pip install "torchrl>=0.14"`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rsoccer import checks
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.controllers import Controllers
from rsoccer.envs.env_matches import EnvMatches
from rsoccer.envs.options import learner_controllers
from rsoccer.frame import team_of
from rsoccer.global_state import LIMIT
from rsoccer.matches import result_checks
from rsoccer.randomization import Ranges
from rsoccer.registry import resolve_task
from rsoccer.sources import SensingSource, SimulatorSource, closed_on_error
from rsoccer.task import Task

try:
    import torch
    from tensordict import TensorDict, TensorDictBase
    from torchrl.data import Bounded, Categorical, Composite, Unbounded
    from torchrl.envs import EnvBase
    from torchrl.envs.utils import MarlGroupMapType, check_marl_grouping
except ImportError as error:
    raise ImportError('rsoccer.torchrl needs TorchRL: pip install "torchrl>=0.14"') from error

GroupMap = Mapping[str, Sequence[str]]
"""Names of the learners by group."""
ENDS = ("done", "terminated", "truncated")
"""Keys of the ends of episodes."""
KEYS = (*ENDS, "state", "metrics", "next", "_reset")
"""Keys beside those of groups."""


class SoccerEnv(EnvBase):
    """n matches of a task as a TorchRL environment with the batch size (n,).

    Learners are in groups: their teams, "blue" and "yellow", by default. A group of k learners
    has a nested TensorDict of batch size (n, k), as TorchRL's multi-agent losses expect:

    | key | shape | content |
    | --- | --- | --- |
    | `(group, "observation")` | (n, k, o) float32 | observations |
    | `(group, "action")` | (n, k, action) float32 | from -1 to 1; beyond, it is clipped |
    | `(group, "action")` | (n, k) int64 | the same for a task with an `action_table`: row indices |
    | `("next", group, "reward")` | (n, k, 1) float32 | rewards |
    | `(group, "done")`, also `terminated`, `truncated` | (n, k, 1) bool | ends, as below |
    | `done`, `terminated`, `truncated` | (n, 1) bool | ends of the matches |
    | `state` | (n, s) float32 | the global state for centralized critics; only with `state=True` |
    | `("metrics", name)` | (n, 1) float32 | metrics of the task; valid where `done` |

    Ends: `terminated` is the task's end, such as a goal, and `truncated` the time limit, whose
    value can be bootstrapped. The environment resets nothing by itself. TorchRL resets the
    matches that are done, by the mask `_reset`, so observations and the state under "next" are
    the last ones of their episode. A match that is done and not reset waits, and remains done.

    Seeding: `set_seed(s)` seeds the next reset of all matches, match i with `s + i`; it then
    equals `Matches.reset(seed=s)` bit for bit. Later resets continue the random streams.

    Attributes:
        matches: the matches.
        group_map: names of the learners by group.
        task: the task that is played.

    Example:
        >>> env = SoccerEnv("VSS-v0", worlds=8)  # doctest: +SKIP
        >>> env.group_map  # doctest: +SKIP
        {'blue': ['blue_0']}
    """

    def __init__(
        self,
        task: Task | str,
        worlds: int = 1,
        *,
        seed: int | None = None,
        threads: int = 1,
        controllers: Controllers | None = None,
        learner: str | None = None,
        simulator: SimulatorSource | None = None,
        sensing: SensingSource | None = None,
        randomization: Ranges | None = None,
        history: int = 1,
        group_map: GroupMap | MarlGroupMapType | None = None,
        state: bool = False,
        device: Any = None,  # noqa: ANN401  (torch's own union)
        max_steps: int | None = None,
        **options: Any,  # noqa: ANN401  (fields of the task, checked by the registry)
    ) -> None:
        """Prepare matches; `reset` begins them.

        Args:
            task: a task or the name of a registered one.
            worlds: number of matches, n, at least 1.
            seed: seed of the first match, at least 0; match i is seeded with `seed + i`. None for
                a random one.
            threads: threads for physics, observations and rewards, at least 1.
            controllers: `LEARN`, a policy, its name or its file, by robot ("blue_1"), team
                ("blue") or "all"; the task's defaults apply elsewhere, and "ou" in place of further
                learners if `learner` is given.
            learner: the only robot that learns, such as "blue_0"; None for all robots that the
                task and `controllers` let learn.
            simulator: moves the robots, as for `Matches`. With a simulator itself the environment
                cannot be copied.
            sensing: what robots know of the true state, as for `Matches`.
            randomization: numbers that each episode draws, as for `Matches`.
            history: observations in a stacked one, as for `Matches`.
            group_map: names of the learners by group, or one of TorchRL's `MarlGroupMapType`;
                None for teams. `MarlGroupMapType.ALL_IN_ONE_GROUP` is one group "agents".
            state: True for the global state under "state".
            device: torch device of the returned tensors; None for the CPU.
            max_steps: time limit of an episode in control steps, at least 1; None for the task's.
            **options: options of a registered task, the fields of its class.

        Raises:
            ImportError: a text "module:name" whose module or name does not exist.
            TypeError: an argument of the wrong type, or options for a `Task` object.
            ValueError: an unknown task, option, controller or device, a number out of range, no
                robot that learns, or groups that do not hold each learner once.
        """
        self.task = resolve_task(task, max_steps, options, SoccerEnv.__init__)
        self.matches = EnvMatches(
            self.task,
            worlds,
            seed,
            threads=threads,
            controllers=learner_controllers(self.task, learner, controllers),
            autoreset="disabled",
            simulator=simulator,
            sensing=sensing,
            randomization=randomization,
            history=history,
        )
        with closed_on_error(self.matches):
            self._prepare(group_map, state, device)

    def _prepare(
        self,
        group_map: GroupMap | MarlGroupMapType | None,
        state: bool,
        device: Any,  # noqa: ANN401
    ) -> None:
        """Set everything but the matches."""
        super().__init__(device=_device(device), batch_size=(self.matches.worlds,))
        self.group_map = _groups(group_map, self.matches.agents)
        names = self.matches.agents
        self._columns = {
            group: _indices([names.index(agent) for agent in agents])
            for group, agents in self.group_map.items()
        }
        self._with_state = checks.boolean("state", state)
        metrics = self.task.metrics(self.matches.play)
        self._metrics = tuple(result_checks.metrics(self.task, metrics, self.matches.worlds))
        self._last_metrics: Mapping[str, Floats] = {
            name: np.zeros(self.matches.worlds, np.float32) for name in self._metrics
        }
        self._ends = np.zeros((2, self.matches.worlds), np.bool_)  # terminated, truncated
        self._pending_seed: int | None = None
        self._make_specs()

    def close(self, *, raise_if_closed: bool = True) -> None:
        """Close the simulator; may be repeated.

        Args:
            raise_if_closed: ignored, as by TorchRL's own environments.
        """
        super().close(raise_if_closed=raise_if_closed)
        self.matches.close()

    def _make_specs(self) -> None:
        """Describe all keys, for TorchRL's checks and buffers."""
        n, size = self.matches.worlds, self.matches.observation_size
        bounds = self.matches.observation_low, self.matches.observation_high
        low, high = (torch.from_numpy(bound) for bound in bounds)
        observations, actions, rewards, done = (Composite(shape=(n,)) for _ in range(4))
        for group, agents in self.group_map.items():
            k = len(agents)
            shape = (n, k, size)
            observations[group] = Composite(
                observation=Bounded(low.expand(shape), high.expand(shape), dtype=torch.float32),
                shape=(n, k),
            )
            actions[group] = Composite(action=self._action_spec(k), shape=(n, k))
            rewards[group] = Composite(reward=Unbounded((n, k, 1)), shape=(n, k))
            done[group] = Composite(_ends_spec((n, k, 1)), shape=(n, k))
        for name, spec in _ends_spec((n, 1)).items():
            done[name] = spec
        if self._with_state:
            observations["state"] = Bounded(-LIMIT, LIMIT, (n, self.matches.state_size))
        if self._metrics:
            observations["metrics"] = Composite(
                {name: Unbounded((n, 1)) for name in self._metrics}, shape=(n,)
            )
        self.observation_spec, self.action_spec = observations, actions
        self.reward_spec, self.done_spec = rewards, done

    def _action_spec(self, k: int) -> Bounded | Categorical:
        """Specification of the actions of k learners in all matches."""
        n = self.matches.worlds
        if (table := self.task.action_table) is not None:
            return Categorical(len(table), shape=(n, k), dtype=torch.int64)
        return Bounded(-1.0, 1.0, (n, k, self.task.action_size), dtype=torch.float32)

    def _reset(self, tensordict: TensorDictBase | None = None, **kwargs: Any) -> TensorDictBase:  # noqa: ANN401
        """Begin episodes in the matches of the mask `_reset`, or in all.

        TorchRL passes on further arguments of `reset`, and none of its own.
        """
        if kwargs:
            raise TypeError(
                f"reset: expected no arguments beside the tensordict, got {sorted(kwargs)}; "
                "set_seed(s) seeds the next reset"
            )
        mask: Mask | None = None
        given = None if tensordict is None else tensordict.get("_reset", None)
        if given is not None and not bool(given.all()):
            mask = given.reshape(-1).numpy(force=True)
        seed = None
        if mask is None:
            seed, self._pending_seed = self._pending_seed, None
        observations = self.matches.reset(seed, mask)
        worlds = slice(None) if mask is None else mask
        self._ends[:, worlds] = False
        metrics = {name: values.copy() for name, values in self._last_metrics.items()}
        for values in metrics.values():
            values[worlds] = 0.0
        self._last_metrics = metrics
        return self._tensors(observations, None, metrics)

    def _step(self, tensordict: TensorDictBase) -> TensorDictBase:
        """Advance all matches by one control step."""
        matches = self.matches
        outcome = matches.step(self._actions(tensordict))
        # Matches that wait for a reset report no end again.
        terminated, truncated = self._ends
        terminated |= outcome.terminated
        truncated |= outcome.truncated
        self._last_metrics = outcome.metrics
        return self._tensors(outcome.observations, outcome.rewards, outcome.metrics)

    def _step_proc_data(self, next_tensordict_out: TensorDictBase) -> TensorDictBase:
        """Skip TorchRL's completion of keys, a fifth of its time: no key is missing."""
        if self.run_type_checks:
            return super()._step_proc_data(next_tensordict_out)
        return next_tensordict_out

    def _set_seed(self, seed: int | None) -> None:
        """Seed the next reset of all matches."""
        self._pending_seed = None if seed is None else checks.integer("seed", seed, 0)

    def _actions(self, tensordict: TensorDictBase) -> Array:
        """Actions of all groups: vectors (n, agents, action) or indices (n, agents)."""
        parts = {
            group: tensordict.get((group, "action")).numpy(force=True) for group in self._columns
        }
        first: Array = next(iter(parts.values()))
        shape = (self.matches.worlds, len(self.matches.agents), *first.shape[2:])
        actions = np.empty(shape, first.dtype)
        for group, columns in self._columns.items():
            actions[:, columns] = parts[group]
        return actions

    def _tensors(
        self, observations: Floats, rewards: Floats | None, metrics: Mapping[str, Floats]
    ) -> TensorDictBase:
        """All keys after a reset, or after a step, which has rewards.

        The specifications hold by construction, so `TensorDict`'s checks of shapes, half of the
        time of this method, are left out.
        """
        size = torch.Size
        n = self.matches.worlds
        ends = np.empty((3, n, 1, 1), np.bool_)
        ends[1:, :, 0, 0] = self._ends
        np.logical_or(ends[1], ends[2], out=ends[0])
        content: dict[str, Any] = _named_ends(ends[..., 0])
        for group, columns in self._columns.items():
            k = len(self.group_map[group])
            part = _named_ends(ends.repeat(k, axis=2))
            part["observation"] = torch.from_numpy(observations[:, columns])
            if rewards is not None:
                part["reward"] = torch.from_numpy(rewards[:, columns, None])
            content[group] = TensorDict._new_unsafe(part, size((n, k)))
        if self._with_state:
            content["state"] = torch.from_numpy(self.matches.states())
        if self._metrics:
            parts = {name: torch.from_numpy(metrics[name].reshape(n, 1)) for name in self._metrics}
            content["metrics"] = TensorDict._new_unsafe(parts, size((n,)))
        tensors = TensorDict._new_unsafe(content, size((n,)))
        return tensors if self.device is None else tensors.to(self.device)


def _named_ends(ends: Mask) -> dict[str, Any]:
    """Tensors of done, terminated and truncated (3, ...) by name, in one memory."""
    return dict(zip(ENDS, torch.from_numpy(ends).unbind(), strict=True))


def _groups(
    given: GroupMap | MarlGroupMapType | None, agents: Sequence[str]
) -> dict[str, list[str]]:
    """Names of the learners by group, checked."""
    if given is None:
        teams = dict.fromkeys(map(team_of, agents))
        return {team: [name for name in agents if team_of(name) == team] for team in teams}
    if isinstance(given, MarlGroupMapType):
        found: dict[str, list[str]] = given.get_group_map(list(agents))
        return found
    if not isinstance(given, Mapping):
        raise TypeError(f"group_map: expected names of learners by group, got {given!r}")
    for group, names in given.items():
        if isinstance(names, str) or not isinstance(names, Sequence):
            raise TypeError(f"group_map[{group!r}]: expected names of learners, got {names!r}")
    if taken := [group for group in given if group in KEYS]:
        raise ValueError(f"group_map: expected other names of groups than {KEYS}, got {taken}")
    groups = {group: list(names) for group, names in given.items()}
    try:
        check_marl_grouping(groups, list(agents))
    except ValueError as error:
        raise ValueError(f"group_map: {error}") from error
    return groups


def _device(given: Any) -> torch.device | None:  # noqa: ANN401
    """A torch device, or None."""
    try:
        return None if given is None else torch.device(given)
    except (RuntimeError, TypeError) as error:
        raise ValueError(f"device: expected a torch device, got {given!r}") from error


def _indices(columns: list[int]) -> slice | NDArray[np.intp]:
    """Indices of learners; a slice, which copies nothing, where possible."""
    if columns == list(range(columns[0], columns[0] + len(columns))):
        return slice(columns[0], columns[0] + len(columns))
    return np.array(columns, np.intp)


def _ends_spec(shape: tuple[int, ...]) -> dict[str, Categorical]:
    """Specifications of done, terminated and truncated."""
    return {name: Categorical(2, shape=shape, dtype=torch.bool) for name in ENDS}
