"""`check_task` finds faults of rules, and writes that raise nothing."""

from collections.abc import Sequence
from typing import ClassVar

import numpy as np
import pytest
from numpy.typing import NDArray

from rsoccer.arrays import Floats, Mask
from rsoccer.game import EventKind
from rsoccer.rules import Restart, Rule
from rsoccer.task import Play
from rsoccer.testing import TaskError, check_task
from tests.testing.test_task_check import Correct


class Watcher(Rule):
    """A correct rule, base of the faulty ones."""

    def judge(self, play: Play) -> Restart | None:
        return None


class StopsTheBallAtBegin(Watcher):
    def begin(self, play: Play, worlds: NDArray[np.intp]) -> None:
        play.frame.ball.velocity[worlds] *= 0.0


class SetsTheClockAtBegin(Watcher):
    def begin(self, play: Play, worlds: NDArray[np.intp]) -> None:
        play.steps[worlds] = 5


class ClearsMemoryAtBegin(Watcher):
    def begin(self, play: Play, worlds: NDArray[np.intp]) -> None:
        play.memory.clear()


class ScoresBySight(Watcher):
    def judge(self, play: Play) -> Restart | None:
        play.game.score[:, 0] += play.sensed.ball.position[:, 0] > 0.0
        return None


class ReportsBySight(Watcher):
    def judge(self, play: Play) -> Restart | None:
        worlds = np.flatnonzero(play.sensed.ball.position[:, 0] > 0.0)
        play.events.add(worlds, EventKind.PASS)
        return None


class WithRule(Correct):
    """A task with one more rule."""

    rule: ClassVar[Rule] = Watcher()

    @property
    def rules(self) -> Sequence[Rule]:
        return (*super().rules, self.rule)


@pytest.mark.parametrize(
    ("faulty", "message"),
    [
        (StopsTheBallAtBegin, r"rules: begin: it writes into play\.frame"),
        (SetsTheClockAtBegin, r"rules: begin: it writes into play\.steps"),
        (ClearsMemoryAtBegin, r"rules: begin: .*play\.memory"),
        (ScoresBySight, r"rules: .*play\.game\['score'\].*it reads what robots sense"),
        (ReportsBySight, r"rules: .*play\.events\['count'\].*it reads what robots sense"),
    ],
)
def test_faults_of_rules_are_found(faulty: type[Rule], message: str) -> None:
    class Faulty(WithRule):
        rule = faulty()

    with pytest.raises(TaskError, match=message):
        check_task(Faulty(), worlds=4, steps=60)


def test_a_task_with_a_correct_rule_passes() -> None:
    check_task(WithRule(), worlds=4, steps=60)


class ReplacesTheFrame(Correct):
    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        play.frame = play.frame.copy()
        play.frame.rows[:] = 0.0
        return super().calculate_reward_and_done(play)


class ReplacesTheClock(Correct):
    def metrics(self, play: Play) -> dict[str, Floats]:
        play.steps = play.steps + 1
        return super().metrics(play)


class UnlocksTheBase(Correct):
    def metrics(self, play: Play) -> dict[str, Floats]:
        rows = play.frame.rows
        base = rows if rows.base is None else rows.base
        base.flags.writeable = True
        base[...] *= np.float32(0.5)
        return super().metrics(play)


class WritesThroughTheBase(Correct):
    def metrics(self, play: Play) -> dict[str, Floats]:
        rows = play.frame.rows
        (rows if rows.base is None else rows.base)[...] *= np.float32(0.5)
        return super().metrics(play)


class DrawsFromTorch(Correct):
    def metrics(self, play: Play) -> dict[str, Floats]:
        torch = pytest.importorskip("torch")
        torch.rand(1)
        return super().metrics(play)


@pytest.mark.parametrize(
    ("faulty", "message"),
    [
        (ReplacesTheFrame, r"calculate_reward_and_done: it replaces play\.frame, which"),
        (ReplacesTheClock, r"metrics: it replaces play\.steps, which"),
        (UnlocksTheBase, r"metrics: it writes into play\.frame, which"),
        (WritesThroughTheBase, r"metrics: it writes into play\.frame, which"),
        (DrawsFromTorch, r"metrics draws global random numbers of torch"),
    ],
)
def test_writes_that_raise_nothing_are_found(faulty: type[Correct], message: str) -> None:
    if faulty is DrawsFromTorch:
        pytest.importorskip("torch")
    with pytest.raises(TaskError, match=message):
        check_task(faulty(), worlds=4, steps=60)
