"""Policies by name."""

from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer import policies
from rsoccer.arrays import Floats
from rsoccer.policies import names
from rsoccer.policies.base import Memory, Policy, PolicyInput
from rsoccer.rng import WorldRng
from rsoccer.task import Task


class Turning(Policy):
    observes = "nothing"

    def __init__(self, task: Task | None = None, skill: float = 1.0) -> None:
        super().__init__(task)
        self.skill = skill

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        return np.full(inputs.action_shape, self.skill, np.float32)


class Unfinished(Policy):
    observes = "nothing"


@pytest.fixture(autouse=True)
def _registered(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(names, "_MAKERS", dict(names._MAKERS))


def test_a_registered_policy_is_known_by_its_name_everywhere() -> None:
    rsoccer.register_policy("turning", Turning)
    rsoccer.register_policy("turning", Turning)  # twice is once
    task = rsoccer.make_task("VSSMulti-v0", opponent="turning:0.5")
    matches = rsoccer.Matches(task, controllers={"blue": "turning"})
    matches.reset()
    matches.step(np.zeros((1, 0, 2), np.float32))
    assert matches.play.actions[0, :, 0].tolist() == [1.0, 1.0, 1.0, 0.5, 0.5, 0.5]
    assert rsoccer.evaluate("turning", "ou", matches=2).policy == "turning"
    assert "turning" in policies.list_policies()
    assert "turning" in policies.list_policies_with_skill()
    assert policies.file_of("turning:0.5") is None


def test_a_function_may_make_a_policy() -> None:
    rsoccer.register_policy("slow", lambda task: Turning(task, 0.25))
    made = policies.make_policy("slow", rsoccer.make_task("VSS-v0"))
    assert isinstance(made, Turning)
    assert made.skill == 0.25
    with pytest.raises(ValueError, match="policy 'slow' has no skill"):
        policies.make_policy("slow:0.5", rsoccer.make_task("VSS-v0"))


@pytest.mark.parametrize(
    ("name", "maker", "message"),
    [
        ("ou", Turning, "name: 'ou' is already taken"),
        ("latest", Turning, "name: 'latest' is already taken"),
        ("my policy", Turning, "name: expected letters, digits and underscores, got 'my policy'"),
        ("turn:1", Turning, "name: expected letters"),
        ("Turn-v0", Turning, "name: expected letters"),
        (3, Turning, "name: expected text, got 3"),
        ("turning", Turning(), "maker: expected a subclass of Policy, or a function"),
        ("turning", dict, "maker: expected a subclass of Policy"),
        ("turning", "Turning", "maker: expected a subclass of Policy"),
        ("turning", Unfinished, "has no `act` of its own"),
        ("turning", lambda: Turning(), "maker: expected to be called with the task alone"),
        ("turning", lambda task, robot: Turning(), "called with the task alone.*robot"),
    ],
)
def test_wrong_registrations_are_refused(name: Any, maker: Any, message: str) -> None:  # noqa: ANN401
    with pytest.raises((TypeError, ValueError), match=message):
        rsoccer.register_policy(name, maker)


def test_a_maker_has_to_return_a_policy() -> None:
    rsoccer.register_policy("nothing", lambda task: None)  # type: ignore[arg-type, return-value]
    with pytest.raises(TypeError, match="nothing: expected its maker to return a Policy, got None"):
        policies.make_policy("nothing", rsoccer.make_task("VSS-v0"))


@pytest.mark.parametrize(
    ("raised", "kind"),
    [(KeyError("lost"), RuntimeError), (ValueError("lost"), ValueError), (OSError(), RuntimeError)],
)
def test_a_maker_that_raises_is_named(raised: Exception, kind: type[Exception]) -> None:
    """Formerly the error alone, in a traceback."""

    def make(task: Task) -> Policy:
        raise raised

    rsoccer.register_policy("faulty", make)
    message = f"^policy 'faulty': its maker raises {type(raised).__name__}: "
    with pytest.raises(kind, match=message) as error:
        rsoccer.Matches("VSS-v0", controllers={"all": "faulty"})
    assert error.value.__cause__ is raised


def test_a_maker_that_is_defined_anew_replaces_the_former() -> None:
    """As in a cell of a notebook that runs again."""
    for speed in (0.25, 0.5):
        space = {"Turning": Turning, "__name__": "__main__"}
        exec(f"def make(task):\n    return Turning(task, {speed})\n", space)
        rsoccer.register_policy("again", space["make"])  # type: ignore[arg-type]
        made = policies.make_policy("again", rsoccer.make_task("VSS-v0"))
        assert isinstance(made, Turning)
        assert made.skill == speed
