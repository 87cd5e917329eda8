from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from benches import simulators
from benches.measuring import SPEED
from benches.scenarios import CROWD, RANDOM, Scenario
from benches.simulators import (
    CONTACTS,
    MIN_SAMPLES,
    BenchmarkedSimulator,
    RobosimAdapter,
    SimulatorAdapter,
    check_contacts,
    timed_episodes,
)
from rsoccer import Frame, WorldRng
from rsoccer.arrays import Floats
from rsoccer.compat import robosim

SHORT = [replace(scenario, episode=40) for scenario in (RANDOM[0], RANDOM[2])]


@pytest.mark.parametrize("scenario", [*RANDOM, *CROWD], ids=lambda scenario: scenario.name)
def test_both_adapters_start_alike(scenario: Scenario) -> None:
    start = scenario.start(WorldRng.seeded(5, 1))
    native, robosim_adapter = SimulatorAdapter(scenario, 1), RobosimAdapter(scenario, robosim)
    for adapter in (native, robosim_adapter):
        adapter.place(start)
    for one, other in zip(native.positions(), robosim_adapter.positions(), strict=True):
        np.testing.assert_allclose(one, other, atol=1e-5)


@pytest.mark.parametrize("scenario", SHORT, ids=lambda scenario: scenario.name)
def test_both_adapters_interpret_commands_alike(scenario: Scenario) -> None:
    columns = len(scenario.config.command_columns)
    commands = np.zeros((1, scenario.config.n_robots, columns), np.float32)
    commands[..., 0] = 1.0
    commands[..., 1] = 1.0 if scenario.has_wheel_commands else 0.0
    adapters: tuple[BenchmarkedSimulator, ...] = (
        SimulatorAdapter(scenario, 1),
        RobosimAdapter(scenario, robosim),
    )
    start = scenario.start(WorldRng.seeded(5, 1))
    moved = []
    for adapter in adapters:
        adapter.place(start)
        for _ in range(20):
            adapter.step(adapter.prepare(commands))
        moved.append(adapter.positions().robots[0] - start.robots.position[0])
    assert np.abs(moved[0]).max() > 0.01
    ahead = [(offset * start.robots.heading[0]).sum(axis=-1) for offset in moved]
    assert np.median(ahead[0]) > 0.01
    assert np.median(ahead[1]) == pytest.approx(np.median(ahead[0]), rel=0.3)


@pytest.mark.parametrize("scenario", SHORT, ids=lambda scenario: scenario.name)
def test_episodes_are_measured(scenario: Scenario) -> None:
    for measure in (
        timed_episodes(scenario, partial(SimulatorAdapter, scenario, 3), 3),
        timed_episodes(scenario, partial(RobosimAdapter, scenario, robosim)),
    ):
        assert measure(0.0) == {}
        values = measure(1e-6)
        assert list(values) == [SPEED, CONTACTS]
        assert values[SPEED] > 0


class RecordingAdapter(SimulatorAdapter):
    """Records the positions at which robots are placed."""

    def __init__(self, scenario: Scenario, worlds: int, placed: list[Floats]) -> None:
        super().__init__(scenario, worlds)
        self.placed = placed

    def place(self, start: Frame) -> None:
        self.placed.extend(start.robots.position)
        super().place(start)


def test_sequential_and_batched_matches_have_equal_starts(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(simulators, "run_episode", lambda *_: (1.0, [0.5]))  # a second each
    scenario, one, many = RANDOM[0], list[Floats](), list[Floats]()
    singly = timed_episodes(scenario, lambda: RecordingAdapter(scenario, 1, one), starts=3)
    at_once = timed_episodes(scenario, lambda: RecordingAdapter(scenario, 3, many), 3)
    for _ in range(2):
        singly(4.0)
        at_once(2.0)
    first, second = np.array(many[:6]), np.array(many[6:])
    np.testing.assert_array_equal(one, [*first[:4], *second[:4]])
    np.testing.assert_array_equal(first[:3], first[3:])
    assert len(np.unique(many, axis=0)) == 6, "every round has different starts"


def test_a_crowd_has_contacts() -> None:
    scenario = replace(CROWD[0], episode=80)
    values = timed_episodes(scenario, partial(SimulatorAdapter, scenario, 2), 2)(1e-6)
    assert values[CONTACTS] > 0.3


def test_a_scenario_without_contacts_is_refused() -> None:
    scenario = replace(CROWD[4], episode=2)
    with pytest.raises(RuntimeError, match=r"SSL 11 v 11 crowd: expected .* got 0\.0%"):
        timed_episodes(scenario, partial(SimulatorAdapter, scenario, 1))(1e-6)
    check_contacts(RANDOM[0], 0.0, MIN_SAMPLES - 1)
    with pytest.raises(RuntimeError, match="VSSS 3 v 3 random"):
        check_contacts(RANDOM[0], 0.0, MIN_SAMPLES)
