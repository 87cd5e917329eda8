"""Every registered task can be trained: the first update of a tiny network is finite."""

import csv
import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest

import rsoccer
from rsoccer.policies.network import Network
from rsoccer.train import train
from rsoccer.train.rollout.episode_stats import EpisodeStats
from rsoccer.train.run.log import read_progress
from tests.train.one_update import one_update

TASKS = rsoccer.list_tasks()  # without the short tasks of the other tests here


@pytest.mark.parametrize("name", TASKS)
def test_the_first_update_is_finite(name: str, tmp_path: Path) -> None:
    policy = Network.load(train(one_update(name, tmp_path)))
    task = rsoccer.make_task(name)
    policy.check_fits(task, task.layout.size)
    with (tmp_path / "progress.csv").open(newline="") as file:
        (row,) = csv.DictReader(file)
    learners = sum(agent.startswith("blue") for agent in task.agents)  # yellow is the opponent
    assert int(row["samples"]) == 3 * 4 * learners
    assert all(
        math.isfinite(float(row[key]))
        for key in ("reward", "value_loss", "approx_kl", "action_std")
    )


def test_metrics_of_a_task_do_not_replace_columns_of_the_run(tmp_path: Path) -> None:
    args = one_update("SSLGoToBall-v0", tmp_path)
    rollout = dataclasses.replace(args.rollout, random_truncation=0.0)
    train(dataclasses.replace(args, samples=2 * 3 * 4, rollout=rollout))
    seconds = read_progress(tmp_path)["seconds"]
    assert len(seconds) == 2
    assert 0.0 < seconds[0] < seconds[1], "not the elapsed time"
    assert "episode/seconds" in read_progress(tmp_path)
    run_columns = {name for name in read_progress(tmp_path) if "/" not in name}
    assert run_columns >= {"seconds", "samples", "episodes", "reward", "time_physics"}
    episode_stats = EpisodeStats(("ou",))
    episode_stats.add(np.zeros(1, int), {name: np.full(1, 7.0) for name in run_columns})
    assert set(episode_stats.take()) & run_columns == {"episodes"}, (
        "a metric replaces a column of the run"
    )
