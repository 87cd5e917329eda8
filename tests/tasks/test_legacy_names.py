"""Names of the environments of rsoccer-gym 1.4."""

from typing import Any

import gymnasium
import pettingzoo
import pytest

import rsoccer
from rsoccer import cli, registry
from rsoccer.tasks import SslGoToBall, SslStaticDefenders, VssMulti, legacy_names
from rsoccer.testing import check_task
from tests.helpers import begun, zeros
from tests.tasks.ssl_scenes import expect_solved

ALIASES = registry.list_aliases()

# As its `__init__.py` registers them.
RSOCCER_GYM = [
    "VSS-v0",
    "VSSMA-v0",
    "VSSMAOpp-v0",
    "VSSGk-v0",
    "VSSFIRA-v0",
    "SSLGoToBall-v0",
    "SSLGoToBallIR-v0",
    "SSLGoToBallShoot-v0",
    "SSLStaticDefenders-v0",
    "SSLDribbling-v0",
    "SSLContestedPossession-v0",
    "SSLPassEndurance-v0",
    "SSLPassEnduranceMA-v0",
]


def test_every_old_name_is_known() -> None:
    names = [*legacy_names.KEPT, *legacy_names.ALIASES, *legacy_names.REMOVED]
    assert sorted(names) == sorted(RSOCCER_GYM)
    assert set(legacy_names.KEPT) <= set(rsoccer.list_tasks())
    assert set(legacy_names.ALIASES) == set(ALIASES)
    assert len(ALIASES) == 6


@pytest.mark.parametrize("name", ALIASES)
def test_an_alias_is_a_task_with_options(name: str) -> None:
    original, options = ALIASES[name]
    task = rsoccer.make_task(name)
    assert task == rsoccer.make_task(original, **options)
    assert task.name == original
    assert name not in rsoccer.list_tasks()
    check_task(task, worlds=3, steps=40)


@pytest.mark.parametrize("name", ALIASES)
def test_every_interface_knows_the_old_names(name: str) -> None:
    original, task = ALIASES[name].task, rsoccer.make_task(name)
    assert begun(task, worlds=1).agents == task.agents == rsoccer.Matches(name).agents
    assert rsoccer.parallel_env(name, max_cycles=3).possible_agents == list(task.agents)
    learner: dict[str, Any] = {"learner": task.agents[0]} if len(task.agents) > 1 else {}
    envs: list[Any] = [
        gymnasium.make(f"rsoccer/{name}", max_steps=3, **learner).unwrapped,
        gymnasium.make_vec(f"rsoccer/{name}", 2 * len(task.agents), max_steps=3).unwrapped,
    ]
    for env in envs:
        assert env.task == rsoccer.make_task(name, max_steps=3)
    if hasattr(pettingzoo, "make"):
        assert pettingzoo.make("parallel", f"rsoccer/{name}").metadata["name"] == original
        assert pettingzoo.make("aec", f"rsoccer/{name}").possible_agents == list(task.agents)


def test_explicit_options_override_those_of_the_alias() -> None:
    task = rsoccer.make_task("SSLGoToBallIR-v0", n_opponents=2, velocity_frame="robot")
    assert isinstance(task, SslGoToBall)
    assert (task.n_opponents, task.velocity_frame) == (2, "robot")
    with pytest.raises(TypeError, match=r"unexpected keyword argument .opponent..*.n_opponents."):
        rsoccer.make_task("SSLGoToBallIR-v0", opponent=2)


def test_old_options_are_kept() -> None:
    assert isinstance(team := rsoccer.make_task("VSSMA-v0"), VssMulti)
    assert team.opponent == "ou"
    matches = begun(rsoccer.make_task("SSLGoToBallIR-v0"), worlds=2)
    assert matches.frame.yellow.position.shape == (2, 6, 2)
    alone = begun(shoot := rsoccer.make_task("SSLGoToBallShoot-v0"), worlds=2)
    assert alone.frame.yellow.position.shape == (2, 0, 2)
    assert shoot.max_steps * shoot.config.time_step == 60.0
    assert alone.step(zeros(alone)).observations.shape[:2] == (2, 1)


def test_shooting_without_opponents_can_be_solved() -> None:
    task = rsoccer.make_task("SSLGoToBallShoot-v0", max_steps=600)
    assert isinstance(task, SslStaticDefenders)
    expect_solved(task, "strike", "goal_score", 0.95)


@pytest.mark.parametrize("name", legacy_names.REMOVED)
def test_removed_names_suggest_a_replacement(name: str) -> None:
    with pytest.raises(ValueError, match=f"unknown task '{name}'") as raised:
        rsoccer.parallel_env(name)
    assert legacy_names.REMOVED[name] in str(raised.value)


def test_the_command_line_lists_aliases(capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("tyro")
    assert cli.main(["list"]) == 0
    assert "SSLGoToBallIR-v0: SSLGoToBall-v0, n_opponents=6\n" in capsys.readouterr().out
