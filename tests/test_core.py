"""The binding: arguments that the compiled module refuses, without any change."""

import copy
import pickle
import threading
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as npst

from rsoccer._core import (
    BALL_COLUMNS,
    COMMAND_COLUMNS,
    CROSSINGS,
    MAX_PLACED_ANGULAR_VELOCITY,
    MAX_PLACED_HEIGHT,
    MAX_PLACED_SPIN,
    ROBOT_COLUMNS,
    Field,
    Forecaster,
    SimConfig,
    Simulator,
    Threads,
    add_rewards,
    build_info,
    clip_actions,
    clip_in_place,
    golden_hashes,
    normalized,
    pooled_moments,
    write_clipped,
)
from rsoccer.arrays import Array, Floats
from tools.paths import ROOT

WORLDS = 3
CONFIG = SimConfig()


def rows_of(simulator: Simulator) -> Floats:
    rows = np.zeros((simulator.worlds, simulator.config.row_size), np.float32)
    simulator.read(rows)
    return rows


def no_commands(worlds: int = WORLDS) -> Floats:
    columns = len(COMMAND_COLUMNS[CONFIG.robot.drive])
    return np.zeros((worlds, CONFIG.n_robots, columns), np.float32)


def driven(simulator: Simulator, steps: int, seed: int = 0) -> Floats:
    """Rows after some steps of random driving."""
    rng, rows = np.random.default_rng(seed), rows_of(simulator)
    for _ in range(steps):
        wheels = rng.uniform(-50, 50, no_commands(simulator.worlds).shape).astype(np.float32)
        simulator.step(wheels, rows)
    return rows


def test_names_and_sizes_agree() -> None:
    assert CONFIG.row_size == len(BALL_COLUMNS) + CONFIG.n_robots * len(ROBOT_COLUMNS)
    assert CONFIG.command_columns == COMMAND_COLUMNS[CONFIG.robot.drive]
    assert CROSSINGS[0] == "none"
    assert set(build_info()) == {"version", "profile", "physics"}


def test_the_golden_hashes_are_those_of_the_core() -> None:
    version, *lines = (ROOT / "crates/rsim-core/tests/golden.txt").read_text().splitlines()
    assert version == f"PHYSICS_VERSION {build_info()['physics']}"
    assert golden_hashes() == dict(line.split() for line in lines)


def test_a_configuration_survives_json_and_pickle() -> None:
    config = SimConfig("vss_5v5", 5, 2, robot="vss_650rpm", time_step=0.02, tick=0.0025)
    for other in (SimConfig.from_json(config.to_json()), pickle.loads(pickle.dumps(config))):
        assert other == config
        assert hash(other) == hash(config)
    assert config != CONFIG
    assert config.ticks_per_step == 8


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"field": "vss_9v9"}, "field must be one of vss_3v3, vss_5v5"),
        ({"robot": "tank"}, "robot must be one of"),
        ({"ball": "tennis"}, "ball must be one of"),
        ({"n_blue": 6}, "n_blue must be at most 5"),
        ({"n_yellow": -1}, "n_yellow must not be negative, got -1"),
        ({"time_step": -0.025}, "time_step must be positive and finite, got -0.025"),
        ({"time_step": float("nan")}, "time_step must be positive and finite"),
        ({"tick": 0.004}, "whole number of ticks"),
        ({"tick": 1e-40, "time_step": 2e-40}, "tick must be at least 0.00001 s"),
    ],
)
def test_a_bad_configuration_is_refused_by_name(options: dict[str, Any], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        SimConfig(**options)


def test_a_field_by_numbers_keeps_the_robots_of_its_league() -> None:
    """An SSL field whose goals have no walls of their own got a VSSS robot and ball."""
    for field, robot, ball in (
        (
            Field("ssl_b", goal_wall_thickness=0.0, goal_line_margin=0.0),
            "ssl_generic",
            "ssl_tigers",
        ),
        (
            Field("vss_3v3", goal_wall_thickness=0.01, goal_line_margin=0.3),
            "vss_440rpm",
            "vss_rsim",
        ),
    ):
        config = SimConfig(field, 1, 1)
        assert (config.robot.name, config.ball.name) == (robot, ball)


def test_a_field_of_no_league_needs_robots_and_ball() -> None:
    field = Field.from_json(Field("ssl_b").to_json().replace("ssl_b", "backyard"))
    given: dict[str, Any] = {"robot": "ssl_generic", "ball": "ssl_tigers"}
    assert SimConfig(field, 1, 1, **given).field.name == "backyard"
    for name, model in given.items():
        other = next(iter(given.keys() - {name}))
        with pytest.raises(ValueError, match=f'{other} must be given .*"backyard"'):
            SimConfig(field, 1, 1, **{name: model})


@pytest.mark.parametrize(
    "text", ["", "{}", "[1, 2]", CONFIG.to_json().replace('"mass":0.15', '"mass":-1')]
)
def test_foreign_json_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match=r"text is not a configuration|must be positive"):
        SimConfig.from_json(text)


