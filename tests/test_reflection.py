"""With left and right swapped, every task is the same match.

This symmetry also holds for tasks in which one team learns. `test_symmetry.py` rotates the field by
half a turn and swaps the teams, for tasks in which both may learn.
"""

from dataclasses import dataclass, replace

import numpy as np
import pytest

import rsoccer
from rsoccer import LEARN, Frame, Matches
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.global_state import StateEncoder
from rsoccer.reflection import Reflection, Symmetry, add_blocks
from rsoccer.task import Play, Task
from rsoccer.tasks import SslDribbling, VssMatch, VssSelfPlay
from rsoccer.tasks.courses import PAPER, Course
from rsoccer.testing.reflection_check import reflected
from tests.games import begin_play
from tests.helpers import same
from tests.parallel_matches import TASKS

WORLDS, STEPS = 40, 12
WALL = 0.06  # distance of a VSSS robot's center from a wall that it may touch, m


class ReversedDribbling(SslDribbling):
    """The course with its gates in the opposite direction, as in a mirror."""

    @property
    def course(self) -> Course:
        return replace(
            PAPER, gates=tuple((first, last, -direction) for first, last, direction in PAPER.gates)
        )


def mirrored(task: Task) -> Task:
    return ReversedDribbling() if isinstance(task, SslDribbling) else task


def reflected_actions(actions: Floats) -> Floats:
    """Actions with left and right swapped: wheels, or lateral velocity and angular velocity."""
    if actions.shape[-1] == 2:
        return np.ascontiguousarray(actions[..., ::-1])
    return actions * np.array([1, -1, -1, 1, 1, 1], np.float32)[: actions.shape[-1]]


def first_rows(task: Task) -> Floats | None:
    """Initial states; None for the task's own. Matches of VSSS robots line up at walls."""
    if not isinstance(task, VssMatch):
        return None
    return VssSelfPlay().get_initial_positions_frame(rsoccer.WorldRng.seeded(1, WORLDS)).rows


def free_of_contact(frame: Frame, task: Task) -> Mask:
    """(n,) worlds in which no square robot can touch a wall or a robot: solvers round there."""
    if task.config.robot.has_mouth:
        return np.ones(len(frame), np.bool_)
    field, robots = task.config.field, frame.robots
    bound = np.array([field.half_length, field.half_width]) - WALL
    inside = (np.abs(robots.position) < bound).all(axis=(1, 2))
    met = (robots.touched_ball + robots.collision_speed).any(axis=1)
    return np.logical_and(inside, ~met)


def signs(original: Array, reflection: Array) -> Array:
    """(o,) 1 for numbers that reflection keeps, -1 for those that change sign, 0 for others."""
    kept, negated = (original == reflection).all(axis=0), (original == -reflection).all(axis=0)
    return np.where(kept, 1, np.where(negated, -1, 0))


