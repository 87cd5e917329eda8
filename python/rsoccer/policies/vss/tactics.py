"""Tactics of the VSSS roles: motion targets of attacker, keeper and support."""

from typing import Final

import numpy as np

from rsoccer.arrays import Array, Floats, Mask
from rsoccer.policies.vss.avoidance import avoid_obstacle, avoid_robots
from rsoccer.policies.vss.drive_control import DriveTarget
from rsoccer.policies.vss.field_geometry import FieldGeometry
from rsoccer.policies.vss.roles import (
    ATTACKER,
    KEEPER,
    KEEPER_DEPTH,
    RUN_UP,
    SUPPORT,
    support_position,
)
from rsoccer.vectors import TINY, XY, norm, reciprocal, rotate_into, unit
from rsoccer.view import View

# -- Attacker --
APPROACH_SPEED: Final = np.float32(1.0)  # m/s that an attacker expects on its way to the ball
MAX_LOOKAHEAD: Final = np.float32(0.5)  # s ahead for which the ball is predicted
ALIGNMENT: Final = np.float32(1.8)  # m beside the push line, per m behind the ball, to start a run
FOLLOW_THROUGH: Final = np.float32(0.15)  # m beyond the robot, on the push line, that a run aims at
BALL_CLEARANCE: Final = np.float32(0.10)  # m from the ball on the way to the run-up
TRAPPED_ERROR: Final = np.float32(0.1)  # m that the run-up lacks to a position on the field
NEAR_WALL: Final = np.float32(0.1)  # m from a wall within which the ball is pressed against it
MIN_FLICK_SINE: Final = np.float32(0.5)  # of the angle between ball and push direction, for a flick
# -- Keeper --
MIN_SHOT_SPEED: Final = np.float32(0.15)  # m/s toward the goal that count as a shot
DEPTH_RATIO: Final = np.float32(0.5)  # m off the goal line, per m of a ball beside the goal
MIN_DEPTH: Final = np.float32(0.05)  # m off the goal line at least
# -- All but the attacker --
YIELD_RADIUS: Final = np.float32(0.14)  # m that they keep from the ball


def role_targets(field: FieldGeometry, view: View, roles: Array) -> DriveTarget:
    """Return the motion target of each robot by its role.

    Args:
        field: geometry of the field.
        view: view of the robots.
        roles: (n, robots) role of each robot.
    """
    position, ball = view.ego.position, view.ball.position
    keeping, attacking = roles == KEEPER, roles == ATTACKER
    x, y, through, turn = (
        np.where(keeping, keeper, np.where(attacking, attacker, support))
        for keeper, attacker, support in zip(
            _keeper_target(field, view),
            _attacker_target(field, view),
            _support_target(roles, view),
            strict=True,
        )
    )
    # A keeper between the ball and its goal does not give way to the ball.
    yielding = ~attacking & (~keeping | (position[..., 0] > ball[..., 0]))
    ball_xy = ball[..., 0], ball[..., 1]
    waypoint = avoid_obstacle(position, (x, y), ball_xy, YIELD_RADIUS, yielding)
    x, y = avoid_robots(view, waypoint, attacking)
    return DriveTarget(x, y, through, turn)


def _attacker_target(field: FieldGeometry, view: View) -> DriveTarget:
    """Get behind the ball, then run at it in the push direction; at walls flick it with a turn."""
    position = view.ego.position
    x, y = _interception(field, view)
    push = field.push_direction(x, y)
    u_x, u_y, trapped = _run_direction(field, (x, y), push)
    from_x, from_y = position[..., 0] - x, position[..., 1] - y
    ahead_of_ball, left = rotate_into(from_x, from_y, u_x, u_y)
    behind = -ahead_of_ball
    runs = (behind > 0.0) & (np.abs(left) < ALIGNMENT * behind)
    start = field.clamp(x - RUN_UP * u_x, y - RUN_UP * u_y)
    ahead = FOLLOW_THROUGH - behind
    start_x, start_y = avoid_obstacle(position, start, (x, y), BALL_CLEARANCE, ~runs)
    turn = _flick_turn(field, view, push, runs, trapped)
    target_x = np.where(runs, x + ahead * u_x, start_x)
    target_y = np.where(runs, y + ahead * u_y, start_y)
    return DriveTarget(target_x, target_y, np.ones_like(x), turn)


