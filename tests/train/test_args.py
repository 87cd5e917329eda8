"""Settings of a run: invalid values raise errors that name the field."""

import dataclasses
import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rsoccer.sources import NETWORK_SIMULATORS
from rsoccer.train import (
    Args,
    NetworkSettings,
    OpponentSettings,
    PpoSettings,
    RolloutSettings,
    RunSettings,
)
from rsoccer.train.args import PARTS

INVALID: list[tuple[str, Any]] = [
    ("samples", 0),
    ("device", "gpu"),
    ("ppo.learning_rate_schedule", "cosine"),
    ("rollout.worlds", 0),
    ("threads", 0),
    ("rollout.horizon", 0),
    ("rollout.action_repeat", 0),
    ("ppo.n_epochs", 0),
    ("ppo.n_minibatches", 0),
    ("seed", -1),
    ("ppo.learning_rate", 0.0),
    ("ppo.learning_rate", float("nan")),
    ("ppo.learning_rate", float("inf")),
    ("network.action_std", -0.5),
    ("network.robot_units", -1),
    ("run.checkpoint_interval", 0.0),
    ("run.ladder_interval", -1),
    ("run.ladder_matches", 0),
    ("rollout.random_truncation", 1.5),
    ("ppo.gamma", 1.5),
    ("ppo.gamma", float("nan")),
    ("ppo.gae_lambda", -0.1),
    ("network.hidden_sizes", ()),
    ("network.hidden_sizes", (64, 0)),
    ("opponents.latest_fraction", 0.9),
    ("opponents.solo_fraction", -0.1),
    ("opponents.fixed", {"ou": -1.0}),
    ("opponents.fixed", {"ou": 0.0}),
    ("opponents.fixed", {"ou": float("nan")}),
    ("network.final_action_std", 0.0),
    ("network.final_action_std", float("inf")),
    ("network.final_action_std", None),
    ("ppo.final_gamma", 1.01),
    ("ppo.final_gamma", float("nan")),
    ("network.initial_action", (0.0, 1.5)),
    ("task_options", {"robot": object()}),
    ("task_options", {"ball_speed": float("nan")}),
    ("task_options", ["n_blue"]),
    ("rollout.worlds", "64"),
    ("rollout.worlds", 64.5),
    ("rollout.worlds", True),
    ("seed", 1.5),
    ("ppo.n_epochs", 2.5),
    ("ppo.gamma", None),
    ("ppo.gamma", "0.9"),
    ("ppo.final_gamma", "0.9"),
    ("resume", "no"),
    ("run.progress", 1),
    ("task", 3),
    ("out", 3),
    ("device", None),
    ("opponents.fixed", "ou"),
    ("opponents.fixed", ["ou"]),
    ("opponents.fixed", None),
    ("opponents.fixed", {"ou": "1"}),
    ("opponents.fixed", {3: 1.0}),
    ("network.hidden_sizes", 64),
    ("network.hidden_sizes", (64.5,)),
    ("network.masked_observations", "ball"),
    ("network.initial_action", (None,)),
    ("network.hidden_sizes", np.array(64)),
    ("ppo.learning_rate", 10**400),
    ("ppo", {"gamma": 0.9}),
    ("rollout", PpoSettings()),
]


@pytest.mark.parametrize(("name", "value"), INVALID)
def test_an_invalid_value_is_refused_by_name(name: str, value: Any) -> None:  # noqa: ANN401
    with pytest.raises(ValueError, match=name):
        Args.from_json({name: value})


def test_numbers_and_arrays_of_numpy_are_converted() -> None:
    values: dict[str, Any] = {
        "rollout.worlds": np.int64(8),
        "ppo.gamma": np.float64(0.5),
        "run.progress": np.bool_(False),
        "network.hidden_sizes": np.array([8, 16]),
        "network.initial_action": [0, np.float32(0.5)],
        "opponents.fixed": {"ou": np.float64(2.0)},
        "out": "out/some",
    }
    args = Args.from_json(values)
    assert (args.rollout.worlds, args.ppo.gamma, args.run.progress) == (8, 0.5, False)
    assert (args.network.hidden_sizes, args.network.initial_action) == ((8, 16), (0, 0.5))
    assert args.out == Path("out/some")
    assert Args.from_json(json.loads(json.dumps(args.to_json()))) == args


def test_the_error_says_what_was_expected() -> None:
    for name, value, message in (
        ("rollout.worlds", "64", "rollout.worlds must be an integer at least 1, got '64'"),
        ("rollout.worlds", 0, "rollout.worlds must be an integer at least 1, got 0"),
        ("ppo.final_gamma", "1", "ppo.final_gamma must be a number between 0 and 1 or None"),
        ("network.hidden_sizes", 64, "network.hidden_sizes must be a sequence, each an integer"),
        ("opponents.fixed", "ou", "opponents.fixed must be a mapping from names, each a number"),
        ("device", "gpu", "device must be one of auto, cpu, cuda, got 'gpu'"),
        ("ppo", 3, "ppo must be an instance of PpoSettings, got 3"),
    ):
        with pytest.raises(ValueError, match=f"^{re.escape(message)}"):
            Args.from_json({name: value})


