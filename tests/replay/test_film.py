from dataclasses import replace
from itertools import islice

import pytest

pytest.importorskip("pygame")

from rsoccer.lineup import lineup
from rsoccer.recording import film_match
from rsoccer.registry import make_task
from rsoccer.replay import Replay
from rsoccer.replay.film import film_replay
from tests.helpers import same
from tests.replay.conftest import GOALS_SEED, ssl, vss


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


def test_markers_are_drawn() -> None:
    with_markers = next(film_replay(ssl(), 96)[0])
    bare: Replay = replace(ssl(), markers=((),) * len(ssl()))
    assert not same(with_markers, next(film_replay(bare, 96)[0]))


def test_a_width_out_of_range_is_refused() -> None:
    with pytest.raises(ValueError, match="width"):
        film_replay(vss(), 5)
