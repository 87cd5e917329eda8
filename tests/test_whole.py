"""What a failed call leaves: refused input nothing changed, a failure half way torn matches."""

import copy
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Literal

import gymnasium
import numpy as np
import pytest
from numpy.typing import NDArray

from rsoccer import Matches, Simulator
from rsoccer.frame import Array, Floats, Frame, Mask
from rsoccer.parallel import SoccerParallelEnv, env
from rsoccer.policies.base import Memory, Policy, Seen
from rsoccer.rng import WorldRng
from rsoccer.single import SoccerEnv
from rsoccer.task import LEARN, Play
from rsoccer.vector import SoccerVectorEnv
from tests.helpers import Crowd, pushing, same, zeros

METHODS = (
    "get_commands",
    "reposition_ball",
    "calculate_reward_and_done",
    "frame_to_observations",
    "metrics",
    "new_memory",
    "get_initial_positions_frame",
)


class Broken(Exception):
    """What fails here."""


@dataclass
class Fuse:
    """Says when what fails: the name of a method, or of what stands in for it."""

    armed: str = ""

    def burn(self, name: str) -> None:
        if name == self.armed:
            self.armed = ""  # once
            raise Broken(f"{name} fails")


@dataclass(frozen=True)
class Fragile(Crowd):
    """A crowd with memory and chance, of which any method fails when it is told to."""

    max_steps: int = 12
    fuse: Fuse = field(default_factory=Fuse)

    def new_memory(self, n: int) -> dict[str, Array]:
        self.fuse.burn("new_memory")
        return {"count": np.zeros(n, np.int64)}

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        frame = super().get_initial_positions_frame(rng)
        self.fuse.burn("get_initial_positions_frame")
        return frame

    def get_commands(self, play: Play, actions: Floats) -> Floats:
        self.fuse.burn("get_commands")
        return super().get_commands(play, actions)

    def reposition_ball(self, frame: Frame) -> tuple[NDArray[np.intp], Floats] | None:
        self.fuse.burn("reposition_ball")
        return None

    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        self.fuse.burn("frame_to_observations")
        return super().frame_to_observations(play)

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        play.memory["count"] += 1
        self.fuse.burn("calculate_reward_and_done")
        terms, done = super().calculate_reward_and_done(play)
        return terms, done | (play.rng.uniform(0.0, 1.0) < 0.05)

    def metrics(self, play: Play) -> dict[str, Floats]:
        self.fuse.burn("metrics")
        return super().metrics(play)


class FragilePolicy(Policy):
    """Draws, counts, and fails when it is told to."""

    observes: Literal["nothing", "view", "observation"] = "view"

    def __init__(self, fuse: Fuse) -> None:
        super().__init__()
        self._fuse = fuse

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        return {"drawn": np.zeros((shape[0], 1), np.float32)}

    def act(self, seen: Seen, rng: WorldRng, memory: Memory) -> Floats:
        memory["drawn"] += rng.uniform(0.0, 1.0, (1,))
        self._fuse.burn("policy")
        return rng.uniform(-1.0, 1.0, seen.shape[1:])


class FragileSimulator:
    """The simulator, of which world 1 is lost when it is told so; the others have stepped."""

    def __init__(self, task: Fragile, worlds: int) -> None:
        self._own, self._fuse = Simulator(task.config, worlds), task.fuse
        self.place, self.reposition_balls = self._own.place, self._own.reposition_balls
        self.snapshot, self.restore = self._own.snapshot, self._own.restore

    def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> None:
        self._own.step(commands, out, active)
        self._fuse.burn("simulator")


def fragile(worlds: int = 4, autoreset: str = "same_step") -> tuple[Matches, Fuse]:
    """Matches under way, and what makes them fail."""
    task = Fragile()
    matches = Matches(
        task,
        worlds,
        seed=3,
        controllers={"yellow": FragilePolicy(task.fuse)},
        autoreset=autoreset,
        simulator=FragileSimulator(task, worlds),
    )
    matches.reset()
    rng = np.random.default_rng(0)
    for _ in range(7):
        matches.step(pushing(rng, matches))
    return matches, task.fuse


def equal(a: dict[str, Array], b: dict[str, Array]) -> bool:
    """Two saved states in every bit."""
    return a.keys() == b.keys() and all(same(a[name], b[name]) for name in a)


