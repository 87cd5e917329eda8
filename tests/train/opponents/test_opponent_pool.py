"""Opponents: their shares, a new draw each episode, past policies spread over the run."""

from pathlib import Path

import numpy as np
import pytest

from rsoccer.arrays import Array, Floats
from rsoccer.history import ObservationStack
from rsoccer.matches import Matches
from rsoccer.policies import make_policy
from rsoccer.policies.base import MatchState, PolicyInput
from rsoccer.policies.network import Network
from rsoccer.policies.policy_file import FORMAT
from rsoccer.policies.shield import Shield
from rsoccer.registry import make_task
from rsoccer.rng import WorldRng
from rsoccer.train.clock import Clock
from rsoccer.train.opponents import opponent_pool
from rsoccer.train.opponents.opponent_pool import OpponentPool
from rsoccer.train.opponents.policy_mix import PolicyMix
from tests.policies.networks import network_for

TASK = make_task("VSSSelfPlay-v0")
ZERO, OU, LATEST, PAST = range(4)  # codes of the pool in these tests
OBSERVATION_SIZE = 5


def constant(action: float, action_std: float | None = None) -> Network:
    """Return a network whose mean action is constant."""
    arrays = {
        "layers.0.weight": np.zeros((2, OBSERVATION_SIZE), np.float32),
        "layers.0.bias": np.full(2, action, np.float32),
        "mean": np.zeros(OBSERVATION_SIZE, np.float32),
        "std": np.ones(OBSERVATION_SIZE, np.float32),
    }
    if action_std is not None:
        arrays["action_std"] = np.full(2, action_std, np.float32)
    sizes = {"observation_size": str(OBSERVATION_SIZE), "action_size": "2"}
    metadata = {"format": FORMAT, "task": "x", "activation": "tanh", "clip": "10", **sizes}
    return Network(arrays, metadata)


@pytest.fixture(autouse=True)
def pool_size(monkeypatch: pytest.MonkeyPatch) -> None:
    """Undo the small pools of the short runs."""
    monkeypatch.setattr(opponent_pool, "POOL_SIZE", 8)


def new_pool(past: int, *, action_repeat: int = 1) -> OpponentPool:
    """Return a pool whose current policy acts 0.5 and whose past policy k acts -0.1 (k + 1)."""
    fixed = {"zero": 1.0, "ou": 3.0}
    pool = OpponentPool(
        TASK, fixed, (0.5, 0.3), action_repeat, Clock(), ObservationStack.of(TASK, 1)
    )
    pool.latest = constant(0.5)
    for slot in range(past):
        pool.freeze(constant(-0.1 * (slot + 1)), slot)
    return pool


def inputs(n: int) -> PolicyInput:
    return PolicyInput((n, 3, 2), None, np.zeros((n, 3, OBSERVATION_SIZE), np.float32))


def start(pool: OpponentPool, n: int, seed: int = 0) -> tuple[WorldRng, dict[str, Array]]:
    rng = WorldRng.seeded(seed, n)
    return rng, pool.new_memory((n, 3, 2), rng)


def test_opponents_are_drawn_in_the_given_fractions() -> None:
    n = 20_000
    pool = new_pool(past=3)
    _, memory = start(pool, n)
    codes, counts = np.unique(memory["drawn"], return_counts=True)
    assert codes.tolist() == [ZERO, OU, LATEST, PAST, PAST + 1, PAST + 2]
    assert counts / n == pytest.approx([0.05, 0.15, 0.5, 0.1, 0.1, 0.1], abs=0.015)
    assert pool.kinds == ("zero", "ou", "latest", "past")
    kinds = np.bincount(pool.kinds_of(memory["drawn"]))
    assert kinds.tolist() == [*counts[:3], counts[3:].sum()]


def test_an_empty_pool_plays_the_latest_policy_instead() -> None:
    _, memory = start(new_pool(past=0), 10_000)
    assert (memory["drawn"] == OU).mean() == pytest.approx(0.15, abs=0.02)
    assert set(memory["drawn"].tolist()) == {ZERO, OU, LATEST}


def test_each_episode_draws_a_new_opponent() -> None:
    pool = new_pool(past=3)
    rng, first = start(pool, 500)
    second = pool.new_memory((500, 3, 2), rng)
    assert (first["drawn"] != second["drawn"]).mean() > 0.3


def test_each_world_is_played_by_its_own_opponent() -> None:
    pool = new_pool(past=2)
    rng, memory = start(pool, 200)
    expected = {ZERO: 0.0, LATEST: 0.5, PAST: -0.1, PAST + 1: -0.2}
    actions = pool.act(inputs(200), rng, memory)
    assert actions.shape == (200, 3, 2)
    for code, action in expected.items():
        rows = memory["drawn"] == code
        assert rows.any()
        np.testing.assert_allclose(actions[rows], action, rtol=1e-6)
    assert pool.drawn.tolist() == memory["drawn"].tolist()


