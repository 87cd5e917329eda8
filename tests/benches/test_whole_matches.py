from pathlib import Path

import pytest

from benches import whole_matches
from benches.whole_matches import SIDES, VSSS, referee_share, times_real_time
from rsoccer.rules.referee import RefereeRule


@pytest.mark.parametrize("sides", SIDES)
def test_the_share_is_that_of_the_referee_in_the_steps(sides: str) -> None:
    judge = RefereeRule.judge
    share, alone = referee_share(VSSS, sides, 2, 0.0)
    assert 0.0 < share < 1.0
    assert 0.0 < alone < 1.0
    assert RefereeRule.judge is judge, "it is measured no longer"


def test_every_match_is_played_to_its_end() -> None:
    times, of_physics = times_real_time(VSSS, "random", 3, 0.5)
    assert 0.0 < times < of_physics


def test_a_quick_run_makes_both_tables(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(whole_matches, "STORED", tmp_path / "whole_matches.md")
    monkeypatch.setattr(whole_matches, "QUICK_HALF_SECONDS", 0.5)
    whole_matches.main(["--quick", "--store"])
    text = whole_matches.STORED.read_text()
    assert capsys.readouterr().out == text
    for row in ("| VSSS 3 v 3 | random |", "| SSL 6 v 6 | scripted |"):
        assert text.count(row) == 2
    assert text.count("| SSL 11 v 11 |") == 2
