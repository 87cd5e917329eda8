"""Line-ups: which robots learn."""

from dataclasses import dataclass

import pytest

import rsoccer
from rsoccer.lineup import learning_team, opponents_of
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


def test_a_task_needs_a_robot_that_learns() -> None:
    @dataclass(frozen=True)
    class Film(VssSelfPlay):
        name = "Film-v0"

        def default_controllers(self) -> dict[str, str | Learn]:
            return dict.fromkeys(self.robots, "scripted")

    for function in (learning_team, opponents_of):
        with pytest.raises(ValueError, match="task: expected one with a robot that learns, Film"):
            function(Film())
