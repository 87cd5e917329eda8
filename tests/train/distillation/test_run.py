"""A distillation: its policy, its log, and what it refuses."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer.policies.network import Network
from rsoccer.train.distillation import DistillArgs, distill
from rsoccer.train.run.log import read_progress

TASK = "SSLGoToBall-v0"


def args(folder: Path, **changes: Any) -> DistillArgs:  # noqa: ANN401  (any field)
    settings: dict[str, Any] = {
        "samples": 500,
        "worlds": 8,
        "decisions": 8,
        "minibatches": 20,
        "minibatch": 64,
    }
    settings |= {"command_delays": (0.0, 0.1), "history": 2, "sensing": "rc2021"}
    return DistillArgs(TASK, folder, **{**settings, **changes})


def test_a_policy_is_written_that_says_how_it_was_made(tmp_path: Path) -> None:
    path = distill(args(tmp_path / "first", randomization={"robot.mass": (0.9, 1.1)}))
    network = Network.load(path)
    assert (network.task_name, network.history, network.action_repeat) == (TASK, 2, 3)
    assert network.sensing == rsoccer.Sensing("rc2021")
    assert network.randomization == {
        "robot.mass": [0.9, 1.1],
        "sensing.command_delay": [0.0, 0.1125],  # half a control step more
    }
    progress = read_progress(tmp_path / "first")
    assert progress["samples"][-1] >= 500
    assert progress["loss"][-1] < progress["loss"][0]
    found = rsoccer.evaluate(path, matches=2, sensing="rc2021")
    assert found.matches == 2


def test_equal_settings_give_equal_policies(tmp_path: Path) -> None:
    first, second, other = (
        Network.load(distill(args(tmp_path / name, seed=seed))).arrays()
        for name, seed in (("a", 1), ("b", 1), ("c", 2))
    )
    assert all(np.array_equal(first[name], second[name]) for name in first)
    assert not np.array_equal(first["layers.0.weight"], other["layers.0.weight"])


def test_wrong_settings_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="worlds must be at least one for each of the 2"):
        args(tmp_path, worlds=1)
    with pytest.raises(ValueError, match=r"randomization must be without command delays"):
        args(tmp_path, randomization={"sensing.command_delay": (0.0, 0.1)})
    with pytest.raises(ValueError, match="command_delays must be one or more times"):
        args(tmp_path, command_delays=())
    with pytest.raises(ValueError, match="teacher: expected a trained policy, got 'fetch'"):
        distill(args(tmp_path, teacher="fetch"))
    with pytest.raises(ValueError, match=r"sensing must be a preset or a \.json file, with which"):
        args(tmp_path, sensing="tests.simulators:Blind")
    for name in ("policy.safetensors", "progress.csv"):
        (tmp_path / name).touch()
        with pytest.raises(ValueError, match=r"out: .*holds a run"):
            distill(args(tmp_path))
        (tmp_path / name).unlink()


def test_the_recorded_delays_are_those_that_matches_draw(tmp_path: Path) -> None:
    late = args(tmp_path / "late", command_delays=(0.05, 0.1))
    assert Network.load(distill(late)).randomization["sensing.command_delay"] == [0.0375, 0.1125]


def test_a_forecast_knows_the_delay_of_its_matches(tmp_path: Path) -> None:
    """So the student, which begins as the teacher, is nearer to it, by all but half a step."""
    losses = {}
    for sensing in ("forecast=1, tracker=0", "forecast=0, delay=0.001, tracker=0"):
        late = args(
            tmp_path / sensing,
            command_delays=(0.1,),
            history=1,
            sensing=sensing,
            minibatches=1,
            worlds=64,
        )
        path = distill(late)
        assert Network.load(path).forecasts == sensing.startswith("forecast=1")
        losses[sensing] = read_progress(tmp_path / sensing)["loss"][0]
    known, unknown = losses.values()
    assert known < 0.7 * unknown, losses


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"command_delays": (0.0, 0.06)}, r"multiples of the control step of 0.025 s, got 0.06 s"),
        ({"decisions": 1}, r"decisions: expected at least 2 for command_delays of 0.1 s, got 1"),
    ],
)
def test_delays_without_labels_are_refused_before_anything_is_written(
    tmp_path: Path, changes: dict[str, Any], message: str
) -> None:
    folder = tmp_path / "none"
    with pytest.raises(ValueError, match=message):
        distill(args(folder, **changes))
    assert not folder.exists()


def test_the_shortest_round_that_a_delay_allows_has_labels(tmp_path: Path) -> None:
    assert distill(args(tmp_path / "short", decisions=2, samples=8)).exists()
