"""Tables of the leaderboard, and the files in `benchmarks/`."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from rsoccer.benchmark import TASKS, Entry, EntryError, Row, problems, rows_of
from tools import leaderboard

TASK = "SSLGoToBall-v0"


@pytest.mark.parametrize("path", leaderboard.files(), ids=lambda path: path.stem)
def test_every_file_is_a_valid_entry(path: Path) -> None:
    assert problems(json.loads(path.read_text())) == []


def test_there_are_entries_of_different_names() -> None:
    names = [entry.name for entry in leaderboard.entries()]
    assert len(names) >= 2
    assert len(set(names)) == len(names)
    assert leaderboard.main() == 0


def made(name: str, score: float, *, robust: bool = False, task: str = TASK) -> Entry:
    """An entry whose score is lower under each further condition."""
    rows = tuple(
        Row(
            opponent or "-", condition, "reached", 200, 100, 50, 50,
            *(score / (1 + i), score / (2 + i), score / (1 + i), 2.0, 30.0),
        )
        for i, (opponent, condition) in enumerate(rows_of(task, robust))
    )  # fmt: skip
    begun = Entry.begun("zero", name, robust=robust, description=f"About {name}.")
    return replace(begun, tasks={task: rows})


def test_the_best_entry_comes_first() -> None:
    text = leaderboard.plain([made("low", 0.5), made("high", 0.9)])
    assert text.startswith(f"### {TASK}\n\nMeasure: reached.")
    assert text.index("`high` | .900 (.450 to .900)") < text.index("`low` | .500 (.250 to .500)")
    assert "VSS-v0" not in text


def test_entries_of_one_name_keep_their_scores_and_are_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    text = leaderboard.plain([made("same", 0.5), made("same", 0.9)])
    assert text.index("`same` | .900 (.450 to .900)") < text.index("`same` | .500 (.250 to .500)")
    entry = leaderboard.entries()[0]
    for name in ("first", "second"):
        entry.save(tmp_path / f"{name}.json")
    with pytest.raises(EntryError, match=r"name: expected another one than in first\.json, got"):
        leaderboard.entries(tmp_path)
    found = leaderboard.files(tmp_path)
    monkeypatch.setattr(leaderboard, "files", lambda: found)
    assert leaderboard.main() == 1
    assert "second.json: name: expected another one" in capsys.readouterr().out


def test_entries_under_all_conditions_have_mean_and_worst() -> None:
    text = leaderboard.robust([made("plain", 0.9), made("robust", 0.8, robust=True)])
    assert "`plain`" not in text
    (row,) = [line for line in text.splitlines() if "`robust`" in line]
    mean = sum(0.8 / (1 + i) for i in range(1, 10)) / 9
    assert f"| .800 (.400 to .800) | {mean:.3f}".replace("0.", ".") in row
    assert "masses and frictions varied by 10%" in row


def test_an_older_physics_is_marked() -> None:
    old = replace(made("old", 0.5), versions={"package": "0.0.1", "physics": 1})
    assert "`old`\\*" in leaderboard.plain([old])
    assert "0.0.1, 1" in leaderboard.provenance([old])
    assert "`old`\\*" not in leaderboard.plain([made("old", 0.5)])


def test_where_an_entry_comes_from_is_shown() -> None:
    linked = replace(made("mine", 0.5), link="https://example.org")
    table = leaderboard.provenance([linked])
    assert "[`mine`](https://example.org) | About mine. | 1 of 10 |" in table
    assert "| tasks measured |" in table


def test_no_entry_claims_tasks_that_it_lacks() -> None:
    found = [entry for entry in leaderboard.entries() if len(entry.tasks) < len(TASKS)]
    assert found
    assert not [entry.name for entry in found if "each task" in entry.description]


def test_texts_of_an_entry_are_no_markup_of_the_page() -> None:
    foreign = replace(
        made("a`|b\n<script>", 0.5, robust=True),
        description="x | y\n\n<img src=x> `code` [here](javascript:1) *b*",
        machine={**made("other", 0.5).machine, "processor": "<b>|"},
        link="javascript:alert(1)",
    )
    row = leaderboard.provenance([foreign]).splitlines()[2]
    cells = row.split(" | ")
    assert cells[0] == "| `a'/b <script>`", "code shows tags as they are"
    assert cells[1].startswith("x &#124; y &#60;img src=x&#62; &#96;code&#96; &#91;here&#93;(")
    assert cells[5].startswith("&#60;b&#62;&#124;, ")
    assert row.count("|") == 8
    assert "](" not in row
    for text in (leaderboard.plain([foreign]), leaderboard.robust([foreign])):
        assert "`a'/b <script>`" in text
        assert "a`" not in text


def test_quoted_results_have_a_source() -> None:
    rows = json.loads((leaderboard.FOLDER / leaderboard.QUOTED).read_text())
    assert all("](https://" in row["source"] for row in rows)
    assert leaderboard.quoted().count("arxiv.org/abs/2106.12895") >= 5
    assert "| DDPG | `VSS-v0` | 2 M |" in leaderboard.papers_algorithms()


def test_a_broken_file_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "broken.json").write_text("{}")
    monkeypatch.setattr(leaderboard, "files", lambda: [tmp_path / "broken.json"])
    assert leaderboard.main() == 1
    assert "broken.json: format: expected 1" in capsys.readouterr().out
