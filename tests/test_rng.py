from typing import Any

import numpy as np
import pytest

from rsoccer import _core
from rsoccer.rng import WorldRng
from tests.helpers import same


def draws(rng: WorldRng) -> list[np.ndarray]:
    return [
        rng.uniform(-1.0, 1.0, (3, 2)),
        rng.normal((3,)),
        rng.integers(10, (2,)),
        rng.uniform(0.0, 1.0),
        rng.normal(),
        rng.normal((4, 2)),
    ]


def test_the_words_are_splitmix64() -> None:
    # First outputs for the seed 0, as published with Vigna's reference code.
    rng = WorldRng.from_state(np.zeros(1, np.uint64))
    words = rng._words(3)[0].tolist()
    assert words == [0xE220A8397B1DCDAF, 0x6E789E6AA1B965F4, 0x06C45D188009454F]


@pytest.mark.parametrize("n", [1, 2, 7, 64, 1001])
def test_row_i_of_a_batch_equals_a_single_world_seeded_plus_i(n: int) -> None:
    many = draws(WorldRng.seeded(40, n))
    for i in {0, n // 2, n - 1}:
        for together, alone in zip(many, draws(WorldRng.seeded(40 + i, 1)), strict=True):
            assert same(together[i : i + 1], alone)


def test_uniform_numbers_are_uniform() -> None:
    drawn = WorldRng.seeded(0, 2000).uniform(-2.0, 3.0, (100,))
    assert drawn.dtype == np.float32
    assert drawn.min() >= -2.0
    assert drawn.max() <= 3.0
    counts = np.histogram(drawn, 50, (-2.0, 3.0))[0]
    assert np.abs(counts - 4000).max() < 5 * 4000**0.5
    assert abs(np.corrcoef(drawn[:-1].ravel(), drawn[1:].ravel())[0, 1]) < 0.01
    assert abs(np.corrcoef(drawn[:, :-1].ravel(), drawn[:, 1:].ravel())[0, 1]) < 0.01


def test_normal_numbers_are_normal() -> None:
    drawn = WorldRng.seeded(0, 2000).normal((101,)).astype(np.float64)
    n = drawn.size
    assert abs(drawn.mean()) < 4 / n**0.5
    assert abs(drawn.var() - 1.0) < 4 * (2 / n) ** 0.5
    assert abs((drawn**4).mean() - 3.0) < 4 * (96 / n) ** 0.5
    assert abs((np.abs(drawn) < 1.0).mean() - 0.682689) < 0.005
    assert abs(np.corrcoef(drawn[:, 0], drawn[:, 51])[0, 1]) < 0.1  # two numbers from one word


def test_integers_are_uniform_over_all_values() -> None:
    drawn = WorldRng.seeded(5, 1000).integers(7, (70,))
    assert drawn.dtype == np.int64
    counts = np.bincount(drawn.ravel(), minlength=7)
    assert len(counts) == 7
    assert np.abs(counts - 10000).max() < 500
    assert not WorldRng.seeded(5, 10).integers(1).any()


@pytest.mark.parametrize("high", [0, -3, 2**32 + 1])
def test_integers_need_a_range(high: int) -> None:
    with pytest.raises(ValueError, match="high"):
        WorldRng.seeded(0, 1).integers(high)


def test_split_streams_are_independent_and_do_not_change_the_parent() -> None:
    parent = WorldRng.seeded(1, 500)
    before = parent.state
    parts = [parent.split(name).uniform(0.0, 1.0, (20,)) for name in ("start", "task", 0, 1)]
    assert (parent.state == before).all()
    parts.append(parent.uniform(0.0, 1.0, (20,)))
    for i, a in enumerate(parts):
        for b in parts[:i]:
            assert abs(np.corrcoef(a.ravel(), b.ravel())[0, 1]) < 0.05


def test_the_same_label_gives_the_same_stream() -> None:
    parent = WorldRng.seeded(1, 3)
    assert same(parent.split("a").normal((2,)), parent.split("a").normal((2,)))


def test_some_worlds_draw_without_the_others() -> None:
    together, apart = WorldRng.seeded(9, 4), WorldRng.seeded(9, 4)
    mask = np.array([True, False, True, False])
    part = apart[mask]
    first = part.uniform(0.0, 1.0)
    assert same(first, together.uniform(0.0, 1.0)[mask])
    assert (apart.state == WorldRng.seeded(9, 4).state).all(), "a part is a copy"
    apart.put(mask, part)
    assert len(part) == 2
    expected = np.where(mask, together.uniform(0.0, 1.0), WorldRng.seeded(9, 4).uniform(0.0, 1.0))
    assert same(apart.uniform(0.0, 1.0), expected)


def test_a_stream_continues_from_its_state() -> None:
    rng = WorldRng.seeded(2, 3)
    rng.normal((5,))
    other = WorldRng.from_state(rng.state)
    assert same(rng.uniform(0, 1, (4,)), other.uniform(0, 1, (4,)))


@pytest.mark.parametrize("state", [np.zeros(3, np.int64), np.zeros((2, 2), np.uint64)])
def test_a_foreign_state_is_refused(state: np.ndarray) -> None:
    with pytest.raises(ValueError, match="state: expected"):
        WorldRng.from_state(state)


def test_seeds_wrap_around() -> None:
    assert WorldRng.seeded(2**64 - 1, 2).state[1] == WorldRng.seeded(0, 1).state[0]


def test_numbers_are_those_of_array_operations_on_the_words() -> None:
    words = WorldRng.seeded(3, 50)._words(4)
    unit = (words >> np.uint64(40)).astype(np.float32) * np.float32(2.0**-24)
    expected = np.float32(-2.5) + np.float32(3.7) * unit
    assert same(WorldRng.seeded(3, 50).uniform(-2.5, 1.2, (4,)), expected)
    low = ((words >> np.uint64(8)) & np.uint64(0xFFFFFF)).astype(np.float32)
    angle = np.float32(2.0 * np.pi) * (low * np.float32(2.0**-24))
    radius = np.sqrt(np.float32(-2.0) * np.log(unit + np.float32(2.0**-24)))
    expected = np.concatenate([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    assert same(WorldRng.seeded(3, 50).normal((8,)), expected)
    assert same(WorldRng.seeded(3, 50).normal((7,)), expected[:, :7])


@pytest.mark.parametrize("states", [[1, 2], np.zeros(2, np.int64), np.zeros((2, 2), np.uint64)])
def test_foreign_states_are_refused_by_the_core(states: Any) -> None:  # noqa: ANN401  (bad input)
    for draw in (
        lambda: _core.random_words(states, 1),
        lambda: _core.uniform(states, 1, 0.0, 1.0),
        lambda: _core.normal_inputs(states, 1),
    ):
        with pytest.raises((TypeError, ValueError), match="states must"):
            draw()


@pytest.mark.parametrize("n", [0, 1, 4])
@pytest.mark.parametrize("count", [2**32, 2**60, 2**62, 2**63])
def test_more_numbers_than_memory_are_refused(n: int, count: int) -> None:
    states = np.zeros(n, np.uint64)
    for draw in (
        lambda: _core.random_words(states, count),
        lambda: _core.uniform(states, count, 0.0, 1.0),
        lambda: _core.normal_inputs(states, count),
    ):
        with pytest.raises(ValueError, match="count must be at most"):
            draw()
