"""The one step loop: many matches of one task at once, as arrays.

Every front door (PettingZoo, evaluation, trainer, video) is a thin layer over `Matches`. One
world is a batch of one. Resets, whole or partial, go through one door: `Matches._begin`.
"""

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from rsoccer import checks
from rsoccer._core import Simulator
from rsoccer.controllers import Controllers, appoint
from rsoccer.frame import Array, Floats, Frame, Mask
from rsoccer.outcome import Outcome
from rsoccer.play import Play
from rsoccer.registry import as_task
from rsoccer.reposition import reposition_balls
from rsoccer.rng import Seeds, WorldRng, next_streams
from rsoccer.saved import Saved
from rsoccer.simulator import Worlds
from rsoccer.standing import Standing
from rsoccer.task import Task
from rsoccer.whole import Whole

__all__ = ["AUTORESETS", "Matches", "Outcome"]

AUTORESETS: Final = ("same_step", "next_step", "disabled")

Indices = NDArray[np.intp]
Seed = int | Sequence[int | None] | None  # of the first world, or one for each


class Matches:
    """n matches of a task, stepped together; actions and observations are (n, agents, ...).

    `autoreset` says what happens to a match that ended: it begins anew within the same step, or
    in the next one (which then ignores its actions and rewards nothing), or when `reset` says so.

    Input that is refused changes nothing. What fails later (a policy, a method of the task, a world
    whose numbers are finite no more) leaves the matches torn, with some parts a step ahead of
    others: `step`, `state_dict` and resets of some worlds then raise a RuntimeError that says what
    failed, until `reset` of all worlds or `load_state_dict` mends them.
    """

    def __init__(
        self,
        task: Task | str,
        worlds: int = 1,
        seed: int = 0,
        threads: int = 1,
        *,
        controllers: Controllers | None = None,
        autoreset: str = "same_step",
        simulator: Worlds | None = None,
    ) -> None:
        """Prepare `worlds` matches; world i has the streams of a single one seeded `seed + i`.

        `controllers` gives robots, by name, team or "all", `LEARN`, a policy or its name.
        """
        if autoreset not in AUTORESETS:
            raise ValueError(f"autoreset: expected one of {AUTORESETS}, got {autoreset!r}")
        self.task = as_task(task)
        self.worlds = checks.whole("worlds", worlds, 1)
        self.autoreset = autoreset
        self.drivers = appoint(self.task, controllers, worlds)
        self.agents = tuple(self.task.robots[robot] for robot in self.drivers.learners)
        self.action_size = self.task.action_size
        self.observation_size = self.task.observation_size
        self.observation_low = self.task.observation_low  # (o,)
        self.observation_high = self.task.observation_high  # (o,)
        threads = checks.whole("threads", threads, 1)
        if simulator is None:
            simulator = Simulator(self.task.config, worlds, threads)
        self._simulator = simulator
        root = WorldRng.seeded(checks.whole("seed", seed, 0), worlds)
        self._start = root.split("start")
        self._viewpoint = self.task.new_viewpoint(self.drivers.seers.tolist())
        self.play = self.task.new_play(worlds, self._viewpoint, root.split("task"))
        for crew in self.drivers.crews:
            crew.rng = root.split(crew.name)
        seen = (worlds, len(self.drivers.seers), self.observation_size)
        self._observations = np.zeros(seen, np.float32)
        self._done, self._begun = np.zeros((2, worlds), np.bool_)
        self._stepped = 0  # calls of `step`, to tell which failed
        self._whole = Whole()

    @property
    def frame(self) -> Frame:
        """Where the worlds are now; to be read only, and only until the next step."""
        return self.play.frame

    @property
    def done(self) -> Mask:
        """(n,) matches that ended and wait to begin again; none where `same_step`."""
        return self._done.copy()

    def reset(
        self, seed: Seed = None, mask: Mask | None = None, rows: Floats | None = None
    ) -> Floats:
        """Begin new episodes in the worlds of `mask`, or all; what all show, (n, agents, o).

        World i gets `seed + i`, or `seed[i]`; without a seed its random streams go on. `rows`
        (k, row) are starts for the k worlds of the mask, in place of the task's own.

        Raises:
            RuntimeError: a reset of some worlds only, of matches that a failure has torn.
            ValueError, TypeError: what is no seed, mask or start; then nothing has changed.
        """
        seeds = checks.seeds(seed, self.worlds)
        worlds = np.flatnonzero(checks.mask(mask, self.worlds))
        if len(worlds) < self.worlds:
            self._whole.check()
        if rows is not None:
            rows = checks.floats("rows", rows, (len(worlds), self.task.config.row_size))
        if len(worlds):
            self._begin(worlds, rows, seeds)
        return self._of_learners(self._observations)

    def step(self, actions: Floats) -> Outcome:
        """One control step: `actions` (n, agents, action), clipped to [-1, 1].

        Raises:
            RuntimeError: some worlds have begun no episode, or an earlier step failed half way.
            ValueError, TypeError: what are no such actions; nothing has changed.
        """
        self._whole.check()
        actions = checks.actions(actions, (self.worlds, len(self.agents), self.action_size))
        if np.count_nonzero(self._begun) < self.worlds:
            raise RuntimeError("step before reset: some worlds have begun no episode")
        self._stepped += 1
        try:
            return self._play_on(actions)
        except BaseException as error:  # an interrupt too
            self._whole.tear(f"step {self._stepped}", error)
            raise

    def state_dict(self) -> dict[str, Array]:
        """Everything that the future depends on; `load_state_dict` continues exactly from it."""
        self._whole.check()
        return self._saved().read()

    def load_state_dict(self, state: Mapping[str, Array]) -> None:
        """Continue as the matches did that `state` was read from; task and sizes must be equal."""
        self._saved().put(state)
        self._viewpoint.fill(self.play.frame, self.play.view)
        self._viewpoint.fill(self.play.last_frame, self.play.last_view)
        self._whole.mend()

    def _play_on(self, actions: Floats) -> Outcome:
        """One control step with actions that nothing speaks against."""
        still = np.flatnonzero(self._done)
        standing = None
        if len(still):
            standing = Standing(still, self.play, self.drivers.crews, self._observations)
        self._move(actions, ~self._done if standing else None)
        outcome = self._judge()
        if standing:
            standing.release(self._observations, outcome)
        self._begin_again(still, outcome)
        return outcome

    def _move(self, actions: Floats, active: Mask | None) -> None:
        """Every driver acts, and the worlds, or those that are active, move on."""
        play, driven = self.play, actions
        if self.drivers.crews:
            driven = np.empty_like(play.actions)
            driven[:, self.drivers.learners] = actions
        for crew in self.drivers.crews:
            crew.act(play, self._observations, driven)
        commands = self.task.get_commands(play, driven)
        play.commands = checks.commands(commands, play.commands.shape)
        play.actions = driven
        self._simulator.step(play.commands, out=play.last_frame.rows, active=active)
        play.advance()
        reposition_balls(self.task, self._simulator, play, self._viewpoint, active)
        self._viewpoint.fill(play.frame, play.view)
        play.steps += 1

    def _judge(self) -> Outcome:
        """What the step is worth and where it led, before anything begins again."""
        task, play = self.task, self.play
        named, terminated = task.calculate_reward_and_done(play)
        terminated = checks.done(terminated, self.worlds)
        shape = (self.worlds, len(play.seers))
        terms = {
            name: self._of_learners(checks.term(name, term, shape)) for name, term in named.items()
        }
        rewards = np.zeros((self.worlds, len(self.agents)), np.float32)
        for term in terms.values():
            rewards += term
        truncated = (play.steps >= task.max_steps) & ~terminated
        metrics = {name: np.array(fact, np.float32) for name, fact in task.metrics(play).items()}
        self._observations = task.observe(play)
        none = self._observations[:0]
        return Outcome(none, none, rewards, terms, terminated.copy(), truncated, metrics)

    def _begin_again(self, still: Indices, outcome: Outcome) -> None:
        """Restart as `autoreset` says, and show what there is to see before and after."""
        ended = outcome.ended
        if self.autoreset == "next_step" and len(still):
            self._begin(still)
        shown = self._of_learners(self._observations)
        outcome.observations = outcome.final_observations = shown
        self._done |= ended
        if self.autoreset == "same_step" and np.count_nonzero(ended):
            self._begin(np.flatnonzero(ended))
            outcome.observations = self._of_learners(self._observations)

    def _begin(
        self, worlds: Indices, rows: Floats | None = None, seeds: Seeds | None = None
    ) -> None:
        """Start episodes in some worlds, from `rows` (k, row) or the task's own starts."""
        start, *others = next_streams(self._saved().streams, worlds, seeds)
        if rows is None:
            rows = self.task.get_initial_positions_frame(start).rows
        part = self.task.new_play(len(worlds), self._viewpoint, others[0])
        mask = np.zeros(self.worlds, np.bool_)
        mask[worlds] = True
        self._simulator.place(mask, rows, out=self.play.frame.rows)
        try:
            self._enter(worlds, part)
            for crew, rng in zip(self.drivers.crews, others[1:], strict=True):
                crew.restart(worlds, rng, self.action_size)
        except BaseException as error:
            self._whole.tear("reset", error)
            raise
        self._start.put(worlds, start)
        if len(worlds) == self.worlds:
            self._whole.mend()

    def _enter(self, worlds: Indices, part: Play) -> None:
        """Let some worlds, which were just placed, show their first moment."""
        part.start(self.play.frame.rows[worlds], self._viewpoint)
        self._observations[worlds] = self.task.observe(part)
        self.play.put(worlds, part)
        self._done[worlds] = False
        self._begun[worlds] = True

    def _saved(self) -> Saved:
        """Where all state is."""
        own = {"observations": self._observations, "done": self._done, "begun": self._begun}
        return Saved.of(self._simulator, self.play, self.drivers.crews, self._start, own)

    def _of_learners(self, seen: Floats) -> Floats:
        """The learners' part of what there is for all seers (n, seers, ...); a copy."""
        return np.array(seen[:, self.drivers.learner_seats])
