"""`rsoccer evolve`: its options are the settings, recommended ones by default."""

import pytest

from rsoccer import cli
from rsoccer.commands import evolve as evolve_command
from rsoccer.train.evolution import EvolveArgs


@pytest.mark.parametrize("task", ["SSLMatch-v0", "SSLKeepaway-v0"])
def test_defaults_are_those_recommended_for_the_task(
    task: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    received: list[EvolveArgs] = []
    monkeypatch.setattr(evolve_command, "evolve", received.append)
    assert cli.main(["evolve", "--task", task]) == 0
    assert received[0].to_json() == EvolveArgs.for_task(task).to_json()
