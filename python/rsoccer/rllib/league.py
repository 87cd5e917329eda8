"""Opponents of a league in RLlib: the policy mapping, and the copies of the policy."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final, Self

import numpy as np

from rsoccer.frame import team_of
from rsoccer.lineup import DEFAULT_OPPONENT
from rsoccer.rllib.env import RESULTS, WIN_RATES
from rsoccer.train.opponents.opponent_pool import FREEZE_INTERVAL, POOL_SIZE
from rsoccer.train.opponents.pool_slots import EQUAL, PoolSlots, draw
from rsoccer.train.opponents.settings import OpponentSettings

MAIN: Final = "main"
"""Name of the module that learns."""


@dataclass(frozen=True)
class League:
    """A pool of past selves and fixed policies, for tasks in which both teams learn.

    Blue always plays the module `main`, which learns. In each match yellow plays `main` too, or
    one of the frozen modules `past_0`, `past_1` and so on, or a policy of the package, such as the
    script `chase`, which `MatchesEnvRunner` plays by the name `fixed_0`. Every `every` iterations
    `main` is copied to a past self; a full pool evicts as the package's own trainer does. As there,
    past selves that `main` seldom beats are drawn often, and before the first one `main` plays.

    The league has no state of its own: the weights and the win rates of runners are in RLlib's
    checkpoints, and the ages follow from the number of the iteration. A restored run therefore
    continues with the same pool; `restore` gives its win rates to all runners.

    Runners other than `MatchesEnvRunner` know no win rates. With them all past selves are equally
    likely, and a module without a copy yet plays its random initial weights.

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

    def shares_with(self, win_rates: Sequence[float]) -> list[float]:
        """Return the shares at given win rates, in the order of `shares`.

        Args:
            win_rates: win rates of `main` against the past selves that were copied, by slot.

        Example:
            >>> League(size=3).shares_with([])  # no past self yet
            [1.0, 0.0, 0.0, 0.0]
            >>> [round(share, 2) for share in League(size=3).shares_with([1.0, 0.5])]
            [0.5, 0.05, 0.45, 0.0]
        """
        latest, past = self.shares[0], sum(self.shares[1 : self.size + 1])
        fixed = self.shares[self.size + 1 :]
        if not win_rates:
            return [latest + past, *[0.0] * self.size, *fixed]
        hard = past * PoolSlots(self.size, win_rates=list(win_rates)).shares()
        return [latest, *hard.tolist(), *[0.0] * (self.size - len(hard)), *fixed]

    def choose(self, agent_id: str, episode: Any, **kwargs: Any) -> str:  # noqa: ANN401
        """Return the module or fixed policy of a robot, as RLlib's `policy_mapping_fn`.

        Args:
            agent_id: name of the robot.
            episode: the episode; its random `id_` selects the opponent of the match, by the win
                rates in its `custom_data`.
            **kwargs: ignored.
        """
        if team_of(agent_id) == "blue":
            return MAIN
        rng = np.random.default_rng(int(episode.id_, 16))
        names = (MAIN, *self.past, *self.fixed_modules)
        win_rates = episode.custom_data.get(WIN_RATES)
        shares = self.shares if win_rates is None else self.shares_with(win_rates)
        return names[int(draw(rng.uniform(size=1), shares)[0])]

    def slots(self, iteration: int) -> Sequence[int]:
        """Return the iterations at which the modules in use were copied, in order of their slots.

        Args:
            iteration: number of iterations that are complete.
        """
        slots = PoolSlots(self.size)
        for update in range(self.every, iteration + 1, self.every):
            slots.take(update)
        return slots.frozen_at

    def freeze(self, algorithm: Any, result: Mapping[str, Any], **kwargs: Any) -> None:  # noqa: ANN401
        """Update the win rates, and copy `main` if it is time, as the callback `on_train_result`.

        Args:
            algorithm: the algorithm, whose learners and runners get the copy.
            result: result of the iteration, with the matches that ended in it.
            **kwargs: ignored.
        """
        iteration = algorithm.iteration
        pool = PoolSlots(self.size, list(self.slots(iteration - 1)), _win_rates(algorithm))
        if len(pool.win_rates) != len(pool.frozen_at):  # a checkpoint without win rates
            pool.win_rates = [EQUAL] * len(pool.frozen_at)
        results = result.get("env_runners", {}).get(RESULTS, {})
        for slot, name in enumerate(self.past[: len(pool.frozen_at)]):
            matches = float(results.get(name, {}).get("matches", 0.0))
            if matches > 0.0:  # RLlib reports NaN in iterations in which none ended
                pool.record_mean(slot, float(results[name]["points"]) / matches, matches)
        if iteration % self.every == 0:
            self._copy(algorithm, self.past[pool.take(iteration)])
        _send(algorithm, pool.win_rates)

    def restore(self, algorithm: Any) -> None:  # noqa: ANN401
        """Give all runners the win rates of a checkpoint, after `Algorithm.from_checkpoint`.

        RLlib restores those of its local runner alone. Without this call the matches that begin in
        the first iteration have no past selves.

        Args:
            algorithm: the restored algorithm.
        """
        _send(algorithm, _win_rates(algorithm))

    def _copy(self, algorithm: Any, target: str) -> None:  # noqa: ANN401
        """Copy `main` to a past self, in learners and runners."""

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


def _win_rates(algorithm: Any) -> list[float]:  # noqa: ANN401
    """Win rates that the local runner has, or else another one."""
    if algorithm.env_runner is not None:
        return list(getattr(algorithm.env_runner, WIN_RATES, []))
    known = algorithm.env_runner_group.foreach_env_runner(lambda r: getattr(r, WIN_RATES, []))
    return list(max(known, key=len, default=[]))


def _send(algorithm: Any, win_rates: list[float]) -> None:  # noqa: ANN401
    """Give all runners the win rates, before their next matches; wait for none."""
    algorithm.env_runner_group.foreach_env_runner(
        lambda runner: runner.set_state({WIN_RATES: win_rates}), timeout_seconds=0.0
    )
