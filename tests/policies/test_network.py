import pickle
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from safetensors.numpy import save_file

from rsoccer.policies.base import Seen
from rsoccer.policies.network import Network
from rsoccer.rng import WorldRng

Arrays = dict[str, np.ndarray]
Metadata = dict[str, str]
Spoil = Callable[[Arrays, Metadata], object]

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
        "format": "rsoccer-policy-1",
        "task": "VSSSelfPlay-v0",
        "observation_size": str(OBSERVATION),
        "action_size": str(ACTION),
        "activation": "tanh",
        "clip": "10",
    }
    return arrays, {**metadata, **extra}


def seen(observations: np.ndarray) -> Seen:
    n, robots = observations.shape[:2]
    return Seen((n, robots, ACTION), None, observations.astype(np.float32))


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


def test_a_file_keeps_everything(tmp_path: Path) -> None:
    network = Network(*parts(action_repeat="3"))
    network.save(tmp_path / "policy.safetensors")
    loaded = Network.load(tmp_path / "policy.safetensors")
    assert loaded.metadata == network.metadata
    assert loaded.action_repeat == 3
    assert loaded.task_name == "VSSSelfPlay-v0"
    assert {name: array.tobytes() for name, array in loaded.arrays().items()} == {
        name: array.tobytes() for name, array in network.arrays().items()
    }
    assert [path.name for path in tmp_path.iterdir()] == ["policy.safetensors"]


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


def test_a_failed_save_leaves_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "policy.safetensors"
    network = Network(*parts())
    network.save(path)
    before = path.read_bytes()

    def full_disk(descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", full_disk)
    with pytest.raises(OSError, match="No space left"):
        Network(*parts(action_repeat="2")).save(path)
    assert path.read_bytes() == before
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]


SPOILED: dict[str, tuple[Spoil, str]] = {
    "no format": (lambda arrays, facts: facts.pop("format"), "'format'.*rsoccer-policy-1.*None"),
    "other format": (lambda arrays, facts: facts.update(format="x"), "'format'.*'x'"),
    "other activation": (lambda arrays, facts: facts.update(activation="relu"), "'relu'"),
    "no task": (lambda arrays, facts: facts.pop("task"), "'task'"),
    "clip of 0": (lambda arrays, facts: facts.update(clip="0"), "'clip'.*'0'"),
    "clip no number": (lambda arrays, facts: facts.update(clip="ten"), "'clip'.*'ten'"),
    "half a repeat": (lambda arrays, facts: facts.update(action_repeat="1.5"), "'action_repeat'"),
    "wrong size": (lambda arrays, facts: facts.update(observation_size="6"), "'5'.*'6'"),
    "no layers": (
        lambda arrays, facts: [arrays.pop(name) for name in list(arrays) if "layers" in name],
        "layers.0.weight",
    ),
    "missing bias": (lambda arrays, facts: arrays.pop("layers.1.bias"), "layers.1.bias"),
    "missing mean": (lambda arrays, facts: arrays.pop("mean"), "mean"),
    "unknown array": (lambda arrays, facts: arrays.update(extra=arrays["mean"]), "extra"),
    "gap in layers": (
        lambda arrays, facts: arrays.update(
            {"layers.7.weight": arrays["mean"], "layers.7.bias": arrays["mean"]}
        ),
        "layers.7",
    ),
    "layers that do not meet": (
        lambda arrays, facts: arrays.update(
            {"layers.1.weight": np.zeros((HIDDEN, 3), np.float32)},
        ),
        "layers.1.weight takes 3",
    ),
    "bias of another size": (
        lambda arrays, facts: arrays.update({"layers.0.bias": np.zeros(3, np.float32)}),
        "layers.0.bias",
    ),
    "double precision": (
        lambda arrays, facts: arrays.update(mean=np.zeros(OBSERVATION)),
        "'mean' should be float32",
    ),
    "std of 0": (lambda arrays, facts: arrays["std"].fill(0.0), "'std'.*above 0"),
    "NaN": (lambda arrays, facts: arrays["layers.1.weight"].fill(np.nan), "layers.1.weight.*NaN"),
}


@pytest.mark.parametrize(("spoil", "message"), SPOILED.values(), ids=SPOILED)
def test_wrong_parts_are_refused(spoil: Spoil, message: str, tmp_path: Path) -> None:
    arrays, metadata = parts()
    spoil(arrays, metadata)
    with pytest.raises(ValueError, match=message):
        Network(arrays, metadata)
    path = tmp_path / "spoiled.safetensors"
    save_file(arrays, path, metadata=metadata)
    with pytest.raises(ValueError, match=rf"spoiled\.safetensors.*{message}"):
        Network.load(path)


def test_no_truncated_file_is_read(tmp_path: Path) -> None:
    path = tmp_path / "policy.safetensors"
    Network(*parts()).save(path)
    whole = path.read_bytes()
    for length in [0, 1, 7, 8, 9, 200, len(whole) // 2, len(whole) - 1]:
        path.write_bytes(whole[:length])
        with pytest.raises(ValueError, match=r"policy\.safetensors is not a usable policy file"):
            Network.load(path)


@pytest.mark.parametrize("content", [b"PK\x03\x04 a zip", b"\xff" * 64, b"\x80\x04K\x01."])
def test_foreign_files_are_refused(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "policy.safetensors"
    path.write_bytes(content)
    with pytest.raises(ValueError, match=r"policy\.safetensors.*not safetensors"):
        Network.load(path)


def test_a_file_of_unknown_number_types_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "half.safetensors"
    arrays, metadata = parts()
    save_file({**arrays, "mean": arrays["mean"].astype(np.float16)}, path, metadata=metadata)
    with pytest.raises(ValueError, match="'mean' should be float32"):
        Network.load(path)


def test_missing_files_and_folders_are_named(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="nowhere"):
        Network.load(tmp_path / "nowhere.safetensors")
    with pytest.raises(ValueError, match="folder"):
        Network.load(tmp_path)


def test_a_network_without_observations_says_so() -> None:
    network = Network(*parts())
    rng = WorldRng.seeded(0, 4)
    with pytest.raises(ValueError, match="needs observations"):
        network.act(Seen((4, 3, ACTION), None, None), rng, {})
    with pytest.raises(ValueError, match="of 5 numbers, got 6"):
        network.decide(np.zeros((4, 3, 6), np.float32))
