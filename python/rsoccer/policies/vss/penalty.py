"""Penalty kicks of a VSSS team: a run at the ball into the corner that the keeper leaves free."""

from typing import Final

import numpy as np

from rsoccer.arrays import Array, Floats, Mask
from rsoccer.game import Command
from rsoccer.policies.base import MatchState
from rsoccer.policies.vss.drive_control import DriveTarget
from rsoccer.policies.vss.field_geometry import FieldGeometry
from rsoccer.policies.vss.roles import ATTACKER, KEEPER
from rsoccer.rng import WorldRng
from rsoccer.vectors import norm, rotate_into, unit
from rsoccer.view import View

NONE, PREPARES, RUNS = 0, 1, 2
"""Stages of a kick; with the sign of y of the corner."""

KICK_DISTANCE: Final = np.float32(0.1)  # m that the ball has moved after which play just goes on
CORNER: Final = np.float32(0.75)  # place in the goal, as a share of half its width
RESTING_SPEED: Final = np.float32(0.05)  # m/s below which the ball rests
OFF_CENTER: Final = np.float32(0.02)  # y of a keeper from which it leaves a corner, m
RUN_UP: Final = np.float32(0.2)  # m behind the ball where the run starts
MAX_SINE: Final = np.float32(0.1)  # of the heading's error, for the way back and the run
TURN_GAIN: Final = np.float32(0.4)  # wheel speed of a turn on the spot, per sine: no overshoot
FOLLOW_THROUGH: Final = np.float32(0.3)  # m ahead that it aims at


def kicks(match: MatchState, roles: Array, n_blue: int) -> Mask:
    """Return which robots have a penalty kick to take, (n, robots).

    Args:
        match: a match with a referee.
        roles: (n, robots) role of each robot.
        n_blue: robots of team blue.
    """
    blue, yellow = Command.PREPARE_PENALTY_BLUE, Command.PREPARE_PENALTY_YELLOW
    own = np.where(match.robots < n_blue, blue, yellow)
    kicking: Mask = _is_due(match, own) & (roles == ATTACKER)
    return kicking


def awaits(match: MatchState, view: View, roles: Array, n_blue: int) -> Mask:
    """Return which keepers await a penalty kick of the opponents, (n, robots).

    Args:
        match: a match with a referee.
        view: view of the robots.
        roles: (n, robots) role of each robot.
        n_blue: robots of team blue.
    """
    blue, yellow = Command.PREPARE_PENALTY_BLUE, Command.PREPARE_PENALTY_YELLOW
    theirs = np.where(match.robots < n_blue, yellow, blue)
    rests = norm(view.ball.velocity[..., 0], view.ball.velocity[..., 1]) < RESTING_SPEED
    waiting: Mask = _is_due(match, theirs) & (roles == KEEPER) & rests
    return waiting


def _is_due(match: MatchState, kick: Array) -> Mask:
    """Whether each robot's command of a kick (robots,) is due, and the ball has hardly moved."""
    game = match.game
    way = match.rows[:, :2] - game.kick_position
    is_near = norm(way[:, 0], way[:, 1]) < KICK_DISTANCE
    is_due: Mask = (game.command == Command.NORMAL_START) & is_near
    of_robots: Mask = is_due[:, None] & (game.kick[:, None] == kick)
    return of_robots


def choose_corner(
    field: FieldGeometry, view: View, kicking: Mask, stage: Array, rng: WorldRng
) -> None:
    """Choose the corner away from the opponent that is nearest to its goal, until the run begins.

    A keeper in the middle leaves both alike: then chance decides.

    Args:
        field: geometry of the field.
        view: view of the robots.
        kicking: (n, robots) whether a robot has a penalty kick to take.
        stage: (n, robots) stage of the kick; updated in place.
        rng: (n,) random streams.
    """
    x, y = view.opponents.position[..., 0], view.opponents.position[..., 1]
    present = view.opponents.absent == 0.0
    distance = np.where(present, norm(x - field.half_length, y), np.float32(np.inf))
    nearest = distance.argmin(axis=2)[..., None]
    keeper_y = np.take_along_axis(y, nearest, axis=2)[..., 0]
    stage[~kicking] = NONE
    new = (kicking & (stage == NONE)).any(axis=1)
    streams = rng[new]
    drawn = np.where(streams.uniform(-1.0, 1.0, stage.shape[1:]) < 0.0, -PREPARES, PREPARES)
    rng.put(new, streams)
    stage[new] = np.where(stage[new] == NONE, drawn, stage[new])
    chosen = np.where(np.abs(keeper_y) > OFF_CENTER, -np.sign(keeper_y) * PREPARES, stage)
    stage[:] = np.where(kicking & (np.abs(stage) != RUNS), chosen, stage)
    stage[~kicking] = NONE


def kick_target(field: FieldGeometry, view: View, stage: Array) -> DriveTarget:
    """Return the motion target of a kicker that stands behind the ball.

    It turns to the corner on the spot, drives back for a run, and runs: the ball goes where the
    flat front faces.

    Args:
        field: geometry of the field.
        view: view of the robots.
        stage: (n, robots) stage of the kick; updated in place.
    """
    position, ball = view.ego.position, view.ball.position
    x, y = ball[..., 0], ball[..., 1]
    corner = np.sign(stage).astype(np.float32)
    u_x, u_y = unit(field.half_length - x, corner * CORNER * field.half_mouth - y)
    ahead, _ = rotate_into(position[..., 0] - x, position[..., 1] - y, u_x, u_y)
    sine = _sine_to(view, u_x, u_y)
    is_facing = np.abs(sine) < MAX_SINE
    begins = is_facing & (-ahead > RUN_UP) & (np.abs(stage) == PREPARES)
    stage[begins] *= RUNS
    runs = np.abs(stage) == RUNS
    way: Floats = np.where(runs, FOLLOW_THROUGH, -FOLLOW_THROUGH)
    turn = np.where(is_facing | runs, np.float32(0.0), sine * TURN_GAIN)
    to_x = position[..., 0] + way * u_x
    to_y = position[..., 1] + way * u_y
    return DriveTarget(to_x, to_y, np.ones_like(x), turn)


def waiting_turn(view: View) -> Floats:
    """Return the turn of keepers until they face a side, so that they reach both at once.

    Args:
        view: view of the robots.

    Returns:
        (n, robots) wheel speeds, 0 for those that do.
    """
    zero = np.zeros_like(view.ego.heading[..., 0])
    sine = _sine_to(view, zero, zero + 1)
    turn: Floats = np.where(np.abs(sine) > MAX_SINE, sine * TURN_GAIN, zero)
    return turn


def _sine_to(view: View, x: Floats, y: Floats) -> Floats:
    """Sine of the angle from the front or back of robots, the nearer one, to a direction."""
    heading_x, heading_y = view.ego.heading[..., 0], view.ego.heading[..., 1]
    side = np.copysign(np.float32(1.0), heading_x * x + heading_y * y)
    sine: Floats = (heading_x * y - heading_y * x) * side
    return sine
