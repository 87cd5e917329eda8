"""Schemas: wire format, generated modules, and other modules in the same program."""

import importlib
import random
import subprocess
import sys
from pathlib import Path

import pytest
from google.protobuf.descriptor import Descriptor, FieldDescriptor
from google.protobuf.message import Message

from rsoccer.protocols.parsing import is_repeated, parse
from tests.protocols import wire_facts
from tools.protocols.readers import READERS, UNREAD
from tools.protocols.samples import required, sample

SCHEMAS = ("vision", "tracker", "referee", "simulation", "grsim", "fira", "vssref")
MODULES = {
    name: importlib.import_module(f"rsoccer.protocols.schemas.{name}_pb2") for name in SCHEMAS
}
FOLDER = Path(str(MODULES["vision"].__file__)).parent
PACKETS = [*(reader.kind for reader in READERS), *(kind for _, kind in UNREAD)]
OWN = {"vision.Packet2010"}  # a part of a message that the league has abolished
TYPES = {
    number: name.removeprefix("TYPE_").lower()
    for name, number in vars(FieldDescriptor).items()
    if name.startswith("TYPE_")
}


def tables(text: str) -> dict[str, list[list[str]]]:
    found: dict[str, list[list[str]]] = {}
    name = ""
    for line in text.strip().splitlines():
        if line.startswith(" "):
            found[name].append(line.split())
        else:
            name = line
            found[name] = []
    return found


def described(kind: Descriptor) -> list[list[str]]:
    """Fields of a message as the facts have them."""
    return [
        [str(field.number), field.name, type_name(field), label(field)]
        for field in sorted(kind.fields, key=lambda each: each.number)
    ]


def type_name(field: FieldDescriptor) -> str:
    inner = field.message_type or field.enum_type
    return TYPES[field.type] if inner is None else str(inner.name)


def label(field: FieldDescriptor) -> str:
    if is_repeated(field):
        return "repeated"
    if field.containing_oneof is not None:
        return "oneof"
    return "required" if required(field) else "optional"


def test_fields_are_those_of_the_leagues() -> None:
    facts = tables(wire_facts.MESSAGES)
    own = {
        f"{name}.{message.name}": described(message)
        for name, module in MODULES.items()
        for message in module.DESCRIPTOR.message_types_by_name.values()
    }
    assert len(facts) > 100
    assert own.keys() - facts.keys() == OWN
    assert {name: own[name] for name in facts} == facts


def test_values_are_those_of_the_leagues() -> None:
    for name, values in tables(wire_facts.ENUMS).items():
        schema, *path = name.split(".")
        found = MODULES[schema]
        for part in path:
            found = getattr(found, part)
        own = sorted([str(number), value] for value, number in found.items())
        # Names of values are not on the wire; the schemas shorten those of senders.
        assert own == sorted([number, value.removeprefix("SSL_")] for number, value in values), name


def test_no_text_of_the_leagues_is_in_the_schemas() -> None:
    for path in FOLDER.glob("*.proto"):
        text = path.read_text()
        assert "go_package" not in text
        assert f"package rsoccer.{path.stem};" in text
    assert "under the GPL" in (FOLDER / "README.md").read_text().replace("\n  ", " ")


def test_modules_are_current(tmp_path: Path) -> None:
    pytest.importorskip("grpc_tools")
    made = importlib.import_module("tools.make_schemas").make(tmp_path)
    assert len(made) == 2 * len(SCHEMAS)
    for path in made:
        assert path.read_text() == (FOLDER / path.name).read_text(), path.name


@pytest.mark.parametrize("kind", PACKETS, ids=lambda kind: kind.DESCRIPTOR.full_name)
def test_every_message_survives_the_wire(kind: type[Message]) -> None:
    rng = random.Random(7)
    for share in (0.0, 0.3, 0.7, 1.0):
        for _ in range(3):
            message = sample(kind, rng, share)
            assert parse(kind, message.SerializeToString()) == message


