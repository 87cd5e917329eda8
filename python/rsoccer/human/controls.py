"""Controls: the state of a person's input devices, before it becomes the action of a task."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Controls:
    """State of the controls at one time.

    Attributes:
        right: deflection to the right, -1 to 1.
        up: deflection upwards or forwards, -1 to 1.
        turn: turn, counterclockwise, -1 to 1.
        kick: speed of a kick as a fraction of the fastest, 0 to 1; 0 for none.
        chip: True makes the kick a chip.
        dribble: the dribbler is on.
        slow: reduced speeds.
    """

    right: float = 0.0
    up: float = 0.0
    turn: float = 0.0
    kick: float = 0.0
    chip: bool = False
    dribble: bool = False
    slow: bool = False

    def combined(self, other: Controls) -> Controls:
        """Return the controls of two devices that are used together.

        Args:
            other: controls of the other device.

        Returns:
            Deflections are added and limited; a switch is on if it is on at either device.
        """
        return Controls(
            right=_limited(self.right + other.right),
            up=_limited(self.up + other.up),
            turn=_limited(self.turn + other.turn),
            kick=max(self.kick, other.kick),
            chip=self.chip or other.chip,
            dribble=self.dribble or other.dribble,
            slow=self.slow or other.slow,
        )


def _limited(value: float) -> float:
    """The value, limited to -1 to 1."""
    return max(-1.0, min(1.0, value))
