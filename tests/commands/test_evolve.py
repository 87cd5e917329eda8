"""`rsoccer evolve`: its options are the settings, recommended ones by default."""

import shlex

import pytest

from rsoccer import cli
from rsoccer.commands import evolve as evolve_command
from rsoccer.train.evolution import EvolveArgs
from tools.ship_policy import command_of


@pytest.mark.parametrize("task", ["SSLMatch-v0", "SSLKeepaway-v0"])
def test_defaults_are_those_recommended_for_the_task(
    task: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    received: list[EvolveArgs] = []
    monkeypatch.setattr(evolve_command, "evolve", received.append)
    assert cli.main(["evolve", "--task", task]) == 0
    assert received[0].to_json() == EvolveArgs.for_task(task).to_json()


def test_the_recorded_command_has_the_settings_of_the_run(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    received: list[EvolveArgs] = []
    monkeypatch.setattr(evolve_command, "evolve", received.append)
    changed = EvolveArgs("SSLMatch-v0", sensing="rc2021, delay=0.1", matches=20, first="best")
    for args in (changed, EvolveArgs.for_task("SSLMatch-v0", seed=3)):
        command = command_of(args.to_json())
        assert command.startswith("rsoccer evolve --task SSLMatch-v0 --script scripted ")
        assert cli.main(shlex.split(command)[1:]) == 0
        assert received[-1].to_json() == args.to_json()
