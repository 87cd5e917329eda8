from dataclasses import dataclass

import numpy as np
import pytest

from rsoccer.arrays import Array, Floats
from rsoccer.frame import Frame
from rsoccer.matches import Matches
from rsoccer.observation_layout import DEFAULT_LIMIT
from rsoccer.rng import WorldRng
from rsoccer.task import LEARN, Play, Task
from rsoccer.tasks import VssMulti, VssSelfPlay


@dataclass(frozen=True)
class Unbounded(VssSelfPlay):
    """Task with observations beyond all limits."""

    def observation_limits(self) -> dict[str, float]:
        return super().observation_limits() | {"bounded": 0.5}

    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        shape = (len(play.frame), len(play.observers), 2, 3)
        values = np.full(shape, 1e9, np.float32) * np.array([-1.0, 1.0, 0.0], np.float32)
        return {"bounded": values[..., 0], "unbounded": values}


def played(task: Task, worlds: int = 4) -> Play:
    matches = Matches(task, worlds, seed=1)
    matches.reset()
    matches.step(np.full((worlds, len(matches.agents), 2), 0.5, np.float32))
    return matches.play


def test_blocks_give_the_columns_of_the_flat_observation() -> None:
    task = VssSelfPlay()
    play = played(task)
    flat = task.layout.observe(play)
    assert flat.shape == (4, 6, task.layout.size)
    named = task.frame_to_observations(play)
    assert list(named) == list(task.layout.blocks)
    for name, block in task.layout.blocks.items():
        assert named[name].shape[2:] == block.shape
        part = flat[:, :, block.columns].reshape(4, 6, *block.shape)
        assert np.allclose(part, named[name], atol=1e-6), name
    assert sum(block.size for block in task.layout.blocks.values()) == flat.shape[2]


def test_observations_stay_within_limits() -> None:
    task = Unbounded()
    flat = task.layout.observe(played(task))
    assert (flat[..., :2] == [-0.5, -0.5]).all()
    assert set(flat[..., 2:].ravel().tolist()) == {-DEFAULT_LIMIT, DEFAULT_LIMIT, 0.0}
    assert task.layout.high.tolist() == [0.5] * 2 + [DEFAULT_LIMIT] * 6
    assert (task.layout.low == -task.layout.high).all()
    assert task.layout.high.dtype == np.float32


def test_the_first_axis_of_memory_must_be_worlds() -> None:
    class WrongMemory(VssSelfPlay):
        def new_memory(self, n: int) -> dict[str, Array]:
            return {"passes": np.zeros(3)}

    with pytest.raises(ValueError, match=r"new_memory: expected \(1, ...\) for 'passes'"):
        Matches(WrongMemory(), 5)  # with 1 world, for the sizes of the observation


def test_agents_are_the_robots_that_learn() -> None:
    assert VssSelfPlay(n_blue=2, n_yellow=1).agents == ("blue_0", "blue_1", "yellow_0")
    task = VssMulti(n_blue=2, n_yellow=1)
    assert task.agents == ("blue_0", "blue_1")
    assert task.default_controllers() == {"blue_0": LEARN, "blue_1": LEARN, "yellow_0": "ou"}


def test_worlds_of_a_play_can_be_copied_and_restored() -> None:
    play = played(VssSelfPlay(), 5)
    play.memory["count"] = np.arange(5)
    worlds = np.array([0, 3])
    part = play.take(worlds)
    rows, steps = play.frame.rows.copy(), play.steps.copy()
    assert part.memory["count"].tolist() == [0, 3]
    play.frame.rows[:] = 0.0
    play.steps[:] = 99
    play.memory["count"][:] = -1
    play.rng.uniform(0.0, 1.0)
    play.put(worlds, part)
    assert (play.frame.rows[worlds] == rows[worlds]).all()
    assert (play.rng[worlds].state == part.rng.state).all()
    assert play.steps.tolist() == [steps[0], 99, 99, steps[3], 99]
    assert play.memory["count"].tolist() == [0, -1, -1, 3, -1]


def test_advance_swaps_the_current_and_the_last_frame() -> None:
    play = played(VssSelfPlay())
    current, last = play.frame, play.last_frame
    play.advance()
    assert play.frame is last
    assert play.last_frame is current


def test_a_task_without_an_abstract_method_cannot_be_created() -> None:
    class Incomplete(Task):
        def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
            return Frame.empty(len(rng), 1, 1)

    with pytest.raises(TypeError, match="abstract"):
        Incomplete()  # type: ignore[abstract]
