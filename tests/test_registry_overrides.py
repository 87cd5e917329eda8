"""Options that a class sets in ways which its dataclass ignores."""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import ClassVar

import pytest

import rsoccer
from rsoccer._core import SimConfig
from rsoccer.registry import check_overrides, list_tasks, task_class
from rsoccer.task import Task
from rsoccer.tasks import VssSelfPlay


@dataclass(frozen=True)
class WithoutAnnotation(VssSelfPlay):
    n_blue = 1


class WithoutDecorator(VssSelfPlay):
    n_blue: int = 1


class WithoutBoth(VssSelfPlay):
    n_blue = 1


class Short:
    max_steps = 400


@dataclass(frozen=True)
class Mixed(Short, VssSelfPlay):
    pass


@dataclass(frozen=True)
class WithWeights(VssSelfPlay):
    weights: dict[str, float] = field(default_factory=dict)
    strength: float = field(kw_only=True)


@dataclass(frozen=True)
class OtherWeights(WithWeights):
    weights = {"goal": 1.0}  # noqa: RUF012


@dataclass(frozen=True)
class Stronger(WithWeights):
    strength = 2.0


@dataclass(frozen=True)
class One(VssSelfPlay):
    n_blue: int = 1


@dataclass(frozen=True)
class Other(VssSelfPlay):
    pass


@dataclass(frozen=True)
class Both(Other, One):
    """Its constructor takes the default of `Other`, and its class attribute is that of `One`."""


DECORATED = (
    "expected @dataclass(frozen=True) above the class and `n_blue: int = 1` in it: "
    "without them the option keeps 3"
)
FAULTS = {
    WithoutAnnotation: "WithoutAnnotation.n_blue: expected an annotation, as in `n_blue: int = 1`: "
    "without one the option keeps 3",
    WithoutDecorator: f"WithoutDecorator: {DECORATED}",
    WithoutBoth: f"WithoutBoth: {DECORATED}",
    Mixed: "Short: expected @dataclass(frozen=True) above the class and `max_steps: int = 400` in "
    "it: without them the option keeps 1200",
    OtherWeights: "OtherWeights.weights: expected an annotation, as in "
    "`weights: dict = {'goal': 1.0}`: without one the option keeps {}",
    Stronger: "Stronger.strength: expected an annotation, as in `strength: float = 2.0`: "
    "without one the option has no default",
    Both: "Both.n_blue: expected an annotation, as in `n_blue: int = 1`: "
    "without one the option keeps 3",
}


@pytest.mark.parametrize("task", FAULTS)
def test_an_override_that_is_ignored_is_refused(task: type[Task]) -> None:
    """The task once played the option of its parent, and nothing said so."""
    with pytest.raises(TypeError) as caught:
        check_overrides(task)
    assert str(caught.value) == FAULTS[task]


USES: dict[str, Callable[[], object]] = {
    "register": lambda: rsoccer.register("Mine-v0", WithoutDecorator),
    "matches": lambda: rsoccer.Matches(WithoutDecorator()),
    "environment": lambda: rsoccer.parallel_env(WithoutDecorator()),
    "evaluate": lambda: rsoccer.evaluate("zero", matches=2, task=WithoutDecorator()),
}


@pytest.mark.parametrize("use", USES)
def test_it_is_refused_where_the_task_is_used(use: str) -> None:
    with pytest.raises(TypeError, match=r"^WithoutDecorator: expected @dataclass\(frozen=True\)"):
        USES[use]()
    assert "Mine-v0" not in rsoccer.list_tasks()
    assert WithoutDecorator.name == "WithoutDecorator"


class WithoutOptions(VssSelfPlay):
    text = "anything"

    def markers(self, play: object, world: int) -> tuple[()]:
        return ()


class OwnConstructor(VssSelfPlay):
    n_blue = 1

    def __init__(self, speed: float = 0.1) -> None:
        super().__init__(ball_speed=speed, n_blue=1)


@dataclass(frozen=True)
class Overriding(One):
    """Overrides of all kinds that are in effect."""

    n_yellow: int = 1
    ball_speed: ClassVar[float] = 0.2  # type: ignore[misc]
    success = None  # type: ignore[assignment]

    @cached_property
    def config(self) -> SimConfig:
        return super().config


@pytest.mark.parametrize("task", [WithoutOptions, OwnConstructor, One, Other, Overriding])
def test_overrides_that_are_in_effect_are_taken(task: type[Task]) -> None:
    check_overrides(task)
    assert task().layout.size > 0


@pytest.mark.parametrize("name", list_tasks())
def test_tasks_of_the_package_override_no_option_in_vain(name: str) -> None:
    check_overrides(task_class(name))
