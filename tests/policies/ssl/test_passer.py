import pytest

from rsoccer import policies
from rsoccer.tasks import SslGoToBall, SslPassEndurance, SslPassEnduranceMulti
from tests.policies.ssl.ssl_policies import expect_rows_alone, expect_view_needed, score


@pytest.mark.parametrize("velocity_frame", ["field", "robot"])
def test_its_passes_are_received(velocity_frame: str) -> None:
    task = SslPassEndurance(velocity_frame=velocity_frame)
    assert score(task, "received", blue_0="passer", blue_1="receive") >= 0.93


def test_it_receives_too() -> None:
    assert score(SslPassEndurance(), "received", blue="passer") >= 0.93


def test_two_of_it_pass_to_and_fro() -> None:
    assert score(SslPassEnduranceMulti(max_steps=400), "passes", blue="passer") >= 4.0


@pytest.mark.parametrize("task", [SslPassEndurance(), SslPassEnduranceMulti()])
def test_rows_do_not_depend_on_their_neighbours(
    task: SslPassEndurance | SslPassEnduranceMulti,
) -> None:
    expect_rows_alone("passer", task, 120)


def test_it_needs_a_teammate_and_a_view() -> None:
    expect_view_needed("passer", SslPassEndurance())
    with pytest.raises(ValueError, match=r"passer needs a teammate, and in .* it has none"):
        policies.make("passer", SslGoToBall())
