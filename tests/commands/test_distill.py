"""`rsoccer distill`: its options are the settings, recommended ones by default."""

import shlex

import pytest

from rsoccer import cli
from rsoccer.commands import distill as distill_command
from rsoccer.train.distillation import DistillArgs
from tools.ship_policy import command_of


@pytest.fixture
def received(monkeypatch: pytest.MonkeyPatch) -> list[DistillArgs]:
    found: list[DistillArgs] = []
    monkeypatch.setattr(distill_command, "distill", found.append)
    return found


@pytest.mark.parametrize("task", ["SSLGoToBall-v0", "SSLDribbling-v0", "VSS-v0"])
def test_defaults_are_those_recommended_for_the_task(
    task: str, received: list[DistillArgs]
) -> None:
    assert cli.main(["distill", "--task", task]) == 0
    assert received[0].to_json() == DistillArgs.for_task(task).to_json()
    assert received[0].randomization["robot.mass"] == [0.85, 1.15]


def test_the_recorded_command_has_the_settings_of_the_run(received: list[DistillArgs]) -> None:
    changed = DistillArgs.for_task(
        "VSS-v0", seed=3, history=2, command_delays=(0.0, 0.05), randomization={"robot.mass": 0.9}
    )
    command = command_of(changed.to_json())
    assert command.startswith("rsoccer distill --task VSS-v0 --teacher best --student None ")
    assert cli.main(shlex.split(command)[1:]) == 0
    assert received[0].to_json() == changed.to_json()