def test_networks_of_the_pool_draw_actions_with_their_standard_deviation() -> None:
    pool = new_pool(past=0)
    pool.latest = constant(0.1, action_std=0.3)
    pool.freeze(constant(-0.1, action_std=0.3), 0)
    rng, memory = start(pool, 2000)
    actions = pool.act(inputs(2000), rng, memory)
    for code, mean in {LATEST: 0.1, PAST: -0.1}.items():
        own = actions[memory["drawn"] == code]
        assert own.mean() == pytest.approx(mean, abs=0.02)
        assert own.std() == pytest.approx(0.3, abs=0.02)
    again = pool.act(inputs(2000), rng, memory)
    rows = memory["drawn"] >= LATEST
    assert (again[rows] != actions[rows]).mean() > 0.99, "the same actions were drawn twice"


def test_actions_depend_on_the_stream_of_their_world_only() -> None:
    pool = new_pool(past=0, action_repeat=2)
    pool.latest = constant(0.0, action_std=0.3)
    rng, memory = start(pool, 30)
    single = rng[np.arange(7, 8)], {name: array[7:8].copy() for name, array in memory.items()}
    memory["drawn"][:], single[1]["drawn"][:] = LATEST, LATEST
    memory["age"][:5] = 1  # these worlds decide in other steps
    batch = [pool.act(inputs(30), rng, memory)[7] for _ in range(6)]
    for step, action in enumerate(batch):
        np.testing.assert_array_equal(pool.act(inputs(1), *single)[0], action)
        assert step % 2 == 0 or np.array_equal(action, batch[step - 1]), "not held for 2 steps"
    assert not np.array_equal(batch[1], batch[2])


def test_ou_opponents_equal_the_ou_policy() -> None:
    pool, ou = new_pool(past=2), make_policy("ou", TASK)
    rng, memory = start(pool, 50)
    ou_rng = WorldRng.from_state(rng.state)
    ou_memory = ou.new_memory((50, 3, 2), ou_rng)
    for _ in range(10):
        actions = pool.act(inputs(50), rng, memory)
        expected = ou.act(inputs(50), ou_rng, ou_memory)
    rows = memory["drawn"] == OU
    assert rows.any()
    assert np.abs(expected[rows]).max() > 0.05, "no action to compare"
    np.testing.assert_array_equal(actions[rows], expected[rows])


def test_networks_hold_a_decision_until_a_new_episode() -> None:
    pool = new_pool(past=0, action_repeat=3)
    rng, memory = start(pool, 40)
    rows = memory["drawn"] == LATEST
    actions: list[Floats] = []
    for step in range(7):
        pool.latest = constant(0.1 * step)
        if step == 4:  # a new episode begins in the first world
            fresh = pool.new_memory((1, 3, 2), rng[np.arange(1)])
            fresh["drawn"][:] = LATEST
            for name, array in fresh.items():
                memory[name][:1] = array
        actions.append(pool.act(inputs(40), rng, memory)[:, 0, 0])
    rows[0] = False
    held = np.array(actions)
    np.testing.assert_allclose(held[:, rows][:, 0], [0, 0, 0, 0.3, 0.3, 0.3, 0.6], rtol=1e-6)
    np.testing.assert_allclose(held[4:, 0], [0.4, 0.4, 0.4], rtol=1e-6)


