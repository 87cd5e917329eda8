"""Policies that try actions in a model of the match before they choose: `best:lookahead`.

At each control step a team draws joint actions around those of its policy, half of them as widely
as in training and half more widely. A model of the match plays each of them for a decision of the
training, and all other robots as the policy would have them play. The value network says what the
state that follows is worth. The team plays the joint action with the greatest sum of rewards and
value over its robots. This is a one-step lookahead with a learned value: chapter 8 of
Sutton and Barto, "Reinforcement Learning: An Introduction" (2018), calls it decision-time planning.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from rsoccer._core import Threads
from rsoccer.policies.base import Observes, Policy
from rsoccer.policies.forward_model import ForwardModel
from rsoccer.policies.names import LOOKAHEAD
from rsoccer.policies.other_task import fitted
from rsoccer.registry import make_task, task_with_options
from rsoccer.view import SIDES

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from rsoccer.arrays import Floats
    from rsoccer.policies.base import MatchState, Memory, PolicyInput
    from rsoccer.policies.network import Network
    from rsoccer.rng import WorldRng
    from rsoccer.task import Task

    Indices = NDArray[np.intp]

CANDIDATES: Final = 32
"""Joint actions that a team tries, with the one of the policy's means."""
SPREAD: Final = 0.3
"""Standard deviation of the wider half of them."""
GROUP: Final = 16
"""Worlds that plan at once, a power of two, so that their copies stay in the cache."""
BODIES: Final = ("field", "robot", "ball", "n_blue", "n_yellow", "engine")
"""Options of a task that decide what moves, and are those of the match in the model."""


