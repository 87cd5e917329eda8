import os
from types import ModuleType

import pytest
import torch

from benches import suite
from benches.measuring import SPEED, measure
from benches.scenarios import RANDOM
from benches.suite import Sizes, core
from benches.third_party import import_optional, silence, vmas_football
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
        *(("Simulator", 1), ("Simulator", 2), ("compat.robosim", 1), ("robosim 1.2", 1)),
    ]
    assert [(f.variant, f.worlds) for f in figures if f.quantity == "ratio"] == [
        ("Simulator / robosim 1.2", 1),
        ("Simulator / robosim 1.2", 2),
        ("compat.robosim / robosim 1.2", 1),
    ]
    monkeypatch.setattr(suite, "import_optional", lambda name: None)
    assert not core(RANDOM[2], 2).pairs


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
