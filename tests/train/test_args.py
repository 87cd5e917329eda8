"""Settings of a run: invalid values raise errors that name the field."""

import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rsoccer.train.args import Args

INVALID: list[tuple[str, Any]] = [
    ("samples", 0),
    ("device", "gpu"),
    ("learning_rate_schedule", "cosine"),
    ("worlds", 0),
    ("threads", 0),
    ("horizon", 0),
    ("action_repeat", 0),
    ("n_epochs", 0),
    ("n_minibatches", 0),
    ("seed", -1),
    ("learning_rate", 0.0),
    ("learning_rate", float("nan")),
    ("action_std", -0.5),
    ("max_grad_norm", float("inf")),
    ("checkpoint_interval", 0.0),
    ("gamma", 1.5),
    ("gae_lambda", -0.1),
    ("entropy_coef", -1.0),
    ("value_coef", float("nan")),
    ("hidden_sizes", ()),
    ("hidden_sizes", (64, 0)),
    ("latest_fraction", 0.9),
    ("opponents", {"ou": -1.0}),
    ("opponents", {"ou": 0.0}),
    ("teammates", {"ou": float("nan")}),
    ("pool_size", 0),
    ("final_action_std", 0.0),
    ("final_action_std", float("inf")),
    ("final_gamma", 1.01),
    ("final_gamma", float("nan")),
    ("initial_action", (0.0, 1.5)),
    ("task_options", {"robot": object()}),
    ("task_options", {"ball_speed": float("nan")}),
    ("task_options", ["n_blue"]),
    ("pfsp_power", -1.0),
    ("worlds", "64"),
    ("worlds", 64.5),
    ("worlds", True),
    ("seed", 1.5),
    ("n_epochs", 2.5),
    ("gamma", None),
    ("gamma", "0.9"),
    ("final_gamma", "0.9"),
    ("resume", "no"),
    ("progress", 1),
    ("task", 3),
    ("out", 3),
    ("device", None),
    ("opponents", "ou"),
    ("opponents", ["ou"]),
    ("opponents", None),
    ("opponents", {"ou": "1"}),
    ("opponents", {3: 1.0}),
    ("hidden_sizes", 64),
    ("hidden_sizes", (64.5,)),
    ("masked_observations", "ball"),
    ("initial_action", (None,)),
    ("hidden_sizes", np.array(64)),
    ("value_coef", 10**400),
]


@pytest.mark.parametrize(("name", "value"), INVALID)
def test_an_invalid_value_is_refused_by_name(name: str, value: Any) -> None:  # noqa: ANN401
    with pytest.raises(ValueError, match=name):
        Args(**{name: value})


def test_numbers_and_arrays_of_numpy_are_converted() -> None:
    values: dict[str, Any] = {
        "worlds": np.int64(8),
        "gamma": np.float64(0.5),
        "progress": np.bool_(False),
        "hidden_sizes": np.array([8, 16]),
        "initial_action": [0, np.float32(0.5)],
        "opponents": {"ou": np.float64(2.0)},
        "out": "out/some",
    }
    args = Args(**values)
    assert (args.worlds, args.gamma, args.progress) == (8, 0.5, False)
    assert (args.hidden_sizes, args.initial_action) == ((8, 16), (0, 0.5))
    assert args.out == Path("out/some")
    assert Args(**json.loads(json.dumps(args.to_json()))) == args


def test_the_error_says_what_was_expected() -> None:
    for changes, message in (
        ({"worlds": "64"}, "worlds must be an integer, got '64'"),
        ({"final_gamma": "1"}, "final_gamma must be a number or None, got '1'"),
        ({"hidden_sizes": 64}, "hidden_sizes must be a sequence, each an integer, got 64"),
        ({"opponents": "ou"}, "opponents must be a mapping from names, each a number, got 'ou'"),
    ):
        with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
            Args(**changes)


def test_resume_and_overwrite_exclude_each_other() -> None:
    with pytest.raises(ValueError, match="resume and overwrite"):
        Args(resume=True, overwrite=True)


def test_an_adaptive_learning_rate_needs_updates_that_can_be_cut_short() -> None:
    with pytest.raises(ValueError, match="n_epochs must be at least 2"):
        Args(learning_rate_schedule="adaptive", n_epochs=1)
    assert Args(learning_rate_schedule="adaptive", n_epochs=2).n_epochs == 2


def test_settings_make_a_round_trip_through_json() -> None:
    args = Args(
        out=Path("somewhere"),
        hidden_sizes=(32, 16),
        task_options={"n_blue": 2, "reward_weights": {"goal": 5.0}},
        final_action_std=0.2,
        opponents={"ou": 2, "chase": 1},
        masked_observations=("shot",),
    )
    saved = json.loads(json.dumps(args.to_json()))
    assert args.differences(saved) == []
    assert Args(**saved) == args


def test_differences_are_the_fields_that_change_the_run() -> None:
    saved = Args(seed=1).to_json()
    assert Args(seed=1, samples=5, resume=True, out=Path("x")).differences(saved) == []
    assert Args(seed=2, worlds=8).differences(saved) == [
        "seed was 1, now 2",
        f"worlds was {Args().worlds}, now 8",
    ]


def test_a_saved_run_may_lack_settings_that_are_newer() -> None:
    saved = Args(seed=1).to_json()
    del saved["final_action_std"], saved["task_options"]
    assert Args(seed=1).differences(saved) == []
    assert Args(seed=1, final_action_std=0.2).differences(saved) == [
        "final_action_std was 0.1, now 0.2"
    ]


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
    saved = Args(opponents={"ou": 2.0, "chase": 1.0}).to_json()
    assert Args(opponents={"chase": 1.0, "ou": 2.0}).differences(saved) == []


def test_reading_the_settings_needs_no_torch() -> None:
    code = "import sys, rsoccer.train.args; sys.exit('torch' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
