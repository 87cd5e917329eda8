"""Policies that try actions in a model of the match before they choose: `best:lookahead`.

At each control step a team draws joint actions around the means of its policy, half of them as
widely as in training and half more widely. A model of the match plays each of them for a decision
of the training, while all other robots play the means of the policy in their place. The value
network says what the state that follows is worth. The team plays the joint action with the greatest
sum of rewards and value over its robots. This is a one-step lookahead with a learned value, a kind
of decision-time planning (Sutton and Barto, "Reinforcement Learning: An Introduction", 2018,
chapter 8).

Where even that joint action is worth little, a goal against the team is near, and one decision
saves nothing. There the team tries whole sequences of decisions: its policy plays, with noise of
each sequence's own, and the means of the policy play for all others. The first joint action of the
sequence with the greatest return is played (random shooting: Nagabandi and others, "Neural Network
Dynamics for Model-Based Deep Reinforcement Learning with Model-Free Fine-Tuning", 2018).
"""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from rsoccer._core import Threads
from rsoccer.policies.base import Observes, Policy
from rsoccer.policies.forward_model import ForwardModel
from rsoccer.policies.other_task import fitted
from rsoccer.policies.policy_file import LOOKAHEAD
from rsoccer.registry import as_task, make_task, task_with_options
from rsoccer.view import SIDES

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from rsoccer.arrays import Floats, Mask
    from rsoccer.policies.base import MatchState, Memory, PolicyInput
    from rsoccer.policies.network import Network
    from rsoccer.rng import WorldRng
    from rsoccer.task import Task

    Indices = NDArray[np.intp]

CANDIDATES: Final = 16
"""Joint actions that a team tries, with the one of the policy's means."""
SPREAD: Final = 0.3
"""Standard deviation of the wider half of them."""
GROUP: Final = 16
"""Worlds that plan at once, a power of two, so that their copies stay in the cache."""
DANGER: Final = 0.7
"""Return of each robot of a team below which the team tries sequences, in the rewards' standard
deviation."""
SEQUENCES: Final = 64
"""Sequences of decisions that a team tries in danger, with the one of the policy's means."""
DECISIONS: Final = 8
"""Decisions of a sequence: .6 s with those of 75 ms, in which a ball crosses half a VSSS field."""
SEQUENCE_SPREADS: Final = (0.3, 0.8)
"""Standard deviations of the noise of both halves of the sequences."""
SEQUENCE_GROUP: Final = 4
"""Worlds that try sequences at once, a power of two."""
BODIES: Final = ("field", "robot", "ball", "n_blue", "n_yellow", "n_opponents", "engine")
"""Options of a task that decide what moves, and are those of the match in the model."""
_LAST: Final = "last"
"""Name of the memory: (n, all robots, action) last actions, those of other robots as planned."""


