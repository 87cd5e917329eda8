import numpy as np
import pytest

import rsoccer
from rsoccer import Matches, SimConfig, Simulator
from rsoccer.arrays import Floats, Mask
from rsoccer.tasks import VssSelfPlay
from tests.helpers import begun, same, zeros


class Frozen:
    """A simulator in which nothing moves, without snapshots and threads."""

    def __init__(self) -> None:
        self.calls: list[str] = []

    def place(self, worlds: Mask, rows: Floats, out: Floats, params: Floats | None = None) -> None:
        self.calls.append("place")
        out[worlds] = rows

    def restart(self, worlds: Mask, rows: Floats, out: Floats) -> None:
        self.calls.append("restart")
        out[worlds] = rows

    def reposition_balls(self, worlds: Mask, balls: Floats, out: Floats) -> None:
        self.calls.append("reposition_balls")

    def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> None:
        self.calls.append("step")


def test_any_class_with_the_methods_can_be_the_simulator() -> None:
    simulator = Frozen()
    matches = Matches("VSSSelfPlay-v0", 2, simulator=simulator)
    first = matches.reset()
    matches.step(zeros(matches))
    outcome = matches.step(zeros(matches))
    assert simulator.calls == ["place", "step", "step"]
    assert same(outcome.observations, first)
    with pytest.raises(TypeError, match="Frozen has no snapshot and restore"):
        matches.state_dict()
    with pytest.raises(TypeError, match="Frozen has no snapshot and restore"):
        matches.load_state_dict(begun(VssSelfPlay()).state_dict())


def test_commands_reach_the_simulator_in_si_units() -> None:
    class Listening(Frozen):
        def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> None:
            self.commands, self.active = commands.copy(), active

    simulator = Listening()
    matches = Matches("VSSSelfPlay-v0", 2, simulator=simulator, autoreset="disabled")
    matches.reset()
    actions = zeros(matches)
    actions[1, 4] = [-1.0, 0.5]
    matches.step(actions)
    top = SimConfig().robot.max_wheel_speed
    assert simulator.commands[1, 4] == pytest.approx([-top, top / 2])
    assert simulator.commands.dtype == np.float32
    assert simulator.active is None


def test_a_failed_step_of_the_simulator_does_not_change_the_frame() -> None:
    class Failing(Frozen):
        def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> None:
            raise RuntimeError("world 1 is lost")

    matches = Matches("VSSSelfPlay-v0", 2, simulator=Failing())
    matches.reset()
    before = matches.frame.rows.copy()
    with pytest.raises(RuntimeError, match="world 1"):
        matches.step(zeros(matches))
    assert same(matches.frame.rows, before)
    assert not matches.play.steps.any()


def test_the_default_simulator_is_the_packages() -> None:
    matches = begun(VssSelfPlay(), threads=2)
    simulator = Simulator(SimConfig(), 5)
    simulator.restore(matches.state_dict()["simulator"].tobytes())
    rows = np.empty_like(matches.frame.rows)
    simulator.read(rows)
    assert same(rows, matches.frame.rows)
    assert rsoccer.Matches is Matches
