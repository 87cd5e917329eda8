"""Records of matches whose state is replaced while a recorder is attached."""

import numpy as np
import pytest

from rsoccer import Matches
from rsoccer.replay import Recorder
from tests.helpers import same, zeros


def played(steps: int, seed: int = 4) -> Matches:
    matches = Matches("VSS-v0", 2, seed=seed, autoreset="disabled")
    matches.reset()
    for _ in range(steps):
        matches.step(zeros(matches))
    return matches


def test_a_record_begins_with_the_state_that_is_taken_over() -> None:
    state = played(7).state_dict()
    matches = Matches("VSS-v0", 2, seed=9, autoreset="disabled", controllers={"yellow": "zero"})
    recorder = Recorder(matches, 1, attach=True)
    matches.take_over(state, 3)
    rows = [matches.frame.rows[1].copy()]
    assert same(rows[0], played(7).frame.rows[1])
    for _ in range(3):
        matches.step(zeros(matches))
        rows.append(matches.frame.rows[1].copy())
    replay = recorder.replay()
    assert same(replay.rows, np.stack(rows))
    assert [(each.start, each.stop) for each in replay.episodes] == [(0, 4)]


def test_a_record_goes_on_with_a_state_that_is_loaded() -> None:
    state, matches = played(7).state_dict(), played(0, seed=8)
    recorder = Recorder(matches, attach=True)
    matches.reset()
    rows = [matches.frame.rows[0].copy()]
    matches.step(zeros(matches))
    rows.append(matches.frame.rows[0].copy())
    matches.load_state_dict(state)
    rows.append(matches.frame.rows[0].copy())
    matches.step(zeros(matches))
    rows.append(matches.frame.rows[0].copy())
    replay = recorder.replay()
    assert same(replay.rows, np.stack(rows))
    assert [(each.start, each.stop) for each in replay.episodes] == [(0, 2), (2, 4)]
    assert not same(rows[1], rows[2])


def test_a_loaded_state_of_a_match_that_has_ended_adds_no_frame() -> None:
    ended = Matches("VSS-v0", seed=4, autoreset="disabled", max_steps=2)
    ended.reset()
    ended.step(zeros(ended))
    ended.step(zeros(ended))
    assert ended.done[0]
    matches = Matches("VSS-v0", seed=5, autoreset="disabled", max_steps=2)
    recorder = Recorder(matches, attach=True)
    matches.reset()
    matches.load_state_dict(ended.state_dict())
    matches.step(zeros(matches))
    matches.reset()
    replay = recorder.replay()
    assert [(each.start, each.stop) for each in replay.episodes] == [(0, 1), (1, 2)]


def test_a_state_that_is_refused_leaves_the_record_at_the_episode_that_has_begun() -> None:
    matches, state = played(0), played(7).state_dict()
    recorder = Recorder(matches, attach=True)
    with pytest.raises(ValueError, match="snapshot"):
        matches.take_over({**state, "simulator": state["simulator"][:-1]})
    assert same(recorder.replay().rows, matches.frame.rows[:1])
