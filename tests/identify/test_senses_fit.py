"""Frame rates and delays of cameras by the stamps of a log."""

import numpy as np
import pytest

from rsoccer.arrays import Array
from rsoccer.identify.log import Log, Track
from rsoccer.identify.results import Estimate
from rsoccer.identify.senses_fit import camera_estimates, delay_estimates

LATENCY = Estimate("latency", "s", 0.070, 0.073, 0.077)
FRAME = 0.016
COUNT = 3000


def log_of(times: Array, captured: Array) -> Log:
    """Log of one robot that stands, with noise."""
    rng = np.random.default_rng(0)
    poses = rng.normal(0.0, 0.001, (len(times), 3))
    track = Track(times, poses[:, :2], poses[:, 2], captured)
    nothing = np.zeros(0)
    return Log(None, {}, {"a": track}, Track(nothing, np.zeros((0, 2)), nothing, nothing))


def stamps(delay: float, seed: int = 0) -> tuple[Array, Array]:
    """Arrivals, late by chance, and captures of frames of which a few are lost."""
    rng = np.random.default_rng(seed)
    captured = FRAME * np.flatnonzero(rng.random(COUNT) > 0.03)
    return captured + delay + rng.exponential(0.002, len(captured)), captured


def test_captures_split_the_latency() -> None:
    times, captured = stamps(0.05)
    delay, command = delay_estimates(log_of(times, captured), LATENCY)
    assert delay.value == pytest.approx(0.05 + 0.002 * np.log(2.0), abs=2e-4)
    assert command.value == pytest.approx(LATENCY.value - delay.value)
    half = delay.high - delay.value
    assert half > 0.0
    assert command.value - command.low == pytest.approx(np.hypot(0.003, half))
    assert command.high - command.value == pytest.approx(np.hypot(0.004, half))


@pytest.mark.parametrize(
    ("delay", "message"), [(5.0, "captured: .* 5.00"), (0.09, "captured: "), (-0.02, "captured: ")]
)
def test_captures_that_the_latency_contradicts_are_refused(delay: float, message: str) -> None:
    times, captured = stamps(delay)
    with pytest.raises(ValueError, match=message):
        delay_estimates(log_of(times, captured), LATENCY)


def test_captures_as_late_as_the_latency_leave_no_delay_of_commands() -> None:
    times = FRAME * np.arange(COUNT)
    delay, command = delay_estimates(log_of(times, times - 0.078), LATENCY)
    assert delay.value == pytest.approx(0.078)
    assert (command.low, command.value) == (0.0, 0.0)


def test_frame_rate_of_arrivals_at_a_loop_s_times() -> None:
    # A loop that looks every 5 ms for frames sees times of 15 ms and, seldom, 20 ms between them.
    _, captured = stamps(0.05)
    times = np.ceil((captured + 0.05) / 0.005) * 0.005
    rate = camera_estimates(log_of(times, np.full(len(times), np.nan)))[0]
    assert 1.0 / np.median(np.diff(times)) > 1.05 / FRAME, "the median tells another rate"
    assert rate.value == pytest.approx(1.0 / FRAME, rel=0.003)
    assert rate.low < rate.value < rate.high
    assert rate.high - rate.low < 0.01 * rate.value


def test_frame_rate_of_captures() -> None:
    times, captured = stamps(0.05)
    rng = np.random.default_rng(1)
    times = times + np.cumsum(rng.random(len(times)) < 0.5) * 0.004  # a clock that runs fast
    rate = camera_estimates(log_of(times, captured))[0]
    assert rate.value == pytest.approx(1.0 / FRAME, rel=1e-6)
