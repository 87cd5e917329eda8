"""`check_task` accepts every task of the package and finds every planted fault."""

import random
from dataclasses import dataclass

import numpy as np
import pytest

import rsoccer
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import Frame
from rsoccer.markers import Marker, Target
from rsoccer.reflection import Reflection, Symmetry, add_blocks
from rsoccer.rng import WorldRng
from rsoccer.task import LEARN, Learn, Play, Task
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


class StopsTheBall(Correct):
    """It writes what is there already, while the ball rests."""

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        play.frame.ball.velocity[:] *= 0
        return super().calculate_reward_and_done(play)


class WritesAtGoals(Correct):
    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        goal = play.frame.ball.crossed > 0
        if goal.any():
            play.frame.ball.position[goal] = 0.0
        return super().calculate_reward_and_done(play)


class ScalesItsView(Correct):
    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        play.view.ego.data[...] /= 2.0
        return super().frame_to_observations(play)


class ScalesTheLastView(Correct):
    def metrics(self, play: Play) -> dict[str, Floats]:
        play.last_view.ball.position[...] *= 1.0
        return super().metrics(play)


class ClipsItsActions(Correct):
    def get_commands(self, play: Play, actions: Floats) -> Floats:
        np.clip(actions, -0.5, 0.5, out=actions)
        return super().get_commands(play, actions)


class SetsTheClock(Correct):
    def metrics(self, play: Play) -> dict[str, Floats]:
        play.steps[:] = 0
        return super().metrics(play)


class CountsInMetrics(Correct):
    def metrics(self, play: Play) -> dict[str, Floats]:
        play.memory["run"] += 1
        return super().metrics(play)


class ReplacesMemoryInObservations(Correct):
    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        play.memory["run"] = play.memory["run"] + np.float32(1.0)
        return super().frame_to_observations(play)


class WidensMemory(Correct):
    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        outcome = super().calculate_reward_and_done(play)
        play.memory["run"] = play.memory["run"].astype(np.float64)
        return outcome


class AddsMemory(Correct):
    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        play.memory["best"] = play.frame.ball.position[:, 0].copy()
        return super().calculate_reward_and_done(play)


class ForgetsTheWorldsOfItsMemory(Correct):
    def new_memory(self, n: int) -> dict[str, Array]:
        return {"run": np.zeros(3, np.float32)}


class RemembersObjects(Correct):
    def new_memory(self, n: int) -> dict[str, Array]:
        return super().new_memory(n) | {"names": np.array(["a"] * n, np.object_)}


class NumbersItsMemory(Correct):
    def new_memory(self, n: int) -> dict[str, Array]:
        return {"run": np.arange(n, dtype=np.float32)}


class StartsByItsPlace(Correct):
    def start_episode(self, play: Play) -> None:
        play.memory["run"][:] = np.arange(len(play.frame))


class ObservesFloat64(Correct):
    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        blocks = super().frame_to_observations(play)
        return {**blocks, "ball": blocks["ball"].astype(np.float64)}


class ObservesNaN(Correct):
    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        blocks = super().frame_to_observations(play)
        return {**blocks, "ball": np.full_like(blocks["ball"], np.nan)}


class NormalizesOverObservers(Correct):
    """The norm over the wrong axis; all observers together give one number."""

    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        blocks = super().frame_to_observations(play)
        scale = np.linalg.norm(play.view.ball.position, axis=1, keepdims=True)
        return blocks | {"ball": blocks["ball"] / np.float32(1.0 + scale.max())}


class ObservesAnotherRobot(Correct):
    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        blocks = super().frame_to_observations(play)
        return blocks | {"ego": np.roll(blocks["ego"], 1, axis=1)}


class AddsNoisePerObserver(Correct):
    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        blocks = super().frame_to_observations(play)
        noise = play.rng.normal((len(play.observers), 1))
        return blocks | {"noise": noise}


class SharesRewardsAmongObservers(Correct):
    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        terms, done = super().calculate_reward_and_done(play)
        return terms | {"approach": terms["approach"].mean(axis=1, keepdims=True)}, done


