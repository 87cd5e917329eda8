"""Settings of a connection."""

from __future__ import annotations

import pytest

from rsoccer.drive.settings import Settings


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"peer": "webots"}, "peer: expected one of"),
        ({"team": "red"}, "team: expected one of"),
        ({"source": "tracker", "peer": "firasim"}, "source: expected 'vision' with firasim"),
        ({"referee": "bribe"}, "referee: expected one of"),
        ({"ports": {"command": 1}}, "ports: expected names of .*'control'.*, got 'command'"),
        ({"ports": {"vision": 0}}, "ports: vision: expected at least 1, got 0"),
        ({"groups": {"blue": "127.0.0.1"}}, "groups: expected names of"),
        ({"ids": (99,)}, "ids: expected 0 to 15, got 99"),
        ({"ids": (3, -1)}, "ids: expected at least 0, got -1"),
        ({"opponent_ids": (16,)}, "opponent_ids: expected 0 to 15, got 16"),
        ({"patience": -1.0}, "patience: expected"),
        ({"rate": 0.0}, "rate: expected"),
        ({"vision_timeout": 0.0}, "vision_timeout: expected"),
        ({"guard_timeout": 100.0}, "guard_timeout: expected"),
        ({"contact_gap": -0.1}, "contact_gap: expected"),
    ],
)
def test_wrong_settings_are_named(change: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Settings(**({"peer": "ssl-simulation"} | change))  # type: ignore[arg-type]


def test_places_are_those_of_the_protocol_unless_others_are_given() -> None:
    usual, other = Settings("grsim"), Settings("grsim", ports={"vision": 10006})
    assert (usual.port_numbers["vision"], other.port_numbers["vision"]) == (10020, 10006)
    assert Settings("firasim").group_hosts["vision"] == "224.0.0.1"
    assert Settings("ssl-simulation", source="tracker").heard == ("tracker", "referee")
    assert Settings("ssl-simulation", referee="ignore").heard == ("vision",)
    hosts = Settings("grsim", groups={"vision": "127.0.0.1"}).group_hosts
    assert hosts == {"vision": "127.0.0.1", "referee": "224.5.23.1"}