def _interception(field: FieldGeometry, view: View) -> XY:
    """Position where the robot can meet the ball, by two rounds of prediction."""
    position, ball = view.ego.position, view.ball
    x, y = ball.position[..., 0], ball.position[..., 1]
    for _ in range(2):
        distance = norm(x - position[..., 0], y - position[..., 1])
        x, y = field.predict_ball(ball, np.minimum(distance / APPROACH_SPEED, MAX_LOOKAHEAD))
    return x, y


def _run_direction(field: FieldGeometry, ball: XY, push: XY) -> tuple[Floats, Floats, Mask]:
    """Direction of the run: the push direction, or into the wall for a trapped ball.

    The mask says whether the ball is trapped, so that a run-up does not fit behind it.
    """
    x, y = ball
    error = field.clamp_error(x - RUN_UP * push[0], y - RUN_UP * push[1])
    zero = np.float32(0.0)
    wall_x = np.where(field.half_length - np.abs(x) < NEAR_WALL, np.sign(x), zero)
    wall_y = np.where(field.half_width - np.abs(y) < NEAR_WALL, np.sign(y), zero)
    trapped = (error > TRAPPED_ERROR) & ((wall_x != 0.0) | (wall_y != 0.0))
    wall_x, wall_y = unit(wall_x, wall_y)
    return np.where(trapped, wall_x, push[0]), np.where(trapped, wall_y, push[1]), trapped


def _flick_turn(field: FieldGeometry, view: View, push: XY, runs: Mask, trapped: Mask) -> Floats:
    """Turn that flicks a ball at a wall in the push direction: 1, -1, or 0 without a flick."""
    position, ball = view.ego.position, view.ball.position
    to_x, to_y = ball[..., 0] - position[..., 0], ball[..., 1] - position[..., 1]
    side, end = field.at_walls(ball[..., 0], ball[..., 1])
    touching = norm(to_x, to_y) < field.contact_distance
    flicks = touching & ((side & ~runs) | end | trapped)
    sine = (to_x * push[1] - to_y * push[0]) * reciprocal(norm(to_x, to_y), TINY)
    return np.where(flicks & (np.abs(sine) > MIN_FLICK_SINE), np.sign(sine), np.float32(0.0))


def _keeper_target(field: FieldGeometry, view: View) -> DriveTarget:
    """Stand in front of the goal, where the ball would cross."""
    x, y = view.ball.position[..., 0], view.ball.position[..., 1]
    v_x, v_y = view.ball.velocity[..., 0], view.ball.velocity[..., 1]
    ball_depth = x + field.half_length
    shot = (v_x < -MIN_SHOT_SPEED) & (ball_depth > KEEPER_DEPTH)
    seconds = (ball_depth - KEEPER_DEPTH) * reciprocal(-v_x, MIN_SHOT_SPEED)
    crossing = field.rebound_y(y + v_y * seconds)
    between = y * KEEPER_DEPTH / np.maximum(ball_depth, KEEPER_DEPTH)
    keeper_y = np.where(shot, crossing, between)
    keeper_y = np.minimum(np.maximum(keeper_y, -field.half_mouth), field.half_mouth)
    # A ball beside the goal comes along the goal line, so the keeper stands closer to the line.
    depth = np.minimum(np.maximum(ball_depth * DEPTH_RATIO, MIN_DEPTH), KEEPER_DEPTH)
    depth = np.where(np.abs(y) < field.half_mouth, KEEPER_DEPTH, depth)
    zero = np.zeros_like(keeper_y)
    return DriveTarget(depth - field.half_length, keeper_y, zero, zero)


def _support_target(roles: Array, view: View) -> DriveTarget:
    """Wait at the support position of the role."""
    ball = view.ball.position[..., 0], view.ball.position[..., 1]
    x, y = support_position(0, ball)
    for index in range(1, view.n_teammates - 1):
        support_x, support_y = support_position(index, ball)
        has_role = roles == SUPPORT + index
        x, y = np.where(has_role, support_x, x), np.where(has_role, support_y, y)
    zero = np.zeros_like(x)
    return DriveTarget(x, y, zero, zero)
