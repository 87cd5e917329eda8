"""The referee of whole matches, for tests of rules and for those who change them.

    >>> from rsoccer.referee import play_scene
    >>> scene = play_scene("ssl", {"ball": (0.0, 2.9, 0.0, 2.0), "last_touch": "blue_0"}, seconds=1)
    >>> [event.kind.name for event in scene.events], scene.next_command.name
    (['BALL_LEFT_FIELD_TOUCH_LINE'], 'DIRECT_FREE_YELLOW')

`RefereeConfig` has the numbers and switches of the rules, `rules` lists the rules with their
sources, `play_scene` plays a situation under the referee. The tasks `VSSMatch-v0` and `SSLMatch-v0`
are whole matches.
"""

from typing import NamedTuple

from rsoccer._core import referee_rules
from rsoccer.game import Command, EventKind, Stage
from rsoccer.referee.scene import Scene, SceneEvent, play_scene
from rsoccer.rules.referee_config import RefereeConfig

__all__ = [
    "Command",
    "EventKind",
    "RefereeConfig",
    "RuleEntry",
    "Scene",
    "SceneEvent",
    "Stage",
    "play_scene",
    "rules",
]


class RuleEntry(NamedTuple):
    """A rule that the referee judges."""

    name: str
    """Name of its event, and of its switch in `RefereeConfig.off`."""
    source: str
    """Paragraph of the source."""
    summary: str
    """Summary of what it says."""
    function: str
    """Its function in the core's crate."""


def rules(league: str) -> list[RuleEntry]:
    """Return the rules of a league in the order in which they are judged.

    Args:
        league: "ssl" or "vsss".

    Raises:
        ValueError: another league.
    """
    return [RuleEntry(*entry) for entry in referee_rules(league)]