@pytest.mark.parametrize("name", TASKS)
def test_the_reflected_match_is_the_same(name: str) -> None:
    task = rsoccer.make_task(name)
    ours, theirs = (
        Matches(each, WORLDS, seed=1, controllers={"all": LEARN}, autoreset="disabled")
        for each in (task, mirrored(task))
    )
    ours.reset(rows=first_rows(task))
    theirs.reset(rows=reflected(ours.frame).rows)
    for matches in (ours, theirs):
        begin_play(matches)
    rng, playing = np.random.default_rng(0), np.ones(WORLDS, np.bool_)
    shape = (WORLDS, len(ours.agents), ours.action_size)
    observed: list[list[Floats]] = [[], []]
    for _ in range(STEPS):
        playing &= free_of_contact(ours.frame, task)
        actions = rng.uniform(-0.6, 0.6, shape).astype(np.float32)
        a, b = ours.step(actions), theirs.step(reflected_actions(actions))
        playing &= free_of_contact(ours.frame, task)
        # Adding 0 turns -0 into 0, so equal numbers are equal in every bit.
        assert same(reflected(ours.frame).rows[playing] + 0, theirs.frame.rows[playing] + 0)
        for each in ("rewards", "terminated", "truncated"):
            assert same(getattr(a, each)[playing] + 0, getattr(b, each)[playing] + 0)
        for metric, value in a.metrics.items():
            assert same(value[playing], b.metrics[metric][playing])
        for kept, outcome in zip(observed, (a, b), strict=True):
            kept.append(outcome.final_observations[playing].reshape(-1, ours.observation_size))
        playing &= ~a.ended
    assert playing.sum() > WORLDS / 2, "too few worlds were compared to the end"
    here, there = (np.concatenate(each) for each in observed)
    action = task.layout.blocks["action"].columns
    assert same(reflected_actions(here[:, action]) + 0, there[:, action] + 0)
    reflection = task.layout.reflection
    if reflection is not None:
        assert same(reflection.apply(here) + 0, there + 0)
        assert same(reflection.apply(reflection.apply(here)), here)
        assert task.symmetry is not None
        assert same(task.symmetry.action.apply(actions), reflected_actions(actions))
    found = np.delete(signs(here, there), action)
    assert found.all(), "some numbers are neither kept nor negated"
    assert {-1, 1} == set(found.tolist())


def test_all_tasks_but_the_slalom_are_symmetric() -> None:
    layouts = {name: rsoccer.make_task(name).layout for name in TASKS}
    asymmetric = [name for name, layout in layouts.items() if layout.reflection is None]
    assert asymmetric == ["SSLDribbling-v0"]


def test_a_task_with_an_unknown_block_is_not_symmetric() -> None:
    @dataclass(frozen=True)
    class Noted(VssSelfPlay):
        def frame_to_observations(self, play: Play) -> dict[str, Floats]:
            blocks = super().frame_to_observations(play)
            return {**blocks, "note": np.ones_like(blocks["action"])}

    assert VssSelfPlay().layout.reflection is not None
    assert Noted().layout.reflection is None

    @dataclass(frozen=True)
    class Known(Noted):
        @property
        def symmetry(self) -> Symmetry | None:
            return add_blocks(super().symmetry, note=Reflection.of([1, 1]))

    assert Known().layout.reflection is not None
    assert add_blocks(None, note=Reflection.of([1, 1])) is None


def test_the_reflected_state_is_the_state_of_the_reflected_match() -> None:
    for name in ("VSSSelfPlay-v0", "SSLSelfPlay-v0"):
        task = rsoccer.make_task(name)
        encoder = StateEncoder(task.config)
        matches = Matches(task, 4, seed=1, controllers={"all": "uniform"})
        matches.reset()
        for _ in range(10):
            matches.step(np.zeros((4, 0, task.action_size), np.float32))
        states = encoder.encode(matches.frame.rows)
        expected = encoder.encode(reflected(matches.frame).rows)
        assert same(encoder.reflection.apply(states) + 0, expected + 0)
        assert not same(states, expected)


def test_an_asymmetric_task_would_be_found() -> None:
    """The original course in a mirror: the direction of its gates is wrong there."""
    task = SslDribbling()
    assert task.course.gates != mirrored(task).course.gates  # type: ignore[attr-defined]
    frame = task.get_initial_positions_frame(rsoccer.WorldRng.seeded(0, 1))
    frame.ball.position[0], frame.ball.velocity[0] = (-0.75, 0.1), (0.0, -1.0)
    gates = []
    for each in (task, mirrored(task)):
        matches = Matches(each, 1, autoreset="disabled")
        matches.reset(rows=reflected(frame).rows)
        for _ in range(12):
            outcome = matches.step(np.zeros((1, 1, 5), np.float32))
            if outcome.ended[0]:
                break
        gates.append((float(outcome.metrics["gates"][0]), bool(outcome.terminated[0])))
    assert gates == [(0.0, True), (1.0, False)]
