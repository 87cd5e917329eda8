"""The keyboard as controls and commands; it knows names of keys and no library."""

from __future__ import annotations

from typing import Final

from rsoccer.human.controls import Controls

PASS_KICK: Final = 0.5
"""Speed of a pass, as a fraction of the fastest kick."""

MOVES: Final[dict[str, tuple[float, float, float]]] = {
    "w": (0.0, 1.0, 0.0),
    "up": (0.0, 1.0, 0.0),
    "s": (0.0, -1.0, 0.0),
    "down": (0.0, -1.0, 0.0),
    "a": (-1.0, 0.0, 0.0),
    "left": (-1.0, 0.0, 0.0),
    "d": (1.0, 0.0, 0.0),
    "right": (1.0, 0.0, 0.0),
    "q": (0.0, 0.0, 1.0),
    "e": (0.0, 0.0, -1.0),
}
"""Deflection right, deflection up and turn of the keys that move the robot while held."""

COMMANDS: Final[dict[str, str]] = {
    "tab": "next_robot",
    "p": "pause",
    "n": "step",
    "r": "reset",
    "f": "frame",
    "h": "help",
    "+": "faster",
    "=": "faster",
    "-": "slower",
    **{str(number): f"robot_{number}" for number in range(10)},
}
"""Commands of the keys that act once when pressed."""

KICK, PASS, CHIP, DRIBBLE = "space", "c", "x", "v"
"""Keys of the kicker while held, and the key that switches the dribbler."""
SLOW: Final = ("left shift", "right shift")
"""Keys that reduce speeds while held."""


class Keyboard:
    """Keys that are held, and the commands of pressed keys.

    Keys have the names of `pygame.key.name`, such as "w", "space" or "left shift".
    """

    def __init__(self) -> None:
        """Begin without a held key, with the dribbler off."""
        self._held: set[str] = set()
        self._tapped: set[str] = set()  # pressed since the last reading
        self._dribble = False
        self._commands: list[str] = []

    def press(self, key: str) -> None:
        """Note that a key went down; keys without a meaning are ignored.

        Args:
            key: name of the key.
        """
        self._held.add(key)
        self._tapped.add(key)
        if key == DRIBBLE:
            self._dribble = not self._dribble
        if key in COMMANDS:
            self._commands.append(COMMANDS[key])

    def release(self, key: str) -> None:
        """Note that a key went up.

        Args:
            key: name of the key.
        """
        self._held.discard(key)

    def release_all(self) -> None:
        """Note that the keyboard belongs to another window now."""
        self._held.clear()
        self._tapped.clear()

    def controls(self) -> Controls:
        """Return the controls that the held keys stand for.

        A key that was pressed and released since the last call counts as held, so that a short
        press between two images is not lost.
        """
        held = self._held | self._tapped
        self._tapped.clear()
        right, up, turn = (
            max(-1.0, min(1.0, sum(move[axis] for key, move in MOVES.items() if key in held)))
            for axis in range(3)
        )
        full = KICK in held or CHIP in held
        return Controls(
            right=right,
            up=up,
            turn=turn,
            kick=1.0 if full else PASS_KICK if PASS in held else 0.0,
            chip=CHIP in held,
            dribble=self._dribble,
            slow=not held.isdisjoint(SLOW),
        )

    def take_commands(self) -> list[str]:
        """Return the commands since the last call, in order, and forget them."""
        commands, self._commands = self._commands, []
        return commands
