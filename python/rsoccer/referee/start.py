"""Starts of scenes: bodies and the state of a match, by name."""

import re
from collections.abc import Mapping, Sequence
from typing import Any, Final, NoReturn

import numpy as np

from rsoccer import checks
from rsoccer._core import GAME_COLUMNS, Referee, SimConfig
from rsoccer.arrays import Array
from rsoccer.frame import Frame, robot_names
from rsoccer.game import BLUE, Command, Game, Stage

LEAGUES: Final = {"ssl": "ssl_2026_b", "vsss": "vsss_3v3"}
"""Presets of the rules that the names of leagues stand for."""
FIELDS: Final = {
    "ssl_2026_a": "ssl_a",
    "ssl_2026_b": "ssl_b",
    "vsss_3v3": "vss_3v3",
    "vsss_5v5": "vss_5v5",
}
"""Fields of the presets."""

_ROBOT: Final = re.compile(r"(blue|yellow)_(0|[1-9]\d*)", re.ASCII)
_BALL: Final = ("x", "y", "v_x", "v_y", "z", "v_z")
_BODY: Final = ("x", "y", "heading", "v_x", "v_y", "v_theta")
_CODES: Final[dict[str, type[Command] | type[Stage]]] = {
    "command": Command,
    "next_command": Command,
    "kick": Command,
    "stage": Stage,
}
_ROBOTS: Final = ("last_touch", "kick_taker", "dribbler", "pusher", "pushed")
_OWN: Final = ("ball", "robots", "seconds_left")
_MOST: Final = 2**24 - 1
"""Greatest whole number of a column: a row of float32 has all up to it."""
_LARGEST: Final = float(np.finfo(np.float32).max)
_FLAG: Final = re.compile(r"in_play|had_|has_|first_kickoff")
"""Columns that are 0 or 1."""
_REAL: Final = re.compile(r"_x$|_y$|^height_since_touch|^penalty_way")
"""Columns of places and ways; all others are whole numbers."""
_LEAST: Final = {"stage_steps_left": -_MOST, "foul_steps": -1, "removal_steps_left": -1}
"""Least values of groups of columns, where it is not 0: a stage may go on after its time, and -1
is no time."""
_TEAM: Final = re.compile(r"_(blue|yellow)$")
_NOTHING: Final = ("next_command", "kick")
"""Codes that may be None."""


def robots_of(start: Mapping[str, Any]) -> Mapping[str, Any]:
    """Return the robots of a start by name.

    Args:
        start: the start of a scene.

    Raises:
        TypeError: `start` is no mapping.
        ValueError: an unknown name.
    """
    if not isinstance(start, Mapping):
        raise TypeError(f"start: expected a mapping, got {start!r}")
    robots = start.get("robots", {})
    if not isinstance(robots, Mapping):
        raise TypeError(f"start['robots']: expected places by name, got {robots!r}")
    for name in robots:
        if not _ROBOT.fullmatch(str(name)):
            raise ValueError(f"start['robots']: expected names like 'blue_0', got {name!r}")
    return robots


def team_sizes(start: Mapping[str, Any]) -> tuple[int, int]:
    """Return the numbers of blue and of yellow robots that a start needs, each at least 1.

    Args:
        start: the start of a scene. Robots below the greatest number of a team that it does not
            name are absent.
    """
    sizes = {"blue": 1, "yellow": 1}
    names = list(robots_of(start))
    names += [start[name] for name in _ROBOTS if isinstance(start.get(name), str)]
    for name in names:
        match = _ROBOT.fullmatch(name)
        if match:
            sizes[match[1]] = max(sizes[match[1]], int(match[2]) + 1)
    return sizes["blue"], sizes["yellow"]


def frame_of(start: Mapping[str, Any], config: SimConfig) -> Frame:
    """Return the bodies of a start; robots that it does not name are absent.

    Args:
        start: the start of a scene.
        config: field, ball and robots.

    Raises:
        TypeError: a body that is no sequence of numbers and no mapping.
        ValueError: too few or too many numbers, one that is not finite, or an unknown name.
    """
    frame = Frame.empty(1, config.n_blue, config.n_yellow)
    ball = _numbers("ball", start.get("ball", (0.0, 0.0)), _BALL)
    frame.ball.position[0] = ball["x"], ball["y"]
    frame.ball.velocity[0] = ball["v_x"], ball["v_y"]
    frame.ball.height[0], frame.ball.vertical_velocity[0] = ball["z"], ball["v_z"]
    robots = frame.robots
    robots.absent[:] = 1.0
    robots.heading[0, :, 0] = 1.0
    names = robot_names(config.n_blue, config.n_yellow)
    for name, given in robots_of(start).items():
        if name not in names:
            raise ValueError(f"start['robots']: expected names of {names}, got {name!r}")
        body = _numbers(f"robots[{name!r}]", given, _BODY)
        index = names.index(name)
        robots.absent[0, index] = 0.0
        robots.position[0, index] = body["x"], body["y"]
        robots.heading[0, index] = np.cos(body["heading"]), np.sin(body["heading"])
        robots.velocity[0, index] = body["v_x"], body["v_y"]
        robots.angular_velocity[0, index] = body["v_theta"]
    return frame


