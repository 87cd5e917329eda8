"""Play of a team: passes, assists, possession, positions of its robots, a mean for each match."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from rsoccer.arrays import Doubles, Floats, Mask
from rsoccer.frame import team_of
from rsoccer.game import NOBODY, EventKind
from rsoccer.play import Play
from rsoccer.task import Task
from rsoccer.vectors import norm

MEASURES: Final = ("passes", "lost", "assists", "ball_share", "spread", "cover")
"""Names of the measures, in the order of tables."""
RELEASE_GAP: Final = 0.05
"""Gap between a robot and the ball from which the ball has left it, m."""
MIN_PASS_LENGTH: Final = {"omni": 0.5, "differential": 0.2}
"""Least length of a pass by the drive of the robots, m; SSL and VSSS."""
AIM_POINTS: Final = 9
"""Points of the own goal's mouth that robots may hide from the ball."""


class TeamPlayRecorder:
    """Measures of one team in matches that are played in batches.

    Passes are counted by touches, alike in both leagues: the ball leaves a robot, and a teammate is
    the next to touch it, at least 0.5 m (VSSS: 0.2 m) from there.

    | measure | meaning | unit |
    | --- | --- | --- |
    | `passes` | passes that arrived | 1 |
    | `lost` | balls that went as far, but to an opponent | 1 |
    | `assists` | goals whose scorer had the ball from a teammate, without an opponent between | 1 |
    | `ball_share` | share of the time with a last touch in which it was the team's | 1 |
    | `spread` | mean distance between two robots of the team | m |
    | `cover` | share of the own goal's mouth that robots of the team hide from the ball | 1 |
    """

    def __init__(self, task: Task, side: str) -> None:
        """Prepare to measure a team.

        Args:
            task: the task that is played.
            side: "blue" or "yellow".
        """
        config, robot = task.config, task.config.robots[0]
        self._n_blue, self._team = task.n_blue, ("blue", "yellow").index(side)
        members = [i for i, name in enumerate(task.robots) if team_of(name) == side]
        self._members: NDArray[np.intp] = np.array(members, np.intp)
        self._reach = np.float32(robot.bounding_radius + config.ball.radius + RELEASE_GAP)
        self._shade = np.float32(robot.bounding_radius + config.ball.radius)
        self._min_length = np.float32(MIN_PASS_LENGTH[robot.drive])
        mouth = np.linspace(-0.5, 0.5, AIM_POINTS, dtype=np.float32) * config.field.goal_width
        goal_x = config.field.half_length * (-1.0 if side == "blue" else 1.0)
        self._aims = np.stack([np.full(AIM_POINTS, goal_x, np.float32), mouth], axis=-1)
        self._batches: list[_Batch] = []

    def begin(self, n: int) -> None:
        """Begin new matches.

        Args:
            n: number of matches that are played at once from now on.
        """
        self._batches.append(
            _Batch(
                totals={name: np.zeros(n) for name in MEASURES},
                steps=np.zeros(n),
                with_ball=np.zeros(n),
                last=np.full(n, NOBODY, np.intp),
                before=np.full(n, NOBODY, np.intp),
                released_at=np.zeros((n, 2), np.float32),
            )
        )

    def record(self, play: Play, playing: Mask) -> None:
        """Measure a step.

        Args:
            play: state of the n matches that the step left.
            playing: (n,) the matches that it belonged to, not those that wait.
        """
        batch, frame = self._batches[-1], play.frame
        scored = playing & play.events.happened(EventKind.GOAL)
        for world in np.flatnonzero(scored).tolist():
            batch.totals["assists"][world] += self._assists(batch, play, world)
        # A restart, after which both frames are equal, ends what touches before it began.
        restarted = (play.last_frame.rows == frame.rows).all(axis=1)
        batch.last[restarted] = batch.before[restarted] = NOBODY
        self._follow_ball(batch, play, playing & ~restarted)
        robots, present = self._positions(play)
        batch.steps += playing
        touched = playing & (batch.last != NOBODY)
        batch.with_ball += touched
        batch.totals["ball_share"] += touched & self._is_own(batch.last)
        batch.totals["spread"] += np.where(playing, _spread(robots, present), 0.0)
        cover = self._cover(frame.ball.position, robots, present)
        batch.totals["cover"] += np.where(playing, cover, 0.0)

    def means(self) -> dict[str, Doubles]:
        """Return the measures of all matches, (n,) by name, in the order of their begin."""
        parts = [batch.means() for batch in self._batches]
        return {name: np.concatenate([part[name] for part in parts]) for name in MEASURES}

    def _is_own(self, robots: NDArray[np.intp]) -> Mask:
        """(n,) whether robots are of the team."""
        own: Mask = (robots != NOBODY) & ((robots >= self._n_blue) == bool(self._team))
        return own

    def _follow_ball(self, batch: _Batch, play: Play, playing: Mask) -> None:
        """Count passes and lost balls where another robot touched the ball."""
        ball = play.frame.ball
        last = ball.last_touch.astype(np.intp)
        changed = playing & (last != batch.last)
        way = ball.position - batch.released_at
        far = norm(way[:, 0], way[:, 1]) >= self._min_length
        sent = changed & far & self._is_own(batch.last) & (last != NOBODY)
        batch.totals["passes"] += sent & self._is_own(last)
        batch.totals["lost"] += sent & ~self._is_own(last)
        batch.before[:] = np.where(changed, batch.last, batch.before)
        batch.last[:] = np.where(changed, last, batch.last)
        worlds = np.arange(len(last))
        offset = ball.position - play.frame.robots.position[worlds, last]
        near = (last != NOBODY) & (norm(offset[:, 0], offset[:, 1]) < self._reach)
        begins = playing & (near | changed)
        batch.released_at[begins] = ball.position[begins]

    def _assists(self, batch: _Batch, play: Play, world: int) -> int:
        """Goals of the team in a world in this step whose scorer had the ball from a teammate."""
        count = 0
        for event in play.events.of_world(world):
            if event.kind is not EventKind.GOAL or event.team != self._team:
                continue
            last, before = int(batch.last[world]), int(batch.before[world])
            passer = before if event.robot == last else last
            count += bool(self._is_own(np.array([passer, event.robot], np.intp)).all())
        return count

    def _positions(self, play: Play) -> tuple[Floats, Mask]:
        """(n, team, 2) positions of the team, m, and (n, team) whether the robots play."""
        robots = play.frame.robots
        return robots.position[:, self._members], robots.absent[:, self._members] == 0.0

    def _cover(self, ball: Floats, robots: Floats, present: Mask) -> Floats:
        """(n,) share of the points of the own goal's mouth that the team hides from the ball."""
        way = self._aims - ball[:, None]  # (n, points, 2)
        offset = robots - ball[:, None]  # (n, team, 2)
        length = np.maximum((way * way).sum(axis=-1), np.float32(1e-6))
        along = np.einsum("npi,nri->nrp", way, offset) / length[:, None]
        along = np.minimum(np.maximum(along, np.float32(0.0)), np.float32(1.0))
        gap = offset[:, :, None] - along[..., None] * way[:, None]
        hides = (norm(gap[..., 0], gap[..., 1]) < self._shade) & present[..., None]
        cover: Floats = hides.any(axis=1).mean(axis=-1)
        return cover


