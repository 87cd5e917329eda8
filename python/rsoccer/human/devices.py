"""Input devices through pygame: events of a window to the keyboard, and connected gamepads."""

from __future__ import annotations

from typing import Any

from rsoccer.human.controls import Controls
from rsoccer.human.gamepad import Gamepad
from rsoccer.human.keyboard import Keyboard
from rsoccer.render.pygame_import import pygame

FULL_DEFLECTION = 32767.0
"""Value of an axis of SDL's game controllers at its end."""


class Devices:
    """The keyboard, and the first gamepad if there is one.

    Attributes:
        keyboard: the keyboard.
        gamepad: the gamepad, or None.
    """

    def __init__(self, gamepad: Gamepad | None = None) -> None:
        """Begin with the keyboard.

        Args:
            gamepad: a gamepad in place of one that pygame reports when it is connected.
        """
        self.keyboard = Keyboard()
        self.gamepad = gamepad
        self._finds_gamepads = gamepad is None and _begin_controllers()
        self.find_gamepad()

    def handle_event(self, event: pygame.Event) -> None:
        """Read an event of the window.

        Args:
            event: the event; those of no device are ignored.
        """
        if event.type == pygame.KEYDOWN:
            self.keyboard.press(_key_name(event))
        elif event.type == pygame.KEYUP:
            self.keyboard.release(_key_name(event))
        elif event.type == pygame.WINDOWFOCUSLOST:
            self.keyboard.release_all()
        elif event.type in (pygame.CONTROLLERDEVICEADDED, pygame.CONTROLLERDEVICEREMOVED):
            self.find_gamepad()

    def find_gamepad(self) -> None:
        """Use the first gamepad that pygame reports; does nothing for a gamepad of the caller."""
        if self._finds_gamepads:
            self.gamepad = _first_gamepad()

    def controls(self) -> Controls:
        """Return the controls of all devices."""
        controls = self.keyboard.controls()
        return controls if self.gamepad is None else controls.combined(self.gamepad.controls())

    def take_commands(self) -> list[str]:
        """Return the commands of all devices since the last call."""
        commands = self.keyboard.take_commands()
        return commands if self.gamepad is None else commands + self.gamepad.take_commands()


class SdlGamepad:
    """A game controller of SDL with axes from -1 to 1."""

    def __init__(self, controller: Any) -> None:  # noqa: ANN401  (pygame has no types for it)
        """Read a controller.

        Args:
            controller: a `pygame._sdl2.controller.Controller`.
        """
        self._controller = controller

    def get_axis(self, axis: int) -> float:
        """Return the deflection of an axis.

        Args:
            axis: index of the axis.

        Returns:
            -1 to 1; 0 to 1 for a trigger.
        """
        return float(self._controller.get_axis(axis)) / FULL_DEFLECTION

    def get_button(self, button: int) -> bool:
        """Return whether a button is held.

        Args:
            button: index of the button.
        """
        return bool(self._controller.get_button(button))


def _key_name(event: pygame.Event) -> str:
    """Name of a key as the keyboard takes it; the keypad's keys have those of the others."""
    return pygame.key.name(event.key, use_compat=True).strip("[]")


def _begin_controllers() -> bool:
    """Whether pygame can read game controllers here."""
    try:
        from pygame._sdl2 import controller
    except ImportError:
        return False
    try:
        controller.init()
    except pygame.error:
        return False
    return True


def _first_gamepad() -> Gamepad | None:
    """The first game controller that is connected."""
    from pygame._sdl2 import controller

    found = (i for i in range(controller.get_count()) if controller.is_controller(i))
    first = next(found, None)
    return None if first is None else Gamepad(SdlGamepad(controller.Controller(first)))
