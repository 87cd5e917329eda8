"""Programs of commands that show all numbers of a robot."""

import csv

import numpy as np
import pytest

from rsoccer import RobotModel
from rsoccer.identify import Program, program


@pytest.mark.parametrize("robot", ["ssl_generic", "vss_440rpm"])
def test_a_program_commands_every_number_there_and_back(robot: str) -> None:
    made = program(robot)
    assert made.seconds < 60.0
    assert (np.diff(made.times) > 0.0).all()
    assert not made.wheels[0].any()
    assert not made.wheels[-1].any()
    for column in made.wheels.T:
        assert column.max() > 0.0
        assert column.max() == pytest.approx(-column.min())
    assert made.wheels.sum(axis=0) == pytest.approx(0.0, abs=1e-9)
    assert len(made.balls) == 3
    assert (made.kicks > 0.0).sum() == (3 if robot == "ssl_generic" else 0)


def test_speeds_can_be_given() -> None:
    made = program("ssl_generic", max_speed=1.5, max_angular_velocity=4.0, pause=3.0)
    assert made.wheels.max(axis=0).tolist() == [1.5, 1.5, 4.0]
    without = program("ssl_generic", max_speed=1.5, max_angular_velocity=4.0)
    assert made.seconds > without.seconds + 7.0
    top = RobotModel("ssl_generic").top_speed
    assert program("ssl_generic").wheels[:, 0].max() > 1.1 * top


def test_a_program_holds_its_commands() -> None:
    made = Program("omni", np.array([0.0, 1.0]), np.eye(3)[:2], np.array([0.0, 2.0]), 2.0, ())
    wheels, kicks = made.at(np.array([-1.0, 0.0, 0.999, 1.0, 5.0]))
    assert wheels.argmax(axis=1).tolist() == [0, 0, 0, 1, 1]
    assert kicks.tolist() == [0.0, 0.0, 0.0, 2.0, 2.0]


def test_a_program_as_csv() -> None:
    made = program("ssl_generic")
    first, *rows = csv.reader(made.to_csv(50.0).splitlines())
    assert first == ["time", "v_x", "v_y", "v_theta", "kick_v_x"]
    assert len(rows) == int(made.seconds * 50.0)
    assert max(float(row[1]) for row in rows) == pytest.approx(made.wheels[:, 0].max(), rel=1e-4)
    first, *rows = csv.reader(program("vss_440rpm").to_csv().splitlines())
    assert first == ["time", "left", "right"]


def test_faulty_programs_are_refused() -> None:
    with pytest.raises(ValueError, match="expected a drive"):
        program("ssl_generic_wheels")
    with pytest.raises(TypeError, match="robot"):
        program(3)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="speed"):
        program(max_speed=0.0)
    with pytest.raises(ValueError, match="pause"):
        program(pause=-1.0)
    for number in ("max_speed", "max_angular_velocity", "pause"):
        with pytest.raises(ValueError, match=r"^program: expected at most 3600 s, got .*e\+1"):
            program(**{number: 1e12})  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="rate"):
        program().to_csv(0.0)
