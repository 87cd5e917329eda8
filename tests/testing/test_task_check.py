"""`check_task` accepts every task of the package and finds every planted fault."""

import random
from dataclasses import dataclass

import numpy as np
import pytest

import rsoccer
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import Frame
from rsoccer.rng import WorldRng
from rsoccer.task import Play, Task
from rsoccer.tasks import VssSelfPlay
from rsoccer.testing import TaskError, check_task
from tests.helpers import Crowd


@pytest.mark.parametrize("name", rsoccer.list_tasks())
def test_every_task_of_the_package_passes(name: str) -> None:
    check_task(rsoccer.make_task(name), steps=100)


@pytest.mark.parametrize(
    "task",
    [
        rsoccer.make_task("VSSMulti-v0", opponent="chase", ball_speed=0.5),
        rsoccer.make_task("VSSMulti-v0", n_blue=1, n_yellow=2, opponent="uniform"),
        rsoccer.make_task("VSSSelfPlay-v0", n_yellow=0),
        Crowd(),
    ],
    ids=["chase", "odd teams", "no opponents", "crowd"],
)
def test_options_pass(task: Task) -> None:
    check_task(task, worlds=3, steps=60)


@dataclass(frozen=True)
class Correct(Crowd):
    """A correct task, base of the faulty ones: it uses memory, both frames and random numbers."""

    def new_memory(self, n: int) -> dict[str, Array]:
        return {"run": np.zeros(n, np.float32)}

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        terms, done = super().calculate_reward_and_done(play)
        ball = play.frame.ball.position[:, 0] - play.last_frame.ball.position[:, 0]
        play.memory["run"] += np.abs(ball)
        terms["run"] = play.memory["run"][:, None] + play.rng.uniform(0.0, 0.1, (1,))
        return terms, done | (play.rng.uniform(0.0, 1.0) < 0.05)


class KeepsOnSelf(Correct):
    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        vars(self)["steps"] = vars(self).get("steps", 0) + 1
        return super().calculate_reward_and_done(play)


class KeepsInAList(Correct):
    calls: tuple[list[int], ...] = ([],)

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        terms, done = super().calculate_reward_and_done(play)
        self.calls[0].append(1)
        return {"goal": terms["goal"] + np.float32(len(self.calls[0]))}, done


class ReadsOtherWorlds(Correct):
    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        terms, done = super().calculate_reward_and_done(play)
        return {"goal": terms["approach"] - terms["approach"].mean()}, done


class SharesMemory(Correct):
    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        play.memory["run"][:] = play.memory["run"].max()
        return super().calculate_reward_and_done(play)


class EndsAllWhenOneEnds(Correct):
    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        terms, done = super().calculate_reward_and_done(play)
        return terms, np.full_like(done, done.any())


class ObservesTheNumberOfWorlds(Correct):
    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        count = np.full((len(play.frame), len(play.observers), 1), len(play.frame), np.float32)
        return {**super().frame_to_observations(play), "count": count}


class StartsFromNumpyRandom(Correct):
    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        frame = super().get_initial_positions_frame(rng)
        frame.ball.velocity[:, 0] = np.random.uniform(-1, 1, len(rng))  # noqa: NPY002
        return frame


class StartsFromRandom(Correct):
    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        frame = super().get_initial_positions_frame(rng)
        random.random()
        return frame


class StartsFromAFixedSeed(Correct):
    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        frame = super().get_initial_positions_frame(rng)
        frame.ball.velocity[:, 0] = np.random.default_rng(0).uniform(-1, 1, len(rng))
        return frame


class StartsAllAlike(Correct):
    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        frame = super().get_initial_positions_frame(rng)
        frame.rows[:] = frame.rows[0]
        return frame


class KeepsMemoryAfterReset(Correct):
    """Its memory continues from an earlier episode."""

    kept: tuple[dict[int, Array], ...] = ({},)

    def new_memory(self, n: int) -> dict[str, Array]:
        last = self.kept[0].get(n)
        return {"run": np.zeros(n, np.float32) if last is None else last}

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        outcome = super().calculate_reward_and_done(play)
        self.kept[0][len(play.frame)] = play.memory["run"].copy()
        return outcome


class MovesTheBall(Correct):
    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        play.frame.ball.position[:, 0] *= 0.5
        return super().calculate_reward_and_done(play)


class ScalesItsView(Correct):
    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        play.view.robots.data[...] /= 2.0
        return {**super().frame_to_observations(play)}


class ObservesFloat64(Correct):
    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        blocks = super().frame_to_observations(play)
        return {**blocks, "ball": blocks["ball"].astype(np.float64)}


class ObservesNaN(Correct):
    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        blocks = super().frame_to_observations(play)
        return {**blocks, "ball": np.full_like(blocks["ball"], np.nan)}


class RewardsInfinity(Correct):
    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        terms, done = super().calculate_reward_and_done(play)
        return {"goal": terms["goal"] + np.float32(np.inf)}, done


def test_the_base_of_the_faulty_tasks_is_correct() -> None:
    check_task(Correct(), worlds=4, steps=60)


@pytest.mark.parametrize(
    ("faulty", "message"),
    [
        (KeepsOnSelf, "keeps state on self"),
        (KeepsInAList, "differ"),
        (ReadsOtherWorlds, "differ from the same worlds alone"),
        (SharesMemory, "differ from the same worlds alone"),
        (EndsAllWhenOneEnds, "differ from the same worlds alone"),
        (ObservesTheNumberOfWorlds, "differ from the same worlds alone"),
        (StartsFromNumpyRandom, "differ"),
        (StartsFromRandom, "global random numbers"),
        (StartsFromAFixedSeed, r"worlds \[1, 2, 3\] of a batch differ"),
        (StartsAllAlike, r"worlds \[1, 2, 3\] of a batch differ"),
        (KeepsMemoryAfterReset, "differ"),
        (MovesTheBall, "writes into play.frame"),
        (ScalesItsView, "writes into play.frame or play.view"),
        (ObservesFloat64, "'ball' is float64, not float32"),
        (ObservesNaN, "'ball' has NaN"),
        (RewardsInfinity, "'goal' has NaN or infinite"),
    ],
)
def test_a_planted_fault_is_found(faulty: type[Correct], message: str) -> None:
    with pytest.raises(TaskError, match=message):
        check_task(faulty(), worlds=4, steps=60)


def test_a_check_without_an_end_of_an_episode_fails() -> None:
    class Endless(VssSelfPlay):
        def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
            terms, done = super().calculate_reward_and_done(play)
            play.steps[:] = 0
            return terms, np.zeros_like(done)

    with pytest.raises(TaskError, match="no episode ended"):
        check_task(Endless(), worlds=2, steps=20)


def test_one_world_is_too_few() -> None:
    with pytest.raises(ValueError, match="worlds: expected at least 2"):
        check_task(VssSelfPlay(), worlds=1)


def test_the_checked_task_does_not_change() -> None:
    task = Crowd()
    before = dict(vars(task))
    check_task(task, worlds=2, steps=20)
    assert vars(task) == before
