import numpy as np
import pytest

from rsoccer import LEARN, Matches, Policy
from rsoccer.arrays import Floats
from rsoccer.controllers import Controllers
from rsoccer.policies.base import Memory, PolicyInput
from rsoccer.rng import WorldRng
from rsoccer.tasks import VssMulti, VssSelfPlay
from tests.helpers import Crowd, begun, same, zeros


class Mirror(Policy):
    """Acts by its own position, and counts its calls."""

    observes = "view"

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        return {"calls": np.zeros(shape[0])}

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        memory["calls"] += 1
        assert inputs.view is not None
        return inputs.view.ego.position * 5.0


def test_any_controller_can_control_any_robot() -> None:
    controllers: Controllers = {
        "all": "zero",
        "yellow": Mirror(),
        "yellow_1": LEARN,
        "blue_2": "uniform",
    }
    matches = Matches(VssSelfPlay(), 3, seed=2, controllers=controllers)
    assert matches.agents == ("yellow_1",)
    assert matches.play.observers.tolist() == [3, 4, 5]
    assert matches.reset().shape == (3, 1, matches.observation_size)
    position = matches.play.view.ego.position.copy()
    matches.step(np.full((3, 1, 2), 0.5, np.float32))
    actions = matches.play.actions
    assert not actions[:, :2].any()
    assert actions[:, 2].any()
    assert (actions[:, 4] == 0.5).all()
    assert (actions[:, [3, 5]] == np.clip(position[:, [0, 2]] * np.float32(5.0), -1, 1)).all()
    assert matches.state_dict()["yellow_0.calls"].tolist() == [1, 1, 1]


def test_observations_and_rewards_do_not_depend_on_other_observers() -> None:
    alone = Matches(Crowd(), 4, seed=2, controllers={"all": "zero", "yellow_1": LEARN})
    again = Matches(Crowd(), 4, seed=2, controllers={"all": "zero", "yellow_1": LEARN})
    everyone = Matches(Crowd(), 4, seed=2)
    assert same(alone.reset(), again.reset())
    assert same(alone.reset(seed=4), everyone.reset(seed=4)[:, [4]])
    actions = np.zeros((4, 6, 2), np.float32)
    actions[:, 4] = 0.7
    one, six = alone.step(actions[:, [4]]), everyone.step(actions)
    assert same(one.rewards, six.rewards[:, [4]])
    assert same(one.observations, six.observations[:, [4]])


def test_matches_without_learners_play_on() -> None:
    matches = Matches(VssMulti(max_steps=20), 3, controllers={"all": "chase"})
    assert matches.agents == ()
    assert matches.reset().shape == (3, 0, matches.observation_size)
    for _ in range(20):
        outcome = matches.step(zeros(matches))
    assert outcome.rewards.shape == (3, 0)
    assert outcome.truncated.all()


def test_a_policy_of_the_wrong_shape_is_named() -> None:
    class Short(Mirror):
        def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
            return np.zeros(inputs.action_shape[:2], np.float32)

    matches = begun(VssSelfPlay(), controllers={"blue": Short()})
    with pytest.raises(ValueError, match=r"Short: expected actions \(5, 3, 2\), got \(5, 3\)"):
        matches.step(zeros(matches))
