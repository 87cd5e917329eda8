import pytest

from rsoccer import Field, derived
from rsoccer._core import CROSSINGS
from rsoccer.frame import Frame

SSL_B = Field("ssl_b")


def crossed(
    before: tuple[float, float, float], after: tuple[float, float, float]
) -> tuple[str, list[float]]:
    last, frame = Frame.empty(1, 0, 0), Frame.empty(1, 0, 0)
    for each, (x, y, z) in ((last, before), (frame, after)):
        each.ball.position[0], each.ball.height[0] = (x, y), z
    found = derived.crossing(last, frame, SSL_B)
    return CROSSINGS[found.line[0]], found.at[0].tolist()


@pytest.mark.parametrize(
    ("before", "after", "line"),
    [
        ((4.49, 1.0, 0.0), (4.51, 1.0, 0.0), "goal_line_right"),
        ((-4.49, -1.0, 0.0), (-4.51, -1.0, 0.0), "goal_line_left"),
        ((4.49, 0.1, 0.2), (4.51, 0.1, 0.2), "goal_line_right"),  # over the bar
        ((4.49, 0.1, 0.1), (4.51, 0.1, 0.1), "goal_right"),
        ((-4.49, 0.1, 0.1), (-4.51, 0.1, 0.1), "goal_left"),
        ((1.0, 2.99, 0.0), (1.0, 3.01, 0.0), "touch_line_left"),
        ((1.0, -2.99, 0.0), (1.0, -3.01, 0.0), "touch_line_right"),
        ((4.49, 2.98, 0.0), (4.51, 3.02, 0.0), "goal_line_right"),  # the first at a corner
        ((4.46, 2.99, 0.0), (4.52, 3.01, 0.0), "touch_line_left"),
        ((4.51, 0.1, 0.0), (4.52, 0.1, 0.0), "none"),  # already behind the line
        ((4.51, 0.1, 0.0), (4.49, 0.1, 0.0), "none"),  # on its way back
    ],
)
def test_lines_are_crossed_once_and_outward(
    before: tuple[float, float, float], after: tuple[float, float, float], line: str
) -> None:
    assert crossed(before, after)[0] == line


def test_the_point_is_on_the_line() -> None:
    assert crossed((4.4, 0.0, 0.0), (4.6, 0.1, 0.1))[1] == pytest.approx([4.5, 0.05, 0.05])
    assert crossed((0.0, 0.0, 0.0), (1.0, 0.0, 0.0)) == ("none", [0.0, 0.0, 0.0])