class Lookahead(Policy):
    """A network that tries joint actions of its team in a model of the match before it acts.

    It plays tasks whose robots are those of the network's own task, from what the robots know:
    behind a forecast, from the state in which their commands act. It decides in every control step,
    whatever the network's `action_repeat`, and draws with the random stream of each world. Matrix
    products are not bit-equal between batch sizes, as for `Network`.

    Example:
        >>> import rsoccer
        >>> matches = rsoccer.Matches("VSSMatch-v0", controllers={"blue": "best:lookahead"})

    Attributes:
        network: the network with its value network.
        task: the task of the model.
    """

    observes: Observes = "view"

    def __init__(self, network: Network, task: Task) -> None:
        """Plan for the robots of a task.

        Args:
            network: a policy with a value network and without a history.
            task: the task to be played.

        Raises:
            ValueError: a policy without a value network or with a history, or one that was trained
                on a task of other robots, or with memory beyond the state of its bodies.
        """
        super().__init__(task)
        if network.value is None or network.history > 1:
            raise ValueError(
                f"{LOOKAHEAD}: expected a policy with a value network and without a history, got "
                f"another one of {network.task_name!r}; `rsoccer train` writes such policies "
                "unless the critic is central"
            )
        self.task = _model_task(network, task)
        self.network = fitted(network, self.task) if _differs(network, self.task) else network
        self.forecasts, self.needs_forecast = network.forecasts, network.needs_forecast
        self._learners = [self.task.robots.index(name) for name in self.task.agents]
        self._models: dict[tuple[str | int, ...], ForwardModel] = {}
        self._model("now", self._learners, 1, Threads())  # refuses a task with memory

    @property
    def task_name(self) -> str:
        """Name of the task that the network was trained on, for `make_task`."""
        return self.network.task_name

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Return actions (n, robots, action): the best of those that were tried, behind the shield.

        Raises:
            ValueError: no state of the match, or a robot that the network does not play.
        """
        match = inputs.match
        if match is None:
            raise ValueError(f"a {type(self).__name__} needs the state of the match, got none")
        strangers = sorted(set(match.robots.tolist()) - set(self._learners))
        if strangers:
            raise ValueError(
                f"{LOOKAHEAD}: expected robots that learn in {self.task.name}, {self.task.agents}, "
                f"got {[self.task.robots[robot] for robot in strangers]}"
            )
        actions = np.zeros((len(match.rows), len(match.robots), self.task.action_size), np.float32)
        worlds = np.arange(len(actions)) if match.playing is None else match.playing.nonzero()[0]
        for first in range(0, len(worlds), GROUP):
            group = worlds[first : first + GROUP]
            size = 1 << (len(group) - 1).bit_length()  # few sizes need few models
            padded = np.pad(group, (0, size - len(group)), mode="edge")
            streams = rng[padded]
            planned = self._planned(match.rows[padded], match, streams)
            actions[group] = planned[: len(group)]
            rng.put(group, streams[np.arange(len(group))])
        if self.network.shield is not None:
            self.network.shield.apply(match, actions)
        return inputs.completed(actions)

    def _planned(self, rows: Floats, match: MatchState, rng: WorldRng) -> Floats:
        """Best actions of the robots in some worlds, (n, robots, action)."""
        robots = match.robots
        model = self._model("now", self._learners, len(rows), match.threads)
        means = np.zeros((len(rows), len(self.task.robots), self.task.action_size), np.float32)
        means[:, self._learners] = self.network.mean_actions(model.observe(rows))
        actions = means[:, robots]
        for team in range(len(SIDES)):  # what one gains the other loses, so each plans for itself
            of_team = np.flatnonzero((robots >= self.task.n_blue) == team)
            if len(of_team):
                own = robots[of_team]
                tried = self._tried(means, own, rng)
                best = self._returns(rows, own, tried, match.threads).argmax(axis=1)
                actions[:, of_team] = tried[np.arange(len(best)), best][:, own]
        return actions

    def _tried(self, means: Floats, robots: Indices, rng: WorldRng) -> Floats:
        """Actions of all robots (n, candidates, robots, action), first the means."""
        size, own = self.network.action_size, self.network.action_std
        spread = np.full((CANDIDATES - 1, 1, size), SPREAD, np.float32)
        if own is not None:
            spread[: CANDIDATES // 2 - 1] = own
        tried = np.repeat(means[:, None], CANDIDATES, axis=1)
        tried[:, 1:, robots] += rng.normal((CANDIDATES - 1, len(robots), size)) * spread
        return np.clip(tried, -1.0, 1.0, out=tried)

    def _returns(self, rows: Floats, robots: Indices, tried: Floats, threads: Threads) -> Floats:
        """What robots of a team may expect together of what was tried, (n, candidates)."""
        value, n = self.network.value, len(rows)
        assert value is not None, "checked by the constructor"
        model = self._model("later", robots.tolist(), n * CANDIDATES, threads)
        model.place(np.repeat(rows, CANDIDATES, axis=0))
        actions = tried.reshape(model.worlds, *tried.shape[2:])
        rewards, ended, observations = model.advance(actions, value.action_repeat)
        later = np.where(ended[:, None], np.float32(0.0), self.network.values(observations))
        expected = rewards / np.float32(value.reward_std) + np.float32(value.discount) * later
        returns: Floats = expected.sum(axis=1).reshape(n, CANDIDATES)
        return returns

    def _model(
        self, moment: str, observers: Sequence[int], worlds: int, threads: Threads
    ) -> ForwardModel:
        """The model for a moment and some observers, which later calls use again."""
        key: tuple[str | int, ...] = (moment, worlds, *observers)
        model = self._models.get(key)
        if model is None:
            model = self._models[key] = ForwardModel(self.task, observers, worlds, threads)
        return model

    def __getstate__(self) -> dict[str, object]:
        """Everything but the models, which the next use makes anew."""
        return {**self.__dict__, "_models": {}}


def _model_task(network: Network, task: Task) -> Task:
    """The task of the network with the bodies of another one."""
    options = {name: getattr(task, name) for name in BODIES if hasattr(task, name)}
    own = make_task(network.task_name)
    options = {name: value for name, value in options.items() if hasattr(own, name)}
    expected = f"{LOOKAHEAD}: expected field and robots that {network.task_name} can have"
    try:
        model = task_with_options(network.task_name, {**network.task_options, **options})
    except ValueError as error:
        raise ValueError(f"{expected}, got those of {task.name}: {error}") from error
    if model.config != task.config:
        raise ValueError(f"{expected}, got those of {task.name}")
    return model


def _differs(network: Network, task: Task) -> bool:
    """Whether a network observes something else than a task has."""
    return network.metadata.get("layout") != task.layout.text
