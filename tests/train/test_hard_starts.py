"""Matches that begin from the initial states of lost ones."""

from pathlib import Path

import numpy as np
import pytest
import torch

from rsoccer.train.hard_starts import SIZE, HardStarts
from rsoccer.train.stop_signal import StopSignal
from rsoccer.train.trainer import Trainer
from tests.train.short_task import tiny

SHARE = 0.4


def rows_of(*numbers: int) -> np.ndarray:
    """States of two columns, named by a number."""
    return np.array([[number, -number] for number in numbers], np.float32)


def generator() -> torch.Generator:
    return torch.Generator().manual_seed(3)


def test_only_kept_states_are_played_again() -> None:
    starts = HardStarts(4, 2, 1.0)
    starts.enter(rows_of(0, 1, 2, 3))
    everywhere = np.ones(4, np.bool_)
    assert len(starts.draw(everywhere, generator())) == 0, "nothing is kept yet"
    assert not starts.repeated.any()
    starts.keep(np.array([False, True, False, True]))
    drawn = np.concatenate([starts.draw(everywhere, generator()) for _ in range(20)])
    assert {tuple(row) for row in drawn.tolist()} <= {(1.0, -1.0), (3.0, -3.0)}
    assert starts.repeated.all()


def test_the_share_of_repeated_matches_is_that_of_the_setting() -> None:
    starts = HardStarts(5000, 2, 0.3)
    starts.enter(rows_of(*range(5000)))
    starts.keep(np.arange(5000) < 100)
    random = generator()
    ended = np.arange(5000) % 2 == 0
    rows = starts.draw(ended, random)
    assert len(rows) == (ended & starts.repeated).sum() == pytest.approx(750, abs=80)
    assert not starts.repeated[~ended].any(), "other matches go on"
    assert len(np.unique(rows[:, 0])) > 90, "all kept states are drawn"


def test_the_newest_states_replace_the_oldest() -> None:
    starts = HardStarts(SIZE, 2, 1.0)
    for first in (0, SIZE, 2 * SIZE - 10):
        starts.enter(rows_of(*range(first, first + SIZE)))
        starts.keep(np.arange(SIZE) < (SIZE if first < 2 * SIZE - 10 else 20))
    kept = set(starts.state_dict()["kept"][:, 0].astype(int).tolist())
    assert set(range(2 * SIZE - 10, 2 * SIZE + 10)) <= kept
    assert not kept & set(range(SIZE))


def test_matches_of_a_run_begin_from_lost_starts(tmp_path: Path) -> None:
    trainer = Trainer(tiny(tmp_path, hard_start_fraction=SHARE, solo_fraction=0.0, samples=10**6))
    collector = trainer.collector
    assert collector.hard_starts is not None
    repeated = 0
    for _ in range(8):
        trainer.collect_rollout(StopSignal().check)
        starts = collector.hard_starts.state_dict()
        kept = {row.tobytes() for row in starts["kept"]}
        current = [row.tobytes() for row in starts["current"]]
        repeats = collector.hard_starts.repeated
        repeated += int(repeats.sum())
        assert all(current[world] in kept for world in np.flatnonzero(repeats))
    assert repeated > 0
    # Each kept match was lost: blue attacks +x, and the ball starts near one goal line.
    assert (starts["kept"][:, 0] < 0.0).mean() > 0.8


def test_results_of_repeated_matches_are_not_logged(tmp_path: Path) -> None:
    settings = {"solo_fraction": 0.0, "samples": 10**6, "worlds": 40}
    counts = []
    for share in (0.0, 1.0):
        trainer = Trainer(tiny(tmp_path, hard_start_fraction=share, **settings))
        for _ in range(8):
            trainer.collect_rollout(StopSignal().check)
        counts.append(trainer.collector.episode_stats.take()["episodes"])
    assert 0 < counts[1] < 0.7 * counts[0]
