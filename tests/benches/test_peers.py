import os
from types import ModuleType

import pytest
import torch

from benches import contests
from benches.contests import Sizes, core
from benches.games import RANDOM
from benches.measuring import SPEED, measure
from benches.peers import peer, silence, vmas_football
from rsoccer.compat import robosim


def test_an_absent_peer_is_none() -> None:
    assert peer("no_such_simulator") is None
    assert isinstance(peer("json"), ModuleType)


def test_silence_is_for_compiled_code_too(capfd: pytest.CaptureFixture[str]) -> None:
    with silence():
        os.write(1, b"turnover\n")
        os.write(2, b"LCP internal error\n")
    os.write(1, b"heard\n")
    assert capfd.readouterr() == ("heard\n", "")


def test_the_old_simulator_is_compared_where_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    # Ours by the old one's interface stands in for it.
    monkeypatch.setattr(contests, "peer", lambda name: robosim if name == "robosim" else None)
    monkeypatch.setattr(contests, "named", lambda name: f"{name} 1.2")
    figures = measure([core(RANDOM[2], Sizes(batch=2).batch)], 1, 1e-6, lambda _: None)
    assert [(f.who, f.worlds) for f in figures if f.quantity == "speed"] == [
        *(("Simulator", 1), ("Simulator", 2), ("compat.robosim", 1), ("robosim 1.2", 1)),
    ]
    assert [(f.who, f.worlds) for f in figures if f.quantity == "ratio"] == [
        ("Simulator / robosim 1.2", 1),
        ("Simulator / robosim 1.2", 2),
        ("compat.robosim / robosim 1.2", 1),
    ]
    monkeypatch.setattr(contests, "peer", lambda name: None)
    assert not core(RANDOM[2], 2).pairs


class Football(ModuleType):
    """VMAS as far as it is asked for anything."""

    def make_env(self, **told: object) -> "Football":
        self.told, self.steps = told, list[list[torch.Tensor]]()
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
        assert torch.get_num_threads() == 1, "whoever was measured before has set it"
    finally:
        torch.set_num_threads(before)
    assert vmas.told["num_envs"] == 5
    assert not vmas.told["ai_blue_agents"]
    assert not vmas.told["ai_red_agents"]
    [actions] = vmas.steps
    assert [tuple(action.shape) for action in actions] == [(5, 2)] * 6
