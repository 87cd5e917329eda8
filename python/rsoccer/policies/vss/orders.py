"""What each robot of a VSSS side is to do: attack, keep the goal, or support."""

from typing import Final

import numpy as np

from rsoccer.frame import Array, Floats, Mask, length
from rsoccer.policies.vectors import TINY, inverse
from rsoccer.policies.vss.driving import Orders, Place, past
from rsoccer.policies.vss.pitch import Pitch, unit
from rsoccer.policies.vss.roles import ATTACKER, KEEP_X, KEEPER, RUN_UP, SUPPORT, spot
from rsoccer.view import View

# -- Attack --
APPROACH: Final = np.float32(1.0)  # m/s at which an attacker counts on coming to the ball
LEAD: Final = np.float32(0.5)  # seconds that it looks ahead at most
ALIGNED: Final = np.float32(1.8)  # metres off the line, per metre behind the ball, to start a run
THROUGH: Final = np.float32(0.15)  # metres ahead on the line through the ball that a run aims at
ROUND: Final = np.float32(0.10)  # metres that it keeps from the ball on the way to the run-up
TRAPPED: Final = np.float32(0.1)  # metres by which there is no room behind the ball for a run
NEAR_WALL: Final = np.float32(0.1)  # metres from a wall within which the ball is pressed against it
SKEW: Final = np.float32(0.5)  # sine from the ball's course to it, from which a spin flicks it on
# -- Keeper --
COMING: Final = np.float32(0.15)  # m/s to the goal from which it goes to where the ball will be
DEEP: Final = np.float32(0.5)  # metres that it stands out, per metre of a ball beside the goal
POST_X: Final = np.float32(0.05)  # metres that it stands out at the least
# -- Ways --
ASIDE: Final = np.float32(0.14)  # metres that all but the attacker keep from the ball
BODY: Final = np.float32(0.08)  # metres that all keep from others' middles: a width or so
SIGHT: Final = np.float32(0.2)  # metres before them in which others are in the way
DUEL: Final = np.float32(0.15)  # metres from the ball in which an attacker pushes others aside
FAR: Final = np.float32(100.0)  # metres; further than anything is


def give(pitch: Pitch, view: View, roles: Array) -> Orders:
    """Orders for each robot, by its role (n, robots)."""
    ego, ball = view.ego.position, view.ball.position
    keeps, attacks = roles == KEEPER, roles == ATTACKER
    x, y, run, spin = (
        np.where(keeps, keep, np.where(attacks, attack, support))
        for keep, attack, support in zip(
            _keep(pitch, view), _attack(pitch, view), _support(roles, view), strict=True
        )
    )
    yields = ~attacks & (~keeps | (ego[..., 0] > ball[..., 0]))  # a keeper behind the ball does not
    way = past(ego, (x, y), (ball[..., 0], ball[..., 1]), ASIDE, yields)
    x, y = _past_robots(view, way, attacks)
    return Orders(x, y, run, spin)


def _past_robots(view: View, target: Place, attacks: Mask) -> Place:
    """Where to drive on the way to a target, past the next robot in it."""
    ego, others = view.ego.position, view.robots.position[:, :, 1:]
    ball = view.ball.position[:, :, None]
    if not others.shape[2]:
        return target
    x, y = others[..., 0], others[..., 1]
    way_x, way_y = target[0] - ego[..., 0], target[1] - ego[..., 1]
    u_x, u_y = (part[..., None] for part in unit(way_x, way_y))
    to_x, to_y = x - ego[..., None, 0], y - ego[..., None, 1]
    ahead, aside = to_x * u_x + to_y * u_y, to_y * u_x - to_x * u_y
    sight = np.minimum(length(way_x, way_y), SIGHT)[..., None]
    blocks = (ahead > 0.0) & (ahead < sight) & (np.abs(aside) < BODY) & view.present[:, 1:]
    duel = length(x - ball[..., 0], y - ball[..., 1]) < DUEL
    blocks &= ~(duel & attacks[..., None])
    nearest = np.argmin(np.where(blocks, ahead, FAR), axis=2)[..., None]
    next_x, next_y = (np.take_along_axis(part, nearest, 2)[..., 0] for part in (x, y))
    return past(ego, target, (next_x, next_y), BODY, np.asarray(blocks.any(axis=2)))


