"""What a failed call leaves: refused input nothing changed, a failure half way torn matches."""

from collections.abc import Callable

import numpy as np
import pytest

from rsoccer import Matches
from rsoccer.frame import Array, Floats
from rsoccer.task import Play
from tests.fragile import METHODS, Broken, Fragile, fragile
from tests.helpers import pushing, same, zeros


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
        with pytest.raises(
            RuntimeError, match=rf"step 8 failed with Broken: {what} fails; call reset"
        ):
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
