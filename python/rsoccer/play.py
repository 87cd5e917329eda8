"""All that a task may look at, for n worlds: frames, views, and what led from one to the next."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rsoccer.frame import Array, Floats, Frame
from rsoccer.rng import WorldRng
from rsoccer.view import View, Viewpoint


@dataclass
class Play:
    """All that a task may look at, for n worlds."""

    frame: Frame  # (n, ...) where the worlds are now
    last_frame: Frame  # (n, ...) one step ago; equal to `frame` after a reset
    view: View  # (n, seers, ...) `frame` as each seer has it
    last_view: View  # (n, seers, ...) `last_frame` likewise
    commands: Floats  # (n, robots, command) what the robots were last told
    actions: Floats  # (n, robots, action) what their drivers last chose; 0 after a reset
    rng: WorldRng  # (n,) one stream per world, the task's own
    memory: dict[str, Array]  # (n, ...) the task's own, fresh after a reset
    seers: NDArray[np.intp]  # (seers,) which robots look
    steps: NDArray[np.int64]  # (n,) control steps since the episode started

    def advance(self) -> None:
        """Swap the buffers: what is now becomes what was."""
        self.frame, self.last_frame = self.last_frame, self.frame
        self.view, self.last_view = self.last_view, self.view

    def start(self, rows: Floats, viewpoint: Viewpoint) -> None:
        """Be at `rows` (n, row), with nothing before: differences to the last frame are zero."""
        self.frame.rows[:] = rows
        self.last_frame.rows[:] = rows
        viewpoint.fill(self.frame, self.view)
        viewpoint.fill(self.last_frame, self.last_view)

    def take(self, worlds: NDArray[np.intp]) -> "Play":
        """A copy of some worlds."""
        return Play(
            frame=_taken(self.frame, worlds),
            last_frame=_taken(self.last_frame, worlds),
            view=self.view.take(worlds),
            last_view=self.last_view.take(worlds),
            commands=self.commands[worlds],
            actions=self.actions[worlds],
            rng=self.rng[worlds],
            memory={name: array[worlds] for name, array in self.memory.items()},
            seers=self.seers,
            steps=self.steps[worlds],
        )

    def put(self, worlds: NDArray[np.intp], part: "Play") -> None:
        """Overwrite some worlds."""
        self.frame.rows[worlds] = part.frame.rows
        self.last_frame.rows[worlds] = part.last_frame.rows
        self.view.put(worlds, part.view)
        self.last_view.put(worlds, part.last_view)
        self.commands[worlds] = part.commands
        self.actions[worlds] = part.actions
        self.rng.put(worlds, part.rng)
        for name, array in part.memory.items():
            self.memory[name][worlds] = array
        self.steps[worlds] = part.steps


def _taken(frame: Frame, worlds: NDArray[np.intp]) -> Frame:
    return Frame(frame.rows[worlds], frame.n_blue, frame.n_yellow)