@dataclass
class _Batch:
    """Measures of n matches that are played at once."""

    totals: dict[str, Doubles]
    """(n,) sums over steps, or counts, by measure"""
    steps: Doubles
    """(n,) steps that were played"""
    with_ball: Doubles
    """(n,) steps since any robot touched the ball"""
    last: NDArray[np.intp]
    """(n,) robot that touched the ball last"""
    before: NDArray[np.intp]
    """(n,) another robot that touched it last before"""
    released_at: Floats
    """(n, 2) position of the ball where it was last with a robot, m"""

    def means(self) -> dict[str, Doubles]:
        """Counts of each match, and means over its steps."""
        per = {"ball_share": self.with_ball, "spread": self.steps, "cover": self.steps}
        return {
            name: total / np.maximum(per[name], 1.0) if name in per else total.copy()
            for name, total in self.totals.items()
        }


def _spread(robots: Floats, present: Mask) -> Floats:
    """(n,) mean distance between two present robots of a team, m; 0 for a single one."""
    first, second = np.triu_indices(robots.shape[1], 1)
    way = robots[:, first] - robots[:, second]
    both = present[:, first] & present[:, second]
    total = np.where(both, norm(way[..., 0], way[..., 1]), np.float32(0.0)).sum(axis=1)
    mean: Floats = total / np.maximum(both.sum(axis=1), 1)
    return mean
