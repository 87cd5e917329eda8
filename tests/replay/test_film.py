from dataclasses import replace
from itertools import islice

import pytest

pytest.importorskip("pygame")

from rsoccer.lineup import lineup
from rsoccer.recording import film_match
from rsoccer.registry import make_task
from rsoccer.render.scoreboard import GOAL_PAUSE
from rsoccer.replay import Replay, record_replay
from rsoccer.replay.film import film_replay
from tests.helpers import same
from tests.replay.conftest import GOALS_SEED, MATCH_SEED, QUICK, ssl, vss, vss_match


def test_a_replay_shows_the_images_of_the_match() -> None:
    task, first_goal = make_task("VSSSelfPlay-v0"), vss().episodes[0].stop
    assert len(vss().episodes) > 1
    controllers = lineup(task, "scripted", "chase")
    played, played_fps = film_match(task, controllers, GOALS_SEED, 8.0, names=("A", "B"), width=96)
    replayed, fps = film_replay(vss(), 96)
    assert fps == played_fps
    count = first_goal + 60  # with the pause at the goal and the next episode
    for image, expected in zip(islice(replayed, count), islice(played, count), strict=True):
        assert same(image, expected)


def test_a_replay_of_a_match_shows_its_referee_as_the_film_does() -> None:
    task = make_task("VSSMatch-v0", half_seconds=5.0, referee=QUICK)
    controllers = lineup(task, "scripted", "chase")
    played, _ = film_match(task, controllers, MATCH_SEED, 20.0, width=96)
    replayed, _ = film_replay(vss_match(), 96)
    count = next(e.frame for e in vss_match().events if e.kind == "goal") + 40  # with the pause
    for image, expected in zip(islice(replayed, count), islice(played, count), strict=True):
        assert same(image, expected)


def test_a_replay_shows_the_kicks_that_the_film_shows() -> None:
    task = make_task("SSLPassEnduranceMulti-v1")
    played, _ = film_match(task, lineup(task, "passer"), 0, 4.0, width=160)
    replayed, _ = film_replay(ssl(), 160)
    first = ssl().episodes[0].stop
    assert first > 60
    for image, expected in zip(islice(replayed, first), islice(played, first), strict=True):
        assert same(image, expected)


def test_goals_and_ends_of_matches_are_shown_for_a_moment() -> None:
    shown = [event.kind for event in vss_match().events if event.kind in ("goal", "end")]
    assert {*shown} == {"goal", "end"}
    images = sum(1 for _ in film_replay(vss_match(), 64)[0])
    pause = round(GOAL_PAUSE / vss_match().config.time_step)
    starts = len(vss_match().episodes) - 1
    assert images == len(vss_match()) - starts + len(shown) * (pause - 1)


def test_markers_are_drawn() -> None:
    with_markers = next(film_replay(ssl(), 96)[0])
    bare: Replay = replace(ssl(), markers=((),) * len(ssl()))
    assert not same(with_markers, next(film_replay(bare, 96)[0]))


def test_a_replay_with_senses_shows_the_ghosts_that_the_film_shows() -> None:
    task = make_task("VSSSelfPlay-v0")
    controllers = lineup(task, "scripted", "chase")
    replay = record_replay(task, controllers, seconds=1.0, sensing="vsss")
    for ghosts in (True, False):
        played, _ = film_match(
            task, controllers, seconds=1.0, width=96, ghosts=ghosts, sensing="vsss"
        )
        replayed, _ = film_replay(replay, 96, ghosts=ghosts)
        for image, expected in zip(replayed, played, strict=True):
            assert same(image, expected)
    last, plain = [*film_replay(replay, 96)[0]][-1], [*film_replay(replay, 96, ghosts=False)[0]][-1]
    assert not same(last, plain)


def test_a_width_out_of_range_is_refused() -> None:
    with pytest.raises(ValueError, match="width"):
        film_replay(vss(), 5)
