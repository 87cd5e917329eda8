import importlib
from dataclasses import dataclass
from pathlib import Path

import gymnasium
import numpy as np
import pytest

import rsoccer
from rsoccer import registry
from rsoccer.arrays import Floats
from rsoccer.play import Play
from rsoccer.registry import names as registry_names
from rsoccer.task import Task
from rsoccer.tasks import VssMulti, VssSelfPlay


@pytest.fixture(autouse=True)
def restored_registry(monkeypatch: pytest.MonkeyPatch) -> None:
    """Remove the names that a test registers."""
    for table in ("_TASKS", "_ALIASES", "_REMOVED"):
        monkeypatch.setattr(registry_names, table, dict(getattr(registry_names, table)))


def test_every_task_of_the_package_is_registered() -> None:
    """All task classes of the package's modules except base classes."""
    folder = Path(rsoccer.tasks.__file__).parent
    modules = [importlib.import_module(f"rsoccer.tasks.{p.stem}") for p in folder.glob("*.py")]
    found = {
        value
        for module in modules
        for value in vars(module).values()
        if isinstance(value, type) and issubclass(value, Task) and value is not Task
    }
    bases = {base for task_class in found for base in task_class.__mro__[1:]}
    registered = {type(rsoccer.make_task(name)) for name in rsoccer.list_tasks()}
    assert found - bases <= registered
    assert len(found - bases) >= 2


@dataclass(frozen=True)
class Counting(VssSelfPlay):
    """A task whose observation depends on its time limit."""

    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        left = 1.0 - play.steps / self.max_steps
        shape = (len(left), len(play.observers), 1)
        return {"left": np.broadcast_to(left[:, None, None], shape).astype(np.float32)}


def test_a_time_limit_is_that_of_the_observations_too() -> None:
    task = Counting()
    assert task.layout.size == 1  # which is kept
    matches = rsoccer.Matches(task, max_steps=4)
    matches.reset()
    for _ in range(4):
        outcome = matches.step(np.zeros((1, 6, 2), np.float32))
    assert outcome.truncated[0]
    assert (outcome.final_observations == 0.0).all()
    assert task.max_steps == 1200


def test_options_are_the_fields_of_a_task() -> None:
    task = rsoccer.make_task("VSSMulti-v0", opponent="uniform", n_blue=2, max_steps=50)
    assert isinstance(task, VssMulti)
    assert (task.opponent, task.n_blue, task.max_steps) == ("uniform", 2, 50)
    assert task.name == "VSSMulti-v0"
    assert rsoccer.make_task("VSSSelfPlay-v0").name == "VSSSelfPlay-v0"


def test_an_unknown_task_is_named_with_the_valid_ones() -> None:
    with pytest.raises(ValueError, match=r"unknown task 'VSS-v9'.*'VSSMulti-v0'.*'VSSSelfPlay-v0'"):
        rsoccer.make_task("VSS-v9")


def test_an_unknown_option_is_named_with_the_valid_ones() -> None:
    expected = r"VSSSelfPlay-v0: got an unexpected keyword argument 'oponent'; .*'n_blue'"
    with pytest.raises(TypeError, match=expected):
        rsoccer.make_task("VSSSelfPlay-v0", oponent="ou")


def test_a_new_task_gets_its_name() -> None:
    class Mine(VssSelfPlay):
        pass

    rsoccer.register("Mine-v3", Mine)
    assert "Mine-v3" in rsoccer.list_tasks()
    assert rsoccer.make_task("Mine-v3").name == "Mine-v3"
    rsoccer.register("Mine-v3", Mine)  # as a reloaded module does
    assert VssSelfPlay.name == "VSSSelfPlay-v0"


def test_a_second_name_does_not_rename_the_tasks_of_the_first() -> None:
    """The second name once replaced the first in existing tasks and their files."""

    class Mine(VssSelfPlay):
        pass

    rsoccer.register("Mine-v0", Mine)
    with pytest.raises(ValueError, match=r"known as 'Mine-v0' already; registry.alias\('Yours-v0'"):
        rsoccer.register("Yours-v0", Mine)
    assert Mine.name == "Mine-v0"
    assert "Yours-v0" not in rsoccer.list_tasks()
    registry.alias("Yours-v0", "Mine-v0")
    assert type(rsoccer.make_task("Yours-v0")) is Mine

    class Further(Mine):
        pass

    rsoccer.register("Further-v0", Further)
    assert (Mine.name, Further.name) == ("Mine-v0", "Further-v0")


@pytest.mark.parametrize("error", [TypeError, ValueError, KeyError])
def test_register_raises_errors_of_the_constructor(error: type[Exception]) -> None:
    """The task was once registered, but silently without an id in any library."""

    class Mine(VssSelfPlay):
        def __init__(self) -> None:
            raise error("a mistake of its author")

    with pytest.raises(error, match="a mistake of its author"):
        rsoccer.register("Mine-v0", Mine)
    assert "Mine-v0" not in rsoccer.list_tasks()
    assert Mine.name == "Mine"


def test_a_task_need_not_be_a_dataclass() -> None:
    class Plain(VssSelfPlay):
        def __init__(self, speed: float = 0.1) -> None:
            super().__init__(ball_speed=speed)

    rsoccer.register("Plain-v0", Plain)
    assert rsoccer.make_task("Plain-v0", speed=0.3).max_steps == 1200


