"""Robots of VSSS that play under a referee, and those that wait."""

import numpy as np

from rsoccer.arrays import Array, Floats, Mask
from rsoccer.game import Command, Stage
from rsoccer.policies.base import MatchState, Memory
from rsoccer.policies.vss.roles import ATTACKER, KEEPER, NONE


def may_play(match: MatchState, roles: Array, n_blue: int) -> Mask:
    """Return which robots play: in the shoot-out only the kicker and the other team's keeper.

    Args:
        match: a match with a referee.
        roles: (n, robots) role of each robot.
        n_blue: robots of team blue.
    """
    allowed: Mask = match.game.may_touch[:, match.robots]
    is_shootout = match.game.stage == Stage.PENALTY_SHOOTOUT
    if not is_shootout.any():
        return allowed
    blue_kicks = match.game.kick == Command.PREPARE_PENALTY_BLUE
    kicks = blue_kicks[:, None] == (match.robots < n_blue)
    takes_part = np.where(kicks, roles == ATTACKER, roles == KEEPER)
    playing: Mask = allowed & (takes_part | ~is_shootout[:, None])
    return playing


def wait(waits: Mask, memory: Memory, actions: Floats) -> None:
    """Let robots stand, and forget what they did: the referee puts them in other places.

    Args:
        waits: (n, robots) whether a robot waits.
        memory: arrays of the `scripted` policy; updated in place.
        actions: (n, robots, 2) wheel speeds; updated in place.
    """
    actions[waits] = 0.0
    memory["roles"][waits] = NONE
    memory["slow_steps"][waits] = 0  # a robot that waits is not stuck
    memory["delay"][waits.all(axis=1)] = 0
