"""Networks sample actions as in training, with each world's own random stream."""

from pathlib import Path

import numpy as np
import pytest

import rsoccer
from rsoccer.policies import make_policy
from rsoccer.policies.network import Network
from rsoccer.rng import WorldRng
from tests.policies.networks import (
    ACTION,
    network_for,
    network_input,
    network_parts,
    random_observations,
)


def sampling_network(mode: str | None = None, **extra: str) -> Network:
    """A network whose two actions have standard deviations of 0.3 and 0.1."""
    arrays, metadata = network_parts(**extra)
    arrays["layers.2.weight"] *= np.float32(0.1)  # few means beyond the bounds
    arrays["layers.2.bias"][:] = 0.0
    return Network({**arrays, "action_std": np.array([0.3, 0.1], np.float32)}, metadata, mode)


def test_a_network_samples_by_default_as_in_training() -> None:
    observations = random_observations(n=3000, robots=2)
    network, mean = sampling_network(), sampling_network("mean")
    expected = mean.act(network_input(observations), WorldRng.seeded(0, 3000), {})
    np.testing.assert_array_equal(expected, network.mean_actions(observations))
    offset = network.act(network_input(observations), WorldRng.seeded(0, 3000), {}) - expected
    inside = (np.abs(expected) < 0.4).all(axis=-1)
    assert inside.sum() > 100
    assert offset[inside].mean(axis=0) == pytest.approx([0.0, 0.0], abs=0.02)
    assert offset[inside].std(axis=0) == pytest.approx([0.3, 0.1], rel=0.05)
    assert network.mode == "sample"
    assert Network(*network_parts()).mode == "mean", "without action_std there is nothing to sample"


def test_actions_are_sampled_around_unclipped_means() -> None:
    arrays, metadata = network_parts()
    arrays["layers.2.weight"][:], arrays["layers.2.bias"][:] = 0.0, [3.0, 1.1]
    network = Network({**arrays, "action_std": np.full(ACTION, 0.2, np.float32)}, metadata)
    observations = network_input(random_observations(n=500))
    actions = network.act(observations, WorldRng.seeded(0, 500), {})
    assert (actions[..., 0] == 1.0).all(), "the mean was clipped before the draw"
    assert (actions[..., 1] < 1.0).mean() == pytest.approx(0.31, abs=0.05)  # P(z < -0.5)


@pytest.mark.parametrize("repeat", ["1", "3"])
def test_samples_depend_on_the_world_alone(repeat: str) -> None:
    arrays, metadata = network_parts(action_repeat=repeat)
    for name in ("layers.2.weight", "layers.2.bias"):
        arrays[name][:] = 0.0  # worlds differ in their random draws only
    network = Network({**arrays, "action_std": np.full(ACTION, 0.3, np.float32)}, metadata)
    rng = WorldRng.seeded(0, 40)
    memory = network.new_memory((40, 3, ACTION), rng)
    if memory:
        memory["age"][:7] = 1  # these worlds decide in other steps
    batch_input, single_input = (network_input(random_observations(n)) for n in (40, 1))
    batch = np.array([network.act(batch_input, rng, memory)[9] for _ in range(7)])
    single_rng = WorldRng.seeded(9, 1)
    memory = network.new_memory((1, 3, ACTION), single_rng)
    single = [network.act(single_input, single_rng, memory)[0] for _ in range(7)]
    assert batch.tobytes() == np.array(single).tobytes()
    changes = (np.diff(batch, axis=0) != 0.0).any(axis=(1, 2)).tolist()
    assert changes == [repeat == "1" or step % 3 == 2 for step in range(6)], "one draw a decision"


def test_the_mode_may_follow_the_path(tmp_path: Path) -> None:
    task = rsoccer.make_task("VSS-v0")
    path = tmp_path / "C:odd" / "policy.safetensors"
    path.parent.mkdir()
    network_for(task).save(path)
    for suffix, mode in {"": "sample", ":sample": "sample", ":mean": "mean"}.items():
        for name in (f"{path}{suffix}", Path(f"{path}{suffix}")):
            policy = make_policy(name, task)
            assert isinstance(policy, Network)
            assert policy.mode == mode
    assert Network.load(path, mode="mean").mode == "mean"
    with pytest.raises(ValueError, match=r"mode: expected one of .*'sample'.*'mean'.*got 'greedy'"):
        make_policy(f"{path}:greedy", task)
    with pytest.raises(FileNotFoundError):
        make_policy(f"{tmp_path}/gone.safetensors:mean", task)
    for unknown in ("nobody:mean", "C:nobody"):
        with pytest.raises(ValueError, match=f"unknown policy '{unknown}'"):
            make_policy(unknown, task)


def test_a_file_whose_name_ends_like_a_mode_is_found(tmp_path: Path) -> None:
    task = rsoccer.make_task("VSS-v0")
    network_for(task).save(tmp_path / "policy:mean")
    policy = make_policy(tmp_path / "policy:mean", task)
    assert isinstance(policy, Network)
    assert policy.mode == "sample"


def test_without_action_std_a_network_cannot_sample(tmp_path: Path) -> None:
    Network(*network_parts()).save(tmp_path / "policy.safetensors")
    assert Network.load(tmp_path / "policy.safetensors").mode == "mean"
    with pytest.raises(ValueError, match=r"mode: expected 'mean'.*no action_std.*got 'sample'"):
        Network.load(tmp_path / "policy.safetensors", mode="sample")
    with pytest.raises(ValueError, match=r"mode: expected one of .*got 'greedy'"):
        Network(*network_parts(), mode="greedy")


def test_matches_play_files_as_in_training(tmp_path: Path) -> None:
    task = rsoccer.make_task("VSSSelfPlay-v0", max_steps=1000)
    network_for(task).save(tmp_path / "policy.safetensors")
    rows = []
    for suffix in ("", ":sample", ":mean"):
        controllers = {"all": f"{tmp_path}/policy.safetensors{suffix}"}
        matches = rsoccer.Matches(task, 3, 5, controllers=controllers)
        matches.reset()
        for _ in range(10):
            matches.step(np.zeros((3, 0, 2), np.float32))
        rows.append(matches.frame.rows.tobytes())
    assert rows[0] == rows[1] != rows[2]
