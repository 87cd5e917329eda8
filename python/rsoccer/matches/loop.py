"""The step loop: many matches of one task at once, as arrays.

All environments, the evaluation, the trainer and the videos call `Matches`. A single match is a
batch of one. `Matches._step` is the order of a step. All resets, of all worlds or of some, go
through `Matches._begin`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any, Final, Protocol, cast

import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray

from rsoccer import checks, spaces
from rsoccer._core import Sensing, Simulator, Threads
from rsoccer.arrays import Array, Doubles, Floats, Mask, read_only
from rsoccer.controllers import Controllers, assign, resolve
from rsoccer.frame import Frame
from rsoccer.global_state import StateEncoder
from rsoccer.history import ObservationStack
from rsoccer.matches import changes, result_checks
from rsoccer.matches.consistency import Consistency
from rsoccer.matches.learners import Learners
from rsoccer.matches.match_state import MatchState
from rsoccer.matches.outcome import Episodes, Outcome
from rsoccer.matches.paused import PausedWorlds
from rsoccer.matches.sensing import (
    ON,
    check_forecasting,
    forecast_together,
    forecasting_teams,
    may_forecast,
    new_senses,
    simulated,
    teams_differ,
    teams_of,
)
from rsoccer.matches.starts import Starts
from rsoccer.new_play import initial_rows, new_play, new_viewpoint
from rsoccer.play import Play
from rsoccer.policies.base import CommandPolicy, Policy
from rsoccer.randomization import Randomization, Ranges
from rsoccer.registry import resolve_task
from rsoccer.rng import Seeds, WorldRng, next_streams
from rsoccer.rules.base import Restart, begin, judge, select
from rsoccer.senses import Senses
from rsoccer.sensing_text import with_number
from rsoccer.simulator_interface import close, has_snapshots, require_snapshots
from rsoccer.sources import (
    SensingSource,
    SimulatorSource,
    is_shared,
    make_sensing,
    make_simulator,
)
from rsoccer.spaces import ActionSpace
from rsoccer.task import Learn, Task

AUTORESETS: Final = ("same_step", "next_step", "disabled")

Indices = NDArray[np.intp]
_STARTS: Final = "starts"
"""Name in a state of the states in which episodes begin; missing if they are the task's."""
_NO_WORLDS: Final = np.empty(0, np.intp)
Seed = int | Sequence[int | None] | None
"""Seed of the first world, or one seed per world; None: random streams continue."""


class Listener(Protocol):
    """An object that follows the steps of matches, see `Matches.attach`."""

    world: int
    """Index of the world whose episodes it follows."""

    def begin(self) -> None:
        """Take note that an episode of the world has begun."""

    def begin_here(self) -> None:
        """Take note that the world goes on from another state, within an episode."""

    def add(self, outcome: Outcome) -> None:
        """Take note of a step of all worlds in which the followed one has played.

        Args:
            outcome: result of the step.
        """


