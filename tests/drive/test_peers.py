"""Messages that put bodies, of each protocol."""

from __future__ import annotations

import itertools

import pytest

from rsoccer import SimConfig
from rsoccer.drive.peers import make_layout, make_peer
from rsoccer.drive.settings import Settings
from rsoccer.frame import Frame
from rsoccer.game import BLUE, YELLOW
from rsoccer.protocols.schemas import fira_pb2, grsim_pb2

STRANGERS = ((BLUE, 1), (BLUE, 2), (YELLOW, 0))


def places(name: str, config: SimConfig) -> dict[tuple[bool, int], tuple[float, float, bool]]:
    """Place and presence by color and number, of a frame whose yellow robot is absent."""
    settings = Settings(name)
    layout = make_layout(settings, config, positive=name == "firasim")
    frame = Frame.empty(1, 1, 1)
    frame.robots.position[0] = ((0.2, 0.1), (0.0, 0.0))
    frame.robots.absent[0, 1] = 1.0
    (message,) = make_peer(settings).placement(layout, frame, STRANGERS[:2])
    if name == "grsim":
        packet = grsim_pb2.Packet.FromString(message.data).replacement
        return {(r.yellowteam, r.id): (r.x, r.y, r.turnon) for r in packet.robots}
    replaced = fira_pb2.Packet.FromString(message.data).replace
    return {
        (r.yellowteam, r.position.robot_id): (r.position.x, r.position.y, r.turnon)
        for r in replaced.robots
    }


@pytest.mark.parametrize(("name", "field"), [("grsim", "ssl_b"), ("firasim", "vss_3v3")])
def test_robots_that_do_not_play_stand_beside_the_field_apart(name: str, field: str) -> None:
    config = SimConfig(field, 1, 1)
    found = places(name, config)
    assert set(found) == {(False, 0), (False, 1), (False, 2), (True, 0)}
    x, y, is_on = found.pop((False, 0))
    assert is_on and abs(x) == pytest.approx(0.2) and abs(y) == pytest.approx(0.1)
    assert not any(is_on for _, _, is_on in found.values())
    assert all(abs(y) > config.field.width / 2 + 0.3 for _, y, _ in found.values())
    sides = sorted(x for x, _, _ in found.values())
    assert all(after - before > 0.19 for before, after in itertools.pairwise(sides))
