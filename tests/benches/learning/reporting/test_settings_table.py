import pytest

from benches.learning.reporting.settings_table import FIELDS, settings
from benches.learning.table import TASKS
from rsoccer.train.args import Args

LONG = {"opponents.fixed", "network.initial_action", "task_options"}
"""Settings that the table leaves out."""


def rows() -> list[list[str]]:
    lines = settings(TASKS).splitlines()
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def test_each_setting_of_a_task_is_in_the_table() -> None:
    default = Args().to_json()
    differing = {
        name
        for task in TASKS
        for name, value in Args.for_task(task).to_json().items()
        if value != default[name]
    }
    assert {"ppo.gamma", "rollout.worlds"} < differing
    assert differing - LONG - {"task"} <= set(FIELDS)


@pytest.mark.parametrize(
    ("name", "task", "shown"),
    [
        ("samples", "VSSMulti-v0", "20 M"),
        ("rollout.worlds", "SSLDribbling-v0", "128"),
        ("ppo.gamma", "SSLGoToBall-v0", "0.99"),
        ("ppo.gamma", "VSS-v0", ""),
        ("network.central_critic", "SSLPassEnduranceMulti-v1", "on"),
        ("network.hidden_sizes", "default", "128 128"),
        ("ppo.final_gamma", "default", "none"),
        ("ppo.mirror_augmentation", "VSS-v0", "on"),
    ],
)
def test_values_differ_from_the_default(name: str, task: str, shown: str) -> None:
    header, _, *body = rows()
    values = {row[0].strip("`"): row for row in body}
    assert tuple(values) == FIELDS
    assert values[name][header.index(task.removesuffix("-v0"))] == shown
