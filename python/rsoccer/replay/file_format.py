"""Replay files: what `rsoccer.replay.container` holds for a replay.

Keys of the header:

| key | content |
| --- | --- |
| `package`, `physics` | versions of the package (text) and of its physics (number) |
| `task`, `options`, `controllers`, `names` | as the fields of `Replay` |
| `sensing` | JSON of `Sensing.to_json`, or "module:name" of a model; absent if none is named |
| `randomization` | distributions of numbers by name, as `Matches` takes them; absent if none |
| `forecasting` | teams that forecast although `sensing` does not; absent if none does |
| `history` | observations in each observation of the learners; absent if 1 |
| `config` | the configuration, JSON of `SimConfig.to_json` |
| `columns` | names of the stored columns: `ball`, `robot`, `command`, `referee`, `sensed` |
| `steps` | steps of the columns of `rows`, `commands`, `referee`, `sensed`; of each reward term |
| `frames`, `observers` | number of frames, names of the robots that are paid |
| `episodes` | for each start, stop, end and metrics |
| `events` | for each frame, kind, robot and detail |
| `marker_sets`, `markers` | sets of markers; pairs of a frame and the set from there on |
| `snapshots` | for each its frame, and name, type and shape of its arrays |

Sections: `rows`, `commands`, `term:<name>`, `referee` of a match with a referee and `sensed` of one
in which robots have senses hold columns as `rsoccer.replay.quantized` writes them;
`snapshot:<frame>` holds the arrays of a snapshot one after the other, exact to the last bit. The
state row of such a frame is taken from there.
"""

from __future__ import annotations

import math
from collections.abc import Container, Mapping
from dataclasses import asdict
from typing import Any

import numpy as np

from rsoccer import randomization, sensing_text
from rsoccer._core import SimConfig
from rsoccer.arrays import Doubles, Floats
from rsoccer.frame import robot_names
from rsoccer.replay import (
    container,
    header_values,
    marker_sets,
    quantized,
    referee_columns,
    sensed_poses,
    snapshot_arrays,
)
from rsoccer.replay.container import ReplayError
from rsoccer.replay.header_values import get
from rsoccer.replay.recorded import Recorded
from rsoccer.replay.sensed_poses import SensedPoses

# -- Writing -----------------------------------------------------------------------------------


def to_bytes(replay: Recorded, snapshots: bool = True) -> bytes:
    """Return the content of a replay's file.

    Args:
        replay: the replay.
        snapshots: whether to include its snapshots.

    Returns:
        The bytes; equal replays give equal bytes.

    Raises:
        ReplayError: numbers that are not finite, or a snapshot with objects.
    """
    _check_metrics(replay)
    config, kept = replay.config, replay.snapshots if snapshots else {}
    row_steps = quantized.row_steps(config.n_robots)
    command_steps = [quantized.STEPS[name] for name in config.command_columns] * config.n_robots
    term_steps = {name: quantized.term_step(name, term) for name, term in replay.terms.items()}
    commands = replay.commands.reshape(len(replay), -1)
    sections = {
        "rows": quantized.encode("rows", quantized.stored_rows(replay.rows), row_steps),
        "commands": quantized.encode("commands", commands, command_steps),
    }
    for name, term in replay.terms.items():
        sections[f"term:{name}"] = quantized.encode(f"term {name!r}", term, term_steps[name])
    referee_steps = [] if replay.referee is None else referee_columns.steps(config)
    if replay.referee is not None:
        sections["referee"] = quantized.encode("referee", replay.referee, referee_steps)
    sensed_steps = [] if replay.sensed is None else sensed_poses.steps(config)
    if replay.sensed is not None:
        sections["sensed"] = quantized.encode("sensed", replay.sensed.columns(), sensed_steps)
    header = {
        "package": replay.package,
        "physics": replay.physics,
        "task": replay.task,
        "options": replay.options,
        "controllers": dict(replay.controllers),
        "names": list(replay.names),
        **_conditions(replay),
        "config": config.to_json(),
        "columns": _columns(config, sections),
        "steps": {
            "rows": row_steps,
            "commands": command_steps,
            "terms": term_steps,
            "referee": referee_steps,
            "sensed": sensed_steps,
        },
        "frames": len(replay),
        "observers": list(replay.observers),
        "episodes": [asdict(episode) for episode in replay.episodes],
        "events": [list(event) for event in replay.events],
        **marker_sets.written(replay.markers),
        "snapshots": snapshot_arrays.described(kept),
    }
    return container.pack(header, sections | snapshot_arrays.written(kept))


def _check_metrics(replay: Recorded) -> None:
    """Refuse metrics that JSON cannot hold."""
    for episode in replay.episodes:
        for name, value in episode.metrics.items():
            if not math.isfinite(value):
                raise ReplayError(f"metric {name!r}: expected a finite number, got {value}")


