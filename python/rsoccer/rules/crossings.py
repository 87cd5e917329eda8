"""The rule of the lines: a ball between the posts is a goal, over other lines it left the field."""

from typing import Final

import numpy as np

from rsoccer._core import CROSSINGS
from rsoccer.frame import GOAL_LEFT, GOAL_RIGHT
from rsoccer.game import BLUE, NOBODY, YELLOW, EventKind
from rsoccer.play import Play
from rsoccer.rules.base import Restart, Rule
from rsoccer.rules.touches import last_touch, team_of

# (crossings,) kind of the event of each crossing, and the team that scores.
_KINDS: Final = np.array(
    [
        EventKind.GOAL
        if name in ("goal_right", "goal_left")
        else EventKind.BALL_LEFT_FIELD_GOAL_LINE
        if name.startswith("goal_line")
        else EventKind.BALL_LEFT_FIELD_TOUCH_LINE
        if name.startswith("touch_line")
        else EventKind.NONE
        for name in CROSSINGS
    ]
)
_SCORERS: Final = np.array(
    [BLUE if i == GOAL_RIGHT else YELLOW if i == GOAL_LEFT else NOBODY for i in range(len(_KINDS))]
)


class Crossings(Rule):
    """Every goal counts, own goals too; play is not stopped by any crossing."""

    def judge(self, play: Play) -> Restart | None:
        """Add goals to the score, and goals and balls that left the field to the events."""
        frame = play.frame
        if not np.count_nonzero(frame.ball.crossed):  # in most steps
            return None
        worlds = np.flatnonzero(frame.ball.crossed)
        crossed = frame.ball.crossed[worlds].astype(np.intp)
        kind, scorer, robot = _KINDS[crossed], _SCORERS[crossed], last_touch(frame, worlds)
        goal = kind == EventKind.GOAL
        play.game.score[worlds[goal], scorer[goal]] += 1
        team = np.where(goal, scorer, team_of(frame, robot))
        play.events.add(worlds, kind, team, robot, frame.ball.crossed_at[worlds])
        return None