class NeedsAllObservers(Correct):
    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        terms, done = super().calculate_reward_and_done(play)
        play.view.ego.position[:, 5]
        return terms, done


class ObservesMillimeters(Correct):
    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        blocks = super().frame_to_observations(play)
        return blocks | {"ball_mm": play.sensed_view.ball.position * np.float32(1000.0)}


class ChangesItsBlocks(Correct):
    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        blocks = super().frame_to_observations(play)
        if play.steps.any():
            del blocks["ball"]
        return blocks


class RewardsInfinity(Correct):
    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        terms, done = super().calculate_reward_and_done(play)
        return {"goal": terms["goal"] + np.float32(np.inf)}, done


class RewardsFromNumpyRandom(Correct):
    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        terms, done = super().calculate_reward_and_done(play)
        noise = np.random.uniform(0, 1, terms["goal"].shape).astype(np.float32)  # noqa: NPY002
        return {"goal": terms["goal"] + noise}, done


class RewardsFromAnUnseededGenerator(Correct):
    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        terms, done = super().calculate_reward_and_done(play)
        noise = np.random.default_rng().uniform(0, 1, terms["goal"].shape).astype(np.float32)
        return {"goal": terms["goal"] + noise}, done


class RewardsAllWorldsAlike(Correct):
    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        terms, done = super().calculate_reward_and_done(play)
        return {"goal": terms["goal"] + play.rng.uniform(0.0, 1.0)[0]}, done


class DrawsForNeighbors(Correct):
    """All worlds draw again where one of them is lucky."""

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        outcome = super().calculate_reward_and_done(play)
        if (play.rng.uniform(0.0, 1.0) < 0.5).any():
            play.rng.uniform(0.0, 1.0)
        return outcome


class MarksAtRandom(Correct):
    def markers(self, play: Play, world: int) -> tuple[Marker, ...]:
        x = float(play.rng.uniform(-0.5, 0.5)[world])
        return (Target((x, 0.0), 0.1),)


class MarksTheFirstWorld(Correct):
    def markers(self, play: Play, world: int) -> tuple[Marker, ...]:
        x, y = play.frame.ball.position[0].tolist()
        return (Target((x, y), 0.1),)


class MeasuresOneNumber(Correct):
    def metrics(self, play: Play) -> dict[str, Floats]:
        return super().metrics(play) | {"speed": np.abs(play.frame.ball.velocity).max()}


class MeasuresTheMean(Correct):
    def metrics(self, play: Play) -> dict[str, Floats]:
        x = play.frame.ball.position[:, 0]
        return super().metrics(play) | {"x": np.full_like(x, x.mean())}


class ForgetsItsSuccess(Correct):
    def metrics(self, play: Play) -> dict[str, Floats]:
        return {}


class CommandsTheMean(Correct):
    def get_commands(self, play: Play, actions: Floats) -> Floats:
        commands = super().get_commands(play, actions)
        return np.broadcast_to(commands.mean(axis=0), commands.shape).astype(np.float32)


class CommandsNaN(Correct):
    def get_commands(self, play: Play, actions: Floats) -> Floats:
        with np.errstate(all="ignore"):
            return super().get_commands(play, actions) / np.float32(0.0) * np.float32(0.0)


class StartsEveryEpisodeAlike(Correct):
    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        return super().get_initial_positions_frame(rng.split("positions"))


class ForgetsARobot(Correct):
    def default_controllers(self) -> dict[str, str | Learn]:
        return dict.fromkeys(self.robots[:-1], LEARN)


class ClaimsToBeSymmetric(Correct):
    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        terms, done = super().calculate_reward_and_done(play)
        return terms | {"left": play.frame.ball.position[:, 1:].copy()}, done


class ReflectsABlockWrongly(Correct):
    @property
    def symmetry(self) -> Symmetry | None:
        return add_blocks(super().symmetry, ball=Reflection.of([1, 1, 1, 1]))


