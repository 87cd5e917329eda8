"""The benchmark of the scripted SSL side: it plays matches to their ends and counts in them."""

import json
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
    printed = capsys.readouterr().out
    assert printed.startswith("| Robots | Skill |")
    monkeypatch.setattr(scripted_ssl, "FILE", path)
    assert scripted_ssl.results().endswith(f"both teams together.\n\n{printed}")
    monkeypatch.setattr(scripted_ssl, "FILE", tmp_path / "none.json")
    assert scripted_ssl.results() == ""


def test_processes_do_not_change_the_rows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pairings = (Pairing(1.0, 0.0, robots=1), Pairing(0.0, 0.0, robots=1))
    monkeypatch.setattr(scripted_ssl, "GROUPS", {"sizes": pairings})
    quick = ["--matches", "1", "--half-seconds", "1", "--out"]

    def rows(name: str, *options: str) -> list[dict[str, object]]:
        path = scripted_ssl.main([*quick, str(tmp_path / name), *options])
        found = json.loads(path.read_text())["rows"]
        assert [row["pairing"]["blue"] for row in found] == [1.0, 0.0]
        return [{name: row[name] for name in row if name != "speed"} for row in found]

    assert rows("one.json") == rows("two.json", "--processes", "2")


def test_a_stopped_run_goes_on_with_the_rows_that_are_missing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pairings = (Pairing(1.0, 0.0, robots=1), Pairing(0.0, 0.0, robots=1))
    quick = ["--matches", "1", "--half-seconds", "1", "--out", str(tmp_path / "rows.json")]
    monkeypatch.setattr(scripted_ssl, "GROUPS", {"sizes": pairings[:1]})
    stopped = json.loads(scripted_ssl.main(quick).read_text())
    stopped["rows"][0]["speed"] = -1.0  # marks the row
    (tmp_path / "rows.json").write_text(json.dumps(stopped))
    monkeypatch.setattr(scripted_ssl, "GROUPS", {"sizes": pairings})
    rows = json.loads(scripted_ssl.main([*quick, "--resume"]).read_text())["rows"]
    assert [row["pairing"]["blue"] for row in rows] == [1.0, 0.0]
    assert rows[0]["speed"] == -1.0 < rows[1]["speed"]
    other = json.loads(scripted_ssl.main([*quick, "--resume", "--seed", "1"]).read_text())["rows"]
    assert all(row["speed"] > 0.0 for row in other)
