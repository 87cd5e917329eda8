"""Goal areas under a referee: which VSSS robots keep out of them, and their ways around them."""

from typing import Final

import numpy as np

from rsoccer._core import SimConfig
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.policies.vss.drive_control import DriveTarget
from rsoccer.policies.vss.roles import ATTACKER, KEEPER
from rsoccer.policies.vss.tactics import MIN_SHOT_SPEED
from rsoccer.vectors import XY
from rsoccer.view import View

MARGIN: Final = np.float32(0.05)  # m that robots keep from an area
BRAKING: Final = np.float32(0.1)  # s ahead for which they look where they would be: they brake then
PASSING: Final = np.float32(0.03)  # m beyond a corner that they aim at, to pass it without a stop
CLEARING_MARGIN: Final = np.float32(0.1)  # m around the own area in which the keeper has the ball


class GoalAreas:
    """The areas in which the referee allows one robot of a team: of a field with two, the smaller.

    The keeper has the own area, the attacker that of the opponents. View coordinates, m.
    """

    def __init__(self, config: SimConfig) -> None:
        """Read the dimensions.

        Args:
            config: configuration of the task.
        """
        field = config.field
        has_two = field.inner_area_depth > 0.0
        depth = field.inner_area_depth if has_two else field.goal_area_depth
        width = field.inner_area_width if has_two else field.goal_area_width
        self._front = np.float32(field.half_length - depth)
        self._half_width = np.float32(width / 2)

    def clears(self, view: View, roles: Array) -> Mask:
        """Return which keepers play a ball in or near their area, that no teammate may fetch.

        Args:
            view: view of the robots.
            roles: (n, robots) role of each robot.
        """
        ball = view.ball
        near = self._is_inside(-ball.position[..., 0], ball.position[..., 1], CLEARING_MARGIN)
        shot = ball.velocity[..., 0] < -MIN_SHOT_SPEED
        clears: Mask = (roles == KEEPER) & near & ~shot
        return clears

    def keep_out(self, view: View, roles: Array, target: DriveTarget) -> DriveTarget:
        """Return motion targets that keep robots out of the areas in which they are too many.

        Args:
            view: view of the robots.
            roles: (n, robots) role of each robot.
            target: motion targets by their roles.
        """
        several = view.present[:, :, : 1 + view.n_teammates].sum(axis=2) > 1
        occupied = self._has_teammate(view) | (roles != ATTACKER)
        for side, forbidden in ((-1.0, several & (roles != KEEPER)), (1.0, several & occupied)):
            target = self._detour(view, target, np.float32(side), forbidden)
        return target

    def _has_teammate(self, view: View) -> Mask:
        """Whether a teammate is in the opponents' area and the robot itself is not."""
        team = slice(0, 1 + view.n_teammates)
        position = view.robots.position[:, :, team]
        inside = self._is_inside(position[..., 0], position[..., 1], MARGIN)
        inside &= view.present[:, :, team]
        occupied: Mask = inside[:, :, 1:].any(axis=2) & ~inside[:, :, 0]
        return occupied

    def _is_inside(self, toward: Floats, y: Floats, margin: np.float32) -> Mask:
        """Whether places are in an area, or nearer to it than a margin.

        `toward` is x in the direction of its goal.
        """
        inside: Mask = (toward > self._front - margin) & (np.abs(y) < self._half_width + margin)
        return inside

    def _detour(
        self, view: View, target: DriveTarget, side: np.float32, forbidden: Mask
    ) -> DriveTarget:
        """Targets outside the area at x of a side, by ways around its corners, where forbidden."""
        x, y = side * view.ego.position[..., 0], view.ego.position[..., 1]
        to_x, to_y = self._outside(side * target.x, target.y)
        front, edge = self._front - MARGIN, self._half_width + MARGIN
        beside, to_beside = x > front, to_x > front
        # Robots beside the area leave by their corner, others reach its side by the corner there.
        leaves = beside & ~(to_beside & (y * to_y > 0.0))
        approaches = to_beside & ~beside & ((np.abs(y) < edge) | (y * to_y < 0.0))
        corner_y = np.copysign(edge + PASSING, np.where(leaves, y, to_y))
        around = leaves | approaches
        way_x = np.where(around, front - PASSING, to_x)
        way_y = np.where(around, corner_y, to_y)
        # A robot that is about to enter stands at once, one that is inside leaves.
        velocity = view.ego.velocity
        next_x, next_y = x + side * velocity[..., 0] * BRAKING, y + velocity[..., 1] * BRAKING
        enters = self._is_inside(x, y, MARGIN) | self._is_inside(next_x, next_y, MARGIN)
        out_x, out_y = self._outside(x, y)
        way_x, way_y = np.where(enters, out_x, way_x), np.where(enters, out_y, way_y)
        way_x = np.where(forbidden, side * way_x, target.x)
        way_y = np.where(forbidden, way_y, target.y)
        changed = (way_x != target.x) | (way_y != target.y)
        stops = np.where(changed, np.float32(0.0), target.through)
        turn = np.where(changed, np.float32(0.0), target.turn)
        return DriveTarget(way_x, way_y, stops, turn)

    def _outside(self, toward: Floats, y: Floats) -> XY:
        """Nearest places that keep the margin from the area."""
        inside = self._is_inside(toward, y, MARGIN)
        front, edge = self._front - MARGIN, self._half_width + MARGIN
        ahead = toward - front < edge - np.abs(y)
        x = np.where(inside & ahead, front, toward)
        return x, np.where(inside & ~ahead, np.copysign(edge, y), y)
