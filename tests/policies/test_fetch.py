import pytest

from rsoccer.tasks import SslGoToBall
from tests.policies.ssl_policies import expect_rows_alone, expect_view_needed, score


@pytest.mark.parametrize("axes", ["field", "robot"])
@pytest.mark.parametrize("foes", [0, 6])
def test_it_takes_the_ball_into_its_mouth(axes: str, foes: int) -> None:
    assert score(SslGoToBall(axes=axes, foes=foes), "reached", blue_0="fetch") >= 0.96


def test_rows_do_not_depend_on_their_neighbours() -> None:
    expect_rows_alone("fetch", SslGoToBall(foes=3))


def test_it_needs_a_view() -> None:
    expect_view_needed("fetch", SslGoToBall())
