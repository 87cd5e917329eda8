"""The soak test of whole matches, in small, and that it finds faults."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from rsoccer._core import GAME_COLUMNS
from rsoccer.game import EventKind
from rsoccer.matches import Matches
from rsoccer.tasks import VssMatch
from rsoccer.testing.pressure import Pressing
from tests.games import begin_play, set_game
from tools import soak_matches
from tools.match_audit import AuditError, MatchAudit
from tools.soak_matches import SCENES, SIDES, Soaked, expect_same, soak

BY_NAME = {scene.name: scene for scene in SCENES}


@pytest.mark.parametrize(
    ("scene", "sides"),
    [
        ("VSSS 3 v 3", "random"),
        ("VSSS 5 v 5", "scripted"),
        ("SSL 1 v 1, B, robots", "scripted"),
        ("SSL 3 v 3, B, teleport", "crowd"),
        ("SSL 6 v 6, B, robots", "scripted"),
        ("SSL 11 v 11, A, teleport", "random"),
    ],
)
def test_whole_matches_add_up_and_repeat(
    scene: str, sides: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(soak_matches, "RESUMES", 1 / 50)
    found = soak(BY_NAME[scene], sides, 3, 2.0)
    assert found.seconds > 3 * 4.0, "two halves each"
    assert found.resumed > 0
    assert 0.0 < found.longest_idle <= 15.0


def audited() -> tuple[Matches, MatchAudit]:
    """Matches with the ball in play, with their audit."""
    task = VssMatch()
    matches = Matches(task, 2, 0, autoreset="disabled")
    matches.reset()
    begin_play(matches)
    return matches, MatchAudit(matches, task)


def spoil_column(name: str, value: float) -> Callable[[Matches], None]:
    """A change of a number of the second match by a value."""

    def spoil(matches: Matches) -> None:
        matches.play.game.referee[1, GAME_COLUMNS.index(name)] += value

    return spoil


def goal(matches: Matches) -> None:
    """A goal that is announced, and not counted."""
    matches.play.events.add(np.array([1]), EventKind.GOAL, 0, 0)


def foul(matches: Matches) -> None:
    """An offense that is announced, and not counted."""
    matches.play.events.add(np.array([1]), EventKind.KEEPER_HELD_BALL, 0)


def speed(matches: Matches) -> None:
    """A robot that is faster than the way that was counted."""
    matches.play.frame.robots.velocity[1, 0] = 9.0


def nothing(matches: Matches) -> None:
    """No number is a number."""
    matches.play.frame.ball.position[1] = np.nan


@pytest.mark.parametrize(
    ("spoil", "message"),
    [
        (spoil_column("stage_steps_left", 1.0), r"the clock is wrong: worlds \[1\]"),
        (spoil_column("red_cards_blue", 1.0), r"red_cards differ from events: worlds \[1\]"),
        (goal, r"score differ from events: worlds \[1\] in their steps \[4\]"),
        (foul, r"offenses differ from events: worlds \[1\]"),
        (speed, r"the distance is wrong: worlds \[1\]"),
        (nothing, r"a number is not finite: worlds \[1\]"),
    ],
)
def test_a_fault_is_found(spoil: Callable[[Matches], None], message: str) -> None:
    matches, audit = audited()
    pressing = Pressing(VssMatch())
    for _ in range(3):
        matches.step(pressing.actions(matches))
        audit.step()
    matches.step(pressing.actions(matches))
    spoil(matches)
    with pytest.raises(AuditError, match=message):
        audit.step()


def test_a_half_of_another_length_is_found() -> None:
    task = VssMatch(half_seconds=1.0, halves=1)
    matches = Matches(task, 1, 0, autoreset="disabled")
    matches.reset()
    begin_play(matches)
    set_game(matches, stage_steps_left=5)  # of 40
    audit = MatchAudit(matches, task)
    with pytest.raises(AuditError, match=r"a half has another length: worlds \[0\] .* \[5\]"):
        for _ in range(10):
            matches.step(np.zeros((1, 6, 2), np.float32))
            audit.step()


def test_a_match_in_which_nothing_happens_is_found() -> None:
    task = VssMatch(referee={"off": ["NO_PROGRESS_IN_GAME", "KEEPER_HELD_BALL"]})
    matches = Matches(task, 1, 0, autoreset="disabled")
    matches.reset()
    audit = MatchAudit(matches, task)
    with pytest.raises(AuditError, match=r"nothing happens: worlds \[0\]"):
        for _ in range(800):
            matches.step(np.zeros((1, 6, 2), np.float32))
            audit.step()


def test_other_bits_are_found() -> None:
    first, second = (Matches(VssMatch(), 2, 0) for _ in range(2))
    for matches in (first, second):
        matches.reset()
    expect_same(first, second, slice(None), "again")
    second.play.game.seconds_left[1] += 1.0
    with pytest.raises(AuditError, match="seconds_left differ again, in step 0"):
        expect_same(first, second, slice(None), "again")


def test_the_table_has_a_row_for_each_scene_and_side(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def found(scene: object, sides: str, *_: object) -> Soaked:
        if sides == "crowd":
            raise AuditError("the clock is wrong")
        return Soaked(100, 36.0, 8.0, 3, 5, 7)

    monkeypatch.setattr(soak_matches, "soak", found)
    monkeypatch.setattr(soak_matches, "STORED", tmp_path / "soak_matches.md")
    assert soak_matches.results() == ""
    assert soak_matches.main(["--only", "SSL 11", "--store"]) == 2
    text = capsys.readouterr().out
    assert soak_matches.results() == text
    assert text.count("FAULT: the clock is wrong") == 2
    assert "| SSL 11 v 11, A, robots | scripted | 100 | 0.01 | 8.0 | 3 | 5 | 7 |" in text
    assert len(SIDES) * len(SCENES) == 30
    assert soak_matches.main(["--only", "VSSS 5", "--sides", "scripted", "random", "--store"]) == 0
    lines = soak_matches.results().splitlines()
    assert lines[:2] + lines[4:] == text.splitlines(), "rows of other scenes have changed"
    assert [line.split(" | ")[1] for line in lines[2:4]] == ["random", "scripted"]
