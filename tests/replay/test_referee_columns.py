from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from rsoccer.game import Command, Stage
from rsoccer.render.referee_state import COLUMNS, RefereeState
from rsoccer.replay import Replay, ReplayError, container, referee_columns
from tests.replay.conftest import ssl, ssl_match, vss, vss_match


def states(replay: Replay) -> tuple[RefereeState, ...]:
    found = replay.referee_states
    assert found is not None
    return found


@pytest.mark.parametrize("recorded", [vss_match, ssl_match], ids=["VSSS", "SSL"])
def test_the_state_of_the_referee_comes_back(recorded: Callable[[], Replay]) -> None:
    replay = recorded()
    read = Replay.from_bytes(replay.to_bytes(snapshots=False))
    assert replay.referee is not None
    assert read.referee is not None
    steps = np.array(referee_columns.steps(replay.config))
    assert (np.abs(read.referee - replay.referee) <= 0.5 * steps + 1e-6).all()
    assert np.abs(read.referee - replay.referee)[:, steps == 1.0].max() <= 0.5
    for found, expected in zip(states(read), states(replay), strict=True):
        assert (
            replace(
                found,
                seconds_left=expected.seconds_left,
                designated_position=expected.designated_position,
            )
            == expected
        )


def test_matches_have_what_the_tests_look_for() -> None:
    """Otherwise they could pass because nothing happened."""
    of_vss, of_ssl = states(vss_match()), states(ssl_match())
    assert {Stage.NORMAL_SECOND_HALF, Stage.POST_GAME} <= {state.stage for state in of_vss}
    assert max(sum(state.score) for state in of_vss) > 0
    commands = {state.command for state in of_ssl}
    assert commands & {Command.BALL_PLACEMENT_BLUE, Command.BALL_PLACEMENT_YELLOW}
    assert max(sum(state.yellow_cards) for state in of_ssl) > 0
    assert ssl_match().frame.robots.absent.any()


def test_the_referee_takes_few_bytes() -> None:
    for replay in (vss_match(), ssl_match()):
        size = len(replay.to_bytes())
        without = len(replace(replay, referee=None).to_bytes())
        assert 0 < size - without < 0.05 * size + 1500


@pytest.mark.parametrize("recorded", [vss, ssl], ids=["VSSS", "SSL"])
def test_other_tasks_have_no_columns_of_a_referee(recorded: Callable[[], Replay]) -> None:
    replay = recorded()
    assert replay.referee is None
    assert replay.referee_states is None
    header, sections = container.unpack(replay.to_bytes())
    assert header["columns"]["referee"] == header["steps"]["referee"] == []
    assert "referee" not in sections
    assert Replay.from_bytes(replay.to_bytes()).referee is None


@pytest.mark.parametrize("name", ["command", "next_command", "kick", "stage"])
def test_codes_that_do_not_exist_are_refused(name: str) -> None:
    replay = vss_match()
    assert replay.referee is not None
    wrong = replay.referee.copy()
    wrong[7, COLUMNS.index(name)] = 77
    with pytest.raises(ReplayError, match=f"expected codes of {name}, got 77"):
        Replay.from_bytes(replace(replay, referee=wrong).to_bytes())


def test_columns_of_a_referee_without_their_section_are_refused() -> None:
    header, sections = container.unpack(vss_match().to_bytes())
    del sections["referee"]
    with pytest.raises(ReplayError, match="columns"):
        Replay.from_bytes(container.pack(header, sections))


def test_equal_matches_have_equal_files() -> None:
    vss_match.cache_clear()
    first = vss_match().to_bytes()
    vss_match.cache_clear()
    assert vss_match().to_bytes() == first
