"""Recommended settings: each entry names a task and fields, and its values are accepted."""

import dataclasses

import pytest

import rsoccer
from rsoccer.registry import list_aliases
from rsoccer.train import Args, task_settings
from rsoccer.train.args import CHANGEABLE_ON_RESUME
from rsoccer.train.mirror import check_symmetric
from rsoccer.train.observation_mask import observation_mask

FIELDS = {field.name for field in dataclasses.fields(Args)} - {"task", "seed"}
FREE = FIELDS - set(CHANGEABLE_ON_RESUME) | {"samples"}


def test_entries_name_tasks_and_fields_of_the_settings() -> None:
    assert set(task_settings.TASK_SETTINGS) <= {*rsoccer.list_tasks(), *list_aliases()}
    for name, settings in task_settings.TASK_SETTINGS.items():
        assert set(settings) <= FREE, name


@pytest.mark.parametrize("name", [*rsoccer.list_tasks(), *list_aliases()])
def test_recommended_values_fit_the_task(name: str) -> None:
    args = Args.for_task(name)
    task = args.make_task()
    observation_mask(task, args.masked_observations)
    if args.mirror_augmentation:
        check_symmetric(task)


def test_given_values_replace_recommended_ones(monkeypatch: pytest.MonkeyPatch) -> None:
    settings = {"gamma": 0.5, "worlds": 8}
    monkeypatch.setattr(task_settings, "TASK_SETTINGS", {"VSS-v0": settings})
    args = Args.for_task("VSS-v0", worlds=9)
    assert (args.task, args.gamma, args.worlds) == ("VSS-v0", 0.5, 9)
    assert Args.for_task("VSSMulti-v0") == Args("VSSMulti-v0")
    assert Args.for_task("VSSFIRA-v0").gamma == 0.5, "the alias of VSS-v0"
    with pytest.raises(TypeError, match="horizons"):
        Args.for_task("VSS-v0", horizons=3)
