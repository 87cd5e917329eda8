"""Policy files: complete, byte-equal for equal policies, and refused where they are invalid."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from safetensors import safe_open
from safetensors.numpy import save_file

from rsoccer.policies.network import Network
from tests.policies.networks import (
    ACTION,
    HIDDEN,
    OBSERVATION,
    VALUE_NUMBERS,
    Arrays,
    Metadata,
    network_parts,
    random_observations,
    with_value,
)

Corruption = Callable[[Arrays, Metadata], object]


def test_saving_and_loading_keeps_everything(tmp_path: Path) -> None:
    arrays, metadata = with_value(*network_parts(action_repeat="3"))
    arrays["action_std"] = np.full(ACTION, 0.5, np.float32)
    network = Network(arrays, metadata)
    network.save(tmp_path / "policy.safetensors")
    loaded = Network.load(tmp_path / "policy.safetensors")
    assert loaded.metadata == network.metadata
    assert loaded.action_repeat == 3
    assert loaded.task_name == "VSSSelfPlay-v0"
    assert loaded.value is not None
    assert loaded.value.text == metadata["value"]
    assert {name: array.tobytes() for name, array in loaded.arrays().items()} == {
        name: array.tobytes() for name, array in network.arrays().items()
    }
    assert [path.name for path in tmp_path.iterdir()] == ["policy.safetensors"]


def test_equal_policies_give_equal_bytes(tmp_path: Path) -> None:
    path = tmp_path / "policy.safetensors"
    contents = set()
    for order in range(10):
        arrays, metadata = network_parts()
        metadata = dict(np.random.default_rng(order).permutation(list(metadata.items())).tolist())
        Network(arrays, metadata).save(path)
        contents.add(path.read_bytes())
    assert len(contents) == 1
    with safe_open(path, framework="numpy") as file:
        assert file.metadata() == metadata
        assert sorted(file.keys()) == sorted(arrays)
        for name in file.keys():  # noqa: SIM118
            np.testing.assert_array_equal(file.get_tensor(name), arrays[name])
    (header_size,) = {int.from_bytes(content[:8], "little") for content in contents}
    assert header_size % 8 == 0, "the data are not aligned"


def test_weights_are_rounded_once_in_half_precision(tmp_path: Path) -> None:
    network = Network(*network_parts())
    paths = [tmp_path / name for name in ("single", "half", "again")]
    network.save(paths[0])
    network.save(paths[1], half_precision=True)
    loaded = Network.load(paths[1])
    for name, array in network.arrays().items():
        expected = array.astype(np.float16).astype(np.float32) if "weight" in name else array
        np.testing.assert_array_equal(loaded.arrays()[name], expected)
    loaded.save(paths[2], half_precision=True)
    assert paths[1].read_bytes() == paths[2].read_bytes(), "rounded once"
    assert paths[1].stat().st_size < paths[0].stat().st_size


def test_weights_beyond_half_precision_are_refused(tmp_path: Path) -> None:
    arrays, metadata = network_parts()
    arrays["layers.0.weight"][0, 0] = -1e5
    with pytest.raises(ValueError, match=r"layers\.0\.weight: expected at most 65504, got 100000"):
        Network(arrays, metadata).save(tmp_path / "policy", half_precision=True)
    assert not list(tmp_path.iterdir())


def test_a_failed_save_leaves_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "policy.safetensors"
    network = Network(*network_parts())
    network.save(path)
    before = path.read_bytes()

    def full_disk(descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", full_disk)
    with pytest.raises(OSError, match="No space left"):
        Network(*network_parts(action_repeat="2")).save(path)
    assert path.read_bytes() == before
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]


CORRUPTIONS: dict[str, tuple[Corruption, str]] = {
    "no format": (
        lambda arrays, metadata: metadata.pop("format"),
        "'format'.*rsoccer-policy-2.*None",
    ),
    "format of an older version": (
        lambda arrays, metadata: metadata.update(format="rsoccer-policy-1"),
        "'format' should be 'rsoccer-policy-2', got 'rsoccer-policy-1'",
    ),
    "action_std of 0": (
        lambda arrays, metadata: arrays.update(action_std=np.zeros(ACTION, np.float32)),
        "'action_std'.*above 0",
    ),
    "action_std of another size": (
        lambda arrays, metadata: arrays.update(action_std=np.ones(3, np.float32)),
        "'action_std' should be float32",
    ),
    "other format": (lambda arrays, metadata: metadata.update(format="x"), "'format'.*'x'"),
    "other activation": (lambda arrays, metadata: metadata.update(activation="gelu"), "'gelu'"),
    "head in the plain format": (
        lambda arrays, metadata: metadata.update(head="squashed"),
        "'format' should be 'rsoccer-policy-3'",
    ),
    "other head": (
        lambda arrays, metadata: metadata.update(format="rsoccer-policy-3", head="beta"),
        "head: expected one of .* got 'beta'",
    ),
    "other deviation": (
        lambda arrays, metadata: metadata.update(format="rsoccer-policy-3", deviation="exp 2 1"),
        "deviation: expected a low number below",
    ),
    "table of no choices": (
        lambda arrays, metadata: arrays.update(action_table=np.ones((2, 2), np.float32)),
        "action_table: expected no array",
    ),
    "table out of range": (
        lambda arrays, metadata: arrays.update(action_table=np.full((2, 2), 2, np.float32)),
        "'action_table' should be within",
    ),
    "no task": (lambda arrays, metadata: metadata.pop("task"), "'task'"),
    "clip of 0": (lambda arrays, metadata: metadata.update(clip="0"), "'clip'.*'0'"),
    "clip that is no number": (
        lambda arrays, metadata: metadata.update(clip="ten"),
        "'clip'.*'ten'",
    ),
    "a fractional repeat": (
        lambda arrays, metadata: metadata.update(action_repeat="1.5"),
        "'action_repeat'",
    ),
    "a repeat that would overflow": (
        lambda arrays, metadata: metadata.update(action_repeat="1e300"),
        "'action_repeat' should be at most 1000000, got '1e300'",
    ),
    "wrong size": (lambda arrays, metadata: metadata.update(observation_size="6"), "'5'.*'6'"),
    "no layers": (
        lambda arrays, metadata: [arrays.pop(name) for name in list(arrays) if "layers" in name],
        "layers.0.weight",
    ),
    "missing bias": (lambda arrays, metadata: arrays.pop("layers.1.bias"), "layers.1.bias"),
    "missing mean": (lambda arrays, metadata: arrays.pop("mean"), "mean"),
    "unknown array": (lambda arrays, metadata: arrays.update(extra=arrays["mean"]), "extra"),
    "gap in layers": (
        lambda arrays, metadata: arrays.update(
            {"layers.7.weight": arrays["mean"], "layers.7.bias": arrays["mean"]}
        ),
        "layers.7",
    ),
    "layers of sizes that do not match": (
        lambda arrays, metadata: arrays.update(
            {"layers.1.weight": np.zeros((HIDDEN, 3), np.float32)},
        ),
        "layers.1.weight takes 3",
    ),
    "bias of another size": (
        lambda arrays, metadata: arrays.update({"layers.0.bias": np.zeros(3, np.float32)}),
        "layers.0.bias",
    ),
    "double precision": (
        lambda arrays, metadata: arrays.update(mean=np.zeros(OBSERVATION)),
        "'mean' should be float32",
    ),
    "std of 0": (lambda arrays, metadata: arrays["std"].fill(0.0), "'std'.*above 0"),
    "NaN": (
        lambda arrays, metadata: arrays["layers.1.weight"].fill(np.nan),
        "layers.1.weight.*NaN",
    ),
}


VALUE_CORRUPTIONS: dict[str, tuple[Corruption, str]] = {
    "no numbers": (lambda arrays, metadata: metadata.pop("value"), "'value' should be a JSON"),
    "no layers": (
        lambda arrays, metadata: [arrays.pop(name) for name in list(arrays) if "value" in name],
        "'value' needs the arrays of a value network",
    ),
    "a discount above 1": (
        lambda arrays, metadata: metadata.update(value=VALUE_NUMBERS.replace("0.95", "1.01")),
        "value.discount: expected 0 to 1, got 1.01",
    ),
    "a fraction of a control step": (
        lambda arrays, metadata: metadata.update(value=VALUE_NUMBERS.replace("3", "2.5")),
        "value.action_repeat: expected",
    ),
    "a number that is missing": (
        lambda arrays, metadata: metadata.update(value='{"discount": 0.95}'),
        "'value' should be a JSON object",
    ),
    "no number": (
        lambda arrays, metadata: metadata.update(value=VALUE_NUMBERS.replace("2.0", "NaN")),
        "value.reward_std: expected",
    ),
    "another observation": (
        lambda arrays, metadata: arrays.update(
            {"value.0.weight": np.zeros((HIDDEN, 3), np.float32)}
        ),
        "value network should take 5 numbers and give 1, got 3 and 1",
    ),
    "a missing bias": (lambda arrays, metadata: arrays.pop("value.1.bias"), "value.1.bias"),
}


@pytest.mark.parametrize(("corrupt", "message"), VALUE_CORRUPTIONS.values(), ids=VALUE_CORRUPTIONS)
def test_invalid_value_networks_are_refused(corrupt: Corruption, message: str) -> None:
    arrays, metadata = with_value(*network_parts())
    assert Network(arrays, dict(metadata)).value is not None
    corrupt(arrays, metadata)
    with pytest.raises(ValueError, match=message):
        Network(arrays, metadata)


def test_values_are_those_of_the_layers() -> None:
    arrays, metadata = with_value(*network_parts())
    observations = random_observations()
    x = np.clip((observations - arrays["mean"]) / arrays["std"], -10.0, 10.0)
    x = np.tanh(x @ arrays["value.0.weight"].T + arrays["value.0.bias"])
    wanted = (x @ arrays["value.1.weight"].T + arrays["value.1.bias"])[..., 0]
    np.testing.assert_allclose(Network(arrays, metadata).values(observations), wanted, atol=1e-5)
    with pytest.raises(ValueError, match="expected a policy with a value network"):
        Network(*network_parts()).values(observations)


@pytest.mark.parametrize(("corrupt", "message"), CORRUPTIONS.values(), ids=CORRUPTIONS)
def test_invalid_content_is_refused(corrupt: Corruption, message: str, tmp_path: Path) -> None:
    arrays, metadata = network_parts()
    corrupt(arrays, metadata)
    with pytest.raises(ValueError, match=message):
        Network(arrays, metadata)
    path = tmp_path / "invalid.safetensors"
    save_file(arrays, path, metadata=metadata)
    with pytest.raises(ValueError, match=rf"invalid\.safetensors.*{message}"):
        Network.load(path)


def test_truncated_files_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "policy.safetensors"
    Network(*network_parts()).save(path)
    content = path.read_bytes()
    for length in [0, 1, 7, 8, 9, 200, len(content) // 2, len(content) - 1]:
        path.write_bytes(content[:length])
        with pytest.raises(ValueError, match=r"policy\.safetensors is not a usable policy file"):
            Network.load(path)


@pytest.mark.parametrize("content", [b"PK\x03\x04 a zip", b"\xff" * 64, b"\x80\x04K\x01."])
def test_files_of_other_formats_are_refused(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "policy.safetensors"
    path.write_bytes(content)
    with pytest.raises(ValueError, match=r"policy\.safetensors.*not safetensors"):
        Network.load(path)


def test_other_dtypes_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "double.safetensors"
    arrays, metadata = network_parts()
    save_file({**arrays, "mean": arrays["mean"].astype(np.float64)}, path, metadata=metadata)
    with pytest.raises(ValueError, match="'mean' should be float32"):
        Network.load(path)


def test_missing_files_and_folders_are_named(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="nowhere"):
        Network.load(tmp_path / "nowhere.safetensors")
    with pytest.raises(ValueError, match="folder"):
        Network.load(tmp_path)
