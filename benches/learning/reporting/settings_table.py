"""The settings of PPO on each task, as a table of the report."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

from benches.markdown import table
from rsoccer.train.args import Args

FIELDS: Final = (
    "samples",
    *("rollout.worlds", "rollout.horizon", "rollout.action_repeat", "rollout.random_truncation"),
    *("network.hidden_sizes", "network.robot_units", "network.central_critic"),
    *("network.action_std", "network.final_action_std"),
    *("network.shield", "network.play_action_repeat"),
    *("ppo.gamma", "ppo.final_gamma", "ppo.gae_lambda"),
    *("ppo.learning_rate", "ppo.learning_rate_schedule", "ppo.n_epochs", "ppo.n_minibatches"),
    "ppo.mirror_augmentation",
    *("opponents.solo_fraction", "opponents.latest_fraction", "opponents.past_fraction"),
)
"""Settings of the table. Mixes of opponents, initial actions and task options are too long."""


def settings(tasks: Sequence[str]) -> str:
    """Return the table: a row for each setting, a column for each task.

    Args:
        tasks: Registered names.

    Returns:
        Defaults, and the values that differ from them.
    """
    default = Args().to_json()
    made = [Args.for_task(task).to_json() for task in tasks]
    rows = []
    for name in FIELDS:
        usual = default[name]
        values = (settings[name] for settings in made)
        own = ("" if value == usual else _text(value) for value in values)
        rows.append((f"`{name}`", _text(usual), *own))
    columns = (task.removesuffix("-v0") for task in tasks)
    return table(("setting", "default", *columns), rows)


def _text(value: Any) -> str:  # noqa: ANN401  (any setting)
    """A value as the command line takes it, but large numbers in millions."""
    if value is None or isinstance(value, bool):
        return {None: "none", True: "on", False: "off"}[value]
    if isinstance(value, list):
        return " ".join(str(number) for number in value)
    if isinstance(value, int) and value >= 1_000_000:
        return f"{value / 1e6:g} M"
    return f"{value:g}" if isinstance(value, float) else str(value)
