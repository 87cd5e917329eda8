from collections.abc import Callable
from typing import Any, ClassVar

import numpy as np
import pytest

from rsoccer import LEARN, CommandPolicy, Matches, Policy
from rsoccer.arrays import Array, Floats
from rsoccer.controllers import Controllers
from rsoccer.evaluate import evaluate
from rsoccer.policies.base import Memory, PolicyInput
from rsoccer.rng import WorldRng
from rsoccer.tasks import SslSelfPlay, VssMulti, VssSelfPlay
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


class Wrong(Mirror):
    """Returns the given value in place of actions."""

    def __init__(self, value: Any) -> None:  # noqa: ANN401  (any mistake)
        super().__init__()
        self._value = value

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        return self._value  # type: ignore[no-any-return]


@pytest.mark.parametrize(
    ("value", "error", "message"),
    [
        (np.zeros((5, 3), np.float32), ValueError, r"expected shape \(5, 3, 2\), got \(5, 3\)"),
        (np.ones((5, 3, 2), np.int64), TypeError, "expected a floating-point array, got int64"),
        (np.full((5, 3, 2), np.nan, np.float32), ValueError, r".* got nan at \(0, 0, 0\)"),
        (np.full((5, 3, 2), -np.inf), ValueError, r".* got -inf at \(0, 0, 0\)"),
        (None, TypeError, "expected a floating-point array, got NoneType"),
        (0.5, ValueError, r"expected shape \(5, 3, 2\), got \(\)"),
        ("left", TypeError, "expected a floating-point array, got <U4"),
        ([[1.0], [1.0, 2.0]], ValueError, "expected an array, got a list whose parts differ"),
    ],
    ids=["shape", "int", "nan", "infinity", "none", "number", "text", "ragged"],
)
def test_what_a_policy_returns_in_place_of_actions_is_named(
    value: object, error: type[Exception], message: str
) -> None:
    matches = begun(VssSelfPlay(), controllers={"blue": Wrong(value)})
    with pytest.raises(error, match=rf"Wrong\.act: {message}"):
        matches.step(zeros(matches))


@pytest.mark.parametrize("value", [None, 0.5, "left"])
def test_wrong_results_are_named_where_actions_may_be_left_out(value: object) -> None:
    task = SslSelfPlay(chip_kick=True)
    assert task.optional_action_size
    matches = begun(task, controllers={"blue": Wrong(value)})
    with pytest.raises((TypeError, ValueError), match=r"Wrong\.act: expected"):
        matches.step(zeros(matches))


def test_actions_of_a_policy_are_cast_and_clipped() -> None:
    given = begun(VssSelfPlay(), controllers={"blue": Wrong(np.full((5, 3, 2), 1e300).tolist())})
    full = begun(VssSelfPlay(), controllers={"blue": Wrong(np.ones((5, 3, 2), np.float32))})
    for matches in (given, full):
        matches.step(zeros(matches))
    assert same(given.frame.rows, full.frame.rows)


class Forgetful(Mirror):
    """Keeps another memory than it began with."""

    def __init__(self, keep: Callable[[Memory], None]) -> None:
        super().__init__()
        self._keep = keep

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        self._keep(memory)
        return np.zeros(inputs.action_shape, np.float32)


@pytest.mark.parametrize(
    ("keep", "found"),
    [
        (lambda memory: memory.update(more=np.zeros(5)), r"'more': \(5,\)"),
        (lambda memory: memory.update(calls=np.zeros(7)), r"'calls': \(7,\)"),
        (lambda memory: memory.update(calls=[0.0] * 5), "'calls': None"),
        (lambda memory: memory.clear(), r"got \{\}"),
    ],
    ids=["more", "shape", "list", "less"],
)
def test_a_policy_keeps_the_memory_that_it_began_with(
    keep: Callable[[Memory], None], found: str
) -> None:
    matches = begun(VssSelfPlay(), controllers={"blue": Forgetful(keep)})
    message = rf"Forgetful\.act: expected a memory of \{{'calls': \(5,\)\}} .*{found}"
    with pytest.raises(ValueError, match=message):
        matches.step(zeros(matches))


