"""Pauses between kicks."""

from __future__ import annotations

import numpy as np
import pytest

from rsoccer import SimConfig
from rsoccer.arrays import Floats
from rsoccer.drive.kicks import KickPauses
from rsoccer.protocols.commands import CommandRow, motion

CONFIG = SimConfig("ssl_b", 1, 1)


def kicking(*speeds: float) -> Floats:
    """Commands of robots that drive and kick."""
    rows = np.zeros((2, len(CONFIG.command_columns)), np.float32)
    for model, row, speed in zip(CONFIG.robots, rows, speeds, strict=True):
        made = CommandRow(model, row)
        made.drive(0.5, 0.2, 1.0)
        made.kick(speed, speed / 2)
    return rows


def kicks(rows: Floats) -> list[float]:
    return [motion(model, row).kick[0] for model, row in zip(CONFIG.robots, rows, strict=True)]


def test_a_kick_within_the_pause_is_left_out_and_the_rest_of_the_command_stays() -> None:
    pauses, commands = KickPauses(CONFIG, 0.03), kicking(3.0, 0.0)
    assert pauses.applied(1.0, commands) is commands
    second = pauses.applied(1.017, commands)
    assert kicks(second) == [0.0, 0.0] and kicks(commands) == pytest.approx([3.0, 0.0])
    assert motion(CONFIG.robots[0], second[0]).velocity == pytest.approx((0.5, 0.2, 1.0))
    assert kicks(pauses.applied(1.031, commands)) == pytest.approx([3.0, 0.0])


def test_each_robot_has_a_pause_of_its_own() -> None:
    pauses = KickPauses(CONFIG, 0.03)
    pauses.applied(1.0, kicking(3.0, 0.0))
    assert kicks(pauses.applied(1.01, kicking(3.0, 2.0))) == pytest.approx([0.0, 2.0])


def test_without_a_pause_all_kicks_are_sent() -> None:
    pauses, commands = KickPauses(CONFIG, 0.0), kicking(3.0, 2.0)
    assert all(pauses.applied(1.0, commands) is commands for _ in range(3))
