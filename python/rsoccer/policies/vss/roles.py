"""Role assignment in a VSSS team: keeper, attacker and support.

Each robot assigns the roles of its whole team from what all of them see. Teammates so agree
without communication, whichever policy drives them.
"""

from typing import Final

import numpy as np

from rsoccer.arrays import Array, Floats
from rsoccer.policies.vss.field_geometry import FieldGeometry
from rsoccer.vectors import XY, norm
from rsoccer.view import View

NONE, KEEPER, ATTACKER, SUPPORT = 0, 1, 2, 3  # a second support is SUPPORT + 1, and so on

LOOKAHEAD: Final = np.float32(0.15)  # s; roles follow the predicted position of the ball
KEEPER_DEPTH: Final = np.float32(0.10)  # m from the own goal line to the keeper
RUN_UP: Final = np.float32(0.14)  # m behind the ball where an attacker starts its run
WRONG_SIDE_COST: Final = np.float32(0.15)  # m of path for a robot on the far side of the ball
HYSTERESIS: Final = np.float32(0.10)  # m by which another robot must be nearer to take a role over
TIE_BREAK: Final = np.float32(1e-4), np.float32(0.7e-4)  # cost per m of x and y: no equal costs

SUPPORT_OFFSETS: Final = ((0.35, 0.4), (0.2, -0.7), (0.5, -0.3))
"""Support positions: m behind the ball, share of its y; the last one for all further robots."""
SUPPORT_LIMIT: Final = np.float32(0.5)
"""Largest |x| and |y| of a support position, m."""


def support_position(index: int, ball: XY) -> XY:
    """Return the position of a supporting robot.

    Args:
        index: 0 for the first supporting robot.
        ball: position of the ball, m.
    """
    behind, share = SUPPORT_OFFSETS[min(index, len(SUPPORT_OFFSETS) - 1)]
    x, y = ball[0] - np.float32(behind), ball[1] * np.float32(share)
    return (
        np.minimum(np.maximum(x, -SUPPORT_LIMIT), SUPPORT_LIMIT),
        np.minimum(np.maximum(y, -SUPPORT_LIMIT), SUPPORT_LIMIT),
    )


def assign_roles(
    field: FieldGeometry, view: View, roles: Array, keeper_hysteresis: np.float32 = HYSTERESIS
) -> None:
    """Assign the roles of each robot's team by the shortest paths, one role after the other.

    Args:
        field: geometry of the field.
        view: view of the robots.
        roles: (n, robots, team) last roles of ego and its teammates; updated in place.
        keeper_hysteresis: m by which another robot must be nearer to become the keeper.
    """
    team = slice(0, 1 + view.n_teammates)
    x, y = view.robots.position[:, :, team, 0], view.robots.position[:, :, team, 1]
    present = view.present[:, :, team]
    several = present.sum(axis=2, keepdims=True) > 1  # a robot without teammates attacks
    ball = field.predict_ball(view.ball, LOOKAHEAD)
    paths = [(KEEPER, _keeper_path(field, x, y)), (ATTACKER, _attacker_path(field, x, y, ball))]
    for index in range(view.n_teammates - 1):
        support_x, support_y = support_position(index, ball)
        path = norm(x - support_x[..., None], y - support_y[..., None])
        paths.append((SUPPORT + index, path))
    assigned = np.full_like(roles, NONE)
    for role, path in paths:
        hysteresis = keeper_hysteresis if role == KEEPER else HYSTERESIS
        bonus = np.where(roles == role, hysteresis, np.float32(0.0))
        cost = path + TIE_BREAK[0] * x + TIE_BREAK[1] * y - bonus
        free = present & (assigned == NONE) & (several | (role != KEEPER))
        nearest = np.where(free, cost, np.float32(np.inf)).argmin(axis=2)[..., None]
        chosen = free & (np.arange(x.shape[2]) == nearest)
        assigned[chosen] = role
    roles[:] = assigned


def _keeper_path(field: FieldGeometry, x: Floats, y: Floats) -> Floats:
    """Distance (m) to the keeper's position, (n, robots, team)."""
    return norm(x + field.half_length - KEEPER_DEPTH, y)


def _attacker_path(field: FieldGeometry, x: Floats, y: Floats, ball: XY) -> Floats:
    """Distance (m) to the start of the run at the ball, (n, robots, team)."""
    u_x, u_y = (part[..., None] for part in field.push_direction(*ball))
    from_x, from_y = x - ball[0][..., None], y - ball[1][..., None]
    wrong_side = from_x * u_x + from_y * u_y > 0.0
    detour = np.where(wrong_side, WRONG_SIDE_COST, np.float32(0.0))
    return norm(from_x + RUN_UP * u_x, from_y + RUN_UP * u_y) + detour