def test_a_task_that_is_defined_anew_replaces_the_former() -> None:
    """As in a cell of a notebook that runs again."""
    made: dict[str, type[Task]] = {}
    cell = "class Again(VssSelfPlay):\n    text = {text!r}\n"
    for text in ("first", "second"):
        space = {"VssSelfPlay": VssSelfPlay, "__name__": "__main__"}
        exec(cell.format(text=text), space)
        made[text] = space["Again"]  # type: ignore[assignment]
        rsoccer.register("Again-v0", made[text])
        assert type(rsoccer.make_task("Again-v0")) is made[text]
    assert made["first"] is not made["second"]
    assert gymnasium.make("rsoccer/Again-v0", learner="blue_0").unwrapped is not None


def test_a_name_belongs_to_one_task() -> None:
    with pytest.raises(ValueError, match="already taken by VssMulti"):
        rsoccer.register("VSSMulti-v0", VssSelfPlay)


def test_an_alias_has_options_of_its_own() -> None:
    registry.alias("Duel-v0", "VSSSelfPlay-v0", n_blue=1, n_yellow=1)
    registry.alias("Duel-v0", "VSSSelfPlay-v0", n_blue=1, n_yellow=1)  # as a reloaded module does
    assert rsoccer.make_task("Duel-v0") == VssSelfPlay(n_blue=1, n_yellow=1)
    assert registry.list_aliases()["Duel-v0"] == ("VSSSelfPlay-v0", {"n_blue": 1, "n_yellow": 1})
    assert "Duel-v0" not in rsoccer.list_tasks()


def test_an_alias_may_refer_to_an_alias() -> None:
    registry.alias("Duel-v0", "VSSSelfPlay-v0", n_blue=1, n_yellow=1)
    registry.alias("ShortDuel-v0", "Duel-v0", max_steps=40)
    assert rsoccer.make_task("ShortDuel-v0") == VssSelfPlay(n_blue=1, n_yellow=1, max_steps=40)
    assert rsoccer.make_task("ShortDuel-v0", n_yellow=2).n_yellow == 2


@pytest.mark.parametrize(
    ("name", "task", "options", "message"),
    [
        ("VSS-v0", "VSSMulti-v0", {}, "'VSS-v0' is already taken"),
        ("VSSMA-v0", "VSSSelfPlay-v0", {}, "'VSSMA-v0' is already taken"),
        ("Duel", "VSSSelfPlay-v0", {}, "expected letters and a version"),
        ("Duel-v0", "Chess-v0", {}, "unknown task 'Chess-v0'"),
        ("Duel-v0", "VSSSelfPlay-v0", {"robots": 1}, "unexpected keyword argument 'robots'"),
        ("Duel-v0", "VSSSelfPlay-v0", {"n_blue": 0}, "n_blue: expected at least 1"),
    ],
)
def test_invalid_aliases_are_refused(
    name: str, task: str, options: dict[str, int], message: str
) -> None:
    before = registry.list_aliases()
    with pytest.raises((TypeError, ValueError), match=message):
        registry.alias(name, task, **options)
    assert registry.list_aliases() == before


def test_a_task_cannot_take_the_name_of_an_alias() -> None:
    with pytest.raises(ValueError, match="'VSSMA-v0' is already taken, for VSSMulti-v0"):
        rsoccer.register("VSSMA-v0", VssSelfPlay)


def test_a_removed_name_suggests_a_replacement() -> None:
    registry.register_removed("Chess-v0", "take VSS-v0")
    with pytest.raises(ValueError, match="unknown task 'Chess-v0': take VSS-v0"):
        rsoccer.make_task("Chess-v0")


@pytest.mark.parametrize("name", ["VSS-v0", "VSSMA-v0", "Chess"])
def test_a_name_in_use_cannot_be_removed(name: str) -> None:
    with pytest.raises(ValueError, match="name: "):
        registry.register_removed(name, "take another")


@pytest.mark.parametrize("name", ["", "Mine", "Mine-v", "-v0", "My Task-v0", "9-v0"])
def test_a_name_has_a_version(name: str) -> None:
    with pytest.raises(ValueError, match="expected letters and a version"):
        rsoccer.register(name, VssSelfPlay)


def test_only_tasks_can_be_registered() -> None:
    with pytest.raises(TypeError, match="a subclass of Task"):
        rsoccer.register("Mine-v0", dict)  # type: ignore[arg-type]


def test_a_task_that_is_not_registered_has_the_name_of_its_class() -> None:
    """It once had the name of its parent, under which policies and results named another task."""

    @dataclass(frozen=True)
    class Mine(VssSelfPlay):
        pass

    @dataclass(frozen=True)
    class Further(Mine):
        name = "Further-v0"

    @dataclass(frozen=True)
    class Labeled(Mine):
        name: str = "of an option"

    @dataclass(frozen=True)
    class Relabeled(Labeled):
        pass

    assert [each().name for each in (Mine, Further)] == ["Mine", "Further-v0"]
    assert [each().name for each in (Labeled, Relabeled)] == ["of an option"] * 2
    assert rsoccer.evaluate("zero", "zero", 2, task=Mine(max_steps=2)).task == "Mine"
    assert [registry.is_registered(task) for task in (Mine(), VssSelfPlay())] == [False, True]
    nearest = {registry.nearest_name(task) for task in (Mine(), Further(), VssSelfPlay())}
    assert nearest == {"VSSSelfPlay-v0"}