def _conditions(replay: Recorded) -> dict[str, Any]:
    """Senses, varied numbers and history of the match, where it has them."""
    conditions: dict[str, Any] = {}
    if replay.sensing is not None:
        conditions["sensing"] = sensing_text.to_text(replay.sensing)
    if replay.randomization:
        conditions["randomization"] = randomization.written(replay.randomization)
    if replay.forecasting:
        conditions["forecasting"] = list(replay.forecasting)
    if replay.history > 1:
        conditions["history"] = replay.history
    return conditions


def _columns(config: SimConfig, sections: Container[str]) -> dict[str, list[str]]:
    """Names of the stored columns; none of a referee or of senses where there are none."""
    return {
        "ball": list(quantized.BALL_STORED),
        "robot": list(quantized.ROBOT_STORED),
        "command": list(config.command_columns),
        "referee": list(referee_columns.names(config)) if "referee" in sections else [],
        "sensed": list(sensed_poses.names(config)) if "sensed" in sections else [],
    }


# -- Reading -----------------------------------------------------------------------------------


def from_bytes(content: bytes) -> Recorded:
    """Return the replay with this content.

    Args:
        content: bytes from `to_bytes`.

    Returns:
        The replay.

    Raises:
        ReplayError: no replay, another version, an incomplete file or wrong bytes.
    """
    header, sections = container.unpack(content)
    config = header_values.config(get(header, "config", str))
    if header.get("columns") != _columns(config, sections):
        raise ReplayError("columns: expected those of this package, got others")
    frames = get(header, "frames", int)
    episodes = header_values.episodes(get(header, "episodes", list), frames)
    steps = get(header, "steps", dict)
    observers = header_values.texts("observers", header.get("observers"))
    stored = _section(
        sections, "rows", frames, steps.get("rows"), len(quantized.row_steps(config.n_robots))
    )
    shape = (config.n_robots, len(config.command_columns))
    commands = _section(sections, "commands", frames, steps.get("commands"), math.prod(shape))
    rows = quantized.rows_of(stored, config.n_blue, config.n_yellow)
    snapshots = snapshot_arrays.read(get(header, "snapshots", list), sections, frames)
    for frame, arrays in snapshots.items():
        snapshot_arrays.restore_row(rows, frame, arrays)
    robots = robot_names(config.n_blue, config.n_yellow)
    events = get(header, "events", list)
    return Recorded(
        task=get(header, "task", str),
        options=header_values.options(header.get("options")),
        controllers=header_values.controllers(get(header, "controllers", dict)),
        names=header_values.team_names(header.get("names")),
        sensing=header_values.sensing(header.get("sensing")),
        randomization=header_values.randomization(header.get("randomization", {}), config),
        forecasting=header_values.teams("forecasting", header.get("forecasting", [])),
        history=header_values.history(header.get("history", 1)),
        config=config,
        rows=rows,
        commands=commands.reshape(frames, *shape).astype(np.float32),
        observers=observers,
        terms=_terms(steps.get("terms"), sections, frames, len(observers)),
        markers=marker_sets.read(header, frames),
        referee=_referee(sections, frames, steps, config),
        sensed=_sensed(sections, frames, steps, config),
        episodes=episodes,
        events=tuple(header_values.event(entry, frames, robots) for entry in events),
        snapshots=snapshots,
        package=get(header, "package", str),
        physics=get(header, "physics", int),
    )


def _section(
    sections: Mapping[str, bytes], name: str, frames: int, steps: object, columns: int
) -> Doubles:
    """Columns (frames, columns) of a section."""
    checked = header_values.steps(name, steps)
    if len(checked) != columns:
        raise ReplayError(f"{name}: expected {columns} columns, got {len(checked)}")
    if name not in sections:
        raise ReplayError(f"sections: expected {name!r:.80}, got none of that name")
    return quantized.decode(name, sections[name], frames, checked)


def _referee(
    sections: Mapping[str, bytes], frames: int, steps: Mapping[str, object], config: SimConfig
) -> Doubles | None:
    """State of the referee (frames, columns), if there is one."""
    if "referee" not in sections:
        return None
    columns = len(referee_columns.names(config))
    values = _section(sections, "referee", frames, steps.get("referee"), columns)
    referee_columns.check(values)
    return values


def _sensed(
    sections: Mapping[str, bytes], frames: int, steps: Mapping[str, object], config: SimConfig
) -> SensedPoses | None:
    """Poses as the robots knew them, if they had senses."""
    if "sensed" not in sections:
        return None
    columns = len(sensed_poses.names(config))
    return SensedPoses.of_columns(
        _section(sections, "sensed", frames, steps.get("sensed"), columns)
    )


def _terms(
    steps: object, sections: Mapping[str, bytes], frames: int, observers: int
) -> dict[str, Floats]:
    """Reward terms (frames, observers) by name."""
    if not isinstance(steps, dict):
        raise ReplayError(f"steps of terms: expected an object, got {type(steps).__name__}")
    terms = {}
    for name, step in steps.items():
        values = _section(sections, f"term:{name}", frames, [step] * observers, observers)
        terms[name] = values.astype(np.float32)
    return terms
