"""Balls that go on from elsewhere, because their task says so, while all else goes on."""

from rsoccer import checks
from rsoccer.frame import Mask
from rsoccer.play import Play
from rsoccer.simulator import Worlds
from rsoccer.task import Task
from rsoccer.view import Viewpoint


def reposition_balls(
    task: Task, simulator: Worlds, play: Play, viewpoint: Viewpoint, active: Mask | None
) -> None:
    """Ask the task, and move its balls, but not in worlds that are not `active` (n,).

    There the last frame becomes equal to the frame, so that nobody is paid for what was between.
    """
    found = task.reposition_ball(play.frame)
    if found is None:
        return
    mask, balls = checks.repositioned(found, len(play.frame))
    if active is not None:
        balls, mask = balls[active[mask]], mask & active
    simulator.reposition_balls(mask, balls, out=play.frame.rows)
    play.last_frame.rows[mask] = play.frame.rows[mask]
    viewpoint.fill(play.last_frame, play.last_view)
