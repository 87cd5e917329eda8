"""Opponents: the right mix, drawn anew each episode, old selves spread over the run."""

import numpy as np
import pytest

from rsoccer.frame import Array, Floats
from rsoccer.policies import make
from rsoccer.policies.base import PolicyInput
from rsoccer.policies.network import Network
from rsoccer.policies.policy_file import FORMAT
from rsoccer.registry import make_task
from rsoccer.rng import WorldRng
from rsoccer.train.opponent_pool import LATEST, OU, PAST, OpponentPool, kinds
from rsoccer.train.timing import Clock

TASK = make_task("VSSSelfPlay-v0")
SHARES = {"latest": 0.5, "past": 0.3, "ou": 0.2}
OBSERVED = 5


def constant(action: float, spread: float | None = None) -> Network:
    """A network that always gives one action, or draws around it."""
    arrays = {
        "layers.0.weight": np.zeros((2, OBSERVED), np.float32),
        "layers.0.bias": np.full(2, action, np.float32),
        "mean": np.zeros(OBSERVED, np.float32),
        "std": np.ones(OBSERVED, np.float32),
    }
    if spread is not None:
        arrays["action_std"] = np.full(2, spread, np.float32)
    sizes = {"observation_size": str(OBSERVED), "action_size": "2"}
    metadata = {"format": FORMAT, "task": "x", "activation": "tanh", "clip": "10", **sizes}
    return Network(arrays, metadata)


def new_pool(past: int, *, repeat: int = 1, size: int = 8) -> OpponentPool:
    """A pool whose latest self acts 0.5 and whose past self k acts -0.1 (k + 1)."""
    pool = OpponentPool(TASK, SHARES, size, repeat, Clock())
    pool.latest = constant(0.5)
    for slot in range(past):
        pool.freeze(constant(-0.1 * (slot + 1)), slot)
    return pool


def seen(n: int) -> PolicyInput:
    return PolicyInput((n, 3, 2), None, np.zeros((n, 3, OBSERVED), np.float32))


def start(pool: OpponentPool, n: int, seed: int = 0) -> tuple[WorldRng, dict[str, Array]]:
    rng = WorldRng.seeded(seed, n)
    return rng, pool.new_memory((n, 3, 2), rng)


def test_worlds_get_opponents_in_the_shares_asked_for() -> None:
    n = 20_000
    _, memory = start(new_pool(past=3), n)
    codes, counts = np.unique(memory["opponent"], return_counts=True)
    assert codes.tolist() == [OU, LATEST, PAST, PAST + 1, PAST + 2]
    assert counts / n == pytest.approx([0.2, 0.5, 0.1, 0.1, 0.1], abs=0.015)
    assert np.bincount(kinds(memory["opponent"])).tolist() == [*counts[:2], counts[2:].sum()]


def test_without_a_past_its_share_goes_to_the_latest_self() -> None:
    _, memory = start(new_pool(past=0), 10_000)
    assert (memory["opponent"] == OU).mean() == pytest.approx(0.2, abs=0.02)
    assert set(memory["opponent"].tolist()) == {OU, LATEST}


def test_each_episode_draws_anew() -> None:
    pool = new_pool(past=3)
    rng, first = start(pool, 500)
    second = pool.new_memory((500, 3, 2), rng)
    assert (first["opponent"] != second["opponent"]).mean() > 0.3


def test_each_world_is_played_by_its_own_opponent() -> None:
    pool = new_pool(past=2)
    rng, memory = start(pool, 200)
    expected = {LATEST: 0.5, PAST: -0.1, PAST + 1: -0.2}
    actions = pool.act(seen(200), rng, memory)
    assert actions.shape == (200, 3, 2)
    for code, action in expected.items():
        rows = memory["opponent"] == code
        assert rows.any()
        np.testing.assert_allclose(actions[rows], action, rtol=1e-6)
    assert pool.opponents.tolist() == memory["opponent"].tolist()


