import pytest

from rsoccer.human.controls import Controls
from rsoccer.human.keyboard import COMMANDS, MOVES, PASS_KICK, Keyboard


def held(*keys: str) -> Controls:
    keyboard = Keyboard()
    for key in keys:
        keyboard.press(key)
    return keyboard.controls()


@pytest.mark.parametrize(
    ("keys", "expected"),
    [
        ((), Controls()),
        (("w",), Controls(up=1.0)),
        (("down",), Controls(up=-1.0)),
        (("a",), Controls(right=-1.0)),
        (("right", "up"), Controls(right=1.0, up=1.0)),
        (("w", "up"), Controls(up=1.0)),
        (("w", "s"), Controls()),
        (("q",), Controls(turn=1.0)),
        (("e", "right shift"), Controls(turn=-1.0, slow=True)),
        (("space",), Controls(kick=1.0)),
        (("c",), Controls(kick=PASS_KICK)),
        (("c", "space"), Controls(kick=1.0)),
        (("x",), Controls(kick=1.0, chip=True)),
        (("v",), Controls(dribble=True)),
        (("f5", "caps lock"), Controls()),
    ],
)
def test_held_keys_are_controls(keys: tuple[str, ...], expected: Controls) -> None:
    assert held(*keys) == expected


def test_a_released_key_has_no_effect_and_the_dribbler_is_switched() -> None:
    keyboard = Keyboard()
    for key in ("w", "v"):
        keyboard.press(key)
        keyboard.release(key)
    keyboard.controls()
    assert keyboard.controls() == Controls(dribble=True)
    keyboard.press("v")
    assert keyboard.controls() == Controls()


def test_a_short_press_between_two_readings_is_not_lost() -> None:
    keyboard = Keyboard()
    keyboard.press("space")
    keyboard.release("space")
    assert keyboard.controls() == Controls(kick=1.0)
    assert keyboard.controls() == Controls()


def test_a_window_without_the_focus_has_no_held_keys() -> None:
    keyboard = Keyboard()
    keyboard.press("w")
    keyboard.press("v")
    keyboard.release_all()
    assert keyboard.controls() == Controls(dribble=True)


def test_commands_come_once_and_in_order() -> None:
    keyboard = Keyboard()
    for key in ("tab", "w", "3", "+", "-"):
        keyboard.press(key)
    assert keyboard.take_commands() == ["next_robot", "robot_3", "faster", "slower"]
    assert keyboard.take_commands() == []


def test_no_key_has_two_meanings() -> None:
    others = ["space", "c", "x", "v", "left shift", "right shift", "escape"]
    keys = [*MOVES, *COMMANDS, *others]
    assert len(keys) == len(set(keys))


def test_controls_of_two_devices_add_up() -> None:
    one = Controls(right=0.7, up=-0.25, turn=0.5, kick=0.5, dribble=True)
    two = Controls(right=0.7, up=0.125, turn=-0.5, kick=1.0, chip=True, slow=True)
    expected = Controls(1.0, -0.125, 0.0, 1.0, chip=True, dribble=True, slow=True)
    assert one.combined(two) == two.combined(one) == expected
