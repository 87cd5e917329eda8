"""Failed calls: refused input changes nothing, a failure within a step is an inconsistency."""

from collections.abc import Callable

import numpy as np
import pytest

from rsoccer import Matches
from rsoccer.arrays import Array, Floats
from rsoccer.task import Play
from tests.failing import METHODS, FailingTask, InjectedError, failing_matches
from tests.helpers import pushing, same, zeros


def equal(a: dict[str, Array], b: dict[str, Array]) -> bool:
    """Compare every bit of two saved states."""
    return a.keys() == b.keys() and all(same(a[name], b[name]) for name in a)


def expect_same_future(ours: Matches, theirs: Matches) -> None:
    rng = np.random.default_rng(1)
    ended = 0
    for _ in range(30):
        actions = pushing(rng, ours)
        outcome, expected = ours.step(actions), theirs.step(actions)
        assert same(outcome.observations, expected.observations)
        assert same(outcome.rewards, expected.rewards)
        ended += int(outcome.ended.sum())
    assert ended, "resets were not compared"
    assert equal(ours.state_dict(), theirs.state_dict())


@pytest.mark.parametrize("autoreset", ["same_step", "next_step", "disabled"])
def test_refused_input_changes_nothing(autoreset: str) -> None:
    matches, _ = failing_matches(autoreset=autoreset)
    before, valid = matches.state_dict(), zeros(matches)
    row = matches.frame.rows[:1].copy()
    outside = row.copy()
    outside[:, 0] = 9.0
    one, nan = np.array([True, False, False, False]), np.full_like(valid, np.nan)
    refused: list[Callable[[], object]] = [
        *(
            lambda wrong=wrong: matches.step(wrong)
            for wrong in (valid[1:], nan, valid.astype(int), None)
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
    control, _ = failing_matches(autoreset=autoreset)
    expect_same_future(matches, control) if autoreset != "disabled" else matches.step(valid)


@pytest.mark.parametrize("method", [*METHODS[:5], "policy", "simulator"])
def test_after_a_failed_step_calls_are_refused_until_the_repair(method: str) -> None:
    """Formerly the next step continued with some parts one step ahead of others."""
    matches, failure = failing_matches()
    kept = matches.state_dict()
    failure.method = method
    with pytest.raises(InjectedError, match=method):
        matches.step(zeros(matches))
    mask = np.array([True, True, False, True])
    calls: list[Callable[[], object]] = [
        lambda: matches.step(zeros(matches)),
        lambda: matches.reset(mask=mask),
        lambda: matches.reset(seed=3, mask=mask),
        matches.state_dict,
    ]
    for call in calls:
        with pytest.raises(
            RuntimeError, match=rf"step 8 failed with InjectedError: {method} fails; call"
        ):
            call()
    matches.load_state_dict(kept)
    control, _ = failing_matches()
    expect_same_future(matches, control)


@pytest.mark.parametrize("method", [*METHODS[:5], "policy", "simulator"])
def test_after_a_failed_step_a_reset_of_all_equals_fresh_matches(method: str) -> None:
    matches, failure = failing_matches()
    failure.method = method
    with pytest.raises(InjectedError):
        matches.step(zeros(matches))
    fresh, _ = failing_matches()
    assert same(matches.reset(11), fresh.reset(11))
    expect_same_future(matches, fresh)
    matches.reset(mask=np.array([True, False, False, True]))


@pytest.mark.parametrize("method", ["new_memory", "get_initial_positions_frame"])
def test_a_reset_that_fails_before_placing_changes_nothing(method: str) -> None:
    for mask in (None, np.array([True, False, False, False])):
        matches, failure = failing_matches()
        before = matches.state_dict()
        failure.method = method
        with pytest.raises(InjectedError):
            matches.reset(mask=mask)
        assert equal(matches.state_dict(), before)
        expect_same_future(matches, failing_matches()[0])


@pytest.mark.parametrize("method", ["frame_to_observations", "start_episode"])
def test_a_reset_that_fails_after_placing_is_an_inconsistency(method: str) -> None:
    matches, failure = failing_matches()
    failure.method = method
    with pytest.raises(InjectedError):
        matches.reset(mask=np.array([True, False, False, False]))
    with pytest.raises(RuntimeError, match=f"reset failed with InjectedError: {method}"):
        matches.step(zeros(matches))
    assert same(matches.reset(4), failing_matches()[0].reset(4))


def test_a_failed_reset_within_a_step_is_an_inconsistency() -> None:
    matches, failure = failing_matches()
    matches.play.steps[2] = matches.task.max_steps
    failure.method = "get_initial_positions_frame"
    with pytest.raises(InjectedError):
        matches.step(zeros(matches))
    with pytest.raises(RuntimeError, match="step 8 failed"):
        matches.step(zeros(matches))


def test_a_refused_reset_of_inconsistent_matches_repairs_nothing() -> None:
    matches, failure = failing_matches()
    failure.method = "metrics"
    with pytest.raises(InjectedError):
        matches.step(zeros(matches))
    outside = matches.frame.rows.copy()
    outside[:, 0] = 9.0
    with pytest.raises(ValueError, match="outside"):
        matches.reset(rows=outside)
    with pytest.raises(RuntimeError, match="step 8 failed"):
        matches.step(zeros(matches))


def test_an_interrupt_within_a_step_is_an_inconsistency() -> None:
    class Interrupted(FailingTask):
        def metrics(self, play: Play) -> dict[str, Floats]:
            raise KeyboardInterrupt

    matches = Matches(Interrupted())
    matches.reset()
    with pytest.raises(KeyboardInterrupt):
        matches.step(zeros(matches))
    with pytest.raises(RuntimeError, match="step 1 failed with KeyboardInterrupt"):
        matches.step(zeros(matches))
