import pytest

from rsoccer.bridge.match_tasks import LEAGUES, TICK, make_match
from rsoccer.policies import make_policy


@pytest.mark.parametrize("league", LEAGUES)
def test_a_served_match_plays_a_step_per_tick(league: str) -> None:
    config = make_match(league, "B", None, {}).config
    assert config.time_step == config.tick == pytest.approx(TICK)


@pytest.mark.parametrize(
    ("league", "policy", "title"), [("ssl", "chase", "SSL"), ("vsss", "fetch", "VSSS")]
)
def test_an_error_named_the_class_of_a_served_match(league: str, policy: str, title: str) -> None:
    task = make_match(league, "B", None, {})
    with pytest.raises(ValueError, match=f"{policy} needs .* got {title} match at 200 Hz"):
        make_policy(policy, task)
