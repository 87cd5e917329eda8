"""Robots as the simulation protocol describes them."""

import math

import pytest

from rsoccer import RobotModel
from rsoccer.protocols.errors import Code, MessageError
from rsoccer.protocols.robot_specs import to_robot_model, to_robot_specs
from rsoccer.protocols.schemas import simulation_pb2

IDENTITY = simulation_pb2.RobotId(id=1, team=simulation_pb2.BLUE)


@pytest.mark.parametrize("name", ["ssl_erforce", "ssl_tigers", "ssl_generic_wheels"])
def test_robots_survive_the_wire(name: str) -> None:
    specs = to_robot_specs(RobotModel(name, max_speed=2.5), IDENTITY)
    found = to_robot_model(RobotModel("ssl_generic"), specs)
    for number in ("radius", "height", "mass", "front_distance", "max_speed", "max_kick_speed"):
        assert getattr(found, number) == getattr(RobotModel(name, max_speed=2.5), number)
    angles = zip(found.wheel_angles, RobotModel(name).wheel_angles, strict=True)
    assert all(math.isclose(now, then, abs_tol=1e-4) for now, then in angles)


def test_angles_are_clockwise_from_the_front() -> None:
    wheels = to_robot_specs(RobotModel("ssl_generic"), IDENTITY).wheel_angles
    degrees = [math.degrees(angle) for angle in (wheels.front_right, wheels.back_left)]
    assert degrees == pytest.approx([60.0, 225.0])


@pytest.mark.parametrize("numbers", [{"mass": -1.0}, {"radius": 0.0}, {"center_to_dribbler": 0.5}])
def test_impossible_robots_are_refused(numbers: dict[str, float]) -> None:
    specs = simulation_pb2.RobotSpecs(id=IDENTITY)
    for name, number in numbers.items():
        setattr(specs, name, number)
    with pytest.raises(MessageError, match=r"^robot_specs") as error:
        to_robot_model(RobotModel("ssl_generic"), specs)
    assert error.value.code is Code.INVALID_SPEC


@pytest.mark.parametrize(
    ("name", "low", "high"),
    [
        ("radius", 0.05, 0.09),
        ("height", 0.05, 0.15),
        ("mass", 0.1, 10.0),
        ("max_linear_kick_speed", 0.0, 20.0),
        ("max_chip_kick_speed", 0.0, 20.0),
        ("vel_absolute_max", 0.0, 20.0),
        ("vel_angular_max", 0.0, 200.0),
    ],
)
def test_numbers_of_no_robot_are_refused_by_name_and_range(
    name: str, low: float, high: float
) -> None:
    for value in (-1.0, 0.98 * low - 1e-3, 1.02 * high, 1e8):
        specs = simulation_pb2.RobotSpecs(id=IDENTITY)
        setattr(specs.limits if name.startswith("vel_") else specs, name, value)
        with pytest.raises(MessageError) as error:
            to_robot_model(RobotModel("ssl_generic"), specs)
        assert error.value.code is Code.INVALID_SPEC
        assert f"robot_specs.{name}: expected {low:g} to {high:g}, got " in str(error.value)


def test_the_largest_robots_of_the_rules_are_taken() -> None:
    # In single precision, as on the wire, both sizes are above those of the rules.
    specs = simulation_pb2.RobotSpecs(id=IDENTITY, radius=0.09, height=0.15, mass=10.0)
    model = to_robot_model(RobotModel("ssl_generic"), specs)
    assert (model.radius, model.height) == pytest.approx((0.09, 0.15))


def test_robots_on_two_wheels_are_not_described() -> None:
    specs = simulation_pb2.RobotSpecs(id=IDENTITY, center_to_dribbler=0.05)
    with pytest.raises(MessageError, match=r"front_distance, got vss_440rpm"):
        to_robot_model(RobotModel("vss_440rpm"), specs)
