import pytest

from benches.learning.experiments import Protocol
from benches.learning.opponents import SCENARIOS
from benches.learning.running.evaluation import on_scenarios
from rsoccer import make_task


@pytest.mark.parametrize("task", SCENARIOS)
def test_all_official_scenarios_count_equally(task: str) -> None:
    count = SCENARIOS[task]
    make_task(task, scenario=count)
    with pytest.raises(ValueError, match="scenario"):
        make_task(task, scenario=count + 1)
    row = on_scenarios(task, "strike", Protocol(starts=2 * count))
    assert row["matches"] == 2 * count
    assert len(row["by_scenario"]) == count
    assert row["score"] == pytest.approx(sum(row["by_scenario"]) / count, abs=1e-3)
    assert row["score"] > 0.9, "strike solves them"
    assert row["wins"] == row["decided"] > 0
    assert 1.0 < row["seconds_to_decision"] < 10.0