def _attack(pitch: Pitch, view: View) -> Orders:
    """Go behind the ball, run at it along its course; where walls are in the way, turn it out."""
    ego = view.ego.position
    x, y = _meeting(pitch, view)
    course = pitch.course(x, y)
    u_x, u_y, trapped = _pressed(pitch, (x, y), course)
    from_x, from_y = ego[..., 0] - x, ego[..., 1] - y
    behind, aside = -(from_x * u_x + from_y * u_y), from_y * u_x - from_x * u_y
    runs = (behind > 0.0) & (np.abs(aside) < ALIGNED * behind)
    start_x, start_y = pitch.inside(x - RUN_UP * u_x, y - RUN_UP * u_y)
    ahead = THROUGH - behind
    start_x, start_y = past(ego, (start_x, start_y), (x, y), ROUND, ~runs)
    spin = _spin(pitch, view, course, runs, trapped)
    to_x = np.where(runs, x + ahead * u_x, start_x)
    to_y = np.where(runs, y + ahead * u_y, start_y)
    return Orders(to_x, to_y, np.ones_like(x), spin)


def _meeting(pitch: Pitch, view: View) -> Place:
    """Where it can meet the ball, found in two rounds."""
    ego, ball = view.ego.position, view.ball
    x, y = ball.position[..., 0], ball.position[..., 1]
    for _ in range(2):
        far = length(x - ego[..., 0], y - ego[..., 1])
        x, y = pitch.rolled(ball, np.minimum(far / APPROACH, LEAD))
    return x, y


def _pressed(pitch: Pitch, ball: Place, course: Place) -> tuple[Floats, Floats, Mask]:
    """The course, or into the wall where there is no room for a run-up; and where there is none."""
    x, y = ball
    room = pitch.outside(x - RUN_UP * course[0], y - RUN_UP * course[1])
    zero = np.float32(0.0)
    out_x = np.where(pitch.half_length - np.abs(x) < NEAR_WALL, np.sign(x), zero)
    out_y = np.where(pitch.half_width - np.abs(y) < NEAR_WALL, np.sign(y), zero)
    trapped = (room > TRAPPED) & ((out_x != 0.0) | (out_y != 0.0))
    out_x, out_y = unit(out_x, out_y)
    return np.where(trapped, out_x, course[0]), np.where(trapped, out_y, course[1]), trapped


def _spin(pitch: Pitch, view: View, course: Place, runs: Mask, trapped: Mask) -> Floats:
    """Turning power that flicks a ball at a wall along its course, by the robot's side; else 0."""
    ego, ball = view.ego.position, view.ball.position
    to_x, to_y = ball[..., 0] - ego[..., 0], ball[..., 1] - ego[..., 1]
    side, end = pitch.walls(ball[..., 0], ball[..., 1])
    flicks = (length(to_x, to_y) < pitch.touch) & ((side & ~runs) | end | trapped)
    skew = (to_x * course[1] - to_y * course[0]) * inverse(length(to_x, to_y), TINY)
    return np.where(flicks & (np.abs(skew) > SKEW), np.sign(skew), np.float32(0.0))


def _keep(pitch: Pitch, view: View) -> Orders:
    """Stand before the goal, where the ball would cross."""
    x, y = view.ball.position[..., 0], view.ball.position[..., 1]
    v_x, v_y = view.ball.velocity[..., 0], view.ball.velocity[..., 1]
    out = x + pitch.half_length
    coming = (v_x < -COMING) & (out > KEEP_X)
    seconds = (out - KEEP_X) * inverse(-v_x, COMING)
    crossing = pitch.rebounding_y(y + v_y * seconds)
    between = y * KEEP_X / np.maximum(out, KEEP_X)
    keep_y = np.where(coming, crossing, between)
    keep_y = np.minimum(np.maximum(keep_y, -pitch.half_mouth), pitch.half_mouth)
    # Beside the goal the ball comes along the line, so it stands nearer to that.
    depth = np.minimum(np.maximum(out * DEEP, POST_X), KEEP_X)
    depth = np.where(np.abs(y) < pitch.half_mouth, KEEP_X, depth)
    zero = np.zeros_like(keep_y)
    return Orders(depth - pitch.half_length, keep_y, zero, zero)


def _support(role: Array, view: View) -> Orders:
    """Wait at the spot of one's role."""
    ball = view.ball.position[..., 0], view.ball.position[..., 1]
    x, y = spot(0, ball)
    for which in range(1, view.n_teammates - 1):
        at_x, at_y = spot(which, ball)
        mine = role == SUPPORT + which
        x, y = np.where(mine, at_x, x), np.where(mine, at_y, y)
    zero = np.zeros_like(x)
    return Orders(x, y, zero, zero)
