"""Checked values of the header of a replay file."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import fields
from typing import Any, Final, TypeVar

from rsoccer import sensing_text
from rsoccer._core import Sensing, SimConfig
from rsoccer.randomization import Randomization
from rsoccer.replay.container import ReplayError
from rsoccer.replay.events import KINDS, Event
from rsoccer.replay.quantized import MAX_STEP
from rsoccer.replay.recorded import Episode
from rsoccer.view import SIDES

ENDS: Final = ("terminated", "truncated", "")
MIN_FIELD, MAX_FIELD = 0.1, 1000.0
"""Smallest length and width of a field that can be drawn, and largest size in it, meters."""
MAX_HISTORY: Final = 100_000
"""Longest history, some 40 minutes: a longer one could fill the memory before it is refused."""
MIN_TIME_STEP: Final = 1e-4
"""Shortest control step that can be played, seconds: a pause of a second is 10,000 images."""

T = TypeVar("T")


def get(header: Mapping[str, Any], key: str, kind: type[T]) -> T:
    """Return the value of a key.

    Args:
        header: the header.
        key: the key.
        kind: type that the value must have.

    Raises:
        ReplayError: no such key, or a value of another type.
    """
    value = header.get(key)
    if type(value) is not kind:
        raise ReplayError(f"{key}: expected {kind.__name__}, got {type(value).__name__}")
    return value


def config(text: str) -> SimConfig:
    """Return a configuration from JSON.

    Args:
        text: the JSON.

    Raises:
        ReplayError: no JSON of a configuration, or sizes that no image can show.
    """
    try:
        config = SimConfig.from_json(text)
    except ValueError as error:
        raise ReplayError(f"config: {error}") from None
    _check_drawable(config)
    return config


def _check_drawable(config: SimConfig) -> None:
    """Refuse sizes for which an image would be endless, or too large for the memory."""
    for name, size in json.loads(config.to_json())["field"].items():
        low = MIN_FIELD if name in ("length", "width") else 0.0
        if is_number(size) and not low <= size <= MAX_FIELD:
            raise ReplayError(
                f"config: expected a field {name} of {low:g} to {MAX_FIELD:g}, got {size:g}"
            )
    if config.time_step < MIN_TIME_STEP:
        raise ReplayError(
            f"config: expected a time_step of at least {MIN_TIME_STEP:g} s, "
            f"got {config.time_step:g}"
        )


def steps(name: str, value: object) -> list[float]:
    """Return the steps of columns: positive finite numbers.

    Args:
        name: name of the section, for errors.
        value: a list of numbers.

    Raises:
        ReplayError: another value.
    """
    numbers: list[Any] = value if isinstance(value, list) else []
    found = [float(v) for v in numbers if is_number(v) and 0 < v <= MAX_STEP]
    if not isinstance(value, list) or len(found) < len(numbers):
        raise ReplayError(f"steps of {name}: expected positive numbers, got {value!s:.80}")
    return found


def episodes(entries: list[Any], frames: int) -> tuple[Episode, ...]:
    """Return episodes that cover all frames, in order.

    Args:
        entries: the fields of each by name.
        frames: number of frames.

    Raises:
        ReplayError: other values, or frames that are missing.
    """
    found, start = [], 0
    for entry in entries:
        if not isinstance(entry, dict) or set(entry) != {f.name for f in fields(Episode)}:
            raise ReplayError(f"episodes: expected start, stop, end, metrics, got {entry!s:.80}")
        stop, end = entry["stop"], entry["end"]
        valid = type(stop) is int and entry["start"] == start and start < stop <= frames
        if not valid or end not in ENDS:
            raise ReplayError(f"episodes: expected frames in order, got {entry!s:.80}")
        found.append(Episode(start, stop, end, _metrics(entry["metrics"])))
        start = stop
    if start != frames or not frames:
        raise ReplayError(f"episodes: expected all {frames} frames, at least 1, got {start}")
    return tuple(found)


def _metrics(value: object) -> dict[str, float]:
    """Metrics by name."""
    if not isinstance(value, dict) or not all(map(is_number, value.values())):
        raise ReplayError(f"metrics: expected numbers by name, got {value!s:.80}")
    return {name: float(v) for name, v in value.items()}


def event(entry: object, frames: int, robots: tuple[str, ...]) -> Event:
    """Return an event.

    Args:
        entry: frame, kind, robot and detail.
        frames: number of frames.
        robots: names of the robots.

    Raises:
        ReplayError: other values.
    """
    if not isinstance(entry, list) or [type(part) for part in entry] != [int, str, str, str]:
        raise ReplayError(f"events: expected a frame and three texts, got {entry!s:.80}")
    found = Event(*entry)
    if not 0 <= found.frame < frames or found.kind not in KINDS or found.robot not in ("", *robots):
        raise ReplayError(f"events: expected a frame, a kind and a robot, got {entry!s:.80}")
    if found.kind == "goal" and found.detail not in SIDES:
        raise ReplayError(f"events: expected the team of a goal, got {entry!s:.80}")
    return found


def texts(name: str, value: object) -> tuple[str, ...]:
    """Return texts.

    Args:
        name: name of the value, for errors.
        value: a list of texts.

    Raises:
        ReplayError: another value.
    """
    if not isinstance(value, list) or not all(isinstance(part, str) for part in value):
        raise ReplayError(f"{name}: expected texts, got {value!s:.80}")
    return tuple(value)


def team_names(value: object) -> tuple[str, str]:
    """Return the names of blue and of yellow.

    Args:
        value: a list of two texts.

    Raises:
        ReplayError: another value.
    """
    names = texts("names", value)
    if len(names) != 2:
        raise ReplayError(f"names: expected two, got {len(names)}")
    return (names[0], names[1])


def controllers(value: dict[str, Any]) -> dict[str, str | None]:
    """Return names of controllers by robot.

    Args:
        value: texts or None by robot.

    Raises:
        ReplayError: another value.
    """
    if not all(part is None or isinstance(part, str) for part in value.values()):
        raise ReplayError("controllers: expected names by robot, got other values")
    return value


def options(value: object) -> dict[str, Any] | None:
    """Return options of a task.

    Args:
        value: values by name, or None.

    Raises:
        ReplayError: another value.
    """
    if value is not None and not isinstance(value, dict):
        raise ReplayError(f"options: expected an object or null, got {type(value).__name__}")
    return value


def teams(name: str, value: object) -> tuple[str, ...]:
    """Return names of teams.

    Args:
        name: name of the value, for errors.
        value: a list of "blue" and "yellow".

    Raises:
        ReplayError: another value.
    """
    found = texts(name, value)
    if set(found) - set(SIDES):
        raise ReplayError(f"{name}: expected some of {list(SIDES)}, got {value!s:.80}")
    return found


def sensing(value: object) -> Sensing | str | None:
    """Return senses.

    Args:
        value: JSON of a `Sensing` or "module:name", or None.

    Raises:
        ReplayError: another value.
    """
    if value is None:
        return None
    if not isinstance(value, str):
        raise ReplayError(f"sensing: expected a text, got {type(value).__name__}")
    try:
        return sensing_text.from_text(value)
    except ValueError as error:
        raise ReplayError(str(error)) from None


def randomization(value: object, config: SimConfig) -> dict[str, Any]:
    """Return distributions by name.

    Args:
        value: distributions by name.
        config: the models whose numbers they vary.

    Raises:
        ReplayError: another value.
    """
    if not isinstance(value, dict):
        raise ReplayError(f"randomization: expected an object, got {type(value).__name__}")
    try:
        Randomization.of(value, config, None)
    except (TypeError, ValueError) as error:
        raise ReplayError(str(error)) from None
    except OverflowError as error:
        raise ReplayError(f"randomization: {error}") from None
    return value


def history(value: object) -> int:
    """Return the number of observations in an observation of the learners.

    Args:
        value: a whole number, at least 1.

    Raises:
        ReplayError: another value.
    """
    if type(value) is not int or not 1 <= value <= MAX_HISTORY:
        raise ReplayError(f"history: expected 1 to {MAX_HISTORY}, got {value!s:.80}")
    return value


def lists(name: str, entries: list[Any]) -> list[list[Any]]:
    """Return lists.

    Args:
        name: name of the value, for errors.
        entries: a list of lists.

    Raises:
        ReplayError: another value.
    """
    if not all(isinstance(entry, list) for entry in entries):
        raise ReplayError(f"{name}: expected lists, got other values")
    return entries


def is_number(value: object) -> bool:
    """Return whether a value is a finite number that a float can hold.

    Args:
        value: any value.
    """
    return isinstance(value, int | float) and type(value) is not bool and abs(value) < 1e300
