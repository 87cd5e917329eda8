"""A match of scripted SSL teams by the native module, as `crates/rsim-match` plays it.

It is what the WebAssembly module is compared with: physics, referee and teams, driven from here.
"""

from typing import Final

import numpy as np

from rsoccer import Sensing, _core
from rsoccer._core import SimConfig, Simulator
from rsoccer.arrays import Array, Floats
from rsoccer.frame import row_size
from rsoccer.rules.referee_config import RefereeConfig
from rsoccer.sensing_text import with_number
from rsoccer.view import SIDES

_KICKOFF, _TEAMS, _SENSES, _PLACES = 0, 1, 5, 7  # words of a seed, as `whole_match.rs` draws them
_MASK: Final = 2**64 - 1
_ALL: Final = np.ones(1, np.bool_)


class NativeMatch:
    """One match of two scripted SSL teams.

    Attributes:
        row: (1, row) state.
        game: (1, game) state of the referee.
        commands: (1, robots, command) commands of the last step.
        restarts: number of times that the referee has put bodies elsewhere.
    """

    def __init__(
        self,
        field: str,
        robots: int,
        skills: tuple[float, float],
        seed: int,
        sensing: Sensing | None = None,
        tactics: Floats | None = None,
    ) -> None:
        """Begin a match.

        Args:
            field: preset of an SSL field.
            robots: robots of each team, 1 to 11.
            skills: skill of blue and of yellow, 0 to 1.
            seed: seed of the match, 0 to 2**32 - 1.
            sensing: senses of the robots; None if they know the true state.
            tactics: (tactics,) numbers by which blue plays; None for those that were set by hand.
        """
        if sensing is not None:
            sensing = with_number(sensing, "forecast", 1.0)
        config = SimConfig(field, robots, robots, sensing=sensing)
        preset = "ssl_2026_a" if field == "ssl_a" else "ssl_2026_b"
        rules = RefereeConfig(preset, extra_half_seconds=0.0, shootout_kicks=0.0)
        self._simulator = Simulator(config)
        self._referee = _core.Referee(config, rules.to_json())
        self._teams = [_core.ScriptedTeam(config, skill) for skill in skills]
        self._memories = [np.zeros((1, team.memory_size), np.float32) for team in self._teams]
        for nth, (team, memory) in enumerate(zip(self._teams, self._memories, strict=True)):
            own = None if nth or tactics is None else tactics[None]
            team.begin(memory, [_word(seed, _TEAMS + nth) & 0xFFFFFFFF], own)
        self.row = np.zeros((1, row_size(robots, robots)), np.float32)
        self._simulator.read(self.row)
        places = _word(seed, _PLACES)
        self._referee.line_up(self.row, [places & 0xFFFFFFFF])
        self._simulator.place_estimates(_ALL, self.row.copy(), self.row)
        self._simulator.place(_ALL, self.row.copy(), self.row)
        self._simulator.begin_senses(_ALL, np.array([_word(seed, _SENSES)], np.uint64))
        self._known = (np.empty_like(self.row), np.empty_like(self.row))
        self._sense()
        self._match: tuple[Array, ...] = (
            _new_game(_word(seed, _KICKOFF) & 1, (places >> 32) & 0xFFFFFF),
            np.zeros((1, len(_core.STATISTICS_COLUMNS)), np.float32),
            np.zeros((1, 2), np.int64),
            np.zeros(1, np.float32),
            np.zeros((1, 2 * robots), np.bool_),
        )
        self._referee.begin(self.row, self._match)
        self._restart = np.empty_like(self.row)
        self.commands: Floats = np.zeros((1, 2 * robots, 6), np.float32)
        self.restarts = 0

    @property
    def known(self) -> Floats:
        """(1, row) state as blue knows it."""
        return self._known[0]

    @property
    def game(self) -> Floats:
        """(1, game) state of the referee."""
        return self._match[0]

    def step(self) -> None:
        """Advance by a control step."""
        acted = [
            team.commands(known, self.game, memory, nth)
            for nth, (known, team, memory) in enumerate(
                zip(self._known, self._teams, self._memories, strict=True)
            )
        ]
        self.commands = np.concatenate(acted, axis=1)
        before = self.row.copy()
        self._simulator.step(self.commands, self.row)
        put, _ = self._referee.judge(before, self.row, self._match, self._restart)
        if put is not None:
            self._simulator.restart(_ALL, self._restart.copy(), self.row)
            self._referee.begin(self.row, self._match)
            self.restarts += 1
        self._sense()

    def _sense(self) -> None:
        """Find what the teams know: scripted ones forecast."""
        for known, team in zip(self._known, SIDES, strict=True):
            self._simulator.sense(known, known=team)


def _new_game(kickoff: int, places: int) -> Floats:
    """A match that begins, (1, game), with the seed of the errors of places."""
    game = _core.Referee.new_game(kickoff)[None].copy()
    game[0, _core.GAME_COLUMNS.index("placements")] = places
    return game


def _word(seed: int, nth: int) -> int:
    """The n-th word of a stream, as `crates/rsim-core/src/streams.rs` defines it."""
    word = (seed + (nth + 1) * 0x9E3779B97F4A7C15) & _MASK
    word = ((word ^ (word >> 30)) * 0xBF58476D1CE4E5B9) & _MASK
    word = ((word ^ (word >> 27)) * 0x94D049BB133111EB) & _MASK
    return word ^ (word >> 31)