class Matches:
    """n matches of a task, stepped together.

    Input that is refused changes nothing. A failure later in a step (in a policy, in a method of
    the task, or a world with non-finite numbers) leaves the matches inconsistent: some parts are
    a step ahead of others. `step`, `state_dict` and resets of some worlds then raise a
    RuntimeError that names the failure, until `reset` of all worlds or `load_state_dict`.

    Attributes:
        task: the task that is played.
        worlds: number of matches, n.
        autoreset: "same_step", "next_step" or "disabled".
        assignment: controllers of all robots.
        agents: names of the learners, in the order of the arrays.
        action_size: numbers in one agent's action.
        history: observations in one agent's stacked observation; 1 for the plain one.
        observation_size: numbers in one agent's observation, stacked or plain, o.
        observation_low: (o,) lower bounds.
        observation_high: (o,) upper bounds.
        sensing: the `Sensing`, or what another sensor model was given as; None if robots know the
            true state.
        forecasting: teams, "blue" or "yellow", that forecast although `sensing` does not: those
            that were asked to, or whose policies play from it.
        randomization: distributions of numbers that each episode draws, by name.
        play: state of all worlds, to be read only: frames, score, events of the last step.

    Example:
        >>> import numpy as np
        >>> import rsoccer
        >>> matches = rsoccer.Matches("VSSSelfPlay-v0", worlds=4, seed=0)
        >>> observations = matches.reset()
        >>> actions = np.zeros((4, len(matches.agents), matches.action_size), np.float32)
        >>> outcome = matches.step(actions)
        >>> outcome.rewards.shape
        (4, 6)
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
        simulator: SimulatorSource | None = None,
        sensing: SensingSource | None = None,
        forecasting: Sequence[str] | Policy | None = None,
        randomization: Ranges | None = None,
        history: int = 1,
        max_steps: int | None = None,
        **options: Any,  # noqa: ANN401  (fields of the task, checked by the registry)
    ) -> None:
        """Prepare matches; `reset` begins them.

        Args:
            task: a task or the name of a registered one.
            worlds: number of matches, at least 1.
            seed: seed of the first world, at least 0. World i has the random streams of a single
                match that is seeded `seed + i`.
            threads: threads for physics, observations and rewards, at least 1. Results do not
                depend on their number.
            controllers: `LEARN`, a policy, its name or its file, by robot ("blue_0"), team
                ("blue") or "all"; the task's defaults apply elsewhere.
            autoreset: reset of a match that ended: "same_step" (within the step that ends it),
                "next_step" (the next step resets it, ignores its actions and gives no reward) or
                "disabled" (it waits for `reset`).
            simulator: moves the robots in place of `rsoccer.Simulator`: a function
                `(config, worlds, threads)` that makes a simulator, its text "module:name", or a
                simulator; see `rsoccer.simulator_interface`. With one that cannot place bodies,
                such as real robots, episodes begin with the state as it is.
            sensing: what robots know of the true state, and how they obey: a `Sensing`, the name
                of a preset of it, a `rsoccer.senses.SensorModel`, or its text "module:name"; None
                if they know and obey exactly.
            forecasting: teams, "blue" or "yellow", that forecast with a `Sensing` whose `forecast`
                is off. None for those without learners in which all policies that look play from
                one; a policy for the same as if it drove the learners. A team with a policy that
                needs a forecast always has one. Changes nothing without senses.
            randomization: distributions of numbers that each episode draws for itself, by name,
                such as `{"robot.mass": (0.9, 1.1)}`; see `rsoccer.randomization`. None for the same
                numbers in all.
            history: observations in each observation of the learners, at least 1: the current one,
                the past ones and the actions between them; see `rsoccer.history`. Policies get
                the plain observations, and a trained one keeps its own history.
            max_steps: time limit of an episode in control steps, at least 1; None for the task's
                own.
            **options: options of a registered task, the fields of its class.

        Raises:
            ImportError: a text "module:name" whose module or name does not exist.
            TypeError: an argument of the wrong type, an unknown option, options for a `Task`
                object, or a simulator that can neither place bodies nor read their state.
            ValueError: an unknown task, controller or autoreset mode, a number out of range, or
                numbers to vary that a simulator or a sensor model of one's own does not take.
        """
        if autoreset not in AUTORESETS:
            raise ValueError(f"autoreset: expected one of {AUTORESETS}, got {autoreset!r}")
        self.task = resolve_task(task, max_steps, options, Matches)
        self._discrete = self.task.action_table is not None
        self.worlds = checks.integer("worlds", worlds, 1)
        self.autoreset = autoreset
        self.action_size = self.task.action_size
        self._stack = ObservationStack.of(self.task, history)
        self.history, self.observation_size = self._stack.history, self._stack.size
        self.observation_low = self.observation_space.low
        self.observation_high = self.observation_space.high
        self._threads = Threads(checks.integer("threads", threads, 1))
        self._sensing = make_sensing(sensing)
        self._randomization = Randomization.of(
            randomization, self.task.config, simulated(self._sensing)
        )
        if self._randomization.sensing is not None and self._sensing is None:
            self._sensing = Sensing()
        is_own_model = self._sensing is not None and not isinstance(self._sensing, Sensing)
        if is_own_model and self._randomization.sensing is not None:
            raise ValueError(
                "randomization: expected no numbers of `Sensing` with a sensor model of one's own, "
                f"got {sorted(name for name in randomization or {} if name.startswith('sensing.'))}"
            )
        self.sensing = sensing if is_own_model else simulated(self._sensing)
        self.randomization = dict(randomization or {})
        by_team = teams_differ(self._sensing, self._randomization.sensing)
        self.assignment = assign(self.task, controllers, worlds, by_team=by_team)
        self.forecasting = self._begin_forecasts(controllers, forecasting)
        self.agents = tuple(self.task.robots[robot] for robot in self.assignment.learners)
        self._learners = Learners(self.task, self.assignment)
        self._rules = self.task.rules
        root = WorldRng.seeded(checks.integer("seed", seed, 0), worlds)
        self._start = root.split("start")
        self._viewpoint = new_viewpoint(self.task, self.assignment.observers.tolist())
        self.play = self._new_play(worlds, root.split("task"))
        self._variation = root.split("randomization")
        for group in self.assignment.groups:
            group.rng = root.split(group.name)
        groups = self.assignment.groups
        self._commanding = [group for group in groups if isinstance(group.policy, CommandPolicy)]
        shape = (worlds, len(self.assignment.observers), self.task.layout.size)
        self._observations = np.zeros(shape, np.float32)
        self._past = self._stack.new_memory(worlds, len(self.agents))
        self._done, self._begun = np.zeros((2, worlds), np.bool_)
        self._all_begun = False
        self._returns = np.zeros((worlds, len(self.agents)))
        self._final_rows: tuple[Indices, Floats] | None = None
        self._observer_terms: Mapping[str, Floats] = {}
        self._waited = _NO_WORLDS  # in the last step
        self._step_calls = 0  # for error messages
        self._start_rows: Floats | None = None
        self._listeners: list[Listener] = []
        self._consistency = Consistency()
        config = self.task.config.with_sensing(simulated(self._sensing))
        self._simulator = make_simulator(simulator, config, worlds, self._threads)
        self._is_own_simulator = isinstance(
            getattr(self._simulator, "__wrapped__", self._simulator), Simulator
        )
        try:
            self._starts = Starts(self._simulator)
            if self._randomization.parameters is not None:
                self._starts.check_parameters()
            self.play.senses = self._new_senses(self.play.frame, root.split("senses"))
        except BaseException:
            if not is_shared(simulator):
                close(self._simulator)
            raise

    @property
    def observer_terms(self) -> dict[str, Floats]:
        """(n, observers) weighted reward terms of the last step by name, of all observing robots.

        The robots are `play.observers`. To be read only, valid until the next step; empty before
        the first one. Those of a world that waits for its reset are 0.
        """
        shape = (self.worlds, len(self.play.observers))
        terms = {name: np.broadcast_to(t, shape) for name, t in self._observer_terms.items()}
        if not len(self._waited):
            return terms
        played = np.ones((self.worlds, 1), np.float32)
        played[self._waited] = 0.0
        return {name: term * played for name, term in terms.items()}

    @property
    def frame(self) -> Frame:
        """Current state of all worlds, to be read only, valid until the next step."""
        return self.play.frame.read_only

    @property
    def done(self) -> Mask:
        """(n,) matches that ended and wait for a reset; all False with "same_step"."""
        return self._done.copy()

    @cached_property
    def observation_space(self) -> Box[np.float32]:
        """Observation space of one agent: Box (o,) float32, of stacked observations if any.

        `task.layout.blocks` are the parts of a plain observation.
        """
        return spaces.observation_space(self.task, self.history)

    @cached_property
    def action_space(self) -> ActionSpace:
        """Action space of one agent: Box (action,) float32 from -1 to 1, or Discrete.

        It is Discrete for tasks with an `action_table`.
        """
        return spaces.action_space(self.task)

    @cached_property
    def state_space(self) -> Box[np.float32]:
        """Space of the global state of one world: Box (state,) float32."""
        return spaces.state_space(self.task)

    @property
    def state_size(self) -> int:
        """Numbers in the global state of one world."""
        return self._state_encoder.size

    @cached_property
    def _state_encoder(self) -> StateEncoder:
        return StateEncoder(self.task.config)

    def states(self) -> Floats:
        """Return the global state of each world, for centralized critics.

        Returns:
            (n, state) float32 in `state_space`, a new array: ball, blue robots, yellow robots, in
            absolute coordinates, scaled to about 1, as `SoccerParallelEnv.state` returns it.
        """
        return self._state_encoder.encode(self.frame.rows)

    def final_states(self) -> Floats:
        """Return the global states after the last step, before it began new episodes.

        They belong to `Outcome.final_observations`, as `states` belongs to
        `Outcome.observations`.

        Returns:
            (n, state) float32, a new array: the last state of the old episode where one began in
            the last step ("same_step"), equal to `states` elsewhere and after a reset.
        """
        states = self.states()
        if self._final_rows is not None:
            worlds, rows = self._final_rows
            states[worlds] = self._state_encoder.encode(rows)
        return states

    def reset(
        self, seed: Seed = None, mask: Mask | None = None, rows: Floats | None = None
    ) -> Floats:
        """Begin new episodes.

        Args:
            seed: world i is seeded with `seed + i`, or with `seed[i]`; without a seed its random
                streams continue.
            mask: (n,) worlds to reset; all if None.
            rows: (k, row) initial states of the k worlds of the mask, in place of the task's own;
                None with a simulator that cannot place bodies.

        Returns:
            (n, agents, o) observations of all worlds, a new array.

        Raises:
            RuntimeError: a reset of some worlds while the matches are inconsistent.
            TypeError: an argument of the wrong type. Nothing has changed.
            ValueError: a wrong shape, a negative seed, or bodies that overlap or are outside.
                Nothing has changed.
        """
        seeds = checks.seeds(seed, self.worlds)
        worlds = np.flatnonzero(checks.mask(mask, self.worlds))
        if len(worlds) < self.worlds:
            self._consistency.check()
        if rows is not None:
            self._starts.check_rows()
            rows = checks.floats("rows", rows, (len(worlds), self.task.config.row_size))
        if len(worlds):
            self._begin(worlds, rows, seeds)
            self.play.events.forget(worlds)
            self._final_rows = None
        return self._observed()

    def step(self, actions: Array) -> Outcome:
        """Advance all matches by one control step.

        Args:
            actions: (n, agents, action) float, clipped to [-1, 1]. For tasks with an
                `action_table` also (n, agents) integers, indices of its rows.

        Returns:
            Observations, rewards and ends, all in new arrays.

        Raises:
            RuntimeError: a world was never reset, or the matches are inconsistent.
            TypeError: actions of the wrong type. Nothing has changed.
            ValueError: actions of the wrong shape, not finite, or an index out of range. Nothing
                has changed.
        """
        self._consistency.check()
        if self._discrete:
            actions = self._action_vectors(actions)
        actions = checks.actions(actions, (self.worlds, len(self.agents), self.action_size))
        if not self._all_begun:
            raise RuntimeError("step before reset: some worlds have begun no episode")
        self._step_calls += 1
        try:
            return self._step(actions)
        except BaseException as error:  # an interrupt too
            self._consistency.fail(f"step {self._step_calls}", error)
            raise

    @property
    def can_be_saved(self) -> bool:
        """True if `state_dict` works: not with robots, and with few other simulators."""
        return has_snapshots(self._simulator)

    def state_dict(self) -> dict[str, Array]:
        """Return copies of all state by name; `load_state_dict` continues exactly from it.

        The task, its options and the policies are no part of it. Matches to load it have the same
        ones, after `change_options` and `change_controllers` too.

        Returns:
            Arrays by name, the states of `start_from` included, as "starts", if it has set any.

        Raises:
            RuntimeError: the matches are inconsistent.
            TypeError: a simulator that has no `snapshot`.
        """
        self._consistency.check()
        starts = {} if self._start_rows is None else {_STARTS: self._start_rows.copy()}
        return self._state().read() | starts

    def load_state_dict(self, state: Mapping[str, Array]) -> None:
        """Continue from a state of matches with the same task, controllers and number of worlds.

        The states of `start_from` are those of the saved matches. Options of the task and policies
        are no part of a state and stay as they are here, so that changes by `change_options` and
        `change_controllers` have to be made here too, before this call.

        Args:
            state: what `state_dict` returned.

        Raises:
            TypeError: a simulator that has no `restore`, or no arrays by name. Nothing has changed.
            ValueError: a state of other matches, numbers that are not finite, or negative steps.
                Nothing has changed.
        """
        self._load(state)
        self._announce_state()

    def _load(self, state: Mapping[str, Array]) -> None:
        """Overwrite all state, unknown to those who follow the matches."""
        starts = self._saved_starts(result_checks.state_arrays(state))
        times = self.play.times
        self.play.times = np.zeros(self.worlds) if "times" in state else None
        try:
            self._state().write({name: a for name, a in state.items() if name != _STARTS})
        except BaseException:
            self.play.times = times
            raise
        self._start_rows = starts
        self._final_rows = None
        self._all_begun = bool(self._begun.all())
        self.play.expire_views()
        self._consistency.repair()

    def _saved_starts(self, state: Mapping[str, Array]) -> Floats | None:
        """Checked states of `start_from` in a saved state; None without any."""
        if _STARTS not in state:
            return None
        self._starts.check_rows()
        return changes.saved_starts(self.task, state[_STARTS])

    def change_options(self, **options: Any) -> None:  # noqa: ANN401
        """Change options of the task while the matches run, for curricula.

        Rewards and time limits hold from the next step on, starts and rules' numbers from the next
        episode of each world on, automatic resets included.

        Args:
            **options: options of the task, such as `reward_weights`, `max_steps` or `ball_speed`.

        Raises:
            TypeError: an unknown option, or one of the wrong type. Nothing has changed.
            ValueError: a value out of range, or an option on which sizes, robots, physics or
                controllers depend. Nothing has changed.
        """
        task = changes.changed_task(self.task, options)
        self.task, self._rules = task, task.rules

    def change_controllers(self, controllers: Controllers) -> None:
        """Replace policies while the matches run; their memory begins anew.

        Args:
            controllers: policies by robot ("yellow_1"), team ("yellow") or "all", for robots that
                do not learn; others keep theirs. Robots that share a policy get the same one.

        Raises:
            TypeError: something that is not a policy. Nothing has changed.
            ValueError: an unknown robot, one that learns, a policy that does not fit the task, one
                that observes in the place of one that does not, or one that needs a forecast in a
                team without it. Nothing has changed.
        """
        were_read = self.assignment.reads_observations
        teams = self._forecasting_teams()
        changes.change_controllers(self.task, self.assignment, controllers, teams)
        groups = self.assignment.groups
        self._commanding = [group for group in groups if isinstance(group.policy, CommandPolicy)]
        if self._all_begun and not were_read:
            self._observe()

    def start_from(self, rows: Floats | None) -> None:
        """Set the states in which episodes begin from now on, after automatic resets too.

        Each episode draws one of them, with the random stream of its world.

        Args:
            rows: (row,) one state, or (m, row) several, in the layout of `Frame.rows`; None for
                those of the task.

        Raises:
            TypeError: not an array of floats. Nothing has changed.
            ValueError: a wrong shape, bodies that overlap or are outside, or a simulator that
                cannot place bodies. Nothing has changed.
        """
        if rows is not None:
            self._starts.check_rows()
            rows = changes.start_rows(self.task, rows)
        self._start_rows = rows

    def attach(self, listener: Listener) -> None:
        """Let an object follow each step, before worlds reset, and each begin of an episode.

        It also learns of states that `load_state_dict` and `take_over` put in place.

        Args:
            listener: such as a `Recorder`.
        """
        if listener not in self._listeners:
            self._listeners.append(listener)

    def detach(self, listener: Listener) -> None:
        """Let an object follow no further steps.

        Args:
            listener: one that `attach` got; others are ignored.
        """
        if listener in self._listeners:
            self._listeners.remove(listener)

    def take_over(self, state: Mapping[str, Array], seed: Seed = None) -> Floats:
        """Continue from a state of matches of the same task with other controllers.

        Bodies, clock, score, rules, senses and states of `start_from` go on. Policies begin anew,
        with the memory that they have at the start of an episode, and so does the history of
        learners. Returns of the episode count from here.

        Args:
            state: what `state_dict` of the other matches returned.
            seed: seed of the policies, as for `reset`.

        Returns:
            (n, agents, o) observations of all worlds, a new array.

        Raises:
            TypeError: a simulator that has no `restore`, or no arrays by name. Nothing has changed.
            ValueError: a state of another task, of other senses or of another number of worlds.
                Nothing has changed, unless it is the simulator that refuses its part: then these
                matches have begun other episodes.
        """
        self._check_shared(result_checks.state_arrays(state))
        listeners, self._listeners = self._listeners, []  # this reset is no begin of an episode
        try:
            self.reset(seed)
        finally:
            self._listeners = listeners
        try:
            anew = self._state()
            names = {*anew.shared, _STARTS}
            kept = {name: array for name, array in anew.read().items() if name not in names}
            self._load({**{n: a for n, a in state.items() if n in names}, **kept})
        except BaseException:
            self._announce(np.arange(self.worlds))
            raise
        self._returns[...] = 0.0
        self._observe()
        self._stack.begin(self._past, slice(None), self._learners.select(self._observations))
        self._announce_state()
        return self._observed()

    def _check_shared(self, state: Mapping[str, Array]) -> None:
        """Check what `take_over` takes from a state, but for the content of the snapshot."""
        expected = self._state()
        require_snapshots(self._simulator)
        expected.check(state, {*expected.shared} - {"times"})  # which a reset may bring
        self._saved_starts(state)

    def close(self) -> None:
        """Release what the simulator holds, such as a socket, if it holds anything."""
        close(self._simulator)

    def _action_vectors(self, actions: Array) -> Array:
        """Actions (n, agents, action) of a discrete task, from indices (n, agents) or vectors."""
        indices, shape = checks.as_array("actions", actions), (self.worlds, len(self.agents))
        if indices.dtype.kind not in "iu":
            if indices.shape == shape:
                raise TypeError(f"actions: expected whole numbers, got {indices.dtype}")
            return actions
        if indices.shape != shape:
            raise ValueError(f"actions: expected shape {shape} of integers, got {indices.shape}")
        return spaces.action_vectors(self.task, indices)

    def _repr_png_(self) -> bytes | None:
        """An image of the first world, for notebooks; None before a reset or without pygame."""
        if not self._begun[0]:
            return None
        try:
            from rsoccer.render import Picture, draw_image
        except ModuleNotFoundError:
            return None
        from rsoccer.render.ghosts import sensed_overlay
        from rsoccer.render.overlay import task_overlay
        from rsoccer.render.referee_state import referee_state

        image = draw_image(
            self.task.config,
            self.frame.rows[0],
            clock=float(self.play.steps[0]) * self.task.config.time_step,
            referee=referee_state(self.task, self.play),
            extras=(
                *task_overlay(self.task, self.play),
                *sensed_overlay(self.task.config, self.play),
            ),
        )
        return Picture(image).to_png()

    def _step(self, actions: Floats) -> Outcome:
        """Advance by one control step, with actions that have been checked."""
        self._final_rows = None
        self._waited, paused = _NO_WORLDS, None
        if np.count_nonzero(self._done):
            self._waited = np.flatnonzero(self._done)
            groups = self.assignment.groups
            paused = PausedWorlds(self._waited, self.play, groups, self._observations)
        active = read_only(~self._done) if paused else None
        self._act(actions, active)
        if self.history > 1:
            self._remember(actions, active)
        self._move(active)
        restarts = self._judge()
        outcome = self._evaluate()
        restarted = self._restart(restarts, outcome, active)
        self._sense(active, restarted)
        self._observe()
        if paused:
            paused.restore(self.task, self._observations, outcome)
        self._returns = self._returns + outcome.rewards
        self._autoreset(outcome)
        return outcome

    def _act(self, actions: Floats, active: Mask | None) -> None:
        """Let all controllers act, and convert their actions to commands."""
        play, all_actions = self.play, actions
        if self.assignment.groups:
            all_actions = np.empty_like(play.actions)
            all_actions[:, self.assignment.written] = actions
        for group in self.assignment.groups:
            group.act(play, self._observations, all_actions, active)
        commands = self.task.get_commands(play, all_actions)
        play.commands = result_checks.commands(self.task, commands, play.commands.shape)
        for group in self._commanding:
            group.command(play, self._observations, play.commands)
        play.actions = all_actions

    def _remember(self, actions: Floats, active: Mask | None) -> None:
        """Keep the learners' observations and actions of this step, as parts of later ones."""
        worlds = slice(None) if active is None else active
        observations = self._learners.select(self._observations)
        self._stack.push(self._past, worlds, observations[worlds], actions[worlds])

    def _move(self, active: Mask | None) -> None:
        """Move the robots and balls of all worlds, or of the active ones."""
        play = self.play
        rows, sensed, times = play.last_frame.rows, self._own_rows(), None
        if sensed is None:
            times = self._simulator.step(play.commands, out=rows, active=active)
        else:
            cast(Simulator, self._simulator).step(play.commands, rows, active, sensed)
        play.advance()
        if not self._is_own_simulator:  # which checks its rows itself
            checks.rows(f"{type(self._simulator).__name__}.step", play.frame)
        if times is not None:
            self._stamp(times)
        play.steps += 1

    def _stamp(self, times: Doubles | None) -> None:
        """Keep the time stamps of the rows, of a simulator that has them."""
        if times is not None:
            self.play.times = result_checks.times(times, self.worlds)

    def _judge(self) -> list[Restart]:
        """Let the rules judge the state that the physics left."""
        self.play.events.forget()
        return judge(self._rules, self.play)

    def _evaluate(self) -> Outcome:
        """Compute rewards, ends and metrics of the state that the physics left."""
        task, play = self.task, self.play
        results = task.calculate_reward_and_done(play)
        named, terminated = result_checks.rewards_and_ends(task, results, self.worlds)
        self._observer_terms = named
        terms, rewards = self._learners.sum_terms(named, self.worlds)
        truncated = np.greater(play.steps >= task.max_steps, terminated)  # late, not terminated
        metrics = result_checks.metrics(task, task.metrics(play), self.worlds)
        none = self._observations[:0]
        return Outcome(none, none, rewards, terms, terminated.copy(), truncated, metrics)

    def _restart(
        self, restarts: list[Restart], outcome: Outcome, active: Mask | None
    ) -> Mask | None:
        """Restart play where a rule has stopped it and the episode goes on.

        Returns:
            (n,) bool, these worlds; None if there are none.
        """
        if not restarts:
            return None
        going = ~outcome.ended if active is None else ~outcome.ended & active
        play, restarted = self.play, None
        for restart in restarts:
            chosen = select(restart, going)
            if not len(chosen.worlds):
                continue
            mask = np.zeros(self.worlds, np.bool_)
            mask[chosen.worlds] = True
            self._stamp(self._starts.restart(mask, chosen.rows, chosen.balls, play.frame.rows))
            play.last_frame.rows[mask] = play.frame.rows[mask]
            begin(self._rules, play, chosen.worlds)
            restarted = mask if restarted is None else restarted | mask
        play.expire_views()
        return restarted

    def _sense(self, active: Mask | None, restarted: Mask | None) -> None:
        """Let the sensor model compute what the robots know."""
        senses = self.play.senses
        if senses is None:
            return
        if self._own_rows() is None:
            senses.sense(self.play.frame, active)
        elif restarted is not None:
            senses.sense(self.play.frame, restarted)

    def _own_rows(self) -> Floats | None:
        """Rows of what robots know that the simulator writes in its step; None where it cannot."""
        senses = self.play.senses
        return senses.own_rows if senses is not None and self._is_own_simulator else None

    def _observe(self) -> None:
        """Compute the observations of all observers, if a learner or a policy reads them."""
        if self.assignment.reads_observations:
            self.task.layout.observe(self.play, out=self._observations)

    def _autoreset(self, outcome: Outcome) -> None:
        """Reset matches as `autoreset` demands, and fill in the outcome's observations."""
        if self.autoreset == "next_step" and len(self._waited):
            self._begin(self._waited)
        final = self._observed()
        outcome.observations = outcome.final_observations = final
        for listener in self._listeners:
            if listener.world not in self._waited:  # it has not played, and perhaps begun
                listener.add(outcome)
        ended = outcome.ended
        if not np.count_nonzero(ended):
            return
        worlds = np.flatnonzero(ended)
        outcome.episodes = self._ended_episodes(worlds, outcome)
        if self.autoreset == "same_step":
            self._final_rows = worlds, self.play.frame.rows[worlds]
            self._begin(worlds)
            outcome.observations = self._observed()
        else:
            self._done |= ended

    def _ended_episodes(self, worlds: Indices, outcome: Outcome) -> Episodes:
        """Statistics of the episodes that ended in some worlds."""
        return Episodes(
            worlds,
            self.play.steps[worlds],
            self._returns[worlds],
            outcome.terminated[worlds],
            {name: values[worlds] for name, values in outcome.metrics.items()},
        )

    def _begin(
        self, worlds: Indices, rows: Floats | None = None, seeds: Seeds | None = None
    ) -> None:
        """Begin episodes in k worlds, from `rows` (k, row) or from the task's initial states."""
        streams = next_streams(self._streams(), worlds, seeds)
        if rows is None and self._starts.can_place:
            rows = self._drawn_start(streams["start"])
        part = self._new_play(len(worlds), streams["task"])
        if "senses" in streams:
            part.senses = self._new_senses(part.frame, streams["senses"])
        varied = self._randomization.parameters
        parameters = None if varied is None else varied.draw(streams["randomization"])
        mask = np.zeros(self.worlds, np.bool_)
        mask[worlds] = True
        times = self._starts.begin(mask, rows, self.play.frame.rows, parameters)
        try:
            self._stamp(times)
            self._observe_start(worlds, part)
            for group in self.assignment.groups:
                group.restart(worlds, streams[group.name], self.action_size)
        except BaseException as error:
            self._consistency.fail("reset", error)
            raise
        self._start.put(worlds, streams["start"])
        if varied is not None:
            self._variation.put(worlds, streams["randomization"])
        if len(worlds) == self.worlds:
            self._consistency.repair()
        self._announce(worlds)

    def _drawn_start(self, rng: WorldRng) -> Floats:
        """Initial states (k, row) for k worlds: the task's own, or drawn from those given."""
        rows = initial_rows(self.task, rng)
        if self._start_rows is None:
            return rows
        drawn: Floats = self._start_rows[rng.integers(len(self._start_rows))]
        return drawn

    def _announce(self, worlds: Indices) -> None:
        """Let those who follow these worlds know that episodes have begun."""
        for listener in self._listeners:
            if listener.world in worlds:
                listener.begin()

    def _announce_state(self) -> None:
        """Let those who follow worlds that play know that these go on from another state."""
        playing = self._begun & ~self._done
        for listener in self._listeners:
            if playing[listener.world]:
                listener.begin_here()

    def _observe_start(self, worlds: Indices, part: Play) -> None:
        """Compute the first observations of worlds that the simulator has just placed."""
        part.start(self.play.frame.rows[worlds])
        part.times = None if self.play.times is None else self.play.times[worlds]
        begin(self._rules, part, np.arange(len(worlds)))
        self.task.start_episode(part)
        if part.senses is not None:
            part.senses.begin(part.frame, worlds)
        if self.assignment.reads_observations:
            self._observations[worlds] = self.task.layout.observe(part)
            observations = self._learners.select(self._observations[worlds])
            self._stack.begin(self._past, worlds, observations)
        self.play.put(worlds, part)
        self._done[worlds] = False
        self._returns[worlds] = 0.0
        self._begun[worlds] = True
        self._all_begun = bool(self._begun.all())

    def _new_play(self, n: int, rng: WorldRng) -> Play:
        """State of n worlds before their episodes begin, without senses."""
        return new_play(self.task, n, self._viewpoint, rng, self._threads)

    def _forecasting_teams(self) -> tuple[str, ...] | None:
        """All teams that forecast; None where policies do not need it."""
        sensing = simulated(self._sensing)
        if sensing is None:
            return None
        if not may_forecast(sensing, self._randomization.sensing):
            return ()
        is_of_all = not self.play.teams_differ or sensing.own_cameras >= ON
        everyone = teams_of(self.task.robots)
        return everyone if is_of_all else self.forecasting or self._observing_teams()

    def _begin_forecasts(
        self, controllers: Controllers | None, asked: Sequence[str] | Policy | None
    ) -> tuple[str, ...]:
        """Let teams forecast that are asked to or whose policies play from it, and return them."""
        if asked is not None and not isinstance(asked, Policy):
            check_forecasting(self.task, asked)
        sensing, ranges = simulated(self._sensing), self._randomization.sensing
        if sensing is None or may_forecast(sensing, ranges):
            return ()
        assignment = self.assignment
        if isinstance(asked, Policy):
            resolved = resolve(self.task, controllers).items()
            driven = {robot: asked if isinstance(each, Learn) else each for robot, each in resolved}
            assignment, asked = assign(self.task, driven, 1), None
        forecast = with_number(sensing, "forecast", 1.0)
        randomization = Randomization.of(self.randomization, self.task.config, forecast)
        together = forecast_together(forecast, randomization.sensing)
        teams = forecasting_teams(self.task, assignment, asked, together=together)
        if not teams:
            return ()
        self._sensing, self._randomization = forecast, randomization
        by_team = teams_differ(forecast, randomization.sensing)
        self.assignment = assign(self.task, controllers, self.worlds, by_team=by_team)
        return teams if by_team else teams_of(self.task.robots)

    def _new_senses(self, frame: Frame, rng: WorldRng) -> Senses | None:
        """Senses of n worlds before their episodes begin."""
        ranges = self._randomization.sensing
        simulator = self._simulator, self.worlds
        teams = self.forecasting or self._observing_teams()
        return new_senses(self._sensing, *simulator, ranges, teams, frame, rng)

    def _observing_teams(self) -> tuple[str, ...]:
        """Teams with robots that observe."""
        return teams_of(self.task.robots[robot] for robot in self.assignment.observers)

    def _state(self) -> MatchState:
        """References to all state of the matches."""
        own: dict[str, Array] = {
            "observations": self._observations,
            "returns": self._returns,
            "done": self._done,
            "begun": self._begun,
            **self._past,
        }
        groups = self.assignment.groups
        shared = ("simulator", *self.play.arrays(), "done", "begun", "rng.task", "rng.start")
        shared += ("rng.senses", "rng.randomization")
        return MatchState.of(self._simulator, self.play, groups, self._streams(), own, shared)

    def _streams(self) -> dict[str, WorldRng]:
        """All random streams by name."""
        streams = {"start": self._start, "task": self.play.rng}
        if self.play.senses is not None:
            streams["senses"] = self.play.senses.rng
        if self._randomization.parameters is not None:
            streams["randomization"] = self._variation
        return streams | {group.name: group.rng for group in self.assignment.groups}

    def _observed(self) -> Floats:
        """Copy (n, agents, o) of the learners' observations, stacked if they have a history."""
        observations = self._learners.copy(self._observations, self._threads)
        return self._stack.stack(self._past, slice(None), observations)
