import pytest

from rsoccer import policies
from rsoccer.tasks import SslGoToBall, SslPassEndurance, SslPassEnduranceMulti
from tests.policies.ssl.ssl_policies import (
    expect_independent_worlds,
    expect_view_needed,
    mean_metric,
)


@pytest.mark.parametrize("velocity_frame", ["field", "robot"])
def test_its_passes_are_received(velocity_frame: str) -> None:
    task = SslPassEndurance(velocity_frame=velocity_frame)
    assert mean_metric(task, "received", blue_0="passer", blue_1="receive") >= 0.93


def test_it_receives_passes() -> None:
    assert mean_metric(SslPassEndurance(), "received", blue="passer") >= 0.93


def test_two_passers_pass_back_and_forth() -> None:
    assert mean_metric(SslPassEnduranceMulti(max_steps=400), "passes", blue="passer") >= 4.0


@pytest.mark.parametrize("task", [SslPassEndurance(), SslPassEnduranceMulti()])
def test_worlds_are_independent(
    task: SslPassEndurance | SslPassEnduranceMulti,
) -> None:
    expect_independent_worlds("passer", task, 120)


def test_it_needs_a_teammate_and_a_view() -> None:
    expect_view_needed("passer", SslPassEndurance())
    with pytest.raises(ValueError, match="task: passer needs a teammate, got"):
        policies.make_policy("passer", SslGoToBall())
