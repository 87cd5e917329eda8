"""Ladder of a run: fixed opponents, equal matches each time, columns of the log."""

from pathlib import Path

import numpy as np
import pytest

from rsoccer.evaluate.episodes import EpisodeRunner
from rsoccer.lineup import lineup
from rsoccer.registry import make_task
from rsoccer.task import LEARN
from rsoccer.train import RunSettings, train
from rsoccer.train.run.ladder import SEED, Ladder
from rsoccer.train.run.log import read_progress
from rsoccer.train.run.trainer import Trainer
from tests.train.one_update import one_update
from tests.train.short_task import NAME, tiny


@pytest.mark.parametrize(
    ("task", "columns"),
    [
        (
            "VSSSelfPlay-v0",
            [f"ladder_{name}_goal_score" for name in ("zero", "ou", "chase", "scripted")],
        ),
        (
            "SSLSelfPlay-v0",
            [f"ladder_{name}_goal_score" for name in ("zero", "ou", "scripted", "strike")],
        ),
        ("SSLStaticDefenders-v0", ["ladder_goal_score"]),
        ("SSLPassEnduranceMulti-v1", ["ladder_passes"]),
    ],
)
def test_each_task_has_its_columns(task: str, columns: list[str]) -> None:
    ladder = Ladder(RunSettings(), make_task(task), threads=1)
    assert list(ladder.columns) == columns
    assert list(ladder.skip()) == columns


def test_the_policy_is_measured_at_the_interval_and_at_the_end(finished: Path) -> None:
    progress = read_progress(finished)
    for name in ("zero", "ou", "chase", "scripted"):
        known = np.isfinite(progress[f"ladder_{name}_goal_score"])
        assert (np.flatnonzero(known) + 1).tolist() == [4, 6]
    assert ((progress["time_ladder"] > 0) == known).all()


def test_measurements_do_not_change_what_is_learned(finished: Path, tmp_path: Path) -> None:
    train(tiny(tmp_path, ladder_interval=0))
    with_ladder, without = read_progress(finished), read_progress(tmp_path)
    assert not np.isfinite(without["ladder_ou_goal_score"]).any()
    assert without["value_loss"].tolist() == with_ladder["value_loss"].tolist()


def test_each_opponent_plays_as_it_plays_alone(tmp_path: Path) -> None:
    """Opponents take the worlds in turn, and rest where a match has ended."""
    network, task = Trainer(tiny(tmp_path)).network(), make_task(NAME)
    ladder = Ladder(RunSettings(ladder_matches=24), task, threads=1)
    row = ladder.measure(network)
    assert row == ladder.measure(network), "other matches"
    for first, name in enumerate(ladder.opponents):
        runner = EpisodeRunner(task, lineup(task, LEARN, name), network, 24, 1)
        scores = runner.run(24, SEED).scores[first::4]
        assert row[f"ladder_{name}_goal_score"] == pytest.approx(scores.mean())
    assert len(set(row.values())) > 1


def test_a_task_for_one_team_is_measured_as_it_is(tmp_path: Path) -> None:
    args = one_update("SSLGoToBall-v0", tmp_path)
    network, task = Trainer(args).network(), make_task("SSLGoToBall-v0")
    row = Ladder(RunSettings(ladder_matches=6), task, threads=1).measure(network)
    scores = EpisodeRunner(task, lineup(task, LEARN), network, 6, 1).run(6, SEED).scores
    assert row == {"ladder_reached": scores.mean()}