def game_of(start: Mapping[str, Any], config: SimConfig, time_step: float) -> Game:
    """Return the state of the match of a start: the ball is free for all, unless it says else.

    Args:
        start: the start of a scene.
        config: field, ball and robots.
        time_step: duration of a control step, s.

    Raises:
        TypeError: a value of another type.
        ValueError: an unknown name, or a value that its column cannot have.
    """
    row = Referee.new_game(BLUE)
    game = Game({"referee": row[None]})
    values: dict[str, Any] = {
        "stage": "NORMAL_FIRST_HALF",
        "seconds_left": 300.0,
        "command": "FORCE_START",
    }
    values |= {name: value for name, value in start.items() if name not in ("ball", "robots")}
    command = _code("command", values["command"], Command)
    values.setdefault("next_command", None)
    values.setdefault("kick", command)
    kicks = (Command.DIRECT_FREE_BLUE, Command.DIRECT_FREE_YELLOW, Command.NORMAL_START)
    values.setdefault("in_play", command == Command.FORCE_START)
    names = robot_names(config.n_blue, config.n_yellow)
    ball = start.get("ball", (0.0, 0.0))
    position = _numbers("ball", ball, _BALL)
    place = position["x"], position["y"]
    if command in kicks:
        values.setdefault("kick_position", place)
    if values.get("last_touch") is not None:
        values.setdefault("last_touch_position", place)
    most = _MOST * time_step
    seconds = checks.number_in_range(
        "start['seconds_left']", values.pop("seconds_left"), -most, most
    )
    values.setdefault("stage_steps_left", round(seconds / time_step))
    for name, value in values.items():
        _set(game, name, value, names)
    return game


def _set(game: Game, name: str, value: Any, names: Sequence[str]) -> None:  # noqa: ANN401
    """Set a column, or the columns of a group, of the state of a match."""
    if name in _CODES:
        game.referee[0, GAME_COLUMNS.index(name)] = _code(name, value, _CODES[name])
        return
    if name in _ROBOTS:
        if value is not None and value not in names:
            raise ValueError(f"start[{name!r}]: expected one of {tuple(names)}, got {value!r}")
        value = -1 if value is None else names.index(value)
    if not isinstance(name, str) or name in game or not hasattr(game, name):
        _unknown(name)
    columns = getattr(game, name)
    if not isinstance(columns, np.ndarray):
        _unknown(name)
    numbers = _columns(name, value, columns[0].shape)
    columns[0] = numbers


def _columns(name: str, value: object, shape: tuple[int, ...]) -> Array:
    """Numbers of a column or a group of columns, as the core reads them."""
    try:
        numbers = np.asarray(value, np.float64).reshape(shape)
    except (TypeError, ValueError):
        raise ValueError(
            f"start[{name!r}]: expected numbers of shape {shape}, got {value!r}"
        ) from None
    if not (np.abs(numbers) <= _LARGEST).all():  # refuses NaN too
        raise ValueError(f"start[{name!r}]: expected finite numbers, got {value!r}")
    group = next(each for each in GAME_COLUMNS if each.startswith(name))
    if _REAL.search(group):
        return numbers
    least = _LEAST.get(_TEAM.sub("", group), -1 if name in _ROBOTS else 0)
    most = 1 if _FLAG.match(group) else _MOST
    if (numbers != np.rint(numbers)).any() or (numbers < least).any() or (numbers > most).any():
        expected = f"whole numbers from {least} to {most}"
        raise ValueError(f"start[{name!r}]: expected {expected}, got {value!r}")
    return numbers


def _unknown(name: object) -> NoReturn:
    known = ", ".join([*_OWN, *GAME_COLUMNS])
    raise ValueError(f"start: expected names of {known}, got {name!r}")


def _code(name: str, value: object, kind: type[Command] | type[Stage]) -> int:
    """Number of a command or a stage; -1 for None where there may be none."""
    if value is None and name in _NOTHING:
        return -1
    if isinstance(value, str) and value in kind.__members__:
        return int(kind[value])
    if (
        isinstance(value, int)
        and not isinstance(value, bool)
        and value in [int(member) for member in kind]
    ):
        return int(value)
    raise ValueError(f"start[{name!r}]: expected one of {list(kind.__members__)}, got {value!r}")


def _numbers(name: str, given: object, names: Sequence[str]) -> dict[str, float]:
    """Numbers of a body by name; those that are not given are 0."""
    if isinstance(given, Mapping):
        unknown = [key for key in given if key not in names]
        if unknown:
            raise ValueError(f"start: {name}: expected names of {names}, got {unknown}")
        found = dict(given)
    elif not isinstance(given, Sequence | np.ndarray) or isinstance(given, str):
        raise TypeError(f"start: {name}: expected numbers {names}, got {given!r}")
    elif not 2 <= len(given) <= len(names):
        raise ValueError(f"start: {name}: expected 2 to {len(names)} of {names}, got {given!r}")
    else:
        found = dict(zip(names, given, strict=False))
    return dict.fromkeys(names, 0.0) | {
        key: checks.number_in_range(f"start: {name}: {key}", value, -_LARGEST, _LARGEST)
        for key, value in found.items()
    }