def goes_on_alike(ours: Matches, theirs: Matches) -> None:
    rng = np.random.default_rng(1)
    ended = 0
    for _ in range(30):
        actions = pushing(rng, ours)
        one, other = ours.step(actions), theirs.step(actions)
        assert same(one.observations, other.observations)
        assert same(one.rewards, other.rewards)
        ended += int(one.ended.sum())
    assert ended, "restarts were not compared"
    assert equal(ours.state_dict(), theirs.state_dict())


@pytest.mark.parametrize("autoreset", ["same_step", "next_step", "disabled"])
def test_refused_input_changes_not_a_bit(autoreset: str) -> None:
    matches, _ = fragile(autoreset=autoreset)
    before, fine = matches.state_dict(), zeros(matches)
    row = matches.frame.rows[:1].copy()
    outside = row.copy()
    outside[:, 0] = 9.0
    one, nan = np.array([True, False, False, False]), np.full_like(fine, np.nan)
    refused: list[Callable[[], object]] = [
        *(
            lambda wrong=wrong: matches.step(wrong)
            for wrong in (fine[1:], nan, fine.astype(int), None)
        ),
        lambda: matches.reset(seed=-1),
        lambda: matches.reset(seed=[1]),
        lambda: matches.reset(mask=np.ones(3, np.bool_)),
        lambda: matches.reset(5, one, row[:, 1:]),
        lambda: matches.reset(5, one, outside),
        lambda: matches.reset(5, rows=np.tile(outside, (4, 1))),
        lambda: matches.load_state_dict({}),
        lambda: matches.load_state_dict({**before, "simulator": before["simulator"][:-1]}),
    ]
    for call in refused:
        with pytest.raises((TypeError, ValueError)):
            call()
        assert equal(matches.state_dict(), before)
    control, _ = fragile(autoreset=autoreset)
    goes_on_alike(matches, control) if autoreset != "disabled" else matches.step(fine)


@pytest.mark.parametrize("what", [*METHODS[:5], "policy", "simulator"])
def test_after_a_failed_step_nothing_goes_on_until_it_is_mended(what: str) -> None:
    """Some parts had moved on and others had not, and the next step went on from there."""
    matches, fuse = fragile()
    kept = matches.state_dict()
    fuse.armed = what
    with pytest.raises(Broken, match=what):
        matches.step(zeros(matches))
    some = np.array([True, True, False, True])
    calls: list[Callable[[], object]] = [
        lambda: matches.step(zeros(matches)),
        lambda: matches.reset(mask=some),
        lambda: matches.reset(seed=3, mask=some),
        matches.state_dict,
    ]
    for call in calls:
        with pytest.raises(RuntimeError, match=rf"step 8 failed with Broken: {what} fails; reset"):
            call()
    matches.load_state_dict(kept)
    control, _ = fragile()
    goes_on_alike(matches, control)


@pytest.mark.parametrize("what", [*METHODS[:5], "policy", "simulator"])
def test_after_a_failed_step_a_reset_of_all_is_as_a_fresh_start(what: str) -> None:
    matches, fuse = fragile()
    fuse.armed = what
    with pytest.raises(Broken):
        matches.step(zeros(matches))
    fresh, _ = fragile()
    assert same(matches.reset(11), fresh.reset(11))
    goes_on_alike(matches, fresh)
    matches.reset(mask=np.array([True, False, False, True]))


@pytest.mark.parametrize("what", ["new_memory", "get_initial_positions_frame"])
def test_a_reset_that_fails_before_anything_is_placed_changes_nothing(what: str) -> None:
    for mask in (None, np.array([True, False, False, False])):
        matches, fuse = fragile()
        before = matches.state_dict()
        fuse.armed = what
        with pytest.raises(Broken):
            matches.reset(mask=mask)
        assert equal(matches.state_dict(), before)
        goes_on_alike(matches, fragile()[0])


def test_a_reset_that_fails_later_tears_the_matches_too() -> None:
    matches, fuse = fragile()
    fuse.armed = "frame_to_observations"
    with pytest.raises(Broken):
        matches.reset(mask=np.array([True, False, False, False]))
    with pytest.raises(RuntimeError, match="reset failed with Broken: frame_to_observations fails"):
        matches.step(zeros(matches))
    assert same(matches.reset(4), fragile()[0].reset(4))