@pytest.mark.parametrize(
    ("worlds", "threads", "words"),
    [(0, 1, "worlds"), (-1, 1, "worlds"), (1, 0, "threads"), (1, 5000, "threads")],
)
def test_a_simulator_needs_worlds_and_threads(worlds: int, threads: int, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        Simulator(CONFIG, worlds, threads)


def read_only(shape: tuple[int, ...]) -> Floats:
    array = np.zeros(shape, np.float32)
    array.setflags(write=False)
    return array


BAD_STEPS: list[tuple[str, dict[str, Any], type[Exception]]] = [
    ("commands must have shape", {"commands": no_commands(2)}, ValueError),
    ("commands must be an array", {"commands": no_commands().astype(np.float64)}, TypeError),
    ("commands must be an array", {"commands": [[0.0]]}, TypeError),
    ("commands must be finite", {"commands": no_commands() * np.nan}, ValueError),
    ("out must have shape", {"out": np.zeros((2, CONFIG.row_size), np.float32)}, ValueError),
    ("out must be an array", {"out": np.zeros((3, CONFIG.row_size))}, TypeError),
    ("out must be C-cont", {"out": np.zeros((CONFIG.row_size, 3), np.float32).T}, ValueError),
    ("out must be writeable", {"out": read_only((3, CONFIG.row_size))}, ValueError),
    ("active must have shape", {"active": np.ones(2, np.bool_)}, ValueError),
    ("active must be an array", {"active": np.ones(3, np.int8)}, TypeError),
]


@pytest.mark.parametrize(("words", "argument", "error"), BAD_STEPS)
def test_a_bad_step_is_refused_before_anything_moves(
    words: str, argument: dict[str, Any], error: type[Exception]
) -> None:
    simulator = Simulator(CONFIG, WORLDS)
    driven(simulator, 5)
    before, kept = simulator.snapshot(), rows_of(simulator)
    good: dict[str, Any] = {"commands": no_commands() + 20, "out": kept.copy(), "active": None}
    with pytest.raises(error, match=words):
        simulator.step(**(good | argument))
    assert simulator.snapshot() == before
    simulator.step(**good)
    assert simulator.snapshot() != before, "the good step does move"


@given(
    npst.arrays(
        st.sampled_from([np.float32, np.float64, np.int32, np.bool_]),
        npst.array_shapes(min_dims=1, max_dims=4, max_side=7),
    )
)
@settings(max_examples=200, deadline=None)
def test_any_commands_are_executed_or_refused(commands: Array) -> None:
    simulator = Simulator(CONFIG, 1)
    before, out = simulator.snapshot(), rows_of(simulator)
    shape = no_commands(1).shape
    fits = commands.dtype == np.float32 and commands.shape == shape and np.isfinite(commands).all()
    if fits:
        simulator.step(commands, out)
        assert np.isfinite(out).all()
    else:
        with pytest.raises((TypeError, ValueError), match=r"^commands must"):
            simulator.step(commands, out)
        assert simulator.snapshot() == before


def test_errors_of_placing_name_world_and_robots() -> None:
    simulator = Simulator(CONFIG, WORLDS)
    out = rows_of(simulator)
    before = simulator.snapshot()
    robot = len(BALL_COLUMNS)
    onto, outside, heading = out[:2].copy(), out[:2].copy(), out[:2].copy()
    teammate = robot + len(ROBOT_COLUMNS)
    onto[1, robot : robot + 2] = onto[1, teammate : teammate + 2] + 0.01
    outside[0, 0] = 5.0
    heading[1, robot + 2] = 0.3
    mask = np.array([True, False, True])
    for rows, words in [
        (onto, "world 2: blue_0 and blue_1 overlap by"),
        (outside, r"world 0: ball is outside the field, at \(5.000, 0.000\) m"),
        (heading, "world 2: the heading of blue_0 must be a unit vector"),
        (out[:1], r"rows must have shape \(2, 89\), got \(1, 89\)"),
    ]:
        with pytest.raises(ValueError, match=words):
            simulator.place(mask, rows, out)
        assert simulator.snapshot() == before


def test_a_placed_state_is_read_back_exactly() -> None:
    simulator = Simulator(CONFIG, WORLDS)
    rows = driven(simulator, 40)
    rows[:, BALL_COLUMNS.index("crossed") :][:, :3] = 0.0  # an event, not a state
    other = Simulator(CONFIG, WORLDS)
    out = np.zeros_like(rows)
    other.place(np.ones(WORLDS, np.bool_), rows, out)
    assert np.abs(rows[:, len(BALL_COLUMNS) + 4]).max() > 0.05, "robots move"
    np.testing.assert_array_equal(out, rows)
    np.testing.assert_array_equal(rows_of(other), rows_of(other))
    np.testing.assert_array_equal(rows_of(other), rows)


@pytest.mark.parametrize("duplicate", [copy.deepcopy, lambda s: pickle.loads(pickle.dumps(s))])
def test_a_copied_simulator_continues_as_the_original(
    duplicate: Callable[[Simulator], Simulator],
) -> None:
    simulator = Simulator(CONFIG, WORLDS, 2)
    driven(simulator, 30)
    twin = duplicate(simulator)
    assert (twin.config, twin.worlds, twin.threads) == (CONFIG, WORLDS, 2)
    np.testing.assert_array_equal(driven(twin, 60, seed=1), driven(simulator, 60, seed=1))


@pytest.mark.parametrize("junk", [b"", b"junk", b"rsimsna7", b"rsimsna7" + bytes(100)])
def test_a_foreign_snapshot_is_refused(junk: bytes) -> None:
    simulator = Simulator(CONFIG, WORLDS)
    before = simulator.snapshot()
    with pytest.raises(ValueError, match="snapshot"):
        simulator.restore(junk)
    with pytest.raises(ValueError, match="snapshot"):
        simulator.restore(Simulator(CONFIG, 1).snapshot())
    with pytest.raises(ValueError, match="damaged"):
        simulator.restore(before[:-7])
    assert simulator.snapshot() == before


def test_a_forecaster_takes_no_snapshot_of_a_simulator() -> None:
    simulator, forecaster = Simulator(CONFIG, 2), Forecaster(CONFIG, 2)
    before = forecaster.snapshot()
    with pytest.raises(ValueError, match="another configuration"):
        forecaster.restore(simulator.snapshot())
    with pytest.raises(ValueError, match="another configuration"):
        simulator.restore(before)
    assert forecaster.snapshot() == before


def test_simulators_on_the_same_threads_equal_one_on_its_own() -> None:
    threads = Threads(2)
    twins = [Simulator(CONFIG, 40, threads), Simulator(CONFIG, 40, threads), Simulator(CONFIG, 40)]
    assert [twin.threads for twin in twins] == [2, 2, 1]
    rows = np.zeros((3, 40, CONFIG.row_size), np.float32)
    shape = (40, CONFIG.n_robots, len(CONFIG.command_columns))
    commands = np.random.default_rng(0).uniform(-40.0, 40.0, shape).astype(np.float32)
    for _ in range(5):
        for twin, out in zip(twins, rows, strict=True):
            twin.step(commands, out)
    assert np.array_equal(rows[0], rows[2])
    assert np.array_equal(rows[1], rows[2])


@pytest.mark.parametrize("size", [0, 7, 200_000])
def test_threads_copy_arrays_of_any_size(size: int) -> None:
    source = np.random.default_rng(0).random((size, 2), np.float32)
    for threads in (Threads(), Threads(3), pickle.loads(pickle.dumps(Threads(2)))):
        out = np.full_like(source, np.nan)
        threads.copy(source, out)
        assert np.array_equal(out, source)


def test_wrong_threads_and_arrays_are_refused_by_name() -> None:
    assert Threads(3).count == 3
    for count in (0, -1, 5000):
        with pytest.raises(ValueError, match="threads"):
            Threads(count)
    zeros = np.zeros((2, 3), np.float32)
    with pytest.raises(ValueError, match=r"out must have shape \(2, 3\), got \(3, 2\)"):
        Threads().copy(zeros, np.zeros((3, 2), np.float32))
    with pytest.raises(TypeError, match="source must be an array of float32, got float64"):
        Threads().copy(zeros.astype(np.float64), zeros)


def test_other_threads_run_during_a_step() -> None:
    """A counter in Python continues during one long step: the step releases the GIL."""
    worlds = 30_000  # for a step of some tenths of a second
    simulator = Simulator(CONFIG, worlds)
    rows, commands = rows_of(simulator), no_commands(worlds) + 30
    counts, stop = [0], threading.Event()

    def count() -> None:
        while not stop.is_set():
            counts[0] += 1

    counter = threading.Thread(target=count)
    counter.start()
    while counts[0] == 0:
        time.sleep(0.001)
    before = counts[0]
    simulator.step(commands, rows)
    during = counts[0] - before
    stop.set()
    counter.join()
    # With the GIL held the counter could run only around the call.
    assert during > 1000


def test_moments_of_parts_are_those_of_all_rows() -> None:
    rng = np.random.default_rng(0)
    rows = (rng.normal(size=(40, 3)) * [1.0, 1e-3, 10.0] + [0.0, 100.0, -5.0]).astype(np.float32)
    mean, variance = np.zeros(3), np.ones(3)
    for start, end in ((0, 1), (1, 30), (30, 30), (30, 40)):
        mean, variance = pooled_moments(rows[start:end], mean, variance, start)
    np.testing.assert_allclose(mean, rows.mean(0, dtype=np.float64), rtol=1e-12)
    np.testing.assert_allclose(variance, rows.var(0, dtype=np.float64), rtol=1e-7)
    expected = (rows - mean) / np.sqrt(variance + 1e-8)
    assert (abs(expected) > 1.0).any()
    found = normalized(rows, mean, variance, 1e-8, 1.0)
    np.testing.assert_allclose(found, expected.clip(-1.0, 1.0), rtol=1e-6)
    with pytest.raises(ValueError, match="count must be 0 or above, and above 0 without rows"):
        pooled_moments(rows[:0], mean, variance, 0.0)
    with pytest.raises(TypeError, match="rows must be an array of float32, got float64"):
        pooled_moments(expected, mean, variance, 1.0)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="limit must be 0 or above, got -1"):
        normalized(rows, mean, variance, 1e-8, -1.0)


