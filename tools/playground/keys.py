"""Keys of `rsoccer play` for the playground, by the names that browsers give them."""

from typing import Any, Final

from rsoccer.human import keyboard

_NAMES: Final = {
    **{name: f"arrow{name}" for name in ("up", "down", "left", "right")},
    "space": " ",
    **dict.fromkeys(keyboard.SLOW, "shift"),
}
"""Lower-case `KeyboardEvent.key` of keys that it names otherwise than `rsoccer.human.keyboard`."""
_COMMANDS: Final = ("next_robot", "pause", "reset")
"""Commands that the playground has."""


def keys() -> dict[str, Any]:
    """Return keys and the speed of a pass, as values for JSON."""
    commands = {command: key for key, command in keyboard.COMMANDS.items()}
    return {
        "moves": {_name(key): move for key, move in keyboard.MOVES.items()},
        "kick": _name(keyboard.KICK),
        "pass": _name(keyboard.PASS),
        "chip": _name(keyboard.CHIP),
        "dribble": _name(keyboard.DRIBBLE),
        "slow": sorted({_name(key) for key in keyboard.SLOW}),
        "commands": {name: commands[name] for name in _COMMANDS},
        "passKick": keyboard.PASS_KICK,
    }


def key_words() -> str:
    """Return the keys of kicker and dribbler in words."""
    names = keyboard.KICK, keyboard.PASS, keyboard.CHIP, keyboard.DRIBBLE
    kick, pass_, chip, dribble = (name.capitalize() for name in names)
    return f"{kick} kicks, {pass_} passes, {chip} chips, {dribble} switches the dribbler"


def _name(key: str) -> str:
    return _NAMES.get(key, key)
