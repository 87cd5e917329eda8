"""The callback of a run: what it gets, and what its answers do."""

from pathlib import Path

import numpy as np
import pytest

from rsoccer.match_evaluation import MatchEvaluation
from rsoccer.policies.network import Network
from rsoccer.train import train
from rsoccer.train.run.callback import Update
from tests.train.runs import digest, progress
from tests.train.short_task import tiny


def test_a_callback_gets_each_update_and_changes_nothing(tmp_path: Path, finished: Path) -> None:
    updates: list[tuple[int, int, dict[str, float]]] = []
    networks: list[Network] = []

    def callback(update: Update) -> None:
        updates.append((update.number, update.samples, dict(update.row)))
        networks.append(update.network())
        np.random.default_rng().normal()
        assert update.out == tmp_path

    policy = train(tiny(tmp_path), callback)
    assert digest(tmp_path) == digest(finished)
    logged = [(int(row["update"]), int(row["samples"])) for row in progress(tmp_path)]
    assert [(number, samples) for number, samples, _ in updates] == logged
    assert len(updates) > 1
    assert set(updates[0][2]) >= {"episodes", "learning_rate"}
    first, last = networks[0], networks[-1]
    assert not np.array_equal(first.layers[0][0], last.layers[0][0])
    assert np.array_equal(Network.load(policy).layers[0][0], last.layers[0][0])


@pytest.mark.parametrize("kind", [bool, np.bool_])
def test_false_ends_the_run_which_can_be_resumed(
    kind: type[bool] | type[np.bool_], tmp_path: Path, finished: Path
) -> None:
    train(tiny(tmp_path), lambda update: kind(update.number < 1))  # type: ignore[arg-type,return-value]
    assert [row["update"] for row in progress(tmp_path)] == ["1"]
    assert (tmp_path / "policy.safetensors").exists()
    train(tiny(tmp_path, resume=True))
    assert digest(tmp_path) == digest(finished)


def test_an_error_comes_after_the_run_was_saved(tmp_path: Path, finished: Path) -> None:
    def fails(update: Update) -> None:
        raise RuntimeError("logger is gone")

    with pytest.raises(RuntimeError, match="logger is gone"):
        train(tiny(tmp_path), fails)
    with pytest.raises(TypeError, match="expected it to return None or a bool, got 'stop'"):
        train(tiny(tmp_path, resume=True), lambda update: "stop")  # type: ignore[arg-type,return-value]
    with pytest.raises(TypeError, match="expected it to return None or a bool, got 0"):
        train(tiny(tmp_path, resume=True), lambda update: 0)  # type: ignore[arg-type,return-value]
    train(tiny(tmp_path, resume=True))
    assert digest(tmp_path) == digest(finished)


def test_other_callbacks_are_refused(tmp_path: Path) -> None:
    with pytest.raises(TypeError, match="callback: expected a function, got 3"):
        train(tiny(tmp_path / "run"), 3)  # type: ignore[arg-type]
    assert not (tmp_path / "run").exists()


def test_evaluations_from_a_callback(tmp_path: Path) -> None:
    measured = MatchEvaluation(("ou", "zero"), matches=2, every=1, seconds=0.2)
    scores: list[dict[str, float]] = []
    train(tiny(tmp_path), lambda u: scores.append(measured(u.network, u.samples)))
    assert len(scores) == len(measured.results) > 1
    assert all({"evaluation/goal_score_ou", "evaluation/goal_score_zero"} == set(s) for s in scores)
