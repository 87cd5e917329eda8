from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer import Matches, SimConfig, Simulator
from rsoccer.arrays import Array, Doubles, Floats, Mask
from rsoccer.tasks import VssSelfPlay
from tests.helpers import begun, same, zeros
from tests.robots import Robots, robots_of


class Frozen:
    """A simulator in which nothing moves, without snapshots and threads."""

    def __init__(self) -> None:
        self.calls: list[str] = []

    def place(
        self, worlds: Mask, rows: Floats, out: Floats, parameters: Floats | None = None
    ) -> None:
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


def test_time_stamps_reach_the_state_and_are_saved() -> None:
    task = VssSelfPlay(max_steps=5)
    matches = Matches(task, 2, simulator=robots_of(task, 2))
    assert matches.play.times is None
    matches.reset()
    assert matches.play.times is not None
    assert matches.play.times.tolist() == [7.0, 7.0]
    for _ in range(7):
        matches.step(zeros(matches))
    assert matches.play.times == pytest.approx([7.21, 7.21])
    saved = matches.state_dict()
    resumed = Matches(task, 2, simulator=robots_of(task, 2))
    resumed.load_state_dict(saved)
    assert resumed.play.times == pytest.approx([7.21, 7.21])
    with pytest.raises(ValueError, match="state: missing or unknown"):
        resumed.load_state_dict({**saved, "times": 0.0 * saved["times"], "more": saved["times"]})
    assert resumed.play.times == pytest.approx([7.21, 7.21]), "nothing has changed"
    plain = Matches(task, 2, simulator=robots_of(task, 2, stamps=False))
    plain.reset()
    plain.step(zeros(plain))
    assert plain.play.times is None
    with pytest.raises(ValueError, match="state: missing or unknown"):
        plain.load_state_dict({**saved, "more": saved["times"]})
    assert plain.play.times is None


def test_waiting_worlds_keep_their_time() -> None:
    task = VssSelfPlay(max_steps=2)
    robots = robots_of(task, 2)
    matches = Matches(task, 2, simulator=robots, autoreset="disabled")
    matches.reset()
    matches.step(zeros(matches))
    matches.reset(mask=np.array([False, True]))
    matches.step(zeros(matches))
    matches.step(zeros(matches))
    assert matches.done.tolist() == [True, True]
    assert matches.play.times == pytest.approx([7.06, 7.09])
    assert robots.clock == pytest.approx([7.06, 7.09]), "the simulator does not move them"


@pytest.mark.parametrize("times", [np.zeros(3), np.zeros(2, np.float32), np.full(2, np.nan)])
def test_wrong_time_stamps_are_refused(times: Array) -> None:
    class Wrong(Robots):
        def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> Doubles:
            super().step(commands, out, active)
            return times

    task = VssSelfPlay()
    wrong = Wrong(task.config, 2)
    wrong._simulator = robots_of(task, 2)._simulator
    matches = Matches(task, 2, simulator=wrong)
    matches.reset()
    with pytest.raises(ValueError, match=r"simulator: expected finite float64 \(2,\)"):
        matches.step(zeros(matches))


def test_a_layer_over_a_simulator_may_forward_its_methods() -> None:
    class Layer:
        def __init__(self, simulator: Simulator) -> None:
            self.inner = simulator

        def __getattr__(self, name: str) -> Any:  # noqa: ANN401
            return getattr(self.inner, name)

        def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> None:
            self.inner.step(commands, out, active)

    layered = Matches("VSSSelfPlay-v0", simulator=Layer(Simulator(SimConfig())))
    plain = Matches("VSSSelfPlay-v0")
    assert same(layered.reset(), plain.reset())
    assert same(layered.state_dict()["simulator"], plain.state_dict()["simulator"])


def test_close_reaches_a_simulator_that_holds_something() -> None:
    task = VssSelfPlay()
    robots = robots_of(task)
    Matches(task, simulator=robots).close()
    assert robots.closed == 1
    Matches(task).close()
