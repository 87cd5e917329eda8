"""Matches that continue from a snapshot of a replay, and what is kept to make them again."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Final

from rsoccer import registry
from rsoccer._core import Sensing, build_info
from rsoccer.controllers import Controller, Controllers
from rsoccer.matches import Matches
from rsoccer.policies import is_module_text
from rsoccer.policies.base import Policy
from rsoccer.randomization import Ranges
from rsoccer.replay.container import ReplayError
from rsoccer.replay.recorded import Recorded
from rsoccer.sources import SensingSource, SimulatorSource, closed_on_error
from rsoccer.task import LEARN, Learn, Task

REFUSALS: Final = (
    *(ArithmeticError, AttributeError, ImportError, LookupError, OSError, TypeError, ValueError),
)
"""Errors of what a file names: a task's own checks of its options may meet values of any type."""
LEARNER: Final = "LEARN"
"""Name of a learner among the controllers of a replay."""


def resume(
    replay: Recorded,
    frame: int,
    task: Task | None,
    controllers: Controllers | None,
    *,
    simulator: SimulatorSource | None,
    sensing: SensingSource | None,
    randomization: Ranges | None,
) -> Matches:
    """Continue a match from a frame with a snapshot.

    Args:
        replay: the replay.
        frame: index of the frame.
        task: the task; None to make it from the replay.
        controllers: controllers; None for those of the replay.
        simulator: moves the robots, as for `Matches`.
        sensing: what robots know of the true state, as for `Matches`; None for that of the replay.
        randomization: numbers that each episode draws; None for those of the replay.

    Returns:
        Matches of one world at that frame.

    Raises:
        ReplayError: no snapshot at that frame, another version of the physics, or a task,
            controllers or senses that do not fit or have to be given.
    """
    if frame not in replay.snapshots:
        held = sorted(replay.snapshots) or "none"
        raise ReplayError(f"frame: expected one with a snapshot ({held}), got {frame}")
    _check_physics(replay)
    try:
        task, sensing = made_again(replay, task, sensing)
        given = _named(replay.controllers) if controllers is None else controllers
        matches = Matches(
            task,
            controllers=given,
            autoreset="disabled",
            simulator=simulator,
            sensing=sensing,
            forecasting=replay.forecasting,
            randomization=replay.randomization if randomization is None else randomization,
            history=replay.history,
        )
        with closed_on_error(matches, simulator):
            matches.load_state_dict(replay.snapshots[frame])
    except ReplayError:
        raise
    except REFUSALS as error:
        raise ReplayError(f"resume: {error}") from error
    return matches


def made_again(
    replay: Recorded, task: Task | None, sensing: SensingSource | None
) -> tuple[Task, SensingSource | None]:
    """Return the task and the senses of a recording.

    Args:
        replay: the replay.
        task: the task; None to make it from the replay.
        sensing: what robots know of the true state; None for that of the replay.

    Raises:
        ReplayError: a task or senses that do not fit or have to be given.
    """
    task = _task(replay) if task is None else task
    if task.config != replay.config:
        raise ReplayError(f"task: expected {replay.task} with the replay's config, got another")
    return task, _sensing(replay) if sensing is None else sensing


def _check_physics(replay: Recorded) -> None:
    physics = int(build_info()["physics"])
    if replay.physics != physics:
        raise ReplayError(
            f"physics: expected version {physics}, got {replay.physics} of package "
            f"{replay.package}: the match would go on otherwise"
        )


def _task(replay: Recorded) -> Task:
    """The task of a replay, made from its name and options."""
    if replay.options is None:
        raise ReplayError(f"task: expected {replay.task} as an argument: its options are not kept")
    task = registry.make_task(replay.task, **replay.options)
    defaults = task.default_controllers().values()
    if code := [name for name in defaults if isinstance(name, str) and is_module_text(name)]:
        raise ReplayError(f"task: expected {replay.task} as an argument: its policies are {code}")
    return task


def _sensing(replay: Recorded) -> Sensing | None:
    """The senses of a replay. A file must not decide which module is imported."""
    if isinstance(replay.sensing, Sensing):
        return replay.sensing
    if replay.sensed is not None:
        named = "has no name" if replay.sensing is None else f"was {replay.sensing!r}"
        raise ReplayError(f"sensing: expected the sensor model as an argument: it {named}")
    return None


def _named(controllers: Mapping[str, str | None]) -> dict[str, Controller]:
    """Controllers of a replay."""
    unknown = [robot for robot, name in controllers.items() if name is None]
    if unknown:
        raise ReplayError(f"controllers: expected policies for {unknown}: they have no name")
    code = {robot: name for robot, name in controllers.items() if name and is_module_text(name)}
    if code:  # a file must not decide which module is imported
        raise ReplayError(f"controllers: expected policies for {list(code)} as arguments: {code}")
    return {robot: LEARN if name == LEARNER else str(name) for robot, name in controllers.items()}


def described_controllers(controllers: Mapping[str, Controller]) -> dict[str, str | None]:
    """Return the names of controllers by robot.

    Args:
        controllers: controllers by robot.

    Returns:
        A name, `LEARNER`, or None for a policy that is an object.
    """
    return {
        robot: LEARNER
        if isinstance(controller, Learn)
        else None
        if isinstance(controller, Policy)
        else os.fspath(controller)
        for robot, controller in controllers.items()
    }