class Lookahead(Policy):
    """A network that tries joint actions of its team in a model of the match before it acts.

    It plays tasks whose robots are those of the network's own task, from what the robots know:
    behind a forecast, from the state in which their commands act. It decides in every control step,
    whatever the network's `action_repeat`, and draws with the random stream of each world. The
    shield changes what was chosen, not what is tried.

    Matrix products are not bit-equal between batch sizes, so two actions that are worth almost the
    same may be chosen in another order there, and sequences may be tried or not where a return is
    almost `DANGER`, as rarely as two numbers agree to 1e-6.

    Example:
        >>> import rsoccer
        >>> matches = rsoccer.Matches("VSSMatch-v0", controllers={"blue": "best:lookahead"})

    Attributes:
        network: the network with its value network, for the robots of the task.
        task: the task of the model.
    """

    observes: Observes = "view"

    def __init__(self, network: Network, task: Task | str) -> None:
        """Plan for the robots of a task.

        Args:
            network: a policy with a value network, a plain Gaussian of constant standard deviation
                and no history.
            task: the task to be played, or its name.

        Raises:
            ValueError: another policy, or one whose task has other robots or other actions, or
                keeps more of a match than the state of its bodies.
        """
        task = as_task(task)
        super().__init__(task)
        _check(network)
        self.task = _model_task(network, task)
        self.network = fitted(network, self.task) if _differs(network, self.task) else network
        self.forecasts, self.needs_forecast = network.forecasts, network.needs_forecast
        self._trained_on = network.task_name, network.task_options
        self._models = threading.local()
        ForwardModel(self.task, [0], 1, Threads())  # refuses a task that keeps more

    @property
    def task_name(self) -> str:
        """Name of the task that the network was trained on, for `make_task`."""
        return self._trained_on[0]

    @property
    def task_options(self) -> dict[str, Any]:
        """Options of that task in the training, for `make_task`."""
        return self._trained_on[1]

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        """Return the last actions of all robots of the match, which networks observe."""
        return {_LAST: np.zeros((shape[0], *self._shape), np.float32)}

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Return actions (n, robots, action): the best of those that were tried, behind the shield.

        Raises:
            ValueError: no state of the match.
        """
        match = inputs.match
        if match is None:
            raise ValueError(f"a {type(self).__name__} needs the state of the match, got none")
        last, acting = memory[_LAST], self._acting(match)
        last[~acting] = 0.0
        worlds = acting.nonzero()[0]
        for group, padded, streams in _groups(worlds, GROUP, rng):
            planned = self._planned(match.take(padded), last[padded], streams, len(group))
            last[group] = planned[: len(group)]
        actions = last[:, match.robots]
        if self.network.shield is not None:
            self.network.shield.apply(match, actions)
            last[:, match.robots] = actions
        return inputs.completed(actions)

    def _acting(self, match: MatchState) -> Mask:
        """Worlds (n,) in which a robot may do anything: the shield has all stand in a stop."""
        acting = np.ones(len(match.rows), np.bool_) if match.playing is None else match.playing
        shield = self.network.shield
        if shield is None or shield.name != "vsss" or "referee" not in match.game:
            return acting
        return np.logical_and(acting, match.game.may_touch[:, match.robots].any(axis=1))

    def _planned(self, match: MatchState, last: Floats, rng: WorldRng, count: int) -> Floats:
        """Actions of all robots, (n, robots, action): the best ones, and means of others.

        Only the first `count` worlds try sequences; the others are copies.
        """
        n, robots = len(match.rows), match.robots
        model = self._model(self._players, n, match.threads)
        means = np.zeros((n, *self._shape), np.float32)
        means[:, self._players] = self.network.mean_actions(model.observe(match.rows, last))
        planned = means.copy()
        for team in range(len(SIDES)):  # what one gains the other loses, so each plans for itself
            own = robots[(robots >= self.task.n_blue) == team]
            if len(own):
                tried = self._tried(means, own, rng)
                returns = self._returns(match, own, tried)
                best = returns.argmax(axis=1)
                planned[:, own] = tried[np.arange(n), best][:, own]
                in_danger = returns.max(axis=1) < DANGER * len(own)
                self._escape(in_danger[:count].nonzero()[0], match, own, means, planned, rng)
        return planned

    def _escape(
        self,
        worlds: Indices,
        match: MatchState,
        own: Indices,
        means: Floats,
        planned: Floats,
        rng: WorldRng,
    ) -> None:
        """Write the first actions of the best sequences of a team in some worlds into a plan."""
        for group, padded, streams in _groups(worlds, SEQUENCE_GROUP, rng):
            tried = np.repeat(means[padded, None], SEQUENCES, axis=1)
            tried[:, 1, own] = planned[padded][:, own]
            noise = _sequence_noise(streams, (len(own), self.network.action_size))
            actions = self._best_first(match.take(padded), own, tried, noise)
            planned[group[:, None], own] = actions[: len(group)]

    def _best_first(self, match: MatchState, own: Indices, tried: Floats, noise: Floats) -> Floats:
        """First actions (n, own robots, action) of the sequence with the greatest return.

        Args:
            match: the match as the robots know it.
            own: indices of the team's robots.
            tried: (n, sequences, robots, action) first actions of all robots, without noise.
            noise: (n, sequences, decisions, own robots, action) what is added to actions.
        """
        value, n = self.network.value, len(tried)
        assert value is not None, "checked by the constructor"
        players = self._players
        model = self._model(players, n * SEQUENCES, match.threads)
        copies, rewarded = np.repeat(np.arange(n), SEQUENCES), np.searchsorted(players, own)
        model.place(match.rows[copies], match.game.take(copies))
        actions = tried.reshape(model.worlds, *self._shape)
        noise = noise.reshape(model.worlds, *noise.shape[2:])
        returns, weight = np.zeros(model.worlds, np.float32), np.ones(model.worlds, np.float32)
        actions[:, own] = np.clip(actions[:, own] + noise[:, 0], -1.0, 1.0)
        begun = actions[:, own].reshape(n, SEQUENCES, len(own), -1)
        for later in range(1, DECISIONS + 1):
            rewards, ended, observations = model.advance(actions, value.action_repeat)
            returns += weight * rewards[:, rewarded].sum(axis=1) / np.float32(value.reward_std)
            weight *= np.where(ended, np.float32(0.0), np.float32(value.discount))
            if later < DECISIONS:
                actions = np.zeros_like(actions)
                actions[:, players] = self.network.mean_actions(observations)
                actions[:, own] = np.clip(actions[:, own] + noise[:, later], -1.0, 1.0)
        returns += weight * self.network.values(observations[:, rewarded]).sum(axis=1)
        best = returns.reshape(n, SEQUENCES).argmax(axis=1)
        chosen: Floats = begun[np.arange(n), best]
        return chosen

    def _tried(self, means: Floats, robots: Indices, rng: WorldRng) -> Floats:
        """Actions of all robots (n, candidates, robots, action), first the means."""
        size = self.network.action_size
        spread = np.full((CANDIDATES - 1, 1, size), SPREAD, np.float32)
        spread[: CANDIDATES // 2 - 1] = self.network.action_std
        tried = np.repeat(means[:, None], CANDIDATES, axis=1)
        tried[:, 1:, robots] += rng.normal((CANDIDATES - 1, len(robots), size)) * spread
        return np.clip(tried, -1.0, 1.0, out=tried)

    def _returns(self, match: MatchState, robots: Indices, tried: Floats) -> Floats:
        """Expected returns of what was tried, summed over robots of a team, (n, candidates)."""
        value, n = self.network.value, len(tried)
        assert value is not None, "checked by the constructor"
        model = self._model(robots.tolist(), n * CANDIDATES, match.threads)
        copies = np.repeat(np.arange(n), CANDIDATES)
        model.place(match.rows[copies], match.game.take(copies))
        actions = tried.reshape(model.worlds, *self._shape)
        rewards, ended, observations = model.advance(actions, value.action_repeat)
        later = np.where(ended[:, None], np.float32(0.0), self.network.values(observations))
        expected = rewards / np.float32(value.reward_std) + np.float32(value.discount) * later
        returns: Floats = expected.sum(axis=1).reshape(n, CANDIDATES)
        return returns

    @property
    def _shape(self) -> tuple[int, int]:
        """Shape (robots, action) of the actions of a match."""
        return len(self.task.robots), self.network.action_size

    @property
    def _players(self) -> list[int]:
        """Robots that the network can play: those of the sides that have observations."""
        n_blue = self.task.n_blue
        sides = [SIDES[robot >= n_blue] for robot in range(len(self.task.robots))]
        return [robot for robot, side in enumerate(sides) if side in self.task.sides]

    def _model(self, observers: Sequence[int], worlds: int, threads: Threads) -> ForwardModel:
        """The model for some observers, which later calls in this thread use again."""
        key = (threads.count, worlds, *observers)
        models = self._models.__dict__.setdefault("by_key", dict[tuple[int, ...], ForwardModel]())
        model: ForwardModel | None = models.get(key)
        if model is None:
            model = models[key] = ForwardModel(self.task, observers, worlds, threads)
        return model

    def __getstate__(self) -> dict[str, Any]:
        """Everything but the models, which the next use makes anew."""
        return {name: value for name, value in self.__dict__.items() if name != "_models"}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Begin without models."""
        self.__dict__.update(state, _models=threading.local())


