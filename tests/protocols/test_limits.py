"""Greatest speeds."""

from __future__ import annotations

import numpy as np
import pytest

from rsoccer import RobotModel
from rsoccer.protocols.commands import CommandRow, motion
from rsoccer.protocols.limits import Limits, limited, stopped

SSL = RobotModel("ssl_generic")
VSS = RobotModel("vss_440rpm")
WIDE = Limits(100.0, 100.0, 100.0)


def command(
    model: RobotModel, forward: float, left: float, turn: float, *kick: float
) -> np.ndarray:
    row = np.zeros(len(model.command_columns), np.float32)
    made = CommandRow(model, row)
    made.drive(forward, left, turn)
    if kick:
        made.kick(*kick)
    return row


def test_a_command_within_the_limits_stays_as_it_is() -> None:
    row = command(SSL, 1.0, -2.0, 3.0, 4.0, 1.0)
    assert limited(SSL, row, WIDE) is row
    assert limited(SSL, row, Limits()) is row


def test_directions_are_kept() -> None:
    row = command(SSL, 3.0, 4.0, -8.0, 6.0, 8.0)
    found = motion(SSL, limited(SSL, row, Limits(1.0, 2.0, 5.0)))
    assert found.velocity == pytest.approx((0.6, 0.8, -2.0), abs=1e-5)
    assert found.kick == pytest.approx((3.0, 4.0), abs=1e-5)


def test_robots_on_two_wheels_are_limited_by_their_speed_and_their_turn() -> None:
    row = command(VSS, -1.0, 0.0, 10.0)
    found = motion(VSS, limited(VSS, row, Limits(speed=0.5, angular_velocity=4.0)))
    assert found.velocity == pytest.approx((-0.5, 0.0, 4.0), abs=1e-5)


def test_no_kick_and_no_movement_at_limits_of_zero() -> None:
    row = command(SSL, 1.0, 0.0, 1.0, 6.0, 0.0)
    assert not limited(SSL, row, Limits(0.0, 0.0, 0.0)).any()
    assert not stopped(row).any()


@pytest.mark.parametrize("value", [-1.0, float("nan")])
def test_limits_are_checked(value: float) -> None:
    with pytest.raises(ValueError, match="limits: angular_velocity: expected"):
        Limits(angular_velocity=value)
