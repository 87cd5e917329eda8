import dataclasses

import pytest

from benches.learning.settings_table import FIELDS, settings
from benches.learning.table import TASKS
from rsoccer.train.args import Args

LONG = {"opponents", "teammates", "initial_action", "task_options"}
"""Settings that the table leaves out."""


def rows() -> list[list[str]]:
    lines = settings(TASKS).splitlines()
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def test_each_setting_of_a_task_is_in_the_table() -> None:
    default = Args()
    differing = {
        field.name
        for task in TASKS
        for field in dataclasses.fields(Args)
        if getattr(Args.for_task(task), field.name) != getattr(default, field.name)
    }
    assert {"gamma", "worlds"} < differing
    assert differing - LONG - {"task"} <= set(FIELDS)


@pytest.mark.parametrize(
    ("name", "task", "shown"),
    [
        ("samples", "VSSMulti-v0", "20 M"),
        ("worlds", "SSLDribbling-v0", "128"),
        ("gamma", "SSLGoToBall-v0", "0.99"),
        ("gamma", "VSS-v0", ""),
        ("hidden_sizes", "default", "128 128"),
        ("final_gamma", "default", "none"),
        ("mirror_augmentation", "VSS-v0", "on"),
    ],
)
def test_values_differ_from_the_default(name: str, task: str, shown: str) -> None:
    header, _, *body = rows()
    values = {row[0].strip("`"): row for row in body}
    assert tuple(values) == FIELDS
    assert values[name][header.index(task.removesuffix("-v0"))] == shown
