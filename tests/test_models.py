"""Fields, robots and balls by numbers, and configurations of them: what they refuse and tell."""

from collections.abc import Callable

import pytest

from rsoccer._core import BallModel, Field, RobotModel, SimConfig, Simulator

MIXED = SimConfig(robot=["vss_440rpm", "vss_650rpm"], n_blue=1, n_yellow=1)
TURNED = RobotModel("ssl_generic").to_json().replace("[60.0", "[160.0")


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Field("vss_3v3", gaol_width=1.0), 'no "gaol_width"; its numbers are length, '),
        (lambda: BallModel("vss_rsim", size=1.0), 'vss_rsim has no "size"; its numbers are '),
        (lambda: RobotModel("vss_440rpm", radius=0.1), 'vss_440rpm has no "radius".* side, '),
        (
            lambda: Field("ssl_b", goal_depth=5.0),
            "must fit into .*goal_line_margin of 0.3 m, got 5",
        ),
        (lambda: RobotModel("ssl_generic", front=0.2), "front must not be beyond .*, got 0.2 m"),
        (lambda: RobotModel.from_json(TURNED), r"in rising order.*, got \[160.0, 135.0"),
        (lambda: Field.from_json("{}"), "text is not a Field: missing field `name`"),
        (lambda: SimConfig(robot=[RobotModel("vss_440rpm")]), "each of 6 robots, got 1"),
        (lambda: MIXED.robot, "robots differ: use `robots`"),
        (lambda: SimConfig(n_blue=0, n_yellow=0).robot, "there are no robots"),
        (lambda: Simulator(SimConfig(Field("vss_3v3", length=0.1))), "teams do not fit"),
    ],
)
def test_what_cannot_be_is_refused_by_name(make: Callable[[], object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        make()


def test_numbers_that_a_robot_lacks_are_no_attributes_of_it() -> None:
    vss = RobotModel("vss_440rpm")
    assert not hasattr(vss, "radius")
    assert not hasattr(vss, "wheel_angles")
    assert hasattr(RobotModel("ssl_generic"), "wheel_angles")


def test_they_show_what_they_are() -> None:
    assert "ssl_generic" in repr(RobotModel("ssl_generic"))
    assert repr(SimConfig()).startswith('SimConfig("vss_3v3", 3, 3, robot="vss_440rpm", ')
    assert 'robot=["vss_440rpm", "vss_650rpm"]' in repr(MIXED)
    assert repr(Simulator(MIXED, 2)) == "Simulator(2 worlds, 1 threads)"
