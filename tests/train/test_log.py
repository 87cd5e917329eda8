"""What a run tells: counts by opponent, files that go on where they were, a curve."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from rsoccer.train import Args
from rsoccer.train.args import SETTINGS_FILE
from rsoccer.train.learning_curve import draw_curve
from rsoccer.train.log import EpisodeStats, Log, read_progress


def test_ended_matches_are_counted_by_opponent() -> None:
    episode_stats = EpisodeStats(("ou", "latest"))
    episode_stats.add(
        np.array([0, 1]), {"goal_score": np.array([1.0, -1.0]), "time": np.array([2.0, 4.0])}
    )
    episode_stats.add(np.array([], int), {"goal_score": np.array([]), "time": np.array([])})
    episode_stats.add(np.array([0]), {"goal_score": np.array([0.0]), "time": np.array([9.0])})
    row = episode_stats.take()
    assert row == {
        "episodes": 3,
        "episode/goal_score": 0.0,
        "episode_ou/goal_score": 0.5,
        "episode_latest/goal_score": -1.0,
        "goals_for": 1.0,
        "goals_against": 1.0,
        "episode/time": 5.0,
        "episode_ou/time": 5.5,
        "episode_latest/time": 4.0,
    }


def test_where_no_match_ended_there_is_no_mean() -> None:
    episode_stats = EpisodeStats(("ou",))
    episode_stats.add(np.array([], int), {"goal_score": np.array([])})
    row = episode_stats.take()
    assert row["episodes"] == 0 and math.isnan(row["episode/goal_score"]) and row["goals_for"] == 0


def rows(log: Log, first: int, last: int) -> int:
    for update in range(first, last):
        score = float("nan") if update == 1 else update / 10
        log.write(
            100 * update, {"samples": 100 * update, "reward": 1.0, "episode_ou/goal_score": score}
        )
    log.close()
    return log.size


def test_a_resumed_log_goes_on_where_the_checkpoint_was(tmp_path: Path) -> None:
    args = Args(out=tmp_path, samples=1000, progress=False)
    size = rows(Log(args, 0, 0), 0, 3)
    rows(Log(args, 200, size), 3, 6)  # died here; the checkpoint is older
    rows(Log(args, 200, size), 3, 5)
    assert read_progress(tmp_path)["samples"].tolist() == [0, 100, 200, 300, 400]


def test_the_curve_is_a_picture_even_with_gaps(tmp_path: Path) -> None:
    rows(Log(Args(out=tmp_path, progress=False), 0, 0), 0, 30)
    path = draw_curve(tmp_path, tmp_path / "curve.png")
    content = path.read_bytes()
    assert content.startswith(b"\x89PNG") and len(content) > 10_000


@pytest.mark.parametrize(
    ("task", "title"),
    [
        ("VSSMulti-v0", "Learning to play VSSMulti-v0, 3 v 3"),
        ("SSLPassEndurance-v0", "Learning to play SSLPassEndurance-v0, 2 v 0"),
    ],
)
def test_the_curve_says_what_is_learned(
    task: str, title: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Every run was titled "three a side"."""
    from matplotlib.figure import Figure

    args = Args(task, tmp_path, progress=False)
    rows(Log(args, 0, 0), 0, 3)
    (tmp_path / SETTINGS_FILE).write_text(json.dumps(args.to_json()))
    drawn: list[Figure] = []
    monkeypatch.setattr(Figure, "savefig", lambda figure, path: drawn.append(figure))
    draw_curve(tmp_path, tmp_path / "curve.png")
    assert drawn[0].axes[0].get_title() == title


def test_without_rows_there_is_no_curve(tmp_path: Path) -> None:
    Log(Args(out=tmp_path, progress=False), 0, 0).close()
    with pytest.raises(ValueError, match="no rows yet"):
        draw_curve(tmp_path, tmp_path / "curve.png")


def test_the_bar_shows_goals_and_wins(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    log = Log(Args(out=tmp_path, samples=400), 0, 0)
    row = {
        "reward": 0.5,
        "episodes": 4,
        "episode/goal_score": 0.5,
        "goals_for": 3,
        "goals_against": 1,
    }
    log.write(400, row)
    log.close()
    shown = capsys.readouterr().err
    assert "goals 3:1, won 75%" in shown and "samples/s" in shown
