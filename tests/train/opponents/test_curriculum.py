"""Matches of a run: opponents that the settings name."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rsoccer import Matches
from rsoccer.registry import make_task
from rsoccer.train import Args, OpponentSettings, train
from rsoccer.train.clock import Clock
from rsoccer.train.opponents.curriculum import Curriculum
from rsoccer.train.rollout.episode_stats import EpisodeStats, opponent_column
from rsoccer.train.run.log import read_progress
from rsoccer.train.run.trainer import Trainer
from tests.test_tournament import write_network
from tests.train.one_update import one_update
from tests.train.short_task import tiny


def curriculum(
    task: str,
    options: dict[str, Any] | None = None,
    **settings: Any,  # noqa: ANN401  (any field)
) -> Curriculum:
    made, played = OpponentSettings(**settings), make_task(task, **(options or {}))
    return Curriculum(made, played, Clock(), worlds=40, threads=1, action_repeat=3)


def test_a_task_keeps_its_own_policies_by_default() -> None:
    own = curriculum("VSSMulti-v0")
    assert own.opponents is None and own.pool is None and own.kinds == ()
    names = [group.name for group in own.team(0).assignment.groups]
    assert names == ["yellow_0"]


def test_a_single_learner_has_mixed_opponents_and_its_own_teammates() -> None:
    mixed = curriculum("VSS-v0", fixed={"zero": 1, "chase": 3})
    assert mixed.pool is None and mixed.kinds == ("chase", "zero")
    matches = mixed.team(0)
    assert matches.agents == ("blue_0",)
    groups = {group.name: group for group in matches.assignment.groups}
    assert {name: len(group.robots) for name, group in groups.items()} == {
        "blue_1": 2,
        "yellow_0": 3,
    }
    matches.reset()
    assert set(groups["yellow_0"].memory["drawn"].tolist()) == {0, 1}
    assert "drawn" not in groups["blue_1"].memory


def test_the_first_part_is_logged_under_its_own_policy() -> None:
    mixed = curriculum("VSSMulti-v0", fixed={"chase": 1})
    assert mixed.kinds == ("ou", "chase")
    matches = mixed.team(0)
    matches.reset()
    assert matches.assignment.groups[0].memory["drawn"].tolist() == [1] * 40
    assert curriculum("VSSSelfPlay-v0", fixed={"chase": 1}).kinds == (
        *("ou", "chase"),
        *("latest", "past"),
    )


def test_files_never_share_the_columns_of_the_runs_own_kinds(tmp_path: Path) -> None:
    """Formerly files in folders `latest`, `past` and `ou` did."""
    latest, past, noise, mine = (
        write_network(tmp_path / name / "policy.safetensors")
        for name in ("latest", "past", "ou", "mine")
    )
    opponents = {latest: 1, past: 1, noise: 1, mine: 1, "ou": 1}
    kinds = curriculum("VSSSelfPlay-v0", fixed=opponents).kinds
    assert kinds == ("ou", latest, "mine", noise, past, "latest", "past")
    stats = EpisodeStats(kinds)
    stats.add(np.arange(len(kinds)), {"goal_score": np.arange(len(kinds)) / 10.0})
    row = stats.take()
    columns = [row[opponent_column(kind, "goal_score")] for kind in kinds]
    assert columns == [index / 10.0 for index in range(len(kinds))]
    assert curriculum("VSSMulti-v0", fixed={latest: 1}, solo_fraction=0).kinds == (latest,)


@pytest.mark.parametrize(
    ("task", "settings", "message"),
    [
        ("SSLGoToBall-v0", {"fixed": {"ou": 1}}, "opponents.fixed: expected none"),
        ("VSS-v0", {"fixed": {"strike": 1}}, "strike|Strike"),
        (
            "VSSSelfPlay-v0",
            {"fixed": {"ou": 1}, "latest_fraction": 0.6, "past_fraction": 0.4},
            "latest_fraction",
        ),
    ],
)
def test_policies_without_robots_or_matches_are_refused(
    task: str, settings: dict[str, Any], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        curriculum(task, **settings)


def test_a_team_with_another_part_is_not_played_by_the_learners_selves() -> None:
    # Formerly the keepers' own policy played the takers, whose part it never learns.
    with pytest.raises(
        ValueError, match=r"expected 0, .* SSLKeepaway-v0, got 0\.5 and 0\.35: let one"
    ):
        curriculum("SSLKeepaway-v0", {"learners": "both"})
    fixed: dict[str, Any] = {"fixed": {"take": 1}, "latest_fraction": 0, "past_fraction": 0}
    mixed = curriculum("SSLKeepaway-v0", {"learners": "both"}, **fixed)
    assert mixed.learners == ("blue_0", "blue_1", "blue_2")
    assert mixed.kinds == ("ou", "take", "latest", "past")


def test_episodes_are_logged_by_opponent(tmp_path: Path) -> None:
    train(tiny(tmp_path, fixed={"zero": 1, "chase": 1}, latest_fraction=0, past_fraction=0))
    progress = read_progress(tmp_path)
    for name in ("ou", "chase", "zero", "latest", "past"):
        known = np.isfinite(progress[f"episode_{name}/goal_score"])
        assert known.any() == (name not in ("latest", "past")), name


def test_win_rates_follow_the_matches(tmp_path: Path) -> None:
    trainer = Trainer(tiny(tmp_path, past_fraction=0.6, solo_fraction=0.0))
    for _ in range(6):
        trainer.update(trainer.collect_rollout(lambda: None), lambda: None)
    assert trainer.pool is not None
    assert any(rate != 0.5 for rate in trainer.pool.slots.win_rates)


def test_clones_of_a_single_learner_are_opponents_of_a_team(tmp_path: Path) -> None:
    """A policy trained on VSS-v0 drives any robot of the tasks with equal observations."""
    clone = str(train(one_update("VSS-v0", tmp_path / "single")))
    for task in ("VSSMulti-v0", "VSSSelfPlay-v0"):
        matches = Matches(task, 2, seed=0, controllers={"blue": "zero", "yellow": clone})
        matches.reset()
        before = matches.play.frame.robots.position.copy()
        for _ in range(10):
            matches.step(np.zeros((2, 0, 2), np.float32))
        moved = np.abs(matches.play.frame.robots.position - before).max(axis=(0, 2))
        assert (moved[3:] > 1e-3).all(), f"a yellow robot stands still in {task}"
    team = one_update("VSSMulti-v0", tmp_path / "team").to_json() | {"opponents.fixed": {clone: 1}}
    assert Trainer(Args.from_json(team)).curriculum.kinds == ("single",)
