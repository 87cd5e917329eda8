import json
import os
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
import torch
from gymnasium.spaces import Box

from benches import suite
from benches.measuring import SPEED, measure
from benches.scenarios import ENGINES, RANDOM
from benches.suite import Sizes, core
from benches.third_party import import_optional, psim_match, silence, vmas_football
from rsoccer.compat import robosim


def test_a_missing_module_is_none() -> None:
    assert import_optional("no_such_simulator") is None
    assert isinstance(import_optional("json"), ModuleType)


def test_output_of_compiled_code_is_suppressed(capfd: pytest.CaptureFixture[str]) -> None:
    with silence():
        os.write(1, b"turnover\n")
        os.write(2, b"LCP internal error\n")
    os.write(1, b"visible\n")
    assert capfd.readouterr() == ("visible\n", "")


def test_rsim_is_compared_if_installed(monkeypatch: pytest.MonkeyPatch) -> None:
    # rsoccer.compat.robosim stands in for rSim.
    monkeypatch.setattr(
        suite, "import_optional", lambda name: robosim if name == "robosim" else None
    )
    monkeypatch.setattr(suite, "name_with_version", lambda name: f"{name} 1.2")
    figures = measure([core(RANDOM[2], Sizes(core=2).core)], 1, 1e-6, lambda _: None)
    assert [(f.variant, f.worlds) for f in figures if f.quantity == "speed"] == [
        *(2 * (("Simulator", 1), ("Simulator", 2))),
        *(("compat.robosim", 1), ("robosim 1.2", 1)),
    ]
    default, other = ENGINES
    assert [(f.variant, f.engine, f.worlds) for f in figures if f.quantity == "ratio"] == [
        ("Simulator / Simulator", "compact / rapier", 1),
        ("Simulator / Simulator", "compact / rapier", 2),
        ("Simulator / robosim 1.2", default, 1),
        ("Simulator / robosim 1.2", default, 2),
        ("Simulator / robosim 1.2", other, 1),
        ("Simulator / robosim 1.2", other, 2),
        ("compat.robosim / robosim 1.2", default, 1),
    ]
    monkeypatch.setattr(suite, "import_optional", lambda name: None)
    alone = core(RANDOM[2], 2)
    assert all("Simulator" in alone.variants[i].name for pair in alone.pairs for i in pair)


class Football(ModuleType):
    """Stand-in for the part of VMAS that the benchmark uses."""

    def make_env(self, **options: object) -> "Football":
        self.options, self.steps = options, list[list[torch.Tensor]]()
        return self

    def reset(self) -> None: ...

    def step(self, actions: list[torch.Tensor]) -> None:
        self.steps.append(actions)


def test_all_robots_of_vmas_are_controlled() -> None:
    vmas, before = Football("vmas"), torch.get_num_threads()
    measure = vmas_football(vmas, 5, 1)
    torch.set_num_threads(2)
    try:
        assert measure(0.0)[SPEED] > 0
        assert torch.get_num_threads() == 1, "an earlier measurement may have changed it"
    finally:
        torch.set_num_threads(before)
    assert vmas.options["num_envs"] == 5
    assert not vmas.options["ai_blue_agents"]
    assert not vmas.options["ai_red_agents"]
    [actions] = vmas.steps
    assert [tuple(action.shape) for action in actions] == [(5, 2)] * 6


class MatchOfSix:
    """Stand-in for pSim's environment, which ends after two steps."""

    possible_agents = ("agent_0", "agent_1", "agent_2")

    def __init__(self, **options: object) -> None:
        self.options = options
        settings = json.loads(Path("game_config.json").read_text())
        self.kinds = settings["scenarios"][options["scenario"]]["agent_robots"]["movement_types"]
        self.steps, self.resets = list[dict[str, np.ndarray]](), 0

    def reset(self, seed: int | None = None) -> None:
        print("reset")  # noqa: T201
        self.resets, self.agents = self.resets + 1, list(self.possible_agents)

    def action_space(self, agent: str) -> Box:
        return Box(-1.0, 1.0, (2,))

    def step(self, actions: dict[str, np.ndarray]) -> None:
        self.steps.append(actions)
        if len(self.steps) % 2 == 0:
            self.agents = []


def test_three_robots_of_psim_learn(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    noise = {"agent_robots": {"movement_types": ["action", "ou", "ou"]}}
    (tmp_path / "config").mkdir()
    settings = json.dumps({"scenarios": {"full_random": noise}})
    (tmp_path / "config" / "game_config.json").write_text(settings)
    psim, made, here = ModuleType("pSim"), list[MatchOfSix](), Path.cwd()
    psim.__file__ = str(tmp_path / "__init__.py")

    def create(**options: object) -> MatchOfSix:
        made.append(MatchOfSix(**options))
        return made[0]

    psim.VSSSPettingZooEnv = create  # type: ignore[attr-defined]
    measure = psim_match(psim)
    for _ in range(4):
        assert measure(0.0)[SPEED] > 0
    [env] = made
    assert (env.options["num_agent_robots"], env.options["num_adversary_robots"]) == (3, 3)
    assert env.kinds == ["action"] * 3
    assert (len(env.steps), env.resets) == (4, 3), "ended matches begin again"
    assert capfd.readouterr().out == ""
    assert (Path.cwd(), (here / "game_config.json").exists()) == (here, False)
