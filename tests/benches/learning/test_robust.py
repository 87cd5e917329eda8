"""The study of robustness: its conditions, its experiments, and their evaluation."""

from typing import Any

import numpy as np
import pytest

import rsoccer
from benches.learning import conditions, robust
from benches.learning.experiments import CLONES, Experiment, Protocol, Run
from benches.learning.run_files import Folders
from benches.learning.running.evaluation import evaluate_run
from benches.learning.running.learned import Learned
from rsoccer.benchmark.conditions import CONDITIONS
from rsoccer.benchmark.protocol import MATCHES
from rsoccer.train import Args

TASK = "SSLGoToBall-v0"


def shipped(**changes: Any) -> Experiment:  # noqa: ANN401  (any field)
    settings: dict[str, Any] = {"settings": {"policy": "fetch"}, "opponents": (None,), "seeds": 1}
    return Experiment("robust", "x", TASK, CLONES, **{**settings, **changes})


@pytest.mark.parametrize("name", CONDITIONS)
def test_matches_can_be_played_under_each_condition(name: str) -> None:
    condition = CONDITIONS[name]
    for task in ("VSS-v0", TASK):
        matches = rsoccer.Matches(
            task, 2, sensing=condition.sensing({}), randomization=condition.randomization(task)
        )
        matches.reset()
        matches.step(np.ones((2, len(matches.agents), matches.action_size), np.float32))
        is_exact = name in ("truth", "varied-10")
        assert (matches.play.senses is None) == is_exact


def test_masses_and_frictions_vary_around_those_of_the_task() -> None:
    ranges = CONDITIONS["varied-10"].randomization(TASK)
    ball = rsoccer.make_task(TASK).config.ball
    assert ranges["ball.mass"] == pytest.approx((0.9 * ball.mass, 1.1 * ball.mass))
    assert ranges["robot.mass"] == pytest.approx((0.9, 1.1))


def test_policies_can_need_numbers_in_all_conditions() -> None:
    found = CONDITIONS["rc2021"].sensing({"command_delay": 0.2})
    assert found == rsoccer.Sensing("rc2021", command_delay=0.2)


def test_every_experiment_learns_what_its_variant_says() -> None:
    made = {experiment.key: experiment for experiment in robust.experiments(seeds=2)}
    assert len(made) >= 4 * len(robust.SAMPLES)
    for task in robust.SAMPLES:
        parts = ("truth", "senses", "variation", "history")
        runs = [made[f"{robust.GROUP}/{task}-{name}"] for name in parts]
        args = [Args.for_task(task, **run.settings) for run in runs]
        assert [each.sensing for each in args] == [None, "rc2021", "rc2021", "rc2021"]
        assert [len(each.randomization) for each in args] == [0, 1, 6, 6]
        assert [each.history for each in args] == [1, 1, 1, robust.HISTORY]
        assert len({each.samples for each in args}) == 1


def test_a_policy_of_the_package_has_a_digest() -> None:
    settings = conditions.settings(Run(shipped(settings={"policy": "best"}), 0))
    assert len(settings["digest"]) == 12
    assert "conditions" not in settings
    named = conditions.settings(Run(shipped(conditions=("truth",)), 0))
    assert (named["conditions"], named["matches"]) == (["truth"], MATCHES)


def test_rows_name_their_condition(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("benches.learning.running.evaluation.MATCHES", 10)
    run = Run(shipped(conditions=("truth", "rc2021-100ms")), 0)
    learned = Learned({"sample": "fetch", "mean": "zero"}, 0, {}, {})
    rows = evaluate_run(run, learned, Protocol(starts=2), Folders())
    assert [row["condition"] for row in rows] == ["truth", "rc2021-100ms"]
    assert {row["mode"] for row in rows} == {"sample"}
    assert {row["matches"] for row in rows} == {10}
    assert rows[0]["score"] == 1.0
    assert rows[1]["seconds"] != rows[0]["seconds"], "commands were late"