def test_rewards_are_added_to_discounted_returns() -> None:
    returns, mean, variance = np.array([1.0, 2.0]), 0.0, 0.0
    mean, variance = add_rewards(returns, np.array([3.0, -1.0], np.float32), 0.5, mean, variance, 0)
    assert returns.tolist() == [3.5, 0.0]
    assert (mean, variance) == (returns.mean(), returns.var())
    with pytest.raises(ValueError, match=r"rewards must have shape \(2,\), got \(3,\)"):
        add_rewards(returns, np.zeros(3, np.float32), 0.5, mean, variance, 1)
    with pytest.raises(ValueError, match="count must be 0 or above, and above 0 without returns"):
        add_rewards(returns, np.zeros(2, np.float32), 0.5, mean, variance, -3)


def test_limits_hold_on_both_sides_and_nan_stays() -> None:
    numbers = np.array([[[-9.0, 0.5, 9.0], [np.nan, -np.inf, -0.0]]], np.float32)
    clip_in_place(numbers, np.array([2.0, 1.0, 4.0], np.float32))
    expected = np.array([[[-2.0, 0.5, 4.0], [np.nan, -1.0, -0.0]]], np.float32)
    assert numbers.tobytes() == expected.tobytes()
    with pytest.raises(ValueError, match=r"bounds must have shape \(3,\), got \(2,\)"):
        clip_in_place(numbers, np.ones(2, np.float32))
    with pytest.raises(ValueError, match="bounds must be 0 or above"):
        clip_in_place(numbers, np.array([1.0, -1.0, np.nan], np.float32))
    with pytest.raises(ValueError, match="values must be writeable"):
        frozen = numbers.copy()
        frozen.flags.writeable = False
        clip_in_place(frozen, np.ones(3, np.float32))