class ReflectsActionsWrongly(Correct):
    ACTION_REFLECTION = Reflection.of([1, -1])


class ObservesTheTruth(Correct):
    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        return super().frame_to_observations(play) | {"x": play.view.ball.position[..., :1] * 1.0}


class CommandsByTheTruth(Correct):
    def get_commands(self, play: Play, actions: Floats) -> Floats:
        return super().get_commands(play, actions) * play.frame.robots.heading[..., :1]


class RewardsTheSenses(Correct):
    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        terms, done = super().calculate_reward_and_done(play)
        return terms | {"x": play.sensed.ball.position[:, :1].copy()}, done


class ScoresInRewards(Correct):
    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        play.game.score[:, 0] += 1
        return super().calculate_reward_and_done(play)


EPISODES: list[int] = []


class StartsByTheModule(Correct):
    """Its starts depend on a list of the module, which only another method changes."""

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        frame = super().get_initial_positions_frame(rng)
        frame.ball.velocity[:, 0] = 0.001 * len(EPISODES)
        return frame

    def start_episode(self, play: Play) -> None:
        EPISODES.append(1)


def test_the_base_of_the_faulty_tasks_is_correct() -> None:
    check_task(Correct(), worlds=4, steps=60)


class HasRowsOfThreeNumbers(Correct):
    action_table = np.ones((3, 3), np.float32)


class HasWholeNumbersAsActions(Correct):
    action_table = np.ones((3, 2), np.int64)


class HasActionsThatAreTooLarge(Correct):
    action_table = np.full((3, 2), 1.5, np.float32)


class LimitsABlockThatItDoesNotHave(Correct):
    def observation_limits(self) -> dict[str, float]:
        return {**super().observation_limits(), "bal": 3.0}


