"""Logs of a run: statistics by opponent, the CSV file after a resume, the progress bar."""

import math
from pathlib import Path

import numpy as np
import pytest

from rsoccer.train.rollout.episode_stats import EpisodeStats
from rsoccer.train.run.log import Logger, read_progress
from tests.train.log_rows import new_logger, write_rows


def test_ended_episodes_are_counted_by_opponent() -> None:
    stats = EpisodeStats(("ou", "latest"))
    stats.add(np.array([0, 1]), {"goal_score": np.array([1.0, -1.0]), "time": np.array([2.0, 4.0])})
    stats.add(np.array([], int), {"goal_score": np.array([]), "time": np.array([])})
    stats.add(np.array([0]), {"goal_score": np.array([0.0]), "time": np.array([9.0])})
    row = stats.take()
    assert row == {
        "episodes": 3,
        "episode/goal_score": 0.0,
        "episode_ou/goal_score": 0.5,
        "episode_latest/goal_score": -1.0,
        "wins": 1.0,
        "losses": 1.0,
        "episode/time": 5.0,
        "episode_ou/time": 5.5,
        "episode_latest/time": 4.0,
    }


def test_the_mean_without_episodes_is_nan() -> None:
    stats = EpisodeStats(("ou",))
    stats.add(np.array([], int), {"goal_score": np.array([])})
    row = stats.take()
    assert row["episodes"] == 0 and math.isnan(row["episode/goal_score"]) and row["wins"] == 0


def test_a_log_of_one_row_is_read(tmp_path: Path) -> None:
    write_rows(new_logger(tmp_path), 0, 1)
    assert {name: values.tolist() for name, values in read_progress(tmp_path).items()} == {
        "samples": [0.0],
        "reward": [1.0],
        "episode_ou/goal_score": [0.0],
    }


def test_a_log_shorter_than_its_checkpoint_says_stays_readable(tmp_path: Path) -> None:
    size = write_rows(new_logger(tmp_path), 0, 2)
    write_rows(new_logger(tmp_path, 200, size + 100), 2, 3)
    assert read_progress(tmp_path)["samples"].tolist() == [0, 100, 200]


def test_a_resumed_log_continues_at_the_checkpoint(tmp_path: Path) -> None:
    size = write_rows(new_logger(tmp_path), 0, 3)
    write_rows(new_logger(tmp_path, 200, size), 3, 6)  # a crash after the checkpoint
    write_rows(new_logger(tmp_path, 200, size), 3, 5)
    assert read_progress(tmp_path)["samples"].tolist() == [0, 100, 200, 300, 400]


def test_the_bar_shows_wins_and_losses(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    logger = Logger(tmp_path, 0, 400, 0, progress=True)
    row = {
        "reward": 0.5,
        "episodes": 4,
        "episode/goal_score": 0.5,
        "wins": 3,
        "losses": 1,
    }
    logger.write(300, row)
    logger.close()
    shown = capsys.readouterr().err
    assert "75%" in shown and "300/400" in shown
    assert "won 75%, lost 25%" in shown and "samples/s" in shown
