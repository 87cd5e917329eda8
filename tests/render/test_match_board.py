import pytest

from rsoccer._core import Field
from rsoccer.game import Stage
from rsoccer.render import palette
from rsoccer.render.match_board import match_board_shapes
from rsoccer.render.scoreboard import Board, board_bounds
from rsoccer.render.shapes import Circle, Polygon, Shape, Text
from tests.render.referee import state_of

FIELD = Field("ssl_b")
ALL = ((True,) * 3, (True,) * 3)


def texts(shapes: tuple[Shape, ...]) -> list[str]:
    found = [shape for shape in shapes if isinstance(shape, Text)]
    return [text.text for text in sorted(found, key=lambda text: text.center[0])]


def board(present: tuple[tuple[bool, ...], ...] = ALL, **changes: object) -> tuple[Shape, ...]:
    return match_board_shapes(FIELD, Board(names=("home", "away")), state_of(**changes), present)


def test_the_board_has_names_goals_part_of_the_match_and_time_left() -> None:
    found = texts(board(score=(3, 12), seconds_left=65.2, stage=Stage.NORMAL_SECOND_HALF))
    assert found == ["HOME", "3", "2ND HALF", "1:06", "12", "AWAY"]


@pytest.mark.parametrize(
    ("seconds", "clock"), [(300.0, "5:00"), (59.99, "1:00"), (0.5, "0:01"), (0.0, "0:00")]
)
def test_the_last_second_ends_at_zero(seconds: float, clock: str) -> None:
    assert clock in texts(board(seconds_left=seconds))


def test_a_shootout_has_no_clock() -> None:
    found = texts(board(stage=Stage.PENALTY_SHOOTOUT, seconds_left=0.0))
    assert "SHOOT-OUT" in found
    assert "0:00" not in found


def test_robots_that_are_not_on_the_field_are_faint() -> None:
    shapes = board(((True, False, True), (False, True, True)))
    pips = sorted((s for s in shapes if isinstance(s, Circle)), key=lambda s: s.center[0])
    assert [pip.color[3] == 255 for pip in pips] == [True, False, True, False, True, True]
    assert [pip.color[:3] for pip in pips] == [palette.WHITE[:3]] * 3 + [palette.INK[:3]] * 3


def test_cards_are_counted_by_color_and_team() -> None:
    def cards(shapes: tuple[Shape, ...]) -> list[tuple[bool, tuple[int, ...]]]:
        kinds = (palette.YELLOW_CARD, palette.RED_CARD)
        found = [s for s in shapes if isinstance(s, Polygon) and s.color in kinds]
        return [(card.points[0][0] < 0, card.color) for card in found]

    assert cards(board()) == []
    shapes = board(yellow_cards=(2, 0), red_cards=(1, 4))
    assert cards(shapes) == [
        (True, palette.YELLOW_CARD),
        (True, palette.RED_CARD),
        (False, palette.RED_CARD),
    ]
    assert {"1", "2", "4"} < set(texts(shapes))


@pytest.mark.parametrize("name", Field.PRESETS)
@pytest.mark.parametrize("robots", [1, 11])
def test_robots_and_cards_are_within_the_end_of_their_team(name: str, robots: int) -> None:
    field = Field(name)
    present = ((True,) * robots, (True,) * robots)
    state = state_of(yellow_cards=(9, 9), red_cards=(3, 3))
    bounds = board_bounds(field)
    for shape in match_board_shapes(field, Board(), state, present):
        if isinstance(shape, Circle):
            points = [(shape.center[0] + d * shape.radius, shape.center[1]) for d in (-1, 1)]
        elif isinstance(shape, Polygon):
            points = list(shape.points)
        else:
            continue
        assert all(0.44 * bounds.right < abs(x) < bounds.right for x, _ in points)
        assert all(bounds.bottom < y < bounds.top for _, y in points)
