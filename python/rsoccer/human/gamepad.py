"""A gamepad as controls and commands, in the standard layout of SDL's game controllers."""

from __future__ import annotations

from typing import Final, Protocol

from rsoccer.human.controls import Controls
from rsoccer.human.keyboard import PASS_KICK

DEAD_ZONE: Final = 0.15
"""Deflection of a stick that counts as none."""
PRESSED: Final = 0.4
"""Deflection of a trigger that counts as pressed."""

LEFT_X, LEFT_Y, RIGHT_X, RIGHT_Y, LEFT_TRIGGER, RIGHT_TRIGGER = range(6)
"""Indices of the axes; y points down."""
A, B, X, Y, BACK, GUIDE, START, LEFT_STICK, RIGHT_STICK, LEFT_SHOULDER, RIGHT_SHOULDER = range(11)
"""Indices of the buttons."""

COMMANDS: Final[dict[int, str]] = {
    Y: "frame",
    BACK: "reset",
    START: "pause",
    RIGHT_SHOULDER: "next_robot",
    RIGHT_STICK: "help",
}
"""Commands of the buttons that act once when pressed."""


class GamepadDevice(Protocol):
    """A gamepad with the axes and buttons of SDL's standard layout."""

    def get_axis(self, axis: int) -> float:
        """Return the deflection of an axis.

        Args:
            axis: index of the axis.

        Returns:
            -1 to 1; 0 to 1 for a trigger.
        """

    def get_button(self, button: int) -> bool:
        """Return whether a button is held.

        Args:
            button: index of the button.
        """


class Gamepad:
    """Sticks and buttons of one gamepad, read when they are needed."""

    def __init__(self, device: GamepadDevice, dead_zone: float = DEAD_ZONE) -> None:
        """Read a device.

        Args:
            device: the gamepad.
            dead_zone: deflection of a stick that counts as none, 0 to below 1.

        Raises:
            ValueError: the dead zone is out of range.
        """
        if not 0.0 <= dead_zone < 1.0:
            raise ValueError(f"dead_zone: expected 0 to below 1, got {dead_zone}")
        self._device = device
        self._dead_zone = dead_zone
        self._held = {button: False for button in COMMANDS}

    def controls(self) -> Controls:
        """Return the controls that sticks, triggers and held buttons stand for."""
        device = self._device
        right, down = self._stick(LEFT_X), self._stick(LEFT_Y)
        full = device.get_button(A) or device.get_axis(RIGHT_TRIGGER) > PRESSED
        chip = bool(device.get_button(B))
        return Controls(
            right=right,
            up=-down,
            turn=-self._stick(RIGHT_X),
            kick=1.0 if full or chip else PASS_KICK if device.get_button(X) else 0.0,
            chip=chip,
            dribble=device.get_axis(LEFT_TRIGGER) > PRESSED,
            slow=bool(device.get_button(LEFT_SHOULDER)),
        )

    def take_commands(self) -> list[str]:
        """Return the commands of buttons that were pressed since the last call."""
        held = {button: bool(self._device.get_button(button)) for button in COMMANDS}
        commands = [COMMANDS[button] for button in COMMANDS if held[button] > self._held[button]]
        self._held = held
        return commands

    def _stick(self, axis: int) -> float:
        """Deflection of a stick beyond the dead zone, from 0 at its edge to 1 at the end."""
        value = max(-1.0, min(1.0, self._device.get_axis(axis)))
        beyond = abs(value) - self._dead_zone
        if beyond <= 0.0:
            return 0.0
        return beyond / (1.0 - self._dead_zone) * (1.0 if value > 0.0 else -1.0)
