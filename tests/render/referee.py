"""States of a referee for the tests of pictures."""

from typing import Any

from rsoccer.game import Command, Stage
from rsoccer.render.referee_state import RefereeState


def state_of(**changes: Any) -> RefereeState:  # noqa: ANN401  (fields of a state)
    """A free kick of blue in the first half, of three robots a side, with some fields changed."""
    values: dict[str, Any] = {
        "command": Command.DIRECT_FREE_BLUE,
        "next_command": None,
        "kick": Command.DIRECT_FREE_BLUE,
        "command_seconds": 1.0,
        "stage": Stage.NORMAL_FIRST_HALF,
        "seconds_left": 100.0,
        "in_play": False,
        "designated_position": (0.3, -0.2),
        "ball_distance": 0.5,
        "score": (0, 0),
        "yellow_cards": (0, 0),
        "red_cards": (0, 0),
        "may_touch": (True, True, True, False, False, False),
    }
    return RefereeState(**{**values, **changes})
