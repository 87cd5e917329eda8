"""Every registered task can be trained on: a first update of a tiny network, all of it finite."""

import csv
import math
from pathlib import Path

import pytest

import rsoccer
from rsoccer.policies.network import Network
from rsoccer.train import Args, train

TASKS = rsoccer.list_tasks()  # before the short tasks of other tests here are known


@pytest.mark.parametrize("name", TASKS)
def test_a_first_update_can_be_made(name: str, tmp_path: Path) -> None:
    args = Args(
        name,
        tmp_path,
        samples=1,  # rounded up to one update
        threads=1,
        progress=False,
        alone=0.0,
        worlds=3,
        horizon=4,
        hidden=(8,),
        epochs=1,
        minibatches=1,
    )
    policy = Network.load(train(args))
    task = rsoccer.make_task(name)
    policy.check_fits(task, task.observation_size)
    with (tmp_path / "progress.csv").open(newline="") as file:
        (row,) = csv.DictReader(file)
    learners = sum(agent.startswith("blue") for agent in task.agents)  # yellow is the opponent
    assert int(row["samples"]) == 3 * 4 * learners
    assert all(
        math.isfinite(float(row[key]))
        for key in ("reward", "value_error", "divergence", "action_std")
    )
