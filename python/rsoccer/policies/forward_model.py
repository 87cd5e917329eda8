"""A model of a match in which policies try actions: the physics and rewards of a task."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from rsoccer._core import Simulator
from rsoccer.new_play import new_play, new_viewpoint
from rsoccer.rng import WorldRng
from rsoccer.rules.base import begin, judge

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rsoccer._core import Threads
    from rsoccer.arrays import Floats, Mask
    from rsoccer.game import Game
    from rsoccer.play import Play
    from rsoccer.task import Task

_SEED: Final = 0
"""Seed of the task's random streams, which no reward and no end of a task that is played needs."""


class ForwardModel:
    """Copies of a match that go on from known states, each with actions of its own.

    It has no memory: each use begins with states from outside. Rules judge goals, but restart no
    play. Models have the numbers of the task, not those that an episode has drawn.
    """

    def __init__(self, task: Task, observers: Sequence[int], worlds: int, threads: Threads) -> None:
        """Prepare the copies.

        Args:
            task: the task whose physics, observations, rewards and ends it has.
            observers: indices of the robots that observe and are rewarded, in a state row.
            worlds: number of copies, n.
            threads: threads that share the work.

        Raises:
            ValueError: a task that keeps more of a match than bodies, actions and columns of rules.
        """
        self._task = task
        self._simulator = Simulator(task.config, worlds, threads)
        self._everywhere = np.ones(worlds, np.bool_)
        viewpoint = new_viewpoint(task, observers)
        self._play = new_play(task, worlds, viewpoint, WorldRng.seeded(_SEED, worlds), threads)
        more = [*self._play.memory, *(("referee",) if "referee" in self._play.game else ())]
        if more:
            raise ValueError(
                "expected a task whose matches go on from the state of their bodies, got "
                f"{task.name}, which also keeps: {', '.join(more)}"
            )

    @property
    def worlds(self) -> int:
        """Number of copies, n."""
        return len(self._everywhere)

    def observe(self, rows: Floats, actions: Floats) -> Floats:
        """Return the observations (n, observers, o) of states that nothing has moved yet.

        Args:
            rows: (n, row) states as robots know them.
            actions: (n, robots, action) last actions.
        """
        self._play.start(rows)
        self._play.actions = actions
        return self._task.layout.observe(self._play)

    def place(self, rows: Floats, game: Game) -> None:
        """Put all copies into states.

        Args:
            rows: (n, row) states as robots know them; bodies that overlap are moved apart.
            game: (n, ...) score and columns of rules; those that the task has, too, go on.
        """
        play, worlds = self._play, np.arange(self.worlds)
        self._simulator.place_estimates(self._everywhere, rows, play.frame.rows)
        play.start(play.frame.rows)
        begin(self._task.rules, play, worlds)
        play.game.put(worlds, {**play.game, **game})
        self._task.start_episode(play)

    def advance(self, actions: Floats, steps: int) -> tuple[Floats, Mask, Floats]:
        """Let all copies go on with held actions.

        Args:
            actions: (n, robots, action) in [-1, 1].
            steps: control steps, at least 1.

        Returns:
            (n, observers) sums of the rewards until the copy ended, (n,) whether it has, and
            (n, observers, o) observations of the last step.
        """
        task, play = self._task, self._play
        returns = np.zeros((self.worlds, len(play.observers)), np.float32)
        ended = np.zeros(self.worlds, np.bool_)
        for _ in range(steps):
            self._move(play, actions)
            terms, terminated = task.calculate_reward_and_done(play)
            rewards = np.sum([np.broadcast_to(t, returns.shape) for t in terms.values()], axis=0)
            returns += np.where(ended[:, None], np.float32(0.0), rewards)
            ended |= terminated
        return returns, ended, task.layout.observe(play)

    def _move(self, play: Play, actions: Floats) -> None:
        """Advance the physics by a control step, and let the rules judge it."""
        play.actions = actions
        play.commands = self._task.get_commands(play, actions)
        self._simulator.step(play.commands, out=play.last_frame.rows)
        play.advance()
        play.events.forget()
        judge(self._task.rules, play)
