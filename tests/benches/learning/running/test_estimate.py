from typing import Any

import pytest

from benches.learning.experiments import Experiment, Run
from benches.learning.running.estimate import SAMPLES_PER_SECOND, expected_seconds
from benches.learning.running.listing import listing
from benches.learning.running.status import DONE, OPEN, STALE, UNAVAILABLE, Status

FIRST = Experiment("ppo", "VSS-v0", "VSS-v0", settings={"samples": 36_000_000}, seeds=2)
LONGER = Experiment("ablation", "long", "VSS-v0", settings={"samples": 72_000_000}, seeds=1)
OTHER = Experiment("ppo", "b", "SSLGoToBall-v0", settings={"samples": 24_000_000}, seeds=1)
SAC = Experiment("baselines", "sac", "VSS-v0", "sac", settings={"samples": 800_000}, seeds=1)


def result(run: Run) -> dict[str, Any]:
    """Return a result of 1 h of learning and 30 min of evaluation."""
    settings = run.experiment.settings
    return {
        "run": run.key,
        "task": run.experiment.task,
        "algorithm": run.experiment.algorithm,
        "samples": settings["samples"],
        "seconds": {"wall": 3600.0},
        "evaluation_seconds": 1800.0,
        "evaluations": [{"metric": "goal_score", "score": 0.5, "opponent": "ou"}],
    }


DONE_RUN = Run(FIRST, 0)
KNOWN = [
    Status(DONE_RUN, DONE, result=result(DONE_RUN)),
    *(Status(Run(FIRST, 1), OPEN), Status(Run(LONGER, 0), OPEN)),
    *(Status(Run(OTHER, 0), OPEN), Status(Run(SAC, 0), UNAVAILABLE, "no library")),
]


@pytest.mark.parametrize(("experiment", "hours"), [(FIRST, 1.5), (LONGER, 3.0), (OTHER, 1.0)])
def test_the_time_of_a_run_follows_from_finished_ones(experiment: Experiment, hours: float) -> None:
    run = Run(experiment, experiment.seeds - 1)
    assert expected_seconds(run, KNOWN[:1]) == pytest.approx(hours * 3600.0)


def test_the_same_task_counts_before_other_tasks() -> None:
    slow = {**result(DONE_RUN), "run": "ppo/c/seed-0", "task": OTHER.task, "samples": 12_000_000}
    known = [*KNOWN[:1], Status(Run(OTHER, 0), DONE, result=slow)]
    longer = Run(Experiment("ppo", "d", OTHER.task, settings=OTHER.settings), 0)
    assert expected_seconds(longer, known) == pytest.approx(3.0 * 3600.0)


def test_without_a_finished_run_of_the_algorithm_it_is_a_guess() -> None:
    assert expected_seconds(Run(OTHER, 0), []) == 24_000_000 / SAMPLES_PER_SECOND["ppo"]
    assert expected_seconds(Run(SAC, 0), KNOWN[:1]) == 800_000 / SAMPLES_PER_SECOND["sac"]


def test_an_earlier_result_with_fewer_samples_counts_in_proportion() -> None:
    run = Run(FIRST, 0)
    stale = Status(run, STALE, "samples", result={**result(run), "samples": 12_000_000})
    assert expected_seconds(run, [stale]) == pytest.approx(3.0 * 1.5 * 3600.0)


def test_the_list_adds_up_the_open_runs() -> None:
    lines = listing(KNOWN, KNOWN, 2).splitlines()
    assert len(lines) == len(KNOWN) + 1
    assert lines[-1] == (
        "1 done, 3 open, 1 unavailable; 5.5 core-hours left, 2.8 h with 2 jobs "
        "without the unavailable ones"
    )