def test_clipped_values_are_written_to_their_columns_alone() -> None:
    values = np.array([[[-9.0, 0.5], [np.nan, -0.0]]], np.float32)
    bounds = np.array([2.0, 1.0], np.float32)
    out = np.full((1, 2, 4), 7.0, np.float32)
    write_clipped(values, bounds, out, 1)
    expected = np.array([[[7.0, -2.0, 0.5, 7.0], [7.0, np.nan, -0.0, 7.0]]], np.float32)
    assert out.tobytes() == expected.tobytes()
    write_clipped(out[..., 1:3], bounds, out, 2)  # from the memory that it writes to
    assert out[0, :, 2:].tobytes() == expected[0, :, 1:3].tobytes()
    before = out.copy()
    for first in (-1, 3):
        with pytest.raises(ValueError, match=r"first must .*got " + str(first)):
            write_clipped(values, bounds, out, first)
    with pytest.raises(ValueError, match=r"bounds must have shape \(2,\), got \(3,\)"):
        write_clipped(values, np.ones(3, np.float32), out, 0)
    with pytest.raises(ValueError, match="bounds must be 0 or above"):
        write_clipped(values, -bounds, out, 0)
    with pytest.raises(ValueError, match=r"out must have shape \(1, 2, 4\), got \(2, 1, 4\)"):
        write_clipped(values, bounds, np.zeros((2, 1, 4), np.float32), 0)
    with pytest.raises(ValueError, match="out must be C-contiguous"):
        write_clipped(values, bounds, np.zeros((4, 2, 1), np.float32).T, 0)
    with pytest.raises(TypeError, match="values must be an array of float32, got float64"):
        write_clipped(values.astype(np.float64), bounds, out, 0)
    assert out.tobytes() == before.tobytes()