def test_unknown_settings_are_refused_by_name() -> None:
    with pytest.raises(TypeError, match="horizons"):
        Args.from_json({"horizons": 3})
    with pytest.raises(TypeError, match="gammas"):
        Args.from_json({"ppo.gammas": 3})
    with pytest.raises(TypeError, match=r"a part of \['rollout', .*got 'learning'"):
        Args.from_json({"learning.gamma": 0.9})


def test_parts_are_the_nested_settings() -> None:
    """Names are unique over all parts, so that a name alone says which setting is meant."""
    nested = [name for name, value in vars(Args()).items() if dataclasses.is_dataclass(value)]
    assert tuple(nested) == PARTS
    names = [name.rpartition(".")[2] for name in Args().to_json()]
    assert len(names) == len(set(names)) > 30


def test_resume_and_overwrite_exclude_each_other() -> None:
    with pytest.raises(ValueError, match="resume and overwrite"):
        Args(resume=True, overwrite=True)


@pytest.mark.parametrize("name", NETWORK_SIMULATORS)
def test_a_simulator_on_a_network_plays_one_match(name: str) -> None:
    with pytest.raises(ValueError, match=rf"worlds: expected 1 with the simulator {name}, .* 512"):
        Args(simulator=name, rollout=RolloutSettings(worlds=512))
    assert Args(simulator=name, rollout=RolloutSettings(worlds=1)).is_on_network
    assert not Args().is_on_network


def test_an_adaptive_learning_rate_needs_updates_that_can_be_cut_short() -> None:
    with pytest.raises(ValueError, match=r"ppo\.n_epochs must be at least 2"):
        PpoSettings(learning_rate_schedule="adaptive", n_epochs=1)
    assert PpoSettings(learning_rate_schedule="adaptive", n_epochs=2).n_epochs == 2


def test_settings_make_a_round_trip_through_json() -> None:
    args = Args(
        out=Path("somewhere"),
        task_options={"n_blue": 2, "reward_weights": {"goal": 5.0}},
        network=NetworkSettings((32, 16), final_action_std=0.2, masked_observations=("shot",)),
        opponents=OpponentSettings(fixed={"ou": 2, "chase": 1}),
    )
    saved = json.loads(json.dumps(args.to_json()))
    assert saved["network.hidden_sizes"] == [32, 16]
    assert args.differences(saved) == []
    assert Args.from_json(saved) == args


def test_differences_are_the_settings_that_change_the_run() -> None:
    saved = Args(seed=1).to_json()
    free = RunSettings(1.0, progress=False, ladder_interval=0)
    assert Args(seed=1, samples=5, resume=True, out=Path("x"), run=free).differences(saved) == []
    assert Args(seed=2, rollout=RolloutSettings(worlds=8)).differences(saved) == [
        "seed was 1, now 2",
        f"rollout.worlds was {RolloutSettings.worlds}, now 8",
    ]


def test_a_saved_run_may_lack_settings_that_are_newer() -> None:
    saved = Args(seed=1).to_json()
    del saved["network.final_action_std"], saved["task_options"]
    assert Args(seed=1).differences(saved) == []
    changed = Args(seed=1, network=NetworkSettings(final_action_std=0.2))
    assert changed.differences(saved) == ["network.final_action_std was 0.1, now 0.2"]


def test_task_folder_and_samples_are_given_by_position() -> None:
    assert Args("VSS-v0", Path("x"), 500) == Args(task="VSS-v0", out=Path("x"), samples=500)


def test_the_task_is_created_with_its_options() -> None:
    task = Args("VSS-v0", task_options={"n_blue": 2, "opponent": "chase"}).make_task()
    assert task.n_blue == 2
    assert task.default_controllers()["yellow_0"] == "chase"


def test_a_wrong_task_option_is_refused_with_the_valid_ones() -> None:
    with pytest.raises(ValueError, match=r"task_options: VSS-v0: .*'weights'.*'reward_weights'"):
        Args("VSS-v0", task_options={"weights": "paper"}).make_task()


def test_the_order_of_opponents_does_not_matter() -> None:
    saved = Args(opponents=OpponentSettings(fixed={"ou": 2.0, "chase": 1.0})).to_json()
    other = OpponentSettings(fixed={"chase": 1.0, "ou": 2.0})
    assert Args(opponents=other).differences(saved) == []


def test_reading_the_settings_needs_no_torch() -> None:
    code = "import sys, rsoccer.train.args; sys.exit('torch' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
