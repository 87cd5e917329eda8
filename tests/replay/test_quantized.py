import numpy as np
import pytest

from rsoccer.arrays import Floats
from rsoccer.frame import Frame
from rsoccer.replay import ReplayError, quantized
from rsoccer.replay.quantized import STEPS, decode, encode


def random_rows(frames: int = 50) -> Floats:
    rng = np.random.default_rng(0)
    frame = Frame.empty(frames, 2, 1)
    frame.rows[:] = rng.uniform(-3.0, 3.0, frame.rows.shape)
    angles = np.cumsum(rng.uniform(-1.0, 1.0, (frames, 3)), axis=0)
    frame.robots.heading[:] = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    frame.robots.infrared[:] = rng.uniform(size=(frames, 3)) < 0.5
    frame.ball.last_touch[:] = rng.integers(-1, 3, frames)
    return frame.rows


def test_numbers_differ_by_half_a_step_at_most() -> None:
    rows, steps = random_rows(), quantized.row_steps(3)
    stored = decode("rows", encode("rows", quantized.stored_rows(rows), steps), len(rows), steps)
    read, frame = Frame(quantized.rows_of(stored, 2, 1), 2, 1), Frame(rows, 2, 1)
    for found, expected, step in (
        (read.ball.position, frame.ball.position, STEPS["x"]),
        (read.ball.velocity, frame.ball.velocity, STEPS["v_x"]),
        (read.robots.position, frame.robots.position, STEPS["x"]),
        (read.robots.heading, frame.robots.heading, STEPS["heading"]),
        (read.robots.angular_velocity, frame.robots.angular_velocity, STEPS["v_theta"]),
    ):
        error = np.abs(found - expected).max()
        assert 0 < error <= step / 2 + 1e-6
    assert (read.robots.infrared == frame.robots.infrared).all()
    assert (read.ball.last_touch == frame.ball.last_touch).all()


def test_a_second_round_changes_nothing() -> None:
    rows, steps = random_rows(), quantized.row_steps(3)
    for _ in range(2):
        content = encode("rows", quantized.stored_rows(rows), steps)
        rows = quantized.rows_of(decode("rows", content, len(rows), steps), 2, 1)
    assert encode("rows", quantized.stored_rows(rows), steps) == content


def test_extreme_numbers_come_back() -> None:
    values = np.array([[0.0], [2.0**31 - 1], [-(2.0**31) + 1], [1.0], [0.0]])
    assert (decode("v", encode("v", values, [1.0]), 5, [1.0]) == values).all()


def test_planes_hold_low_bytes_first() -> None:
    assert encode("v", np.array([[1.0], [0.0], [256.0]]), 1.0) == bytes(
        [2, 1, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0]
    )


@pytest.mark.parametrize("value", [np.nan, np.inf, 1e30])
def test_numbers_that_cannot_be_stored_are_refused(value: float) -> None:
    with pytest.raises(ReplayError, match="rows: expected finite numbers"):
        encode("rows", np.array([[value]]), 1e-4)


def test_a_term_has_a_step_of_its_own() -> None:
    assert quantized.term_step("goal", np.zeros((3, 2), np.float32)) == 1.0
    assert quantized.term_step("goal", np.array([[0.5], [-2.0]], np.float32)) == 2.0 / 2**15
    with pytest.raises(
        ReplayError, match="term 'goal': expected finite numbers of some size, got nan"
    ):
        quantized.term_step("goal", np.array([[np.nan]], np.float32))
