"""Columns that follow from two frames: velocities, touches, lines, break beams, collisions.

No camera sees these. A simulator or robots that report poses alone become complete with them, see
`rsoccer.completed`. Both frames are of n worlds and one control step apart; `last` is the earlier
one. Positions in between are not known: a body is assumed to have moved on with its last velocity,
and to have come with its present one.
"""

from rsoccer.derived.collisions import Collisions, collisions
from rsoccer.derived.lines import Crossing, crossing
from rsoccer.derived.motion import differentiate, roll
from rsoccer.derived.touches import (
    SinceTouch,
    ball_holder,
    ball_touches,
    beam_broken,
    last_touch,
    since_touch,
)
from rsoccer.derived.track_record import TrackRecord

__all__ = ["Collisions", "Crossing", "SinceTouch", "TrackRecord", "ball_holder", "ball_touches"]
__all__ += ["beam_broken", "collisions", "crossing", "differentiate", "last_touch", "roll"]
__all__ += ["since_touch"]
