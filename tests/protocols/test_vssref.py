"""VSSReferee's packets."""

import numpy as np
import pytest

from rsoccer.game import BLUE, YELLOW, Command, Stage
from rsoccer.protocols import vssref
from rsoccer.protocols.errors import Code, MessageError
from rsoccer.protocols.parsing import parse
from rsoccer.protocols.schemas import vssref_pb2
from tests.protocols.matches import SIDES, VSSS, codes, layout, state

COMMANDS = [
    command for command in Command if not command.name.startswith(("BALL_PLACEMENT", "FORCE"))
]
HALVES = [
    stage for stage in Stage if stage.name.endswith("HALF") or stage is Stage.PENALTY_SHOOTOUT
]


@pytest.mark.parametrize("command", COMMANDS)
def test_commands_survive_the_wire(command: Command) -> None:
    for stage in HALVES:
        sent = vssref.to_command(layout(VSSS), command, stage, timestamp=2.5, position=(0.3, 0.4))
        status = vssref.read_command(parse(vssref_pb2.Command, sent.SerializeToString()))
        free = int(command is Command.FREE_BALL)
        assert status == (command, stage, free, 2.5)
    assert len(HALVES) == 5


def test_a_force_start_is_a_start() -> None:
    sent = vssref.to_command(layout(VSSS), Command.FORCE_START, Stage.POST_GAME, timestamp=0.0)
    assert sent.foul == vssref_pb2.GAME_ON
    assert vssref.read_command(sent)[:2] == (Command.NORMAL_START, None)


@pytest.mark.parametrize("command", [Command.BALL_PLACEMENT_BLUE, Command.BALL_PLACEMENT_YELLOW])
def test_commands_of_the_other_league_are_refused(command: Command) -> None:
    with pytest.raises(MessageError, match=r"^command: expected one of VSSS") as error:
        vssref.to_command(layout(VSSS), command, Stage.NORMAL_FIRST_HALF, timestamp=0.0)
    assert error.value.code is Code.UNSUPPORTED_COMMAND


@pytest.mark.parametrize(
    ("position", "number"),
    [((0.3, 0.4), 1), ((-0.3, 0.4), 2), ((-0.3, -0.4), 3), ((0.3, -0.4), 4), ((0.0, 0.0), 3)],
)
def test_quadrants_are_counted_counterclockwise_on_the_wire(
    position: tuple[float, float], number: int
) -> None:
    assert vssref.quadrant(layout(VSSS), position) == number
    turned = (-position[0], -position[1])
    assert vssref.quadrant(layout(VSSS, positive=True), turned) == number


@pytest.mark.parametrize(
    ("fields", "code"),
    [
        ({"foul": 8}, Code.UNSUPPORTED_COMMAND),
        ({"foul": 1, "teamcolor": 2}, Code.UNSUPPORTED_COMMAND),
        ({"foul": 1, "teamcolor": 7}, Code.UNSUPPORTED_COMMAND),
        ({"foul": 3, "foulQuadrant": 5}, Code.OUT_OF_RANGE),
        ({"foul": 5, "gameHalf": -1}, Code.OUT_OF_RANGE),
    ],
)
def test_values_that_do_not_exist_are_refused(fields: dict[str, int], code: Code) -> None:
    with pytest.raises(MessageError) as error:
        vssref.read_command(vssref_pb2.Command(**fields))  # type: ignore[arg-type]
    assert error.value.code is code


@pytest.mark.parametrize("positive", SIDES)
@pytest.mark.parametrize("team", [BLUE, YELLOW])
def test_placements_survive_the_wire(positive: bool, team: int) -> None:
    made, frame, before = layout(VSSS, positive=positive), state(VSSS), state(VSSS, seed=5)
    sent = vssref.to_placement(made, frame, 1, team).SerializeToString()
    message = parse(vssref_pb2.Placement, sent)
    placement = vssref.read_placement(made, message, before)
    slots = list(made.slots(team))
    robots = placement.frame.robots
    assert np.allclose(robots.position[0, slots], frame.robots.position[1, slots], atol=1e-6)
    assert np.allclose(robots.heading[0, slots], frame.robots.heading[1, slots], atol=1e-6)
    assert placement.robots.nonzero()[0].tolist() == slots
    assert not placement.ball
    others = [slot for slot in range(6) if slot not in slots]
    assert np.array_equal(robots.data[0, others], before.robots.data[0, others])


def test_placements_of_nobody_and_of_unknown_robots() -> None:
    message = vssref_pb2.Placement()
    message.world.teamColor = vssref_pb2.NONE
    with pytest.raises(MessageError, match=r"^teamColor: expected 0 or 1, got 2"):
        vssref.read_placement(layout(VSSS), message, state(VSSS))
    message.world.teamColor = vssref_pb2.BLUE
    message.world.robots.add(robot_id=77)
    placement = vssref.read_placement(layout(VSSS), message, state(VSSS))
    assert codes(placement.problems) == [Code.UNKNOWN_ROBOT]
