import pytest

from rsoccer.human import gamepad
from rsoccer.human.controls import Controls
from rsoccer.human.gamepad import DEAD_ZONE, Gamepad
from rsoccer.human.keyboard import PASS_KICK


class FakeDevice:
    def __init__(self) -> None:
        self.axes: dict[int, float] = {}
        self.buttons: set[int] = set()

    def get_axis(self, axis: int) -> float:
        return self.axes.get(axis, 0.0)

    def get_button(self, button: int) -> bool:
        return button in self.buttons


@pytest.fixture
def device() -> FakeDevice:
    return FakeDevice()


def test_a_gamepad_at_rest_does_nothing(device: FakeDevice) -> None:
    pad = Gamepad(device)
    assert pad.controls() == Controls()
    assert pad.take_commands() == []


def test_sticks_are_up_and_right_and_turn_like_the_hand(device: FakeDevice) -> None:
    device.axes = {gamepad.LEFT_X: 1.0, gamepad.LEFT_Y: -1.0, gamepad.RIGHT_X: 1.0}
    assert Gamepad(device).controls() == Controls(right=1.0, up=1.0, turn=-1.0)
    device.axes = {gamepad.LEFT_X: -1.0, gamepad.LEFT_Y: 1.0, gamepad.RIGHT_X: -1.0}
    assert Gamepad(device).controls() == Controls(right=-1.0, up=-1.0, turn=1.0)


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_deflections_begin_at_the_edge_of_the_dead_zone(device: FakeDevice, sign: float) -> None:
    pad = Gamepad(device)
    values = []
    for deflection in (0.5 * DEAD_ZONE, DEAD_ZONE, DEAD_ZONE + 0.01, 0.6, 1.0, 1.01):
        device.axes = {gamepad.LEFT_X: sign * deflection}
        values.append(sign * pad.controls().right)
    assert values[:2] == [0.0, 0.0]
    assert 0.0 < values[2] < 0.02
    assert values[2] < values[3] < values[4] == values[5] == 1.0


@pytest.mark.parametrize(
    ("axes", "buttons", "expected"),
    [
        ({}, {gamepad.A}, Controls(kick=1.0)),
        ({gamepad.RIGHT_TRIGGER: 0.9}, set(), Controls(kick=1.0)),
        ({gamepad.RIGHT_TRIGGER: 0.1}, set(), Controls()),
        ({}, {gamepad.B}, Controls(kick=1.0, chip=True)),
        ({}, {gamepad.X}, Controls(kick=PASS_KICK)),
        ({gamepad.LEFT_TRIGGER: 1.0}, set(), Controls(dribble=True)),
        ({}, {gamepad.LEFT_SHOULDER}, Controls(slow=True)),
    ],
)
def test_buttons_and_triggers(
    device: FakeDevice, axes: dict[int, float], buttons: set[int], expected: Controls
) -> None:
    device.axes, device.buttons = axes, buttons
    assert Gamepad(device).controls() == expected


@pytest.mark.parametrize(("button", "command"), gamepad.COMMANDS.items())
def test_a_held_button_gives_its_command_once(
    device: FakeDevice, button: int, command: str
) -> None:
    pad = Gamepad(device)
    device.buttons = {button}
    assert pad.take_commands() == [command]
    assert pad.take_commands() == []
    device.buttons = set()
    assert pad.take_commands() == []
    device.buttons = {button}
    assert pad.take_commands() == [command]


def test_without_a_dead_zone_the_smallest_deflection_counts(device: FakeDevice) -> None:
    device.axes = {gamepad.LEFT_X: 0.01}
    assert Gamepad(device, 0.0).controls().right == pytest.approx(0.01)


@pytest.mark.parametrize("dead_zone", [-0.1, 1.0, float("nan")])
def test_a_dead_zone_out_of_range_is_refused(device: FakeDevice, dead_zone: float) -> None:
    with pytest.raises(ValueError, match="dead_zone: expected 0 to below 1"):
        Gamepad(device, dead_zone)
