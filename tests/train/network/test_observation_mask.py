"""Masked observations: the networks do not read them, in training or in the policy file."""

from pathlib import Path

import numpy as np
import pytest

from rsoccer import make_task
from rsoccer.policies.network import Network
from rsoccer.train import train
from rsoccer.train.network.actor_critic import ActorCritic
from rsoccer.train.network.observation_mask import observation_mask
from rsoccer.train.run.trainer import Trainer
from tests.train.short_task import tiny


def test_a_mask_covers_the_named_blocks_and_numbers() -> None:
    task = make_task("VSS-v0")
    assert observation_mask(task, []).all()
    mask = observation_mask(task, ["shot", "opponents:2,3"])
    hidden = np.flatnonzero(mask == 0).tolist()
    shot, opponents = task.layout.blocks["shot"].columns, task.layout.blocks["opponents"].columns
    headings = [opponents.start + 7 * robot + k for robot in range(3) for k in (2, 3)]
    assert hidden == sorted([*range(shot.start, shot.stop), *headings])


@pytest.mark.parametrize(
    ("part", "message"),
    [
        ("sight", r"blocks of \['ball'.*got 'sight'"),
        ("opponents:7", r"indices from 0 to 6 in 'opponents:7'"),
        ("opponents:x", r"indices from 0 to 6 in 'opponents:x'"),
    ],
)
def test_an_unknown_part_is_refused_before_a_folder_is_made(
    part: str, message: str, tmp_path: Path
) -> None:
    with pytest.raises(ValueError, match=f"masked_observations: expected {message}"):
        train(tiny(tmp_path / "run", masked_observations=(part,)))
    assert not (tmp_path / "run").exists()


def test_networks_do_not_depend_on_masked_numbers(tmp_path: Path) -> None:
    parts = ("ball_polar", "opponents:2,3")
    path = train(tiny(tmp_path, masked_observations=parts))
    policy, untrained = (Network.load(file) for file in (path, tmp_path / "untrained.safetensors"))
    mask = observation_mask(make_task("VSSSelfPlay-v0"), parts)
    for network in (policy, untrained):
        assert not network.layers[0][0][:, mask == 0].any()
    read = untrained.layers[0][0][:, mask == 1]
    assert read.any(axis=0).all(), "some numbers were masked in addition"
    observations = np.random.default_rng(0).normal(size=(9, 1, len(mask))).astype(np.float32)
    others = np.where(mask, observations, np.float32(3.0))
    assert np.array_equal(policy.mean_actions(observations), policy.mean_actions(others))


def test_the_value_network_reads_no_masked_numbers_either(tmp_path: Path) -> None:
    trainer = Trainer(tiny(tmp_path, masked_observations=("shot",)))
    batch = trainer.collect_rollout(lambda: None)
    columns = trainer.task.layout.blocks["shot"].columns
    assert not batch.observations[:, columns].any()
    assert batch.observations[:, : columns.start].any()
    trainer.update(batch, lambda: None)
    model: ActorCritic = trainer.model
    first = next(model.critic.parameters())
    assert not first[:, columns].any()
    assert first[:, : columns.start].any()
