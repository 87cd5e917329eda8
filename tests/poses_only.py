"""A simulator that hides from its rows what no camera sees."""

import numpy as np

from rsoccer import Frame, SimConfig, Simulator
from rsoccer.arrays import Doubles, Floats, Mask


class PosesOnly:
    """`rsoccer.Simulator` whose rows have poses and `absent` alone; others are NaN.

    Attributes:
        truth: (n, row) complete rows of the last call.
    """

    def __init__(self, config: SimConfig, worlds: int, stamps: bool = False) -> None:
        self._simulator, self._config = Simulator(config, worlds), config
        self._stamps, self._steps = stamps, np.zeros(worlds)
        self.truth = np.zeros((worlds, config.row_size), np.float32)

    def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> Doubles | None:
        self._simulator.step(commands, self.truth, active)
        self._steps += 1.0 if active is None else active
        return self._hide(slice(None) if active is None else active, out)

    def read(self, out: Floats) -> Doubles | None:
        self._simulator.read(self.truth)
        return self._hide(slice(None), out)

    def place(
        self, worlds: Mask, rows: Floats, out: Floats, parameters: Floats | None = None
    ) -> Doubles | None:
        self._simulator.place(worlds, rows, self.truth, parameters)
        return self._hide(worlds, out)

    def restart(self, worlds: Mask, rows: Floats, out: Floats) -> Doubles | None:
        self._simulator.restart(worlds, rows, self.truth)
        return self._hide(worlds, out)

    def reposition_balls(self, worlds: Mask, balls: Floats, out: Floats) -> Doubles | None:
        self._simulator.reposition_balls(worlds, balls, self.truth)
        return self._hide(worlds, out)

    def _hide(self, worlds: Mask | slice, out: Floats) -> Doubles | None:
        n_blue, n_yellow = self._config.n_blue, self._config.n_yellow
        true, seen = Frame(self.truth, n_blue, n_yellow), Frame(out, n_blue, n_yellow)
        out[worlds] = np.nan
        seen.ball.position[worlds] = true.ball.position[worlds]
        seen.ball.height[worlds] = true.ball.height[worlds]
        seen.robots.position[worlds] = true.robots.position[worlds]
        seen.robots.heading[worlds] = true.robots.heading[worlds]
        seen.robots.absent[worlds] = true.robots.absent[worlds]
        return 100.0 + self._steps * self._config.time_step if self._stamps else None


def frames(config: SimConfig, *rows: Floats) -> list[Frame]:
    """Rows as frames."""
    return [Frame(np.atleast_2d(row), config.n_blue, config.n_yellow) for row in rows]
