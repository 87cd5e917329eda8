"""Fields of messages, codes and fuzzing."""

from collections import Counter

import numpy as np
import pytest

from rsoccer.protocols.errors import Code
from tests.protocols import wire_facts
from tests.protocols.test_schemas import OWN, tables
from tools.protocols import codes, fields, fuzz
from tools.protocols.reasons import REASONS, reason


def test_every_field_of_the_leagues_is_in_the_table() -> None:
    facts = {
        f"{message}.{name}"
        for message, lines in tables(wire_facts.MESSAGES).items()
        for _, name, *_ in lines
    }
    found = [fields.name(row) for row in fields.rows()]
    assert len(found) == len(set(found)) > 500
    assert facts == {name for name in found if not name.startswith(tuple(OWN))}
    page = fields.field_tables()
    assert all(f"`{name.partition('.')[2]}`" in page for name in facts)


def test_every_field_that_is_not_read_has_a_reason_and_no_other() -> None:
    used = set()
    for row in fields.rows():
        starts = [start for start in REASONS if fields.name(row).startswith(start)]
        if row.read == fields.NO:
            assert starts, fields.name(row)
            used.add(max(starts, key=len))
    assert used == set(REASONS), "reasons of fields that are read"


def test_errors_have_stable_codes() -> None:
    known = {f"`{code}`" for code in Code}
    refused = [row for row in fields.rows() if row.read not in (fields.READ, fields.NO)]
    assert {code for row in refused for code in row.read.split(", ")} <= known
    names = {fields.name(row) for row in refused}
    assert "simulation.TeleportBall.by_force" in names
    assert "simulation.Config.geometry" in names


@pytest.mark.parametrize(
    "name",
    [
        *("simulation.TeleportBall.roll", "simulation.TeleportBall.teleport_safely"),
        *("simulation.TeleportRobot.present", "simulation.RobotCommand.kick_angle"),
        *("simulation.Control.simulation_speed", "simulation.GlobalVelocity.x"),
        *("simulation.RobotLimits.vel_absolute_max", "grsim.RobotCommand.wheel4"),
        *("fira.RobotReplacement.turnon", "vision.DetectionRobot.orientation"),
        *("referee.Packet.next_command", "vssref.Command.foulQuadrant"),
    ],
)
def test_some_fields_are_read(name: str) -> None:
    (row,) = [row for row in fields.rows() if fields.name(row) == name]
    assert row.read == fields.READ


def test_counts_are_those_of_the_rows() -> None:
    last = fields.counts().splitlines()[-1]
    assert f"| all | {len(fields.rows())} |" in last


def test_the_table_of_codes_has_all() -> None:
    page = codes.table_of_codes()
    assert all(f"| `{code}` | " in page for code in Code)


def test_reasons_are_those_of_the_longest_name() -> None:
    assert reason("vision.FieldSize.ball_radius").startswith("the ball")
    assert reason("vision.FieldSize.field_length") == ""


def test_random_packets_raise_one_kind_of_error() -> None:
    with np.errstate(over="raise", invalid="raise", divide="raise"):
        outcomes = fuzz.fuzz(10_000, seed=1)
    assert outcomes.total() == 10_000
    assert outcomes["read"] > 3_000
    assert outcomes["UNREADABLE"] > 3_000
    assert outcomes["NOT_FINITE"] > 300
    assert set(outcomes) <= {"read", *map(str, Code)}


def test_the_fuzz_finds_what_is_not_finite() -> None:
    assert not fuzz.finite({"a": [(1.0, np.array([1.0, np.nan]))]})
    assert fuzz.finite(Counter(a=1))
