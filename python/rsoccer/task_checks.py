"""Validation of what the author of a task defines: attributes, initial states, observations."""

from collections.abc import Mapping, Sequence
from typing import Any, Final, NoReturn

import numpy as np

from rsoccer import checks
from rsoccer._core import SimConfig
from rsoccer.arrays import Array, Floats
from rsoccer.frame import Frame, robot_names
from rsoccer.rules.base import Rule
from rsoccer.task_definition import TaskDefinition
from rsoccer.view import SIDES

_OWN_MODULES: Final = "rsoccer."
"""Begin of the names of modules whose classes list bounds of blocks that not all tasks have."""


def label(task: TaskDefinition, attribute: str) -> str:
    """Return the name of an attribute of a task for errors, such as "Mine.get_commands".

    Args:
        task: the task.
        attribute: name of the attribute.
    """
    return f"{type(task).__name__}.{attribute}"


def definition(task: TaskDefinition) -> None:
    """Validate the attributes of a task that are not results of a state.

    Args:
        task: the task.

    Raises:
        TypeError: an attribute of another type.
        ValueError: a number out of range, an unknown team, or actions of another shape.
    """
    if not isinstance(task.config, SimConfig):
        _refuse(task, "config", "a SimConfig", task.config)
    size = checks.integer(label(task, "action_size"), task.action_size, 1)
    name = label(task, "optional_action_size")
    checks.integer_in_range(name, task.optional_action_size, 0, size)
    sides = task.sides
    if not isinstance(sides, list | tuple) or not sides or not set(map(str, sides)) <= set(SIDES):
        raise ValueError(f"{label(task, 'sides')}: expected teams of {SIDES}, got {sides!r}")
    rules = task.rules
    if not isinstance(rules, Sequence) or not all(isinstance(rule, Rule) for rule in rules):
        _refuse(task, "rules", "a sequence of rules", rules)
    _action_table(task)


def _action_table(task: TaskDefinition) -> None:
    """Validate the actions of a discrete task."""
    table = task.action_table
    if table is None:
        return
    expected = f"numbers (choices, {task.action_size}) from -1 to 1"
    if not isinstance(table, np.ndarray):
        _refuse(task, "action_table", expected, table)
    is_table = table.dtype.kind in "fiu" and table.ndim == 2 and len(table) > 0
    if not is_table or table.shape[1] != task.action_size or not (np.abs(table) <= 1.0).all():
        raise ValueError(f"{label(task, 'action_table')}: expected {expected}, got {table!r}")


def controllers(task: TaskDefinition) -> Mapping[str, Any]:
    """Return the default controllers of a task, one for each robot.

    Args:
        task: the task.

    Raises:
        TypeError: no mapping.
        ValueError: a robot without a controller, or a controller of another name.
    """
    found = task.default_controllers()
    robots = robot_names(task.config.n_blue, task.config.n_yellow)
    expected = f"a controller for each of {list(robots)}"
    if not isinstance(found, Mapping):
        _refuse(task, "default_controllers", expected, found)
    if found.keys() != set(robots):
        name = label(task, "default_controllers")
        raise ValueError(f"{name}: expected {expected}, got those of {list(found)}")
    return found


def limits(task: TaskDefinition, blocks: Mapping[str, object]) -> Mapping[str, float]:
    """Return the bounds of observation blocks.

    Args:
        task: the task.
        blocks: its blocks by name.

    Raises:
        TypeError: no mapping, or a bound that is not a number.
        ValueError: a bound that is not above 0, or one of a block that does not exist.
    """
    found = task.observation_limits()
    name = label(task, "observation_limits")
    if not isinstance(found, Mapping):
        _refuse(task, "observation_limits", "bounds by name", found)
    for block, bound in found.items():
        if bound != np.inf:
            checks.positive_number(f"{name}: {block!r}", bound)
    owners = [each for each in type(task).__mro__ if "observation_limits" in vars(each)]
    own = [each for each in owners if not each.__module__.startswith(_OWN_MODULES)]
    if own and (unknown := set(found) - set(blocks)):
        # A class of the package lists blocks that not all of its tasks have.
        parent = owners[owners.index(own[-1]) + 1]
        inherited = vars(parent)["observation_limits"](task)
        if unknown := unknown - set(inherited):
            raise ValueError(f"{name}: expected names of {list(blocks)}, got {sorted(unknown)}")
    return found


def initial_rows(task: TaskDefinition, frame: object, n: int) -> Floats:
    """Return the rows of initial states.

    Args:
        task: the task.
        frame: result of `Task.get_initial_positions_frame`.
        n: number of worlds.

    Returns:
        The rows (n, row).

    Raises:
        TypeError: no frame.
        ValueError: a frame of other robots or of another number of worlds.
    """
    method, config = "get_initial_positions_frame", task.config
    if not isinstance(frame, Frame):
        _refuse(task, method, "a Frame", frame)
    wanted, got = (n, config.n_blue, config.n_yellow), (len(frame), frame.n_blue, frame.n_yellow)
    if got != wanted:
        raise ValueError(
            f"{label(task, method)}: expected a Frame of {_sizes(*wanted)}, got {_sizes(*got)}"
        )
    return frame.rows


def _sizes(worlds: int, blue: int, yellow: int) -> str:
    return f"{worlds} worlds with {blue} blue and {yellow} yellow robots"


def blocks(
    task: TaskDefinition,
    found: object,
    rows: tuple[int, int],
    shapes: Mapping[str, tuple[int, ...]] | None = None,
) -> Mapping[str, Floats]:
    """Validate observation blocks.

    Args:
        task: the task.
        found: result of `Task.frame_to_observations`.
        rows: numbers of worlds and of observers, (n, observers).
        shapes: shape of the block of one observer by name; None if it is not known yet.

    Returns:
        The blocks (n, observers, ...) by name.

    Raises:
        TypeError: no mapping, or a block that is no array.
        ValueError: no block, other blocks, or a block of another shape.
    """
    method = "frame_to_observations"
    if not isinstance(found, Mapping):
        _refuse(task, method, "blocks (n, observers, ...) by name", found)
    if not found or found.keys() != (found if shapes is None else shapes).keys():
        expected = "at least one block" if shapes is None else f"the blocks {list(shapes)}"
        raise ValueError(f"{label(task, method)}: expected {expected}, got {list(found)}")
    for name, block in found.items():
        array(f"{label(task, method)}: {name!r}", block, "(n, observers, ...)")
        shape = block.shape[2:] if shapes is None else shapes[name]
        if block.ndim < 2 or block.shape != (*rows, *shape):
            expected = f"({rows[0]}, {rows[1]}, ...)" if shapes is None else str((*rows, *shape))
            raise ValueError(
                f"{label(task, method)}: expected {expected} for {name!r}, got {block.shape}"
            )
    return found


def array(name: str, value: object, shape: str) -> Array:
    """Return a value that has to be an array.

    Args:
        name: name of the value, for the error.
        value: the value.
        shape: shape that it should have, in words.

    Raises:
        TypeError: something else.
    """
    if not isinstance(value, np.ndarray):
        raise TypeError(f"{name}: expected an array {shape}, got {type(value).__name__}")
    return value


def _refuse(task: TaskDefinition, attribute: str, expected: str, value: object) -> NoReturn:
    """Raise TypeError for an attribute of another type."""
    is_plain = value is not None and not isinstance(value, np.ndarray)
    got = f"{value!r:.120}" if is_plain else type(value).__name__
    raise TypeError(f"{label(task, attribute)}: expected {expected}, got {got}")
