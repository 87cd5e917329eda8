"""Networks draw what they do as they did while they learned, each world by its own stream."""

from pathlib import Path

import numpy as np
import pytest

import rsoccer
from rsoccer.policies import make
from rsoccer.policies.network import Network
from rsoccer.policies.policy_file import FORMAT
from rsoccer.rng import WorldRng
from tests.policies.test_network import ACTION, observations, parts, seen


def fitting(task: rsoccer.Task) -> Network:
    """A network that fits a task, of a spread of 0.4."""
    arrays = {
        "layers.0.weight": np.zeros((task.action_size, task.observation_size), np.float32),
        "layers.0.bias": np.zeros(task.action_size, np.float32),
        "mean": np.zeros(task.observation_size, np.float32),
        "std": np.ones(task.observation_size, np.float32),
        "action_std": np.full(task.action_size, 0.4, np.float32),
    }
    sizes = {"observation_size": task.observation_size, "action_size": task.action_size}
    metadata = {"format": FORMAT, "task": task.name, "activation": "tanh"}
    return Network(arrays, metadata | {name: str(size) for name, size in sizes.items()})


def with_spread(play: str | None = None, **extra: str) -> Network:
    """A network whose two actions were learned with spreads of 0.3 and 0.1."""
    arrays, metadata = parts(**extra)
    arrays["layers.2.weight"] *= np.float32(0.1)  # few means beyond the bounds
    arrays["layers.2.bias"][:] = 0.0
    return Network({**arrays, "action_std": np.array([0.3, 0.1], np.float32)}, metadata, play)


def test_a_network_plays_as_it_was_trained_unless_told_otherwise() -> None:
    given = observations(n=3000, robots=2)
    network, mean = with_spread(), with_spread("mean")
    expected = mean.act(seen(given), WorldRng.seeded(0, 3000), {})
    np.testing.assert_array_equal(expected, network.decide(given))
    offset = network.act(seen(given), WorldRng.seeded(0, 3000), {}) - expected
    inside = (np.abs(expected) < 0.4).all(axis=-1)
    assert inside.sum() > 100
    assert offset[inside].mean(axis=0) == pytest.approx([0.0, 0.0], abs=0.02)
    assert offset[inside].std(axis=0) == pytest.approx([0.3, 0.1], rel=0.05)
    assert network.play == "sample"
    assert Network(*parts()).play == "mean", "without a spread there is nothing to draw with"


def test_means_beyond_the_bounds_are_drawn_around_before_they_are_clipped() -> None:
    arrays, metadata = parts()
    arrays["layers.2.weight"][:], arrays["layers.2.bias"][:] = 0.0, [3.0, 1.1]
    network = Network({**arrays, "action_std": np.full(ACTION, 0.2, np.float32)}, metadata)
    actions = network.act(seen(observations(n=500)), WorldRng.seeded(0, 500), {})
    assert (actions[..., 0] == 1.0).all(), "the mean was clipped before the draw"
    assert (actions[..., 1] < 1.0).mean() == pytest.approx(0.31, abs=0.05)  # P(z < -0.5)


@pytest.mark.parametrize("repeat", ["1", "3"])
def test_what_a_network_draws_depends_on_its_world_alone(repeat: str) -> None:
    arrays, metadata = parts(action_repeat=repeat)
    for name in ("layers.2.weight", "layers.2.bias"):
        arrays[name][:] = 0.0  # so that nothing but chance tells worlds apart
    network = Network({**arrays, "action_std": np.full(ACTION, 0.3, np.float32)}, metadata)
    rng = WorldRng.seeded(0, 40)
    memory = network.new_memory((40, 3, ACTION), rng)
    if memory:
        memory["age"][:7] = 1  # these worlds decide in other steps
    many = np.array([network.act(seen(observations(40)), rng, memory)[9] for _ in range(7)])
    alone = WorldRng.seeded(9, 1)
    memory = network.new_memory((1, 3, ACTION), alone)
    single = [network.act(seen(observations(1)), alone, memory)[0] for _ in range(7)]
    assert many.tobytes() == np.array(single).tobytes()
    changes = (np.diff(many, axis=0) != 0.0).any(axis=(1, 2)).tolist()
    assert changes == [repeat == "1" or step % 3 == 2 for step in range(6)], "one draw a decision"


def test_how_a_file_plays_can_be_chosen(tmp_path: Path) -> None:
    task = rsoccer.make_task("VSS-v0")
    path = tmp_path / "C:odd" / "policy.safetensors"
    path.parent.mkdir()
    fitting(task).save(path)
    for given, play in {"": "sample", ":sample": "sample", ":mean": "mean"}.items():
        for name in (f"{path}{given}", Path(f"{path}{given}")):
            policy = make(name, task)
            assert isinstance(policy, Network)
            assert policy.play == play
    assert Network.load(path, play="mean").play == "mean"
    with pytest.raises(ValueError, match=r"play: expected one of .*'sample'.*'mean'.*got 'greedy'"):
        make(f"{path}:greedy", task)
    with pytest.raises(FileNotFoundError):
        make(f"{tmp_path}/gone.safetensors:mean", task)
    for unknown in ("nobody:mean", "C:nobody"):
        with pytest.raises(ValueError, match=f"unknown policy '{unknown}'"):
            make(unknown, task)


def test_a_file_whose_name_ends_like_a_choice_is_found(tmp_path: Path) -> None:
    task = rsoccer.make_task("VSS-v0")
    fitting(task).save(tmp_path / "policy:mean")
    policy = make(tmp_path / "policy:mean", task)
    assert isinstance(policy, Network)
    assert policy.play == "sample"


def test_without_a_spread_there_is_nothing_to_sample_with(tmp_path: Path) -> None:
    Network(*parts()).save(tmp_path / "policy.safetensors")
    assert Network.load(tmp_path / "policy.safetensors").play == "mean"
    with pytest.raises(ValueError, match=r"play: expected 'mean'.*no spread.*got 'sample'"):
        Network.load(tmp_path / "policy.safetensors", play="sample")
    with pytest.raises(ValueError, match=r"play: expected one of .*got 'greedy'"):
        Network(*parts(), play="greedy")


def test_matches_play_files_as_they_were_trained(tmp_path: Path) -> None:
    task = rsoccer.make_task("VSSSelfPlay-v0", max_steps=1000)
    fitting(task).save(tmp_path / "policy.safetensors")
    ways = []
    for suffix in ("", ":sample", ":mean"):
        teams = {"all": f"{tmp_path}/policy.safetensors{suffix}"}
        matches = rsoccer.Matches(task, 3, 5, controllers=teams)
        matches.reset()
        for _ in range(10):
            matches.step(np.zeros((3, 0, 2), np.float32))
        ways.append(matches.frame.rows.tobytes())
    assert ways[0] == ways[1] != ways[2]
