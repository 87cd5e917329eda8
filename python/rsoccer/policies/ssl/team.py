"""The `scripted` policy for SSL: a whole team that plays matches under a referee."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from rsoccer._core import GAME_COLUMNS, TACTICS, Referee, ScriptedTeam
from rsoccer.arrays import Floats
from rsoccer.game import BLUE, YELLOW, Command
from rsoccer.policies.base import MatchState, Memory, Observes, PolicyInput
from rsoccer.policies.ssl.robot_control import DRIBBLER, KICK, TURN, require_ssl
from rsoccer.policies.tactics import Tactic, TacticalPolicy, checked, rows_of
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from rsoccer.tasks.ssl import Ssl

_V_X, _V_Y, _V_THETA, _KICK_X, _KICK_Z, _DRIBBLER = range(6)  # columns of a command
_CHIP_SWITCH: Final = 5  # index in an action with a chip kick
_SEEDS: Final = 2**31


def _free_play() -> Floats:
    """A match (1, game) in which the ball is free for all, for tasks without a referee."""
    row: Floats = Referee.new_game(BLUE)[None]
    for name, value in (("command", Command.FORCE_START), ("next_command", -1), ("in_play", 1)):
        row[0, GAME_COLUMNS.index(name)] = value
    return row


_FREE_PLAY: Final = _free_play()


class ScriptedSsl(TacticalPolicy):
    """A team script for SSL: keeper, defenders who mark, attacker, receivers; 1 to 11 robots.

    It obeys the referee, passes flat and by chips where that is likelier to lead to a goal than a
    shot, and places the ball. A robot whose teammates have other controllers plays as if they
    followed the script too.
    """

    TACTICS = tuple(Tactic(*numbers) for numbers in TACTICS)
    observes: Observes = "view"
    forecasts = True

    def __init__(self, task: Task, skill: float = 1.0, tactics: ArrayLike | None = None) -> None:
        """Prepare the script for a task.

        Args:
            task: an SSL task.
            skill: 0 to 1; faster decisions and robots, better aim.
            tactics: numbers by which it plays, (tactics,) in the order of `TACTICS`, or
                (n, tactics), one row for each of n matches at once; None for those that were set by
                hand.

        Raises:
            ValueError: another task, a skill out of range, or tactics of another shape or out of
                their ranges.
        """
        ssl = require_ssl("scripted", task)
        if not 0.0 <= skill <= 1.0:
            raise ValueError(f"scripted: expected a skill from 0 to 1, got {skill}")
        numbers = [tactic.default for tactic in self.TACTICS] if tactics is None else tactics
        self.tactics = checked(numbers, self.TACTICS)
        super().__init__(task)
        self._task: Ssl = ssl
        self._team = ScriptedTeam(ssl.config, skill)
        self._n_blue = ssl.n_blue

    @classmethod
    def with_tactics(cls, task: Task, tactics: Floats) -> ScriptedSsl:
        """Return the script with other numbers, see `TacticalPolicy.with_tactics`."""
        return cls(task, tactics=tactics)

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        """Return the memories of both teams, `blue` and `yellow`, each (n, memory)."""
        memory, tactics = {}, rows_of(self.tactics, shape[0])
        for name in ("blue", "yellow"):
            rows = np.zeros((shape[0], self._team.memory_size), np.float32)
            seeds = (rng.uniform(0.0, 1.0) * np.float32(_SEEDS)).astype(np.int64)
            self._team.begin(rows, seeds.tolist(), tactics)
            memory[name] = rows
        return memory

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Return the actions of the team's robots, (n, robots, action)."""
        match = inputs.match
        if match is None:
            raise ValueError("scripted needs the state of a match, got none")
        n, robots, size = inputs.action_shape
        commands = np.zeros((n, robots, 6), np.float32)
        game = match.game.get("referee")
        games = np.repeat(_FREE_PLAY, n, axis=0) if game is None else game
        for team, name, of_team in (
            (BLUE, "blue", match.robots < self._n_blue),
            (YELLOW, "yellow", match.robots >= self._n_blue),
        ):
            if of_team.any():
                first = team * self._n_blue
                found = self._team.commands(match.rows, games, memory[name], team, match.threads)
                commands[:, of_team] = found[:, match.robots[of_team] - first]
        return self._actions(inputs, match, commands, size)

    def _actions(
        self, inputs: PolicyInput, match: MatchState, commands: Floats, size: int
    ) -> Floats:
        """Actions (n, robots, action) that lead to commands (n, robots, 6)."""
        task = self._task
        actions = np.zeros((*commands.shape[:2], size), np.float32)
        v_x, v_y = commands[..., _V_X], commands[..., _V_Y]
        if task.velocity_frame == "field":
            ego = inputs.required_view("scripted").ego.heading
            cos, sin = ego[..., 0], ego[..., 1]
            v_x, v_y = v_x * cos - v_y * sin, v_x * sin + v_y * cos
        scales = task.action_scales
        actions[..., 0], actions[..., 1] = v_x / scales[0], v_y / scales[1]
        actions[..., TURN] = commands[..., _V_THETA] / scales[TURN]
        along, up = commands[..., _KICK_X], commands[..., _KICK_Z]
        actions[..., KICK] = np.where(along > 0.0, along / scales[KICK], np.float32(-1.0))
        actions[..., DRIBBLER] = np.where(commands[..., _DRIBBLER] > 0.0, 1.0, -1.0)
        if size > _CHIP_SWITCH:
            is_chip = up > 0.0
            chip = np.hypot(along, up) / np.float32(task.chip_scale)
            actions[..., KICK] = np.where(is_chip, chip, actions[..., KICK])
            actions[..., _CHIP_SWITCH] = np.where(is_chip, 1.0, -1.0)
        return np.minimum(np.maximum(actions, -1.0), 1.0)