def test_past_selves_played_their_mean_though_they_had_learned_with_chance() -> None:
    pool = new_pool(past=0)
    pool.latest = constant(0.1, spread=0.3)
    pool.freeze(constant(-0.1, spread=0.3), 0)
    rng, memory = start(pool, 2000)
    actions = pool.act(seen(2000), rng, memory)
    for code, mean in {LATEST: 0.1, PAST: -0.1}.items():
        drawn = actions[memory["opponent"] == code]
        assert drawn.mean() == pytest.approx(mean, abs=0.02)
        assert drawn.std() == pytest.approx(0.3, abs=0.02)
    again = pool.act(seen(2000), rng, memory)
    rows = memory["opponent"] != OU
    assert (again[rows] != actions[rows]).mean() > 0.99, "it drew the same again"


def test_what_a_past_self_draws_depends_on_its_world_alone() -> None:
    pool = new_pool(past=0, repeat=2)
    pool.latest = constant(0.0, spread=0.3)
    rng, memory = start(pool, 30)
    alone = rng[np.arange(7, 8)], {name: array[7:8].copy() for name, array in memory.items()}
    memory["opponent"][:], alone[1]["opponent"][:] = LATEST, LATEST
    memory["age"][:5] = 1  # these decide in other steps
    together = [pool.act(seen(30), rng, memory)[7] for _ in range(6)]
    for step, action in enumerate(together):
        np.testing.assert_array_equal(pool.act(seen(1), *alone)[0], action)
        assert step % 2 == 0 or np.array_equal(action, together[step - 1]), "it is held for 2"
    assert not np.array_equal(together[1], together[2])


def test_drifting_worlds_drift_as_the_ou_policy_does() -> None:
    pool, drift = new_pool(past=2), make("ou", TASK)
    rng, memory = start(pool, 50)
    alone, own = WorldRng.from_state(rng.state), {}
    own = drift.new_memory((50, 3, 2), alone)
    for _ in range(10):
        actions = pool.act(seen(50), rng, memory)
        expected = drift.act(seen(50), alone, own)
    rows = memory["opponent"] == OU
    assert rows.any()
    assert np.abs(expected[rows]).max() > 0.05, "it has not moved, so nothing was compared"
    np.testing.assert_array_equal(actions[rows], expected[rows])


def test_networks_hold_a_decision_and_start_afresh_with_an_episode() -> None:
    pool = new_pool(past=0, repeat=3)
    rng, memory = start(pool, 40)
    rows = memory["opponent"] == LATEST
    shown: list[Floats] = []
    for step in range(7):
        pool.latest = constant(0.1 * step)
        if step == 4:  # the match in the first world ended: it begins anew
            fresh = pool.new_memory((1, 3, 2), rng[np.arange(1)])
            fresh["opponent"][:] = LATEST
            for name, array in fresh.items():
                memory[name][:1] = array
        shown.append(pool.act(seen(40), rng, memory)[:, 0, 0])
    rows[0] = False
    held = np.array(shown)
    np.testing.assert_allclose(held[:, rows][:, 0], [0, 0, 0, 0.3, 0.3, 0.3, 0.6], rtol=1e-6)
    np.testing.assert_allclose(held[4:, 0], [0.4, 0.4, 0.4], rtol=1e-6)


def test_a_full_pool_stays_spread_over_the_run() -> None:
    pool = new_pool(past=0, size=6)
    for born in range(0, 1000, 10):
        pool.freeze(constant(0.0), born)
        assert len(pool.past) == len(pool.born) <= 6
    ages = sorted(pool.born)
    assert ages[0] == 0 and ages[-1] == 990
    assert np.diff(ages).max() < 600, ages


def test_a_pool_of_one_keeps_the_newest() -> None:
    pool = new_pool(past=0, size=1)
    for born in range(3):
        pool.freeze(constant(0.0), born)
    assert pool.born == [2]


def test_it_goes_on_from_its_state() -> None:
    pool, other = new_pool(past=3), new_pool(past=0)
    metadata = constant(0.0).metadata
    other.load_state_dict(pool.state_dict(), metadata)
    assert other.born == pool.born == [0, 1, 2]
    for mine, its in zip(pool.past, other.past, strict=True):
        assert {k: v.tobytes() for k, v in mine.arrays().items()} == {
            k: v.tobytes() for k, v in its.arrays().items()
        }
