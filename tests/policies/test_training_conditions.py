"""Senses and varied numbers of a training in the metadata of a policy file."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer import Sensing
from rsoccer.policies import trained, training_conditions
from rsoccer.policies.network import Network
from tests.helpers import same
from tests.policies.networks import (
    network_for,
    network_input,
    network_parts,
    random_observations,
)
from tests.simulators import BLIND

RANGES: dict[str, Any] = {"robot.mass": (0.9, 1.1), "ball.hop": 0.5}


def network(**conditions: Any) -> Network:  # noqa: ANN401
    task = rsoccer.make_task("VSS-v0")
    layers = [(np.zeros((task.action_size, task.layout.size)), np.zeros(task.action_size))]
    return Network.from_layers(task, layers, **conditions)


def test_a_policy_file_keeps_the_conditions_of_its_training(tmp_path: Path) -> None:
    path = tmp_path / "policy.safetensors"
    network(sensing=Sensing("vsss", delay=0.1), randomization=RANGES).save(path)
    loaded = Network.load(path)
    assert loaded.sensing == Sensing("vsss", delay=0.1)
    assert loaded.randomization == {"robot.mass": [0.9, 1.1], "ball.hop": 0.5}
    assert trained.describe_training(path) == (
        "sensing vsss, delay=0.1, ball.hop 0.5, robot.mass 0.9 to 1.1"
    )


def test_without_conditions_there_are_no_keys(tmp_path: Path) -> None:
    path = tmp_path / "policy.safetensors"
    network(randomization={}).save(path)
    loaded = Network.load(path)
    assert not {"sensing", "randomization"} & set(loaded.metadata)
    assert (loaded.sensing, loaded.randomization) == (None, {})
    assert trained.describe_training(path) == ""


def test_presets_are_kept_by_their_numbers_and_models_by_their_text() -> None:
    assert network(sensing="rc2021").sensing == Sensing("rc2021")
    assert network(sensing="tests.simulators:Blind").sensing == "tests.simulators:Blind"
    assert network(sensing=BLIND).sensing is None


def test_conditions_do_not_change_how_a_policy_plays() -> None:
    written = training_conditions.written("vsss", RANGES)
    noted, plain = Network(*network_parts(**written)), Network(*network_parts())
    inputs = network_input(random_observations())
    assert inputs.observations is not None
    assert same(noted.mean_actions(inputs.observations), plain.mean_actions(inputs.observations))


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("sensing", "vsss"),
        ("sensing", "{}"),
        ("randomization", "{"),
        ("randomization", "[1]"),
        ("randomization", '{"robot.mass": "heavy"}'),
        ("randomization", '{"robot.mass": [2, 1]}'),
    ],
)
def test_wrong_conditions_are_refused_by_name(name: str, text: str, tmp_path: Path) -> None:
    path, policy = tmp_path / "policy.safetensors", network_for(rsoccer.make_task("VSS-v0"))
    policy.metadata[name] = text
    policy.save(path)
    with pytest.raises(ValueError, match=f"metadata '{name}'"):
        Network.load(path)


def test_distributions_that_are_none_are_not_written() -> None:
    with pytest.raises(ValueError, match=r"robot\.mass"):
        training_conditions.written(None, {"robot.mass": (2.0, 1.0)})
    with pytest.raises(ValueError, match="sensing must be one of"):
        training_conditions.written("none of them", None)
