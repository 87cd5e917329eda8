import pytest

from rsoccer._core import Field
from rsoccer.game import BLUE, NOBODY, YELLOW
from rsoccer.render import palette
from rsoccer.render.pitch import arena_bounds
from rsoccer.render.scoreboard import scene_bounds
from rsoccer.render.shapes import Polygon, Text
from rsoccer.render.ticker import ticker_shapes
from rsoccer.render.words import NOTHING, Words

COMMAND, EVENT = Words("Free kick Blue", BLUE), Words("Pushing Yellow #3", YELLOW)


@pytest.mark.parametrize("name", Field.PRESETS)
def test_the_ticker_is_under_the_arena_and_within_the_picture(name: str) -> None:
    field = Field(name)
    bounds, arena = scene_bounds(field, ticker=True), arena_bounds(field)
    shapes = ticker_shapes(field, COMMAND, EVENT)
    points = [p for s in shapes if isinstance(s, Polygon) for p in s.points]
    assert all(bounds.left < x < bounds.right for x, _ in points)
    assert all(bounds.bottom < y <= arena.bottom for _, y in points)


def test_the_command_is_on_the_left_and_the_announcement_on_the_right() -> None:
    found = [s for s in ticker_shapes(Field("ssl_b"), COMMAND, EVENT) if isinstance(s, Text)]
    assert [text.text for text in found] == [COMMAND.text, EVENT.text]
    assert found[0].center[0] < 0 < found[1].center[0]


def test_a_plate_has_the_color_of_its_team() -> None:
    def colors(words: Words) -> set[tuple[int, ...]]:
        shapes = ticker_shapes(Field("ssl_b"), words, NOTHING)
        return {shape.color for shape in shapes if isinstance(shape, Polygon)}

    assert colors(COMMAND) == {palette.BOARD, palette.BLUE}
    assert colors(EVENT) == {palette.BOARD, palette.YELLOW}
    assert colors(Words("Halt", NOBODY)) == {palette.BOARD, palette.MUTED}


def test_without_words_there_is_nothing() -> None:
    assert ticker_shapes(Field("ssl_b"), NOTHING, NOTHING) == ()
