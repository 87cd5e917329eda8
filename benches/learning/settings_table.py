"""The settings of PPO on each task, as a table of the report."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

from rsoccer.train.args import Args
from tools.markdown import table

FIELDS: Final = (
    *("samples", "worlds", "horizon", "action_repeat", "gamma", "final_gamma", "gae_lambda"),
    *("hidden_sizes", "robot_units", "action_std", "final_action_std"),
    *("learning_rate", "learning_rate_schedule", "n_epochs", "n_minibatches", "clip_range"),
    *("target_kl", "value_coef", "max_grad_norm", "mirror_augmentation", "random_truncation"),
    *("solo_fraction", "latest_fraction", "past_fraction"),
)
"""Settings of the table. Mixes of opponents, initial actions and task options are too long."""


def settings(tasks: Sequence[str]) -> str:
    """Return the table: a row for each setting, a column for each task.

    Args:
        tasks: Registered names.

    Returns:
        Defaults, and the values that differ from them.
    """
    default = Args()
    made = [Args.for_task(task) for task in tasks]
    rows = []
    for name in FIELDS:
        usual = getattr(default, name)
        values = (getattr(args, name) for args in made)
        own = ("" if value == usual else _text(value) for value in values)
        rows.append((f"`{name}`", _text(usual), *own))
    columns = (task.removesuffix("-v0") for task in tasks)
    return table(("setting", "default", *columns), rows)


def _text(value: Any) -> str:  # noqa: ANN401  (any field)
    """A value as the command line takes it, but large numbers in millions."""
    if value is None or isinstance(value, bool):
        return {None: "none", True: "on", False: "off"}[value]
    if isinstance(value, tuple):
        return " ".join(str(number) for number in value)
    if isinstance(value, int) and value >= 1_000_000:
        return f"{value / 1e6:g} M"
    return f"{value:g}" if isinstance(value, float) else str(value)
