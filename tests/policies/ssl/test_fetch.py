import pytest

from rsoccer.tasks import SslGoToBall
from tests.policies.ssl.ssl_policies import (
    expect_independent_worlds,
    expect_view_needed,
    mean_metric,
)


@pytest.mark.parametrize("velocity_frame", ["field", "robot"])
@pytest.mark.parametrize("n_opponents", [0, 6])
def test_it_takes_the_ball_into_its_mouth(velocity_frame: str, n_opponents: int) -> None:
    assert (
        mean_metric(
            SslGoToBall(velocity_frame=velocity_frame, n_opponents=n_opponents),
            "reached",
            blue_0="fetch",
        )
        >= 0.96
    )


def test_worlds_are_independent() -> None:
    expect_independent_worlds("fetch", SslGoToBall(n_opponents=3))


def test_it_needs_a_view() -> None:
    expect_view_needed("fetch", SslGoToBall())
