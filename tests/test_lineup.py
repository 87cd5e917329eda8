"""Line-ups: which robots learn."""

from dataclasses import dataclass

import pytest

import rsoccer
from rsoccer.lineup import learning_team, opponents_of, script_of
from rsoccer.task import Learn
from rsoccer.tasks import VssSelfPlay


@pytest.mark.parametrize(
    ("task", "expected"),
    [
        ("VSS-v0", ("blue_0",)),
        ("VSSMulti-v0", ("blue_0", "blue_1", "blue_2")),
        ("VSSSelfPlay-v0", ("blue_0", "blue_1", "blue_2")),
        ("SSLPassEnduranceMulti-v1", ("blue_0", "blue_1")),
        ("SSLKeepaway-v0", ("blue_0", "blue_1", "blue_2")),
    ],
)
def test_one_team_learns_in_training(task: str, expected: tuple[str, ...]) -> None:
    assert learning_team(rsoccer.make_task(task)) == expected


@pytest.mark.parametrize(
    ("task", "script"),
    [
        ("SSLPassEndurance-v1", "passer"),
        ("SSLPassEnduranceMulti-v1", "passer"),
        ("SSLKeepaway-v0", "keep"),
        ("SSLMatch-v0", "scripted"),
        ("VSS-v0", "scripted"),
        ("SSLGoToBall-v0", "strike"),
    ],
)
def test_the_script_of_a_task_is_its_reference(task: str, script: str) -> None:
    assert script_of(rsoccer.make_task(task)) == script


def test_a_task_needs_a_robot_that_learns() -> None:
    @dataclass(frozen=True)
    class Film(VssSelfPlay):
        name = "Film-v0"

        def default_controllers(self) -> dict[str, str | Learn]:
            return dict.fromkeys(self.robots, "scripted")

    for function in (learning_team, opponents_of):
        with pytest.raises(ValueError, match="task: expected one with a robot that learns, Film"):
            function(Film())
