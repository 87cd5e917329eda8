"""Custom fields, robots and balls, and their configurations: errors and representations."""

from collections.abc import Callable
from dataclasses import dataclass

import pytest

from rsoccer._core import BallModel, Field, RobotModel, SimConfig, Simulator
from rsoccer.tasks import VssSelfPlay

HEAVY = RobotModel("vss_440rpm", mass=0.2)
MIXED = SimConfig(robot=["vss_440rpm", "vss_650rpm"], n_blue=1, n_yellow=1)
UNORDERED_WHEELS = RobotModel("ssl_generic").to_json().replace("[60.0", "[160.0")


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Field("vss_3v3", gaol_width=1.0), 'no "gaol_width"; its numbers are length, '),
        (lambda: BallModel("vss_rsim", size=1.0), 'vss_rsim has no "size"; its numbers are '),
        (
            lambda: RobotModel("vss_440rpm", radius=0.1),
            'vss_440rpm has no "radius".* side_length, ',
        ),
        (
            lambda: Field("ssl_b", goal_depth=5.0),
            "must fit into .*goal_line_margin of 0.3 m, got 5",
        ),
        (
            lambda: RobotModel("ssl_generic", front_distance=0.2),
            "front_distance must not be beyond .*, got 0.2 m",
        ),
        (lambda: RobotModel.from_json(UNORDERED_WHEELS), r"in rising order.*, got \[160.0, 135.0"),
        (lambda: Field.from_json("{}"), "text is not a Field: missing field `name`"),
        (lambda: SimConfig(robot=[RobotModel("vss_440rpm")]), "each of 6 robots, got 1"),
        (lambda: MIXED.robot, "robots differ: use `robots`"),
        (lambda: SimConfig(n_blue=0, n_yellow=0).robot, "there are no robots"),
        (lambda: Simulator(SimConfig(Field("vss_3v3", length=0.1))), "teams do not fit"),
    ],
)
def test_invalid_models_are_refused_by_name(make: Callable[[], object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        make()


def test_a_robot_has_only_the_parameters_of_its_drive() -> None:
    vss = RobotModel("vss_440rpm")
    assert not hasattr(vss, "radius")
    assert not hasattr(vss, "wheel_angles")
    assert hasattr(RobotModel("ssl_generic"), "wheel_angles")


def test_representations() -> None:
    assert "ssl_generic" in repr(RobotModel("ssl_generic"))
    assert repr(SimConfig()).startswith('SimConfig("vss_3v3", 3, 3, robot="vss_440rpm", ')
    assert 'robot=["vss_440rpm", "vss_650rpm"]' in repr(MIXED)
    assert repr(Simulator(MIXED, 2)) == "Simulator(2 worlds, 1 threads)"


@pytest.mark.parametrize(
    ("model", "equal", "other"),
    [
        (Field("ssl_b"), Field("ssl_b"), Field("ssl_b", width=5.0)),
        (BallModel("vss_rsim"), BallModel("vss_rsim"), BallModel("ssl_tigers")),
        (
            RobotModel("vss_440rpm", mass=0.2),
            RobotModel("vss_440rpm", mass=0.2),
            RobotModel("vss_440rpm"),
        ),
    ],
)
def test_equal_models_have_equal_hashes(model: object, equal: object, other: object) -> None:
    assert hash(model) == hash(equal)
    assert {model, equal, other} == {model, other}


def test_a_model_can_be_the_default_of_a_dataclass() -> None:
    @dataclass(frozen=True)
    class Heavy(VssSelfPlay):
        robot: str | RobotModel = HEAVY

    assert Heavy().config.robot.mass == 0.2


def test_a_number_of_another_type_is_refused_by_name() -> None:
    with pytest.raises(TypeError, match="mass: expected a number, got 'heavy'"):
        RobotModel("vss_440rpm", mass="heavy")  # type: ignore[arg-type]
