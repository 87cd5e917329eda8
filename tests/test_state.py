import numpy as np
import pytest

from rsoccer import SimConfig
from rsoccer.frame import Frame
from rsoccer.parallel import parallel_env
from rsoccer.state import LIMIT, StateScale
from tests.one_match import SELF_PLAY, shot_at


def test_the_state_is_the_scaled_frame() -> None:
    match = parallel_env(SELF_PLAY)
    row = shot_at(-1)
    match.reset(seed=0, options={"frame": row})
    state = match.state()
    assert state.shape == (4 + 6 * 7,)
    assert state[:4] == pytest.approx(
        [-0.6 / 0.75, 0.0, -1.0 / match.task.config.robot.top_speed, 0]
    )
    assert state[4:11] == pytest.approx([-0.5 / 0.75, 0.45 / 0.75, 1.0, 0.0, 0.0, 0.0, 0.0])
    row = shot_at(-1)
    Frame(row[None], 3, 3).ball.velocity[0] = [0.0, 19.0]
    match.reset(seed=0, options={"frame": row})
    assert match.state()[3] == LIMIT


def test_states_of_many_worlds_are_those_of_each() -> None:
    config = SimConfig(n_blue=1, n_yellow=2)
    rows = np.random.default_rng(0).normal(size=(5, config.row_size)).astype(np.float32)
    scale = StateScale(config)
    states = scale.states(rows)
    assert states.shape == (5, scale.size) == (5, 4 + 3 * 7)
    assert all(
        np.array_equal(scale.states(row[None])[0], state)
        for row, state in zip(rows, states, strict=True)
    )
    before = states.copy()
    rows[:] = 0.0
    assert np.array_equal(states, before)
