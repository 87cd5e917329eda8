import numpy as np
import pytest

from rsoccer import Matches, Play, Restart, Rule, SimConfig
from rsoccer.arrays import Doubles, Floats, Mask
from rsoccer.tasks import VssSelfPlay
from tests.helpers import same, zeros
from tests.robots import Robots, robots_of


def test_episodes_begin_as_it_is_where_nothing_can_be_placed() -> None:
    task = VssSelfPlay(max_steps=4)
    robots = robots_of(task, 2)
    matches = Matches(task, 2, simulator=robots)
    matches.reset()
    present = np.empty_like(matches.frame.rows)
    robots.read(present)
    assert same(matches.frame.rows, present)
    for _ in range(4):
        outcome = matches.step(zeros(matches) + 1.0)
    assert outcome.truncated.all()
    robots.read(present)
    assert same(matches.frame.rows, present), "the next episode goes on from there"
    assert not matches.play.steps.any()
    with pytest.raises(ValueError, match=r"rows: Robots cannot place bodies.*as it is"):
        matches.reset(rows=present)
    matches.step(zeros(matches))


def test_some_worlds_begin_while_the_others_keep_their_frame() -> None:
    task = VssSelfPlay()
    matches = Matches(task, 2, simulator=robots_of(task, 2))
    matches.reset()
    matches.step(zeros(matches) + 1.0)
    before = matches.frame.rows.copy()
    matches.reset(mask=np.array([True, False]))
    assert same(matches.frame.rows[1], before[1])
    assert matches.play.steps.tolist() == [0, 1]


def test_a_restart_without_a_placer_says_what_to_do() -> None:
    class Always(Rule):
        def judge(self, play: Play) -> Restart:
            return Restart(np.array([0]), rows=play.frame.rows[:1])

    class Restarted(VssSelfPlay):
        @property
        def rules(self) -> list[Rule]:
            return [Always()]

    task = Restarted()
    matches = Matches(task, simulator=robots_of(task))
    matches.reset()
    with pytest.raises(RuntimeError, match=r"worlds \[0\], but Robots cannot place.*PlacedByHand"):
        matches.step(zeros(matches))
    matches.reset()


@pytest.mark.parametrize("autoreset", ["same_step", "next_step", "disabled"])
def test_a_restart_in_the_last_step_of_an_episode_moves_nothing(autoreset: str) -> None:
    class Last(Rule):
        def judge(self, play: Play) -> Restart | None:
            worlds = np.flatnonzero(play.steps >= 3)
            return Restart(worlds, rows=play.frame.rows[worlds]) if len(worlds) else None

    class Restarted(VssSelfPlay):
        @property
        def rules(self) -> list[Rule]:
            return [Last()]

    task = Restarted(max_steps=3)
    matches = Matches(task, 2, simulator=robots_of(task, 2), autoreset=autoreset)
    matches.reset()
    ended = 0
    for _ in range(8):
        ended += int(matches.step(zeros(matches)).ended.sum())
    assert ended >= 2


def test_a_simulator_that_neither_places_nor_reads_is_refused() -> None:
    class OnlySteps:
        def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> None:
            pass

    with pytest.raises(TypeError, match=r"simulator: expected one that can place.*OnlySteps"):
        Matches("VSSSelfPlay-v0", simulator=OnlySteps())


@pytest.mark.parametrize("lost", [slice(None), 0, -1])
def test_a_state_that_is_not_finite_begins_no_episode(lost: int | slice) -> None:
    class Lost(Robots):
        def read(self, out: Floats) -> Doubles | None:
            super().read(out)
            out[:, lost] = np.nan
            return None

    matches = Matches("VSSSelfPlay-v0", simulator=Lost(SimConfig()))
    with pytest.raises(ValueError, match=r"Lost\.read: expected finite numbers"):
        matches.reset()
