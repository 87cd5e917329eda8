import math

import pytest

from rsoccer.render.shapes import (
    ARC_TOLERANCE,
    Line,
    Point,
    Pose,
    arc_points,
    rounded_rectangle,
    stroke,
)

RED = (255, 0, 0, 255)


def area(points: tuple[Point, ...]) -> float:
    """Twice the signed sum of triangles, halved: positive if counterclockwise."""
    following = (*points[1:], points[0])
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(points, following, strict=True)) / 2


@pytest.mark.parametrize("radius", [0.005, 0.0214, 0.2, 0.5])
def test_chords_of_an_arc_stay_within_the_tolerance(radius: float) -> None:
    points = arc_points((1.0, 2.0), radius, 0.0, math.tau)
    middle = math.dist(
        (1.0, 2.0),
        ((points[0][0] + points[1][0]) / 2, (points[0][1] + points[1][1]) / 2),
    )
    assert all(math.isclose(math.dist((1.0, 2.0), p), radius) for p in points)
    assert 0.0 < radius - middle <= ARC_TOLERANCE


def test_an_arc_includes_both_ends() -> None:
    points = arc_points((0.0, 0.0), 2.0, 0.0, math.pi / 2)
    assert points[0] == (2.0, 0.0)
    assert points[-1] == pytest.approx((0.0, 2.0))


def test_a_round_rectangle_lacks_only_its_corners() -> None:
    radius = 0.1
    points = rounded_rectangle(-1.0, -2.0, 1.0, 2.0, radius)
    missing = (4 - math.pi) * radius**2
    assert area(points) == pytest.approx(8.0 - missing, abs=1e-3)
    assert max(x for x, _ in points) == pytest.approx(1.0)
    assert min(y for _, y in points) == pytest.approx(-2.0)


def test_a_radius_too_large_for_a_rectangle_is_reduced() -> None:
    points = rounded_rectangle(0.0, 0.0, 1.0, 4.0, 9.0)
    assert all(-1e-9 <= x <= 1.0 + 1e-9 and -1e-9 <= y <= 4.0 + 1e-9 for x, y in points)


def test_a_pose_turns_left_and_then_moves() -> None:
    quarter = Pose((3.0, 4.0), 0.0, 1.0)
    assert quarter.to_world(((1.0, 0.0), (0.0, 1.0))) == ((3.0, 5.0), (2.0, 4.0))


def test_a_stroke_joins_consecutive_points() -> None:
    a, b, c = (0.0, 0.0), (1.0, 0.0), (1.0, 1.0)
    assert stroke((a, b, c), 0.1, RED) == (Line(a, b, 0.1, RED), Line(b, c, 0.1, RED))
