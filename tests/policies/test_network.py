import pickle

import numpy as np
import pytest

from rsoccer.policies.base import PolicyInput
from rsoccer.policies.network import Network
from rsoccer.policies.policy_file import FORMAT
from rsoccer.rng import WorldRng

Arrays = dict[str, np.ndarray]
Metadata = dict[str, str]

OBSERVATION, HIDDEN, ACTION = 5, 8, 2


def parts(**extra: str) -> tuple[Arrays, Metadata]:
    rng = np.random.default_rng(0)
    shapes = [(HIDDEN, OBSERVATION), (HIDDEN, HIDDEN), (ACTION, HIDDEN)]
    arrays: Arrays = {}
    for index, shape in enumerate(shapes):
        arrays[f"layers.{index}.weight"] = rng.normal(size=shape).astype(np.float32)
        arrays[f"layers.{index}.bias"] = rng.normal(size=shape[0]).astype(np.float32)
    arrays["mean"] = rng.normal(size=OBSERVATION).astype(np.float32)
    arrays["std"] = rng.uniform(0.5, 2.0, OBSERVATION).astype(np.float32)
    metadata = {
        "format": FORMAT,
        "task": "VSSSelfPlay-v0",
        "observation_size": str(OBSERVATION),
        "action_size": str(ACTION),
        "activation": "tanh",
        "clip": "10",
    }
    return arrays, {**metadata, **extra}


def seen(observations: np.ndarray) -> PolicyInput:
    n, robots = observations.shape[:2]
    return PolicyInput((n, robots, ACTION), None, observations.astype(np.float32))


def observations(n: int = 4, robots: int = 3, seed: int = 1) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=(n, robots, OBSERVATION)).astype(np.float32)


def by_hand(arrays: Arrays, observation: np.ndarray, clip: float = 10.0) -> np.ndarray:
    """The formula of the file format, one robot at a time, in double precision."""
    hidden = (observation.astype(float) - arrays["mean"]) / arrays["std"]
    hidden = np.minimum(np.maximum(hidden, -clip), clip)
    for index in range(3):
        hidden = arrays[f"layers.{index}.weight"] @ hidden + arrays[f"layers.{index}.bias"]
        hidden = np.tanh(hidden) if index < 2 else hidden
    return np.minimum(np.maximum(hidden, -1.0), 1.0)


def test_actions_follow_the_formula() -> None:
    arrays, metadata = parts()
    given = observations()
    rng = WorldRng.seeded(0, len(given))
    actions = Network(arrays, metadata).act(seen(given), rng, {})
    expected = np.array([[by_hand(arrays, robot) for robot in world] for world in given])
    assert actions.shape == (4, 3, ACTION)
    assert actions.dtype == np.float32
    np.testing.assert_allclose(actions, expected, atol=1e-5)
    assert (np.abs(expected) < 1.0).any(), "all actions at a bound: the formula was not compared"
    assert (np.abs(expected) == 1.0).any(), "no action at a bound: the clip was not compared"


def test_far_observations_are_clipped() -> None:
    arrays, metadata = parts(clip="2")
    far = observations() * np.float32(1000.0)
    network = Network(arrays, metadata)
    assert network.decide(far) == pytest.approx(
        np.array([[by_hand(arrays, robot, clip=2.0) for robot in world] for world in far]), abs=1e-5
    )
    assert not np.allclose(network.decide(far), Network(*parts()).decide(far))


def test_batches_agree_with_single_worlds() -> None:
    network, given = Network(*parts()), observations(n=33)
    single = np.concatenate([network.decide(world[None]) for world in given])
    np.testing.assert_allclose(network.decide(given), single, atol=1e-5)


def test_a_decision_is_held_for_the_repeat() -> None:
    network = Network(*parts(action_repeat="3"))
    rng = WorldRng.seeded(0, 4)
    memory = network.new_memory((4, 3, ACTION), rng)
    memory["age"][0] = 1  # this world began two steps later than a decision
    looks = [observations(seed=seed) for seed in range(6)]
    acted = np.array([network.act(seen(look), rng, memory) for look in looks])
    decided = np.array([network.decide(look) for look in looks])
    assert np.array_equal(acted[0, 1:], acted[2, 1:])
    np.testing.assert_allclose(acted[0:3, 1:], decided[[0, 0, 0], 1:], atol=1e-5)
    np.testing.assert_allclose(acted[3:6, 1:], decided[[3, 3, 3], 1:], atol=1e-5)
    np.testing.assert_allclose(acted[2:5, 0], decided[[2, 2, 2], 0], atol=1e-5)
    assert not np.allclose(decided[0], decided[3]), "the looks do not differ"


def test_a_network_pickles() -> None:
    network, given = Network(*parts()), observations()
    assert np.array_equal(pickle.loads(pickle.dumps(network)).decide(given), network.decide(given))


def test_a_network_owns_its_arrays() -> None:
    arrays, metadata = parts()
    network, given = Network(arrays, metadata), observations()
    before = network.decide(given)
    for array in [*arrays.values(), *network.arrays().values()]:
        array[:] = 0.0
    assert np.array_equal(network.decide(given), before)


def test_a_network_without_observations_says_so() -> None:
    network = Network(*parts())
    rng = WorldRng.seeded(0, 4)
    with pytest.raises(ValueError, match="needs observations"):
        network.act(PolicyInput((4, 3, ACTION), None, None), rng, {})
    with pytest.raises(ValueError, match="of 5 numbers, got 6"):
        network.decide(np.zeros((4, 3, 6), np.float32))