def _groups(
    worlds: Indices, most: int, rng: WorldRng
) -> Iterator[tuple[Indices, Indices, WorldRng]]:
    """Groups of worlds, the same with copies of the last one, and the streams of the latter.

    Copies are added up to a power of two, as few sizes need few models. What a group has drawn from
    its streams, but for those of copies, is drawn from `rng` too.
    """
    for first in range(0, len(worlds), most):
        group = worlds[first : first + most]
        size = 1 << (len(group) - 1).bit_length()
        padded = np.pad(group, (0, size - len(group)), mode="edge")
        streams = rng[padded]
        yield group, padded, streams
        rng.put(group, streams[np.arange(len(group))])


def _sequence_noise(rng: WorldRng, shape: tuple[int, int]) -> Floats:
    """Noise (n, sequences, decisions, *shape): none in the first two, constant in every other."""
    spread = np.full((SEQUENCES, 1, 1, 1), SEQUENCE_SPREADS[1], np.float32)
    spread[: SEQUENCES // 2] = SEQUENCE_SPREADS[0]
    noise: Floats = rng.normal((SEQUENCES, DECISIONS, *shape)) * spread
    noise[:, 1::2] = noise[:, 1::2, :1]
    noise[:, :2] = 0.0
    return noise


def _check(network: Network) -> None:
    """Refuse a network without what a lookahead needs."""
    missing = {
        "a value network": network.value is None,
        "a plain Gaussian head": network.head.kind != "gaussian",
        "a constant action_std": network.action_std is None,
        "no history": network.history > 1,
    }
    lacking = [name for name, is_missing in missing.items() if is_missing]
    if lacking:
        raise ValueError(
            f"{LOOKAHEAD}: expected a policy with {', '.join(missing)}, got one of "
            f"{network.task_name!r} that lacks {', '.join(lacking)}"
        )


def _model_task(network: Network, task: Task) -> Task:
    """The task of the network with the bodies of another one."""
    known = getattr(make_task(network.task_name), "__dataclass_fields__", {})
    names = [name for name in BODIES if name in known and hasattr(task, name)]
    options = {name: getattr(task, name) for name in names}
    expected = f"{LOOKAHEAD}: expected field, robots and actions that {network.task_name} can have"
    try:
        model = task_with_options(network.task_name, {**network.task_options, **options})
    except ValueError as error:
        raise ValueError(f"{expected}, got those of {task.name}: {error}") from error
    longer = model.action_size + task.optional_action_size
    fits = model.action_size <= task.action_size <= longer
    if model.config != task.config or model.action_meaning != task.action_meaning or not fits:
        raise ValueError(f"{expected}, got those of {task.name}")
    return model


def _differs(network: Network, task: Task) -> bool:
    """Whether a network observes something else than a task has."""
    return network.metadata.get("layout") != task.layout.text