# Bytes by hand: a tag is number * 8 + kind; kind 0 is a varint, 1 are 8 bytes, 2 has a length, and
# 5 are 4 bytes.
GOLDEN = [
    (
        MODULES["simulation"].RobotControl(
            robot_commands=[MODULES["simulation"].RobotCommand(id=5, kick_speed=1.0)]
        ),
        "0a 07 08 05 1d 00 00 80 3f",
    ),
    (
        MODULES["simulation"].RobotCommand(
            id=300,
            move_command=MODULES["simulation"].MoveCommand(
                local_velocity=MODULES["simulation"].LocalVelocity(forward=1, left=-2, angular=0)
            ),
        ),
        "08 ac 02 12 11 12 0f 0d 00 00 80 3f 15 00 00 00 c0 1d 00 00 00 00",
    ),
    (
        MODULES["fira"].Command(id=1, yellowteam=True, wheel_left=1.0),
        "08 01 10 01 31 00 00 00 00 00 00 f0 3f",
    ),
    (MODULES["fira"].Command(), ""),
    (MODULES["tracker"].RobotId(id=2, team_color=1), "08 02 10 01"),
    (MODULES["vision"].Point(x=1.0, y=0.0), "0d 00 00 80 3f 15 00 00 00 00"),
    (MODULES["vssref"].Command(foul=7, teamcolor=1), "08 07 10 01"),
    (
        MODULES["referee"].GameEvent(
            type=8, goal=MODULES["referee"].Goal(by_team=2, kicking_bot=3)
        ),
        "42 04 08 02 10 03 c0 02 08",
    ),
]


@pytest.mark.parametrize(("message", "golden"), GOLDEN)
def test_bytes_are_those_of_the_wire_format(message: Message, golden: str) -> None:
    assert message.SerializeToString() == bytes.fromhex(golden)
    assert type(message).FromString(bytes.fromhex(golden)) == message


def test_packed_and_zigzag_numbers() -> None:
    referee = MODULES["referee"]
    team = referee.TeamInfo(yellow_card_times=[1, 300])
    assert team.SerializePartialToString() == bytes.fromhex("22 03 01 ac 02")
    packet = referee.Packet(stage_time_left=-2)
    assert packet.SerializePartialToString() == bytes.fromhex("18 03")


OFFICIAL = """
from google.protobuf import descriptor_pb2, descriptor_pool, message_factory

file = descriptor_pb2.FileDescriptorProto(name="ssl_vision_detection.proto", syntax="proto2")
for name in ("Packet", "SSL_DetectionRobot", "RobotId", "Team"):
    file.message_type.add(name=name).field.add(name="x", number=1, type=2, label=1)
same = descriptor_pb2.FileDescriptorProto()
same.CopyFrom(file)
same.name, same.package = "rsoccer/protocols/schemas/vision.proto", "rsoccer.vision"
pool = descriptor_pool.Default()
pool.AddSerializedFile(file.SerializeToString())
pool.AddSerializedFile(same.SerializeToString())
for name in ("SSL_DetectionRobot", "rsoccer.vision.Packet"):
    kind = message_factory.GetMessageClass(pool.FindMessageTypeByName(name))
    assert kind(x=1.0).SerializeToString() == bytes.fromhex("0d0000803f")
"""
OWN_FIRST = "from rsoccer.protocols.schemas import vision_pb2, referee_pb2\n"


@pytest.mark.parametrize("code", [OWN_FIRST + OFFICIAL, OFFICIAL + OWN_FIRST])
def test_modules_of_the_same_names_may_be_loaded_too(code: str) -> None:
    code += "assert vision_pb2.Packet().SerializeToString() == b''\n"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_without_protobuf_the_error_names_the_extra() -> None:
    code = (
        "import sys; sys.modules['google.protobuf'] = None\n"
        "import rsoccer, rsoccer.protocols\n"
        "from rsoccer.protocols import WireLayout\n"
        "try:\n    from rsoccer.protocols import vision\n"
        "except ImportError as error:\n    assert \"'rsoccer[network]'\" in str(error), error\n"
        "else:\n    raise SystemExit('no error')\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize("module", ["parsing", "tracker", "referee", "logs", "fira"])
def test_every_module_names_the_extra(module: str) -> None:
    code = (
        "import sys; sys.modules['google.protobuf'] = None\n"
        f"try:\n    import rsoccer.protocols.{module}\n"
        "except ImportError as error:\n    assert \"'rsoccer[network]'\" in str(error), error\n"
        "else:\n    raise SystemExit('no error')\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
