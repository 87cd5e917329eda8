"""Opponents of a league in RLlib: the policy mapping, and the copies of the policy."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final, Self

import numpy as np

from rsoccer.frame import team_of
from rsoccer.lineup import DEFAULT_OPPONENT
from rsoccer.train.opponents.opponent_pool import FREEZE_INTERVAL, POOL_SIZE
from rsoccer.train.opponents.pool_slots import PoolSlots, draw
from rsoccer.train.opponents.settings import OpponentSettings

MAIN: Final = "main"
"""Name of the module that learns."""


@dataclass(frozen=True)
class League:
    """A pool of past selves and fixed policies, for tasks in which both teams learn.

    Blue always plays the module `main`, which learns. In each match yellow plays `main` too, or
    one of the frozen modules `past_0`, `past_1` and so on, or a policy of the package, such as the
    script `chase`, which `MatchesEnvRunner` plays by the name `fixed_0`. Every `every` iterations
    `main` is copied to a past self; a full pool evicts as the package's own trainer does. A module
    without a copy yet plays its random initial weights.

    The pool has no state of its own: the weights are in RLlib's checkpoints, and the ages follow
    from the number of the iteration. A restored run therefore continues with the same pool.

    Example:
        >>> from ray.rllib.algorithms.ppo import PPOConfig  # doctest: +SKIP
        >>> league = League(size=4)
        >>> config = PPOConfig().multi_agent(  # doctest: +SKIP
        ...     policies=league.modules,
        ...     policies_to_train=["main"],
        ...     policy_mapping_fn=league.choose,
        ... ).callbacks(on_train_result=league.freeze)
        >>> league.past
        ('past_0', 'past_1', 'past_2', 'past_3')
        >>> mixed = League(latest_fraction=0.1, past_fraction=0.1, fixed={"ou": 1, "chase": 3})
        >>> mixed.fixed_modules, [round(share, 2) for share in mixed.shares[-2:]]
        ({'fixed_0': 'ou', 'fixed_1': 'chase'}, [0.2, 0.6])
    """

    size: int = 8
    """Number of past selves, at least 1."""
    latest_fraction: float = 0.5
    """Share of the matches in which both teams play `main`, 0 to 1."""
    every: int = 20
    """Iterations between two copies, at least 1."""
    past_fraction: float | None = None
    """Share of the matches against past selves, 0 to 1; None is the rest without fixed policies."""
    fixed: Mapping[str, float] = field(default_factory=dict)
    """Policies, names or files, with their shares in all other matches, relative to each other."""

    def __post_init__(self) -> None:
        """Check the shares.

        Raises:
            ValueError: shares whose sum is not 1, or fixed policies without matches.
        """
        selves = self.latest_fraction + (self.past_fraction or 0.0)
        rest = self.past_fraction is not None and selves < 1.0 - 1e-6
        if selves > 1.0 + 1e-6 or rest != bool(self.fixed):
            raise ValueError(
                "league: expected latest_fraction + past_fraction to be 1 without fixed policies, "
                f"and below 1 with them, got {self.latest_fraction} + {self.past_fraction} and "
                f"{dict(self.fixed)}"
            )

    @classmethod
    def of(cls, settings: OpponentSettings) -> Self:
        """Return the league of the trainer's settings, with the trainer's pool of past selves.

        Args:
            settings: shares of the opponents, such as `Args.for_task("VSSMatch-v0").opponents`.

        Raises:
            ValueError: fixed policies in settings that leave no matches for them.
        """
        latest, past = settings.latest_fraction, settings.past_fraction
        fixed = settings.fixed
        if not fixed and latest + past < 1.0 - 1e-6:
            fixed = {DEFAULT_OPPONENT: 1.0}
        return cls(POOL_SIZE, latest, FREEZE_INTERVAL, past, fixed)

    @property
    def past(self) -> tuple[str, ...]:
        """Names of the frozen modules, for `env_config["frozen"]`."""
        return tuple(f"past_{slot}" for slot in range(self.size))

    @property
    def modules(self) -> set[str]:
        """Names of all modules, for `policies`."""
        return {MAIN, *self.past}

    @property
    def fixed_modules(self) -> dict[str, str]:
        """Fixed policies by the names that they are chosen by, for `env_config["fixed"]`."""
        return {f"fixed_{index}": policy for index, policy in enumerate(self.fixed)}

    @property
    def shares(self) -> list[float]:
        """Shares of the matches against `main`, each past self and each fixed policy; sum 1."""
        past = 1.0 - self.latest_fraction if self.past_fraction is None else self.past_fraction
        rest = max(1.0 - self.latest_fraction - past, 0.0)
        total = sum(self.fixed.values())
        scripted = [rest * share / total for share in self.fixed.values()]
        return [self.latest_fraction, *[past / self.size] * self.size, *scripted]

    def choose(self, agent_id: str, episode: Any, **kwargs: Any) -> str:  # noqa: ANN401
        """Return the module or fixed policy of a robot, as RLlib's `policy_mapping_fn`.

        Args:
            agent_id: name of the robot.
            episode: the episode; its random `id_` selects the opponent of the match.
            **kwargs: ignored.
        """
        if team_of(agent_id) == "blue":
            return MAIN
        rng = np.random.default_rng(int(episode.id_, 16))
        names = (MAIN, *self.past, *self.fixed_modules)
        return names[int(draw(rng.uniform(size=1), self.shares)[0])]

    def slots(self, iteration: int) -> Sequence[int]:
        """Return the iterations at which the modules in use were copied, in order of their slots.

        Args:
            iteration: number of iterations that are complete.
        """
        slots = PoolSlots(self.size)
        for update in range(self.every, iteration + 1, self.every):
            slots.take(update)
        return slots.frozen_at

    def freeze(self, algorithm: Any, **kwargs: Any) -> None:  # noqa: ANN401
        """Copy `main` if it is time, as RLlib's callback `on_train_result`.

        Args:
            algorithm: the algorithm, whose learners and runners get the copy.
            **kwargs: ignored.
        """
        iteration = algorithm.iteration
        if iteration % self.every:
            return
        target = self.past[self.slots(iteration).index(iteration)]

        def copy(learner: Any) -> None:  # noqa: ANN401
            learner.module[target].set_state(learner.module[MAIN].get_state())

        algorithm.learner_group.foreach_learner(copy)
        state = algorithm.learner_group.get_state(
            components=f"learner/rl_module/{target}", inference_only=True
        )["learner"]["rl_module"]
        # Without a sequence number: RLlib would take the copy for weights that the runners have.
        algorithm.env_runner_group.foreach_env_runner(
            lambda runner: runner.set_state({"rl_module": state})
        )