def test_every_episode_begins_with_the_same_kind_of_memory() -> None:
    class Moody(Mirror):
        def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
            return {f"of {shape[0]}": np.zeros(shape[0])}

    matches = Matches(VssSelfPlay(), 5, controllers={"blue": Moody()})
    matches.reset()
    with pytest.raises(ValueError, match=r"Moody\.new_memory: expected .*'of 5'.* got .*'of 2'"):
        matches.reset(mask=np.array([True, True, False, False, False]))


@pytest.mark.parametrize("observes", [None, "observations"])
def test_a_policy_says_what_it_observes(observes: str | None) -> None:
    got = "none" if observes is None else repr(observes)
    silent = type("Silent", (Policy,), {"act": Mirror.act})
    policy = silent()
    if observes is not None:
        policy.observes = observes
    message = rf"Silent\.observes: expected one of \['nothing', 'view', .*\], got {got}"
    with pytest.raises(ValueError, match=message):
        Matches(VssSelfPlay(), 5, controllers={"blue": policy})


class Wheels(CommandPolicy):
    """Commands wheel speeds of its own, drawn and counted."""

    observes = "view"

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        return {"calls": np.zeros(shape[0])}

    def commands(
        self, inputs: PolicyInput, converted: Floats, rng: WorldRng, memory: Memory
    ) -> Floats:
        memory["calls"] += 1
        assert inputs.view is not None
        assert not converted.any(), "zero actions"
        return 3.0 + rng.uniform(0.0, 1.0, converted.shape[1:])


def test_a_controller_in_si_units_replaces_the_commands_of_its_robots_alone() -> None:
    controllers: Controllers = {"all": "ou", "yellow": Wheels(), "blue_0": LEARN}
    matches = Matches(VssSelfPlay(), 3, seed=2, controllers=controllers)
    matches.reset()
    matches.step(np.full((3, 1, 2), 0.5, np.float32))
    play, top = matches.play, matches.task.config.robot.max_wheel_speed
    assert (play.commands[:, 3:] >= 3.0).all()
    assert (play.commands[:, 3:] <= 4.0).all()
    assert (play.commands[:, 0] == np.float32(0.5 * top)).all()
    assert not play.actions[:, 3:].any()
    assert play.actions[:, 1:3].any()
    plain = Matches(VssSelfPlay(), 3, seed=2, controllers={**controllers, "yellow": "zero"})
    plain.reset()
    plain.step(np.full((3, 1, 2), 0.5, np.float32))
    assert same(plain.play.commands[:, :3], play.commands[:, :3])


def test_a_controller_in_si_units_may_act_by_the_observations_of_its_robots() -> None:
    class Observing(CommandPolicy):
        observes = "observation"
        seen: ClassVar[list[Floats]] = []

        def commands(
            self, inputs: PolicyInput, converted: Floats, rng: WorldRng, memory: Memory
        ) -> Floats:
            assert inputs.observations is not None
            self.seen.append(inputs.observations.copy())
            return converted

    matches = begun(VssSelfPlay(), controllers={"yellow": Observing()})
    everyone = begun(VssSelfPlay(), controllers={"all": LEARN})
    shown = everyone.reset(seed=3)
    matches.reset(seed=3)
    matches.step(zeros(matches))
    assert len(Observing.seen) == 1
    assert same(Observing.seen[0], np.ascontiguousarray(shown[:, 3:]))