@pytest.mark.parametrize(
    ("faulty", "message"),
    [
        (
            HasRowsOfThreeNumbers,
            r"Numbers\.action_table: expected numbers \(choices, 2\)",
        ),
        (HasWholeNumbersAsActions, "action_table: expected float32 numbers, got int"),
        (HasActionsThatAreTooLarge, "action_table: expected numbers .* from -1 to 1"),
        (LimitsABlockThatItDoesNotHave, r"observation_limits: expected names of .*\['bal'\]"),
        (KeepsOnSelf, "calculate_reward_and_done keeps state on self, in steps"),
        (KeepsInAList, r"calculate_reward_and_done keeps state on self, in KeepsInAList\.calls"),
        (ReadsOtherWorlds, "calculate_reward_and_done: 'goal' of worlds .* differ from the same"),
        (SharesMemory, "calculate_reward_and_done: play.memory.*'run'.* worlds .* differ from"),
        (EndsAllWhenOneEnds, "calculate_reward_and_done: 'end of episodes' of worlds"),
        (ObservesTheNumberOfWorlds, "frame_to_observations: 'count' of worlds .* differ from"),
        (StartsFromNumpyRandom, "get_initial_positions_frame draws global .* numpy.random"),
        (StartsFromRandom, "get_initial_positions_frame draws global random numbers of random "),
        (StartsFromAFixedSeed, r"get_initial_positions_frame: 'frame' of worlds \[1, 2, 3\]"),
        (StartsAllAlike, r"get_initial_positions_frame: 'frame' of worlds \[1, 2, 3\]"),
        (StartsEveryEpisodeAlike, "every episode of a world starts alike"),
        (KeepsMemoryAfterReset, r"keeps state on self, in KeepsMemoryAfterReset\.kept"),
        (StopsTheBall, "calculate_reward_and_done: it writes into play.frame, which"),
        (WritesAtGoals, "calculate_reward_and_done: it writes into play.frame, which"),
        (ScalesItsView, "frame_to_observations: .*read-only"),
        (ScalesTheLastView, "metrics: it writes into play.last_view, which"),
        (ClipsItsActions, "get_commands: it writes into play.actions, which"),
        (SetsTheClock, "metrics: it writes into play.steps, which"),
        (CountsInMetrics, "metrics: it writes into play.memory, which"),
        (ReplacesMemoryInObservations, "frame_to_observations: it replaces play.memory.*'run'"),
        (WidensMemory, "calculate_reward_and_done: play.memory.*'run'.* becomes float64"),
        (AddsMemory, "calculate_reward_and_done: .* other names than new_memory: .*'best'"),
        (ForgetsTheWorldsOfItsMemory, r"new_memory: expected \(4, ...\) for 'run'"),
        (RemembersObjects, "new_memory: 'names' holds objects"),
        (NumbersItsMemory, r"new_memory: 'run' of worlds \[1, 2, 3\]"),
        (StartsByItsPlace, "start_episode: play.memory.*'run'.* of worlds"),
        (ObservesFloat64, "frame_to_observations: 'ball' is float64, not float32"),
        (ObservesNaN, "frame_to_observations: 'ball' has NaN"),
        (
            ObservesMillimeters,
            "observation_limits: a number of 'ball_mm' is beyond its limit of 10",
        ),
        (ChangesItsBlocks, "frame_to_observations: it returns other blocks than at first.*'ball'"),
        (NormalizesOverObservers, "frame_to_observations: 'ball' of blue_0 depends on which"),
        (ObservesAnotherRobot, "frame_to_observations: 'ego' of blue_0 depends on which"),
        (AddsNoisePerObserver, "frame_to_observations: .* of blue_0 depends on which"),
        (SharesRewardsAmongObservers, "calculate_reward_and_done: 'approach' of blue_0 depends on"),
        (NeedsAllObservers, "calculate_reward_and_done: IndexError: .*blue_0 alone observes"),
        (RewardsInfinity, "calculate_reward_and_done: 'goal' has NaN or infinite"),
        (RewardsFromNumpyRandom, "calculate_reward_and_done draws global .* of numpy.random"),
        (RewardsFromAnUnseededGenerator, "calculate_reward_and_done: 'goal' differ between two"),
        (RewardsAllWorldsAlike, r"calculate_reward_and_done: 'goal' of worlds \[1, 2, 3\]"),
        (DrawsForNeighbors, "calculate_reward_and_done: random stream of worlds"),
        (MarksAtRandom, "markers: it draws from play.rng"),
        (MarksTheFirstWorld, "markers: 'markers' of worlds"),
        (MeasuresOneNumber, "metrics: 'speed' is float32, not an array"),
        (MeasuresTheMean, "metrics: 'x' of worlds"),
        (ForgetsItsSuccess, "metrics: it lacks the metric 'goal_score'"),
        (CommandsTheMean, "get_commands: 'commands' of worlds"),
        (CommandsNaN, "get_commands: 'commands' has NaN"),
        (ForgetsARobot, "default_controllers: expected a controller for each of .*yellow_2"),
        (ClaimsToBeSymmetric, "symmetry: the reward term 'left'"),
        (ReflectsABlockWrongly, "symmetry.blocks: block 'ball'"),
        (ReflectsActionsWrongly, "symmetry.action: the states that follow"),
        (ObservesTheTruth, "frame_to_observations: 'x': it reads the true state; robots know"),
        (CommandsByTheTruth, "get_commands: 'commands': it reads the true state; robots know"),
        (RewardsTheSenses, "calculate_reward_and_done: 'x': it reads what robots sense instead"),
        (ScoresInRewards, "calculate_reward_and_done: it writes into play.game, which"),
        (StartsByTheModule, "differ from the same worlds alone"),
    ],
)
def test_a_planted_fault_is_found(faulty: type[Correct], message: str) -> None:
    with pytest.raises(TaskError, match=message):
        check_task(faulty(), worlds=4, steps=60)


def test_a_check_without_an_end_of_an_episode_fails() -> None:
    class Endless(VssSelfPlay):
        max_steps = property(lambda self: 10_000)

        def __init__(self) -> None:
            vars(self).update(vars(VssSelfPlay()))

        def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
            terms, done = super().calculate_reward_and_done(play)
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
