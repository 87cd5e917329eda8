import pytest

from rsoccer import SimConfig
from rsoccer._core import Field
from rsoccer.render.pitch import arena_bounds
from rsoccer.render.scoreboard import (
    Board,
    board_shapes,
    caption_shapes,
    clock_text,
    scene_bounds,
    score_shapes,
)
from rsoccer.render.shapes import Polygon, Text

FIELD = SimConfig().field


@pytest.mark.parametrize(
    ("seconds", "text"),
    [(0.0, "0:00"), (59.99, "0:59"), (60.0, "1:00"), (605.4, "10:05"), (40 * 0.1 - 1e-9, "0:04")],
)
def test_the_clock_counts_whole_seconds(seconds: float, text: str) -> None:
    assert clock_text(seconds) == text


def test_blue_is_on_the_left_and_yellow_on_the_right() -> None:
    shapes = score_shapes(FIELD, Board((3, 12), 61.0, ("home", "away")))
    texts = [shape for shape in shapes if isinstance(shape, Text)]
    ordered = sorted(texts, key=lambda text: text.center[0])
    assert [text.text for text in ordered] == ["HOME", "3", "1:01", "12", "AWAY"]


@pytest.mark.parametrize("name", Field.PRESETS)
def test_the_board_is_above_the_arena_and_within_the_picture(name: str) -> None:
    field = Field(name)
    bounds, arena = scene_bounds(field), arena_bounds(field)
    points = [p for s in board_shapes(field) if isinstance(s, Polygon) for p in s.points]
    assert points
    assert min(y for _, y in points) >= arena.top
    assert max(y for _, y in points) < bounds.top
    assert all(bounds.left < x < bounds.right for x, _ in points)


def test_a_caption_is_drawn_only_if_there_is_one() -> None:
    assert caption_shapes(FIELD, "") == ()
    texts = [s.text for s in caption_shapes(FIELD, "goal") if isinstance(s, Text)]
    assert texts == ["GOAL"]