def test_a_full_pool_stays_spread_over_the_run(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(opponent_pool, "POOL_SIZE", 6)
    pool = new_pool(past=0)
    for update in range(0, 1000, 10):
        pool.freeze(constant(0.0), update)
        assert len(pool.past) == len(pool.slots.frozen_at) <= 6
    updates = sorted(pool.slots.frozen_at)
    assert updates[0] == 0 and updates[-1] == 990
    assert np.diff(updates).max() < 600, updates


def test_a_pool_of_one_keeps_the_newest(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(opponent_pool, "POOL_SIZE", 1)
    pool = new_pool(past=0)
    for update in range(3):
        pool.freeze(constant(0.0), update)
    assert pool.slots.frozen_at == [2]


def test_the_latest_policy_is_frozen_at_intervals(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(opponent_pool, "FREEZE_INTERVAL", 10)
    pool, shown = new_pool(past=0), [constant(0.01 * update) for update in range(31)]
    for update in range(1, 31):
        pool.show(shown[update], update)
        assert pool.latest is shown[update]
    assert pool.slots.frozen_at == [10, 20, 30]
    assert pool.past == [shown[10], shown[20], shown[30]]


def test_the_state_of_a_pool_can_be_restored() -> None:
    pool, other = new_pool(past=3), new_pool(past=0)
    pool.slots.record([1, 1, 2], [1.0, 1.0, -1.0])
    metadata = constant(0.0).metadata
    other.load_state_dict(pool.state_dict(), metadata)
    assert other.slots.frozen_at == pool.slots.frozen_at == [0, 1, 2]
    assert other.slots.win_rates == pool.slots.win_rates
    assert len(set(other.slots.win_rates)) == 3
    for saved, restored in zip(pool.past, other.past, strict=True):
        assert {k: v.tobytes() for k, v in saved.arrays().items()} == {
            k: v.tobytes() for k, v in restored.arrays().items()
        }


def test_opponents_that_are_seldom_beaten_are_drawn_more_often() -> None:
    pool = new_pool(past=2)
    start(pool, 1000)
    pool.drawn = np.tile([ZERO, LATEST, PAST, PAST + 1], 40)
    scores = np.where(pool.drawn == PAST, 1.0, -1.0)
    pool.record(np.arange(160) >= 4, scores)  # the first four are still being played
    assert pool.slots.win_rates == pytest.approx([1 - 0.5 * 0.95**39, 0.5 * 0.95**39])
    _, memory = start(pool, 20_000)
    counts = np.bincount(memory["drawn"])
    assert counts[PAST] / counts[PAST + 1] == pytest.approx(0.16 / 0.84, rel=0.15)


def test_scripts_and_files_are_opponents(tmp_path: Path) -> None:
    """A script acts on the view of its own worlds, a file holds decisions as it was trained."""
    size = TASK.layout.size
    arrays = {
        "layers.0.weight": np.zeros((2, size), np.float32),
        "layers.0.bias": np.full(2, 0.3, np.float32),
        "mean": np.zeros(size, np.float32),
        "std": np.ones(size, np.float32),
    }
    metadata = {"format": FORMAT, "task": TASK.name, "activation": "tanh", "clip": "10"}
    metadata |= {"observation_size": str(size), "action_size": "2", "action_repeat": "2"}
    path = tmp_path / "clone.safetensors"
    Network(arrays, metadata).save(path)
    shares = {"chase": 0.4, "ou": 0.2, str(path): 0.4}
    mix = PolicyMix(TASK, shares, Clock())
    assert mix.kinds == ("chase", "ou", "clone")
    worlds = 12
    matches = Matches(TASK, worlds, seed=3, controllers={"blue": "zero", "yellow": mix})
    alone = {
        name: Matches(TASK, worlds, seed=3, controllers={"blue": "zero", "yellow": name})
        for name in ("chase", str(path))
    }
    matches.reset()
    for own in alone.values():
        own.reset()
    for _ in range(5):
        matches.step(np.zeros((worlds, 0, 2), np.float32))
        for own in alone.values():
            own.step(np.zeros((worlds, 0, 2), np.float32))
    for code, name in ((0, "chase"), (2, str(path))):
        rows = mix.drawn == code
        assert rows.any()
        expected = alone[name].play.frame.rows[rows]
        np.testing.assert_allclose(matches.play.frame.rows[rows], expected, atol=1e-5)
    moved = alone["chase"].play.frame.rows - alone[str(path)].play.frame.rows
    assert np.abs(moved).max(axis=1).min() > 0.01, "all policies play alike"


@pytest.mark.parametrize("action_repeat", [1, 3])
def test_selves_play_behind_the_shield_of_the_learners(action_repeat: int) -> None:
    task = make_task("VSSMatch-v0")
    network = network_for(task)
    network.shield = Shield("vsss")
    stack = ObservationStack.of(task, 1)
    pool = OpponentPool(task, {"zero": 1.0}, (0.6, 0.4), action_repeat, Clock(), stack)
    pool.show(network, 0)
    seen: list[tuple[int, list[int]]] = []

    def block(match: MatchState, actions: Floats) -> None:
        seen.append((len(match.rows), match.robots.tolist()))
        assert len(match.rows) == len(actions)
        actions[...] = 0.25

    network.shield.apply = block  # type: ignore[method-assign]
    matches = Matches(task, 6, 0, controllers={"yellow": pool})
    matches.reset()
    steps = 4
    for _ in range(steps):
        matches.step(np.zeros((6, 3, 2), np.float32))
        assert (matches.play.actions[:, 3:] == 0.25).all()
    assert seen == [(6, [3, 4, 5])] * steps, "in each control step, in all matches of selves"


def test_fixed_policies_have_no_shield() -> None:
    task = make_task("VSSMatch-v0")
    network = network_for(task)
    network.shield = Shield("vsss")
    pool = OpponentPool(task, {"zero": 1.0}, (0.5, 0.0), 1, Clock(), ObservationStack.of(task, 1))
    pool.latest = network
    worlds = []
    network.shield.apply = lambda match, actions: worlds.append(len(match.rows))  # type: ignore[method-assign]
    matches = Matches(task, 40, 0, controllers={"yellow": pool})
    matches.reset()
    matches.step(np.zeros((40, 3, 2), np.float32))
    assert worlds == [int((pool.drawn == 1).sum())]
    assert 0 < worlds[0] < 40
    assert not matches.play.actions[pool.drawn == 0, 3:].any()