def test_a_start_within_a_step_that_fails_tears_the_matches() -> None:
    matches, fuse = fragile()
    matches.play.steps[2] = matches.task.max_steps
    fuse.armed = "get_initial_positions_frame"
    with pytest.raises(Broken):
        matches.step(zeros(matches))
    with pytest.raises(RuntimeError, match="step 8 failed"):
        matches.step(zeros(matches))


def test_a_refused_reset_of_torn_matches_mends_nothing() -> None:
    matches, fuse = fragile()
    fuse.armed = "metrics"
    with pytest.raises(Broken):
        matches.step(zeros(matches))
    outside = matches.frame.rows.copy()
    outside[:, 0] = 9.0
    with pytest.raises(ValueError, match="outside"):
        matches.reset(rows=outside)
    with pytest.raises(RuntimeError, match="step 8 failed"):
        matches.step(zeros(matches))


def test_an_interrupt_in_the_middle_of_a_step_tears_the_matches() -> None:
    class Interrupted(Fragile):
        def metrics(self, play: Play) -> dict[str, Floats]:
            raise KeyboardInterrupt

    matches = Matches(Interrupted())
    matches.reset()
    with pytest.raises(KeyboardInterrupt):
        matches.step(zeros(matches))
    with pytest.raises(RuntimeError, match="step 1 failed with KeyboardInterrupt"):
        matches.step(zeros(matches))


# -- The environments -------------------------------------------------------------------------

Door = Callable[[Fragile], tuple[Any, Callable[[Any], object]]]


def single(task: Fragile) -> tuple[Any, Callable[[Any], object]]:
    made: gymnasium.Env[Any, Any] = SoccerEnv(task, controllers={"all": "ou", "blue_0": LEARN})
    return made, lambda env: env.step(np.zeros(2, np.float32))


def vector(task: Fragile) -> tuple[Any, Callable[[Any], object]]:
    made = SoccerVectorEnv(task, 3, controllers={"all": "ou", "blue_0": LEARN})
    return made, lambda env: env.step(np.zeros((3, 2), np.float32))


def parallel(task: Fragile) -> tuple[Any, Callable[[Any], object]]:
    still = np.zeros(2, np.float32)
    return SoccerParallelEnv(task), lambda env: env.step(dict.fromkeys(env.agents, still))


@pytest.mark.parametrize("door", [single, vector, parallel])
@pytest.mark.parametrize("what", ["get_commands", "calculate_reward_and_done"])
def test_every_environment_says_what_failed_and_a_reset_mends_it(door: Door, what: str) -> None:
    task = Fragile()
    made, step = door(task)
    other, _ = door(Fragile())
    made.reset(seed=3)
    step(made)
    task.fuse.armed = what
    with pytest.raises(Broken):
        step(made)
    calls: list[Callable[[], object]] = [lambda: step(made), lambda: copy.deepcopy(made)]
    for call in calls:
        with pytest.raises(RuntimeError, match=rf"step 2 failed with Broken: {what} fails"):
            call()
    made.reset(seed=1)
    other.reset(seed=1)
    for _ in range(3):
        step(made)
        step(other)
    assert same(made._matches.frame.rows, other._matches.frame.rows)


def test_some_of_torn_vector_matches_cannot_be_reset() -> None:
    task = Fragile()
    made, step = vector(task)
    made.reset(seed=3)
    task.fuse.armed = "metrics"
    with pytest.raises(Broken):
        step(made)
    with pytest.raises(RuntimeError, match="step 1 failed"):
        made.reset(options={"reset_mask": np.array([True, False, False])})
    made.reset()
    step(made)


def test_turn_by_turn_too_a_reset_mends_it(monkeypatch: pytest.MonkeyPatch) -> None:
    turns = env("VSSSelfPlay-v0")
    turns.reset(seed=0)
    with monkeypatch.context() as patch:
        fails = lambda task, play: (_ for _ in ()).throw(Broken("metrics fails"))  # noqa: E731
        patch.setattr("rsoccer.tasks.vss.Vss.metrics", fails)
        with pytest.raises(Broken):
            for _ in range(6):
                turns.step(np.zeros(2, np.float32))
    turns.reset(seed=0)
    for _ in range(12):
        turns.step(np.zeros(2, np.float32))