class Intruder(CommandPolicy):
    """Tries to write all that it is shown but its own observations, in both of its calls."""

    observes = "observation"
    refusals: ClassVar[list[str]] = []

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        match, view = inputs.match, inputs.view
        assert match is not None
        assert view is not None
        shown: dict[str, Array | None] = {
            "rows": match.rows,
            "score": match.game.score,
            "robots": match.robots,
            "ball": view.ball.data,
            "slots": view.robots.data,
            "playing": match.playing,
        }
        for name, array in shown.items():
            if array is not None:
                with pytest.raises(ValueError, match="read-only"):
                    array[...] = 1
                self.refusals.append(name)
        return super().act(inputs, rng, memory)

    def commands(
        self, inputs: PolicyInput, converted: Floats, rng: WorldRng, memory: Memory
    ) -> Floats:
        self.act(inputs, rng, memory)
        return converted


@pytest.mark.parametrize("sensing", [None, "rc2021", "rc2021, forecast=1, own_cameras=1"])
def test_policies_cannot_write_the_state_of_matches(sensing: str | None) -> None:
    matches = Matches(
        VssSelfPlay(max_steps=2),
        2,
        controllers={"yellow": Intruder()},
        sensing=sensing,
        autoreset="disabled",
    )
    matches.reset(seed=0)
    Intruder.refusals.clear()
    matches.step(zeros(matches))
    assert len(Intruder.refusals) == 2 * 5, "of all but `playing`, in both calls"
    matches.reset(mask=np.array([True, False]))
    matches.step(zeros(matches))
    matches.step(zeros(matches))
    assert "playing" in Intruder.refusals
    for frame in (matches.frame, matches.play.known_to_robots(np.array([0]))):
        with pytest.raises(ValueError, match="read-only"):
            frame.ball.position[:] = 0.0


def test_a_controller_in_si_units_is_reproduced_saved_and_copied_like_a_policy() -> None:
    def new(worlds: int, seed: int) -> Matches:
        task = VssSelfPlay(max_steps=7)
        matches = Matches(task, worlds, seed, controllers={"blue": "ou", "yellow": Wheels()})
        matches.reset()
        return matches

    matches, single = new(3, seed=4), new(1, seed=6)
    for _ in range(10):
        matches.step(zeros(matches))
        single.step(zeros(single))
    assert same(matches.frame.rows[2:], single.frame.rows)
    assert matches.state_dict()["yellow_0.calls"].tolist() == [3.0, 3.0, 3.0]
    resumed = new(3, seed=9)
    resumed.load_state_dict(matches.state_dict())
    for _ in range(5):
        matches.step(zeros(matches))
        resumed.step(zeros(resumed))
    assert same(matches.frame.rows, resumed.frame.rows)


def test_worlds_that_wait_keep_the_memory_of_a_controller_in_si_units() -> None:
    matches = Matches(
        VssSelfPlay(max_steps=2), 2, controllers={"all": Wheels()}, autoreset="disabled"
    )
    matches.reset()
    matches.step(zeros(matches))
    matches.reset(mask=np.array([False, True]))
    matches.step(zeros(matches))
    matches.step(zeros(matches))
    assert matches.state_dict()["blue_0.calls"].tolist() == [2.0, 2.0]


def test_a_controller_in_si_units_is_not_evaluated_by_its_actions() -> None:
    with pytest.raises(
        TypeError, match=r"policy: expected .* actions, got Wheels, which gives com"
    ):
        evaluate(Wheels(), task="VSS-v0", matches=2)


@pytest.mark.parametrize(
    ("commands", "message"),
    [
        (np.zeros((5, 3), np.float32), r"Wrong\.commands: expected shape \(5, 3, 2\)"),
        (np.full((5, 3, 2), np.nan, np.float32), r"Wrong\.commands: expected finite numbers"),
    ],
)
def test_wrong_commands_are_named(commands: Floats, message: str) -> None:
    class Wrong(CommandPolicy):
        observes = "nothing"

        def commands(
            self, inputs: PolicyInput, converted: Floats, rng: WorldRng, memory: Memory
        ) -> Floats:
            return commands

    matches = begun(VssSelfPlay(), controllers={"yellow": Wrong()})
    with pytest.raises(ValueError, match=message):
        matches.step(zeros(matches))
