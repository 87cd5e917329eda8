"""Scenes: situations of a match that are played under the referee."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from rsoccer import _core, checks
from rsoccer._core import SimConfig, Simulator
from rsoccer.arrays import Array, Floats
from rsoccer.frame import Frame, robot_names
from rsoccer.game import Command, EventKind, Game
from rsoccer.referee.start import FIELDS, LEAGUES, frame_of, game_of, team_sizes
from rsoccer.rules.referee_config import RefereeConfig

Commands = Mapping[str, Any] | Callable[[Frame, float], Array] | Array | None
"""Commands of robots: numbers by the robot's name, (robots, command) for all steps, a function of
the frame and the time (s) that returns (robots, command), or None to stand still."""


@dataclass(frozen=True)
class SceneEvent:
    """Something that the referee decided in a scene."""

    seconds: float
    """Time since the scene began, s."""
    kind: EventKind
    """Kind of the event."""
    team: str | None
    """"blue", "yellow", or None."""
    robot: str | None
    """Name of the robot, or None."""
    position: tuple[float, float]
    """Place, m."""


@dataclass(frozen=True)
class Scene:
    """Result of a scene."""

    events: tuple[SceneEvent, ...]
    """Events in their order."""
    restart: Frame | None
    """Bodies (1, ...) as the referee put them in its first restart; None if it put none."""
    command: Command
    """Command of the referee at the end."""
    next_command: Command | None
    """Command that follows; None if none is decided."""
    commands: tuple[tuple[float, Command], ...]
    """All commands of the referee, with the times at which they began, s."""
    score: tuple[int, int]
    """Goals of blue and of yellow."""
    game: Game
    """State of the match (1, ...) at the end."""
    frame: Frame
    """Bodies (1, ...) at the end."""


def play_scene(
    league: str | RefereeConfig,
    start: Mapping[str, Any],
    commands: Commands = None,
    seconds: float = 1.0,
    config: SimConfig | None = None,
) -> Scene:
    """Play a situation under the referee.

    Args:
        league: rules: "ssl" (division B), "vsss" (three a side), the name of a preset, or a
            `RefereeConfig`.
        start: how the scene begins. "ball": x, y, and optionally v_x, v_y, z, v_z (m, m/s);
            "robots": by name x, y, and optionally heading (radians), v_x, v_y, v_theta. Robots that
            are not named are absent. All else is the state of the match, by the names of
            `rsoccer._core.GAME_COLUMNS` or without their ends: "command" and "next_command" (names
            of `Command`; "FORCE_START" by default), "kick" (the command that prepared a
            "NORMAL_START"), "stage", "seconds_left" (of the stage, 300), "score" (blue, yellow),
            "last_touch" and "kick_taker" (names of robots), "designated_position", "in_play",
            "fouls", "yellow_cards" and so on.
        commands: commands of the robots in SI units, with the columns `config.command_columns`.
        seconds: duration, s.
        config: field, ball, robots and time step; by default those of the league.

    Returns:
        Events, restarts and commands of the referee.

    Raises:
        TypeError: an argument of another type.
        ValueError: an unknown name, a number out of range, or bodies that overlap.

    Example:
        >>> from rsoccer.referee import play_scene
        >>> kick = {"ball": (3.0, 0.0, 4.0, 0.0), "last_touch": "blue_0"}
        >>> play_scene("ssl", kick).score
        (1, 0)
    """
    rules = league if isinstance(league, RefereeConfig) else _rules(league)
    if not 0.0 <= checks.number("seconds", seconds) < math.inf:
        raise ValueError(f"seconds: expected at least 0, got {seconds}")
    if config is None:
        config = SimConfig(FIELDS[rules.preset], *team_sizes(start))
    elif not isinstance(config, SimConfig):
        raise TypeError(f"config: expected a SimConfig, got {config!r}")
    referee = _core.Referee(config, rules.to_json())
    played = _Played(referee, config, start)
    for step in range(round(seconds / config.time_step)):
        played.step(_commands(commands, played.frame, step * config.time_step, config))
    return played.result()


class _Played:
    """A scene in progress."""

    def __init__(self, referee: _core.Referee, config: SimConfig, start: Mapping[str, Any]) -> None:
        self.referee = referee
        self.frame = frame_of(start, config)
        self.game = _with_outputs(game_of(start, config, config.time_step), config)
        self.names = robot_names(config.n_blue, config.n_yellow)
        self.time_step, self.steps = config.time_step, 0
        self.events: list[SceneEvent] = []
        self.restart: Frame | None = None
        self.simulator = Simulator(config, 1)
        self.all = np.ones(1, np.bool_)
        self.simulator.place(self.all, self.frame.rows.copy(), self.frame.rows)
        self.commands = [(0.0, Command(int(self.game.command[0])))]

    def step(self, commands: Floats) -> None:
        """Play one control step."""
        rows, before = self.frame.rows, self.frame.rows.copy()
        self.simulator.step(commands[None], out=rows)
        self.steps += 1
        restart = np.empty_like(rows)
        restarts, events = self.referee.judge(before, rows, self._matches(), restart)
        if events is not None:
            self.events += [self._event(event) for event in events.tolist()]
        if restarts is not None:
            self.simulator.restart(self.all, restart, rows)
            self.referee.begin(rows, self._matches())
            if self.restart is None:
                self.restart = self.frame.take(np.arange(1))
        command = Command(int(self.game.command[0]))
        if command != self.commands[-1][1]:
            self.commands.append((self._seconds, command))

    def result(self) -> Scene:
        """Return what happened."""
        following = int(self.game.next_command[0])
        blue, yellow = self.game.score[0].tolist()
        return Scene(
            events=tuple(self.events),
            restart=self.restart,
            command=self.commands[-1][1],
            next_command=None if following < 0 else Command(following),
            commands=tuple(self.commands),
            score=(blue, yellow),
            game=self.game,
            frame=self.frame,
        )

    @property
    def _seconds(self) -> float:
        return self.steps * self.time_step

    def _matches(self) -> tuple[Array, ...]:
        game = self.game
        return game.referee, game.statistics, game.score, game.seconds_left, game.may_touch

    def _event(self, numbers: list[float]) -> SceneEvent:
        _, kind, team, robot, x, y = numbers
        return SceneEvent(
            seconds=self._seconds,
            kind=EventKind(int(kind)),
            team=None if team < 0 else ("blue", "yellow")[int(team)],
            robot=None if robot < 0 else self.names[int(robot)],
            position=(x, y),
        )


def _rules(league: object) -> RefereeConfig:
    """The rules of a league or a preset by name."""
    if not isinstance(league, str):
        raise TypeError(f"league: expected a name or a RefereeConfig, got {league!r}")
    name = LEAGUES.get(league, league)
    if name not in FIELDS:
        raise ValueError(f"league: expected one of {(*LEAGUES, *FIELDS)}, got {league!r}")
    return RefereeConfig(name)


def _with_outputs(game: Game, config: SimConfig) -> Game:
    """The state of a match, with the arrays that the referee writes."""
    robots = config.n_blue + config.n_yellow
    return Game(
        {
            "score": game.score.astype(np.int64),
            "referee": game.referee,
            "statistics": np.zeros((1, len(_core.STATISTICS_COLUMNS)), np.float32),
            "seconds_left": np.zeros(1, np.float32),
            "may_touch": np.zeros((1, robots), np.bool_),
        }
    )


def _commands(commands: Commands, frame: Frame, seconds: float, config: SimConfig) -> Floats:
    """Commands (robots, command) of one step."""
    names = robot_names(config.n_blue, config.n_yellow)
    shape = (len(names), len(config.command_columns))
    found = np.zeros(shape, np.float32)
    if commands is None:
        return found
    if callable(commands):
        commands = commands(frame, seconds)
    if isinstance(commands, Mapping):
        for name, numbers in commands.items():
            if name not in names:
                raise ValueError(f"commands: expected names of {names}, got {name!r}")
            found[names.index(name)] = _numbers(f"commands[{name!r}]", numbers, shape[1:])
        return found
    return _numbers("commands", commands, shape)


def _numbers(name: str, value: object, shape: tuple[int, ...]) -> Floats:
    """Finite numbers of a shape; whole ones are taken too."""
    array = checks.as_array(name, value)
    return checks.floats(
        name, array.astype(np.float32) if array.dtype.kind in "iu" else array, shape
    )
