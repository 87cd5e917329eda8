"""`keep` and `take`, the scripts of keepaway and of pass tasks with opponents."""

import pytest

from rsoccer import policies
from rsoccer.tasks import SslGoToBall, SslKeepaway, SslPassEndurance, SslPassEnduranceMulti
from tests.policies.ssl.ssl_policies import (
    expect_independent_worlds,
    expect_view_needed,
    mean_metric,
)


@pytest.mark.parametrize("name", ["keep", "take"])
def test_worlds_are_independent(name: str) -> None:
    learners = "keepers" if name == "keep" else "takers"
    expect_independent_worlds(name, SslKeepaway(learners=learners), 60)


@pytest.mark.parametrize("name", ["keep", "take"])
def test_they_need_a_view(name: str) -> None:
    expect_view_needed(name, SslKeepaway())


def test_keep_needs_a_teammate() -> None:
    with pytest.raises(ValueError, match="task: keep needs a teammate, got"):
        policies.make_policy("keep", SslGoToBall())


@pytest.mark.parametrize("velocity_frame", ["field", "robot"])
def test_keepers_pass(velocity_frame: str) -> None:
    task = SslKeepaway(velocity_frame=velocity_frame, max_steps=200)
    assert mean_metric(task, "passes", blue="keep") >= 0.7


def test_keep_passes_without_opponents_too() -> None:
    assert mean_metric(SslPassEnduranceMulti(max_steps=300), "passes", blue="keep") >= 3.0


def test_takers_end_passes() -> None:
    alone, opposed = (
        SslPassEnduranceMulti(max_steps=300),
        SslPassEnduranceMulti(max_steps=300, n_opponents=2),
    )
    free = mean_metric(alone, "passes", blue="passer")
    assert mean_metric(opposed, "passes", blue="passer") < 0.3 * free
    assert mean_metric(SslPassEndurance(n_opponents=1), "received", blue_0="passer") > 0.5
