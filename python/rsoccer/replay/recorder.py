"""Recording of matches: a recorder beside any step loop, and whole matches between policies."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from rsoccer import checks, sensing_text
from rsoccer._core import build_info
from rsoccer.arrays import Array, Doubles, Floats
from rsoccer.controllers import Controllers, resolve
from rsoccer.frame import Frame
from rsoccer.markers import Marker
from rsoccer.matches import Matches, Outcome
from rsoccer.matches.policy_match import policy_match
from rsoccer.randomization import Ranges
from rsoccer.registry import options_of
from rsoccer.render.referee_state import referee_row
from rsoccer.replay.events import Event, ball_events, game_events
from rsoccer.replay.recorded import Episode
from rsoccer.replay.replay import Replay
from rsoccer.replay.resume import described_controllers
from rsoccer.replay.sensed_poses import SensedPoses
from rsoccer.sources import SensingSource, SimulatorSource, closed_after
from rsoccer.task import Task


class Recorder:
    """A record of one world of `Matches`, which the caller resets and steps.

    Call `begin` after each reset of the world and `add` after each step. A world that waits for a
    reset may be stepped on; nothing is added. With `attach=True` the matches call both themselves,
    so that matches can be recorded that a library steps, as in
    `Recorder(envs.matches, attach=True)` beside Stable-Baselines3; the record begins with the next
    episode of the world, and `matches.detach(recorder)` ends it.

    Example:
        >>> import numpy as np
        >>> import rsoccer
        >>> from rsoccer.replay import Recorder
        >>> matches = rsoccer.Matches("VSSMulti-v0", autoreset="disabled")
        >>> recorder = Recorder(matches)
        >>> observations = matches.reset(seed=0)
        >>> recorder.begin()
        >>> actions = np.zeros((1, len(matches.agents), matches.action_size), np.float32)
        >>> while not matches.done[0]:
        ...     recorder.add(matches.step(actions))
        >>> recorder.replay().seconds
        30.0

    Attributes:
        matches: the matches.
        world: index of the recorded world.
    """

    def __init__(
        self,
        matches: Matches,
        world: int = 0,
        *,
        names: tuple[str, str] = ("BLUE", "YELLOW"),
        controllers: Controllers | None = None,
        snapshot_interval: float | None = None,
        attach: bool = False,
    ) -> None:
        """Prepare a record; `begin` adds its first frame.

        Args:
            matches: the matches. Without `attach` their `autoreset` is "disabled" or "next_step":
                within "same_step" the last state of an episode cannot be seen from outside.
            world: index of the world to record.
            names: names of blue and of yellow on the score board.
            controllers: controllers that the matches were made with, so that `Replay.resume` can
                make them again.
            snapshot_interval: seconds of play between two snapshots, above 0, the first at the
                start; None for no snapshots. They need matches of one world.
            attach: True if the matches call `begin` and `add`; then the caller does not.

        Raises:
            TypeError: an argument of the wrong type.
            ValueError: matches that reset within a step, a world or an interval out of range, or
                snapshots of several worlds.
        """
        self._attached = checks.boolean("attach", attach)
        if matches.autoreset == "same_step" and not attach:
            raise ValueError(
                "matches: expected autoreset 'disabled' or 'next_step', or attach=True, "
                "got same_step"
            )
        if checks.integer("world", world, 0) >= matches.worlds:
            raise ValueError(f"world: expected 0 to {matches.worlds - 1}, got {world}")
        if snapshot_interval is not None:
            checks.positive_number("snapshot_interval", snapshot_interval)
            if matches.worlds > 1:
                raise ValueError(
                    f"snapshot_interval: expected None for {matches.worlds} worlds, "
                    f"got {snapshot_interval}"
                )
        self._names = checks.team_names(names)
        self.matches, self.world = matches, world
        self._controllers = described_controllers(resolve(matches.task, controllers))
        self._interval = snapshot_interval
        self._rows: list[Floats] = []
        self._commands: list[Floats] = []
        self._terms: list[Mapping[str, Floats]] = []
        self._markers: list[tuple[Marker, ...]] = []
        self._referee: list[Doubles] = []
        self._sensed: list[Floats] = []
        self._events: list[Event] = []
        self._episodes: list[Episode] = []
        self._snapshots: dict[int, Mapping[str, Array]] = {}
        self._next_snapshot = 0.0
        self._start = 0
        self._ended = True
        if attach:
            matches.attach(self)

    def begin(self) -> None:
        """Add the initial state of an episode, after a reset of the world.

        Raises:
            RuntimeError: the world has stepped since its reset.
        """
        if self.matches.play.steps[self.world]:
            raise RuntimeError("begin after a step: call it directly after reset")
        self.begin_here()

    def begin_here(self) -> None:
        """Add the present state as the first one of an episode, of which a part has been played."""
        self._close("", {})
        self._start, self._ended = len(self._rows), False
        self._add_frame(np.zeros_like(self.matches.play.commands[self.world]), {})

    def add(self, outcome: Outcome) -> None:
        """Add the state after a step.

        Args:
            outcome: result of the step, of all worlds.

        Raises:
            RuntimeError: no `begin` since the world was reset.
            ValueError: a reward term, or a metric at the end of an episode, that is not finite:
                files do not hold it. Nothing has changed.
        """
        matches, world = self.matches, self.world
        if self._ended and self._attached:
            return  # the matches call `begin`
        if self._ended and matches.autoreset == "next_step" and self._rows:
            self.begin()  # this step has reset the world
            return
        if self._ended:
            if matches.done[world] and not outcome.ended[world]:
                return  # the world waits
            raise RuntimeError("add before begin: call begin() after each reset")
        terms = {name: np.array(term[world]) for name, term in matches.observer_terms.items()}
        metrics = {}
        if outcome.ended[world]:
            metrics = {name: float(value[world]) for name, value in outcome.metrics.items()}
        task = type(matches.task).__name__
        _check_finite(f"{task}.calculate_reward_and_done", terms)
        _check_finite(f"{task}.metrics", metrics)
        self._add_frame(matches.play.commands[world].copy(), terms)
        index, config = len(self._rows) - 1, matches.task.config
        rows = np.stack(self._rows[-2:])
        robots = matches.task.robots
        self._events += ball_events(config, robots, index, rows, self._commands[-1])
        self._events += game_events(robots, index, matches.play.events.of_world(world))
        if outcome.ended[world]:
            end = "terminated" if outcome.terminated[world] else "truncated"
            self._events.append(Event(index, "end", "", end))
            self._close(end, metrics)

    def replay(self) -> Replay:
        """Return what has been recorded so far.

        Returns:
            A replay, which later frames leave as it is.

        Raises:
            RuntimeError: no `begin` yet.
        """
        if not self._rows:
            raise RuntimeError("replay before begin: nothing has been recorded")
        task, play, info = self.matches.task, self.matches.play, build_info()
        observers = tuple(task.robots[i] for i in play.observers)
        names = {name: None for terms in self._terms for name in terms}
        none = np.zeros(len(observers), np.float32)
        terms = {name: np.stack([step.get(name, none) for step in self._terms]) for name in names}
        last = [] if self._ended else [Episode(self._start, len(self._rows), "")]
        return Replay(
            task=task.name,
            options=options_of(task),
            controllers=self._controllers,
            names=self._names,
            sensing=sensing_text.recordable(self.matches.sensing),
            randomization=self.matches.randomization,
            forecasting=self.matches.forecasting,
            history=self.matches.history,
            config=task.config,
            rows=np.stack(self._rows),
            commands=np.stack(self._commands),
            observers=observers,
            terms=terms,
            markers=tuple(self._markers),
            referee=np.stack(self._referee) if self._referee else None,
            sensed=self._sensed_poses(),
            episodes=(*self._episodes, *last),
            events=tuple(self._events),
            snapshots=dict(self._snapshots),
            package=str(info["version"]),
            physics=int(info["physics"]),
        )

    @property
    def seconds(self) -> float:
        """Duration of play so far, s."""
        starts = len(self._episodes) + (not self._ended)
        return (len(self._rows) - starts) * self.matches.task.config.time_step

    def _add_frame(self, commands: Floats, terms: Mapping[str, Floats]) -> None:
        """Add the current state, and a snapshot if one is due."""
        matches, play = self.matches, self.matches.play
        self._rows.append(matches.frame.rows[self.world].copy())
        self._commands.append(commands)
        self._terms.append(terms)
        self._markers.append(matches.task.markers(play, self.world))
        referee = referee_row(matches.task, play, self.world)
        if referee is not None:
            self._referee.append(referee)
        if play.senses is not None:
            self._sensed.append(play.sensed.rows[self.world].copy())
        if self._interval is not None and self.seconds >= self._next_snapshot - 1e-9:
            self._snapshots[len(self._rows) - 1] = matches.state_dict()
            self._next_snapshot = self.seconds + self._interval

    def _sensed_poses(self) -> SensedPoses | None:
        """Poses as the robots knew them, in all frames."""
        if not self._sensed:
            return None
        config = self.matches.task.config
        frame = Frame(np.stack(self._sensed), config.n_blue, config.n_yellow)
        return SensedPoses.of_frame(frame)

    def _close(self, end: str, metrics: dict[str, float]) -> None:
        """End the current episode, if there is one."""
        if not self._ended:
            self._episodes.append(Episode(self._start, len(self._rows), end, metrics))
            self._ended = True


def _check_finite(source: str, named: Mapping[str, Floats | float]) -> None:
    """Refuse numbers by name that a file cannot hold."""
    for name, value in named.items():
        if not np.isfinite(value).all():
            raise ValueError(f"{source}: expected finite numbers for {name!r}, got {value}")


def record_replay(
    task: Task | str | None = None,
    controllers: Controllers | None = None,
    seed: int = 0,
    seconds: float = 30.0,
    *,
    names: tuple[str, str] = ("BLUE", "YELLOW"),
    snapshot_interval: float | None = None,
    simulator: SimulatorSource | None = None,
    sensing: SensingSource | None = None,
    randomization: Ranges | None = None,
) -> Replay:
    """Play a match between policies, episode after episode, and record it.

    The match is the one that `rsoccer.recording.film_match` shows for the same arguments.

    Args:
        task: the task or its id; by default the task of the first trained policy among
            `controllers`, or VSSSelfPlay-v0.
        controllers: policies as `Matches` takes them, for all robots.
        seed: seed of starts and policies.
        seconds: duration of play, above 0.
        names: names of blue and of yellow on the score board.
        snapshot_interval: seconds between snapshots, above 0; None for no snapshots.
        simulator: moves the robots, as for `Matches`.
        sensing: what robots know of the true state, as for `Matches`.
        randomization: numbers that each episode draws, as for `Matches`.

    Returns:
        The replay.

    Raises:
        ImportError: a text "module:name" whose module or name does not exist.
        ValueError: `seconds` is not positive, a robot has no policy, or another bad argument.
    """
    matches = policy_match(
        task,
        controllers,
        seed,
        seconds,
        simulator=simulator,
        sensing=sensing,
        randomization=randomization,
    )
    with closed_after(matches, simulator):
        recorder = Recorder(
            matches, names=names, controllers=controllers, snapshot_interval=snapshot_interval
        )
        actions = np.zeros((1, 0, matches.action_size), np.float32)  # no robot learns
        matches.reset()
        recorder.begin()
        for _ in range(max(1, round(seconds / matches.task.config.time_step))):
            if matches.done[0]:
                matches.reset()
                recorder.begin()
            recorder.add(matches.step(actions))
        return recorder.replay()
