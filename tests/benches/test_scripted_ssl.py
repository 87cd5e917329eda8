"""The benchmark of the scripted SSL side: it plays matches to their ends and counts in them."""

from pathlib import Path

import pytest

from benches import scripted_ssl
from benches.scripted_ssl import Pairing, measure, report


def test_rows_count_whole_matches() -> None:
    row = measure(Pairing(1.0, 0.0, robots=1), matches=2, half_seconds=5.0, seed=0)
    assert row.matches == 2 and 0.0 <= row.won.mean <= 1.0
    assert row.won.low is None, "two matches have no interval"
    assert 0.0 < row.in_play <= 1.0 and row.speed > 0.0
    assert row.passes.mean == pytest.approx(0.0), "nobody to pass to"
    again = measure(row.pairing, matches=2, half_seconds=5.0, seed=0)
    assert (again.goals, again.fouls, again.in_play) == (row.goals, row.fouls, row.in_play)
    assert "| 1 | 1 | 0 | 2 |" in report([row])


def test_the_result_file_has_the_rows(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(scripted_ssl, "GROUPS", {"sizes": (Pairing(1.0, 1.0, robots=1),)})
    path = scripted_ssl.main(
        ["--matches", "1", "--half-seconds", "1", "--out", str(tmp_path / "rows.json")]
    )
    assert '"robots": 1' in path.read_text()
    assert capsys.readouterr().out.startswith("| Robots | Skill |")
