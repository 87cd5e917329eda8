"""Self-play against past selves in RLlib: the policy mapping, and the copies of the policy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from rsoccer.frame import team_of
from rsoccer.train.opponents.pool_slots import PoolSlots, draw

MAIN: Final = "main"
"""Name of the module that learns."""


@dataclass(frozen=True)
class League:
    """A pool of past selves as frozen RLModules, for tasks in which both teams learn.

    Blue always plays the module `main`, which learns. In each match yellow plays `main` too, or
    one of the modules `past_0`, `past_1` and so on. Every `every` iterations `main` is copied to
    one of them; a full pool evicts as the package's own trainer does. A module without a copy yet
    plays its random initial weights.

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
    """

    size: int = 8
    """Number of past selves, at least 1."""
    latest_fraction: float = 0.5
    """Share of the matches in which both teams play `main`, 0 to 1."""
    every: int = 20
    """Iterations between two copies, at least 1."""

    @property
    def past(self) -> tuple[str, ...]:
        """Names of the frozen modules, for `env_config["frozen"]`."""
        return tuple(f"past_{slot}" for slot in range(self.size))

    @property
    def modules(self) -> set[str]:
        """Names of all modules, for `policies`."""
        return {MAIN, *self.past}

    def choose(self, agent_id: str, episode: Any, **kwargs: Any) -> str:  # noqa: ANN401
        """Return the module of a robot, as RLlib's `policy_mapping_fn`.

        Args:
            agent_id: name of the robot.
            episode: the episode; its random `id_` selects the opponent of the match.
            **kwargs: ignored.
        """
        if team_of(agent_id) == "blue":
            return MAIN
        rng = np.random.default_rng(int(episode.id_, 16))
        past_share = (1.0 - self.latest_fraction) / self.size
        shares = [self.latest_fraction, *[past_share] * self.size]
        return (MAIN, *self.past)[int(draw(rng.uniform(size=1), shares)[0])]

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