def test_clipped_returns_a_copy_or_none_for_the_caller_to_handle() -> None:
    numbers = np.array([[-9.0, 0.5], [1.0, 9.0]], np.float32)
    for array, expected in [
        (numbers, [[-1.0, 0.5], [1.0, 1.0]]),
        (numbers.T, [[-1.0, 1.0], [0.5, 1.0]]),
    ]:
        copied = clip_actions(array, (2, 2))
        assert copied is not None
        assert np.array_equal(copied, expected)
    assert numbers[0, 0] == -9.0
    for other in (numbers.astype(np.float64), numbers[0], [[0.0] * 2] * 2, numbers * np.inf, None):
        assert clip_actions(other, (2, 2)) is None


def test_commands_may_have_any_memory_layout() -> None:
    commands = np.random.default_rng(0).uniform(-9, 9, no_commands().shape).astype(np.float32)
    ours, theirs = Simulator(CONFIG, worlds=WORLDS), Simulator(CONFIG, worlds=WORLDS)
    ours.step(commands, rows_of(ours))
    theirs.step(np.asfortranarray(commands), rows_of(theirs))
    assert np.array_equal(rows_of(ours), rows_of(theirs))


@pytest.mark.parametrize(
    ("column", "value", "message"),
    [
        ("v_theta", 1e38, r"blue_0 turns at 1e38 rad/s \(v_theta\); at most 200 rad/s"),
        ("v_theta", -1.01 * MAX_PLACED_ANGULAR_VELOCITY, "blue_0 turns at -202"),
        ("cos", 1e30, "heading of blue_0 must be a unit vector"),
        ("v_x", np.inf, "v_x of blue_0 must be finite, got inf"),
        ("ball_z", 1.01 * MAX_PLACED_HEIGHT, "higher than 20 m, got z = 20.2"),
        ("ball_v_z", -1e20, r"ball moves at 1e20 m/s \(v_x, v_y, v_z\); at most 20 m/s"),
        ("ball_spin_z", 1.01 * MAX_PLACED_SPIN, "spins at 1010.0 rad/s .* at most 1000 rad/s"),
    ],
)
def test_absurd_starts_are_refused_by_their_column(column: str, value: float, message: str) -> None:
    simulator = Simulator(SimConfig(), 2)
    rows = np.zeros((2, simulator.config.row_size), np.float32)
    simulator.read(rows)
    before = rows.copy()
    start = rows.copy()
    of_ball = column.removeprefix("ball_")
    robot = len(BALL_COLUMNS)
    at = BALL_COLUMNS.index(of_ball) if of_ball != column else robot + ROBOT_COLUMNS.index(column)
    start[1, at] = value
    with pytest.raises(ValueError, match="world 1: .*" + message):
        simulator.place(np.ones(2, np.bool_), start, rows)
    simulator.read(rows)
    assert np.array_equal(rows, before)
