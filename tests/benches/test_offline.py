"""The baseline of offline learning; its algorithms need d3rlpy, which tests do without."""

import json
from pathlib import Path

import numpy as np
import pytest

import rsoccer
from benches import offline
from rsoccer.datasets import record_episodes


def test_a_policy_of_another_library_plays() -> None:
    class Forward:
        def predict(self, observations: np.ndarray) -> np.ndarray:
            assert observations.ndim == 2
            return np.full((len(observations), 5), 0.5, np.float32)

    task = rsoccer.make_task(offline.TASK, max_steps=40)
    (episode,) = record_episodes(offline.Learned(Forward()), task, 1)
    assert np.all(episode.actions == 0.5)
    assert episode.policy == "Learned"


def test_the_table_has_a_row_for_each_policy(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(offline, "RESULT", tmp_path / "offline.json")
    assert offline.results() == ""
    row = {"score": 0.5, "low": 0.4, "high": 0.6, "seconds": 2.0, "training": 12.0}
    stored = offline.settings() | {"rows": {"fetch": row, "IQL": row}}
    offline.store(stored)
    assert offline.load() == json.loads(json.dumps(stored))
    table = offline.results()
    assert f"| `fetch` | {offline.SKILLS['fetch']} | 0.500 | 0.400 to 0.600 | 2.0 s | - |" in table
    assert "| IQL | - | 0.500 | 0.400 to 0.600 | 2.0 s | 12 s |" in table


@pytest.mark.parametrize(
    "change", [{"physics": 1}, {"steps": 7}, {"matches": 2}, {"skills": {"ou": 1}}, {}]
)
def test_rows_of_other_settings_are_measured_again(
    change: dict[str, object], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(offline, "RESULT", tmp_path / "offline.json")
    monkeypatch.setattr(offline, "ALGORITHMS", {})
    monkeypatch.setattr("sys.argv", ["offline"])
    old = {"score": 0.5, "low": 0.4, "high": 0.6, "seconds": 2.0, "training": 0.0}
    new = {**old, "score": 0.25}
    monkeypatch.setattr(offline, "scored", lambda policy, seconds: new)
    rows = dict.fromkeys(offline.SKILLS, old)
    offline.store({**offline.settings(), "date": "2000-01-01", **change, "rows": rows})
    offline.main()
    found = offline.load()
    assert found["rows"] == dict.fromkeys(offline.SKILLS, new if change else old)
    assert (found["date"] == "2000-01-01") is not bool(change), "the day of the measurement"
    assert all(found[name] == offline.settings()[name] for name in offline.COMPARED)


def test_steps_of_all_episodes_are_joined_for_the_library() -> None:
    class Episode:
        def __init__(self, steps: int) -> None:
            self.observations = np.zeros((steps + 1, 4), np.float32)
            self.actions = np.zeros((steps, 2), np.float32)
            self.rewards = np.zeros(steps)
            self.terminations = np.arange(steps) == steps - 1
            self.truncations = np.zeros(steps, np.bool_)

    class Dataset:
        def iterate_episodes(self) -> list[Episode]:
            return [Episode(3), Episode(2)]

    found = offline.columns(Dataset())
    assert [len(array) for array in found.values()] == [5] * 5
    assert found["terminals"].tolist() == [0, 0, 1, 0, 1]
