import numpy as np
import pytest

from rsoccer import SimConfig
from rsoccer.envs.parallel import parallel_env
from rsoccer.frame import Frame
from rsoccer.global_state import LIMIT, StateEncoder
from tests.parallel_matches import SELF_PLAY, TASKS, random_actions, shot_at


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


def test_the_state_of_ssl_has_heights_and_beams_too() -> None:
    match = parallel_env("SSLPassEnduranceMulti-v1")
    config = match.task.config
    top, half_length = config.robot.top_speed, config.field.half_length
    frame = Frame.empty(1, 2, 0)
    frame.robots.position[0] = [[-1.0, 0.5], [1.0, 0.0]]
    frame.ball.position[0] = [-1.0 + config.robot.front_distance + config.ball.radius, 0.5]
    match.reset(seed=0, options={"frame": frame.rows[0]})
    ball, first, second = np.split(match.state(), [6, 14])
    assert ball == pytest.approx([frame.ball.position[0, 0] / 3.0, 0.5 / 3.0, 0, 0, 0, 0])
    assert first == pytest.approx([-1 / half_length, 0.5 / half_length, 1, 0, 0, 0, 0, 1])
    assert second == pytest.approx([1 / half_length, 0, 1, 0, 0, 0, 0, 0])
    frame.ball.position[0], frame.ball.velocity[0] = (0.0, 0.0), (0.0, 1.0)
    frame.ball.height[0], frame.ball.vertical_velocity[0] = 0.6, 2.0
    match.reset(options={"frame": frame.rows[0]})
    flying = match.state()[:6]
    assert flying == pytest.approx([0, 0, 0.6 / half_length, 0, 1 / top, 2 / top])


@pytest.mark.parametrize("name", TASKS)
def test_states_stay_in_their_space_and_change(name: str) -> None:
    match = parallel_env(name, max_cycles=30)
    match.reset(seed=1)
    assert match.state_space.shape == match.state().shape
    rng, states = np.random.default_rng(0), []
    while match.agents:
        match.step(random_actions(match, rng))
        states.append(match.state())
        assert match.state_space.contains(states[-1])
    assert len(np.unique(states, axis=0)) == len(states)


def test_states_of_many_worlds_are_those_of_each() -> None:
    config = SimConfig(n_blue=1, n_yellow=2)
    rows = np.random.default_rng(0).normal(size=(5, config.row_size)).astype(np.float32)
    encoder = StateEncoder(config)
    states = encoder.encode(rows)
    assert states.shape == (5, encoder.size) == (5, 4 + 3 * 7)
    assert all(
        np.array_equal(encoder.encode(row[None])[0], state)
        for row, state in zip(rows, states, strict=True)
    )
    before = states.copy()
    rows[:] = 0.0
    assert np.array_equal(states, before)
