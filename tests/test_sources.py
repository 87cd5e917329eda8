"""Ways to name a simulator and a sensor model, and what is refused."""

from typing import Any

import pytest

from rsoccer import Matches, Simulator
from tests.simulators import Blind, still


def test_the_packages_simulator_is_a_factory() -> None:
    assert isinstance(Matches("VSS-v0", 3, simulator=Simulator)._simulator, Simulator)


def test_a_factory_is_given_what_the_matches_have() -> None:
    given: list[Any] = []

    def make(*arguments: Any) -> Any:  # noqa: ANN401
        given.extend(arguments)
        return still(*arguments)

    matches = Matches("VSS-v0", 3, threads=2, simulator=make)
    assert given == [matches.task.config, 3, matches._threads]


def test_no_senses_are_the_truth() -> None:
    matches = Matches("VSS-v0")
    assert matches.play.sensed is matches.play.frame


NOT_A_TEXT = "expected a text 'module:name', got"


@pytest.mark.parametrize("argument", ["simulator", "sensing"])
@pytest.mark.parametrize(
    ("text", "error", "message"),
    [
        (":still", ValueError, NOT_A_TEXT),
        ("tests.simulators:", ValueError, NOT_A_TEXT),
        ("tests.simulators:two words", ValueError, NOT_A_TEXT),
        ("tests/simulators.py:still", ValueError, "expected the name of a module"),
        ("no_such_module:still", ImportError, "expected a module of .* got 'no_such_module'"),
        ("tests.simulators:tsill", ImportError, "module 'tests.simulators' has no 'tsill'"),
    ],
)
def test_a_text_that_names_nothing_is_refused(
    argument: str, text: str, error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=f"^{argument}: .*{message}"):
        Matches("VSS-v0", **{argument: text})  # type: ignore[arg-type]


def test_a_text_without_a_module_is_a_factory_or_a_preset() -> None:
    expected = r"expected grsim, .* or a text 'module:name', got 'still'"
    with pytest.raises(ValueError, match=rf"^simulator: {expected}"):
        Matches("VSS-v0", simulator="still")
    with pytest.raises(ValueError, match=r'sensing must be one of none, friendly.* got "still"'):
        Matches("VSS-v0", sensing="still")
    assert Matches("VSS-v0", sensing="none").play.senses is None


@pytest.mark.parametrize(
    ("argument", "given"),
    [
        ("simulator", 3),
        ("simulator", lambda *_: None),
        ("simulator", "tests.simulators:NOTHING"),
        ("sensing", 3),
        ("sensing", Blind),
        ("sensing", "tests.simulators:NOTHING"),
        ("sensing", "tests.simulators:BLIND.columns.__doc__"),
    ],
)
def test_other_objects_are_refused(argument: str, given: Any) -> None:  # noqa: ANN401
    with pytest.raises(TypeError, match=f"^{argument}: expected a .*, got "):
        Matches("VSS-v0", **{argument: given})


def test_a_factory_with_other_arguments_is_named() -> None:
    """Formerly Python's error, without a word of the argument."""

    def make(config: object) -> None:
        raise AssertionError

    message = r"^simulator: expected a function \(config, worlds, threads\), got .*make.*too many"
    with pytest.raises(TypeError, match=message) as error:
        Matches("VSS-v0", simulator=make)  # type: ignore[arg-type]
    assert isinstance(error.value.__cause__, TypeError)


def test_a_text_of_a_function_with_arguments_is_no_sensor_model() -> None:
    message = r"^sensing: expected a model or a function without arguments, got .*Matches.*'task'"
    with pytest.raises(TypeError, match=message):
        Matches("VSS-v0", sensing="rsoccer:Matches")


def test_the_error_of_a_factory_is_its_own() -> None:
    def make(config: object, worlds: int, threads: object) -> Any:  # noqa: ANN401
        raise ConnectionError("no robots")

    with pytest.raises(ConnectionError, match="no robots"):
        Matches("VSS-v0", simulator=make)
