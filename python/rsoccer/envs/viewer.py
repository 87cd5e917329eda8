"""Rendering of an environment's matches, as images or in a window."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from gymnasium.error import ClosedEnvironmentError
from numpy.typing import NDArray

from rsoccer.envs.env_matches import EnvMatches
from rsoccer.task import Task

if TYPE_CHECKING:
    from rsoccer.render.announcer import Announcer
    from rsoccer.render.effects import Effects
    from rsoccer.render.window import Window

Image = NDArray[np.uint8]

RENDER_MODES: Final = ("human", "rgb_array")


class Viewer:
    """Renderer of matches in the render mode of an environment.

    The drawing code is imported with the first image.

    Attributes:
        closed: True after `close`.
    """

    def __init__(self, mode: str | None, task: Task, modes: Sequence[str] = RENDER_MODES) -> None:
        """Prepare rendering.

        Args:
            mode: render mode, one of `modes`; None for no rendering.
            task: the task that is played; its time step sets the frame rate of a window.
            modes: render modes that the environment supports.

        Raises:
            ValueError: an unknown render mode.
        """
        if mode is not None and mode not in modes:
            raise ValueError(f"render_mode: expected one of {modes} or None, got {mode!r}")
        self._mode, self._modes, self._fps = mode, modes, frames_per_second(task)
        self._window: Window | None = None
        self._effects: dict[int, Effects] = {}
        self._announcers: dict[int, Announcer] = {}
        self.closed = False

    def render(self, matches: EnvMatches) -> Image | None:
        """Render a single match.

        Args:
            matches: the single match.

        Returns:
            Image (height, width, 3) uint8 with "rgb_array". None with "human", which shows the
            image in a window, and without a render mode, which warns.

        Raises:
            ClosedEnvironmentError: the environment is closed.
            RuntimeError: the match has not begun.
        """
        self.check_open("render")
        if self._mode is None:
            text = f"render() needs a render_mode, one of {self._modes}"
            warnings.warn(text, stacklevel=3)
            return None
        image = self.image(matches)
        if self._mode == "rgb_array":
            return image
        if self._window is None:
            from rsoccer.render.window import Window

            self._window = Window(matches.task.name, self._fps)
        self._window.show(image)
        return None

    def image(self, matches: EnvMatches, world: int = 0) -> Image:
        """Return an image of one match.

        Args:
            matches: all matches.
            world: index of the match.

        Returns:
            (height, width, 3) uint8.

        Raises:
            ClosedEnvironmentError: the environment is closed.
            RuntimeError: a match has not begun.
        """
        self.check_open("render")
        if not matches.begun:
            raise RuntimeError("render before reset: call reset() to begin an episode")
        from rsoccer.render.announcer import Announcer, named_events
        from rsoccer.render.effects import Effects
        from rsoccer.render.ghosts import sensed_overlay
        from rsoccer.render.image import draw_image
        from rsoccer.render.overlay import task_overlay
        from rsoccer.render.referee_state import referee_state

        task, play = matches.task, matches.play
        config, row, clock = task.config, matches.frame.rows[world], matches.clock(world)
        effects = self._effects.setdefault(world, Effects(config))
        announcer = self._announcers.setdefault(world, Announcer(config.field))
        return draw_image(
            config,
            row,
            score=matches.score(world),
            clock=clock,
            referee=referee_state(task, play, world),
            announcement=announcer.update(named_events(task, play.events.of_world(world)), clock),
            extras=(
                *task_overlay(task, play, world),
                *sensed_overlay(config, play, world),
                *effects.update(row, clock, play.commands[world]),
            ),
        )

    def png(self, matches: EnvMatches) -> bytes | None:
        """Return an image of the first match for notebooks, whatever the render mode.

        Args:
            matches: all matches.

        Returns:
            Content of a PNG file; None without a match to show, and without pygame.
        """
        if self.closed or not matches.begun:
            return None
        try:
            image = self.image(matches)
        except ModuleNotFoundError:
            return None
        from rsoccer.render.picture import Picture

        return Picture(image).to_png()

    def check_open(self, call: str) -> None:
        """Refuse a call after `close`.

        Args:
            call: name of the called method, for the error message.

        Raises:
            ClosedEnvironmentError: the environment is closed; Gymnasium's own class.
        """
        if self.closed:
            raise ClosedEnvironmentError(f"{call} after close: make another environment")

    def close(self) -> None:
        """Close the window, if there is one, and refuse later calls; may be repeated."""
        self.closed = True
        if self._window is not None:
            self._window.close()
            self._window = None

    def __getstate__(self) -> dict[str, Any]:
        """Return all attributes except the window; a copy opens its own."""
        return {**self.__dict__, "_window": None}


class ViewedMatch:
    """Rendering and closing of an environment with a single match."""

    _viewer: Viewer
    _matches: EnvMatches

    def render(self) -> Image | None:
        """Render the match.

        Returns:
            Image (height, width, 3) uint8 with "rgb_array". None with "human", which shows the
            image in a window, and without a render mode, which warns.

        Raises:
            ClosedEnvironmentError: the environment is closed.
            RuntimeError: no episode has begun.
        """
        return self._viewer.render(self._matches)

    def close(self) -> None:
        """Close the window and the simulator, if they hold anything; may be repeated.

        `reset`, `step` and `render` raise `ClosedEnvironmentError` from then on.
        """
        self._matches.close()
        self._viewer.close()

    def _repr_png_(self) -> bytes | None:
        """An image of the match, for notebooks."""
        return self._viewer.png(self._matches)


def metadata(task: Task, modes: Sequence[str] = RENDER_MODES) -> dict[str, Any]:
    """Return the metadata of an environment: `name`, `render_modes` and `render_fps`.

    Args:
        task: the task that is played.
        modes: render modes that the environment supports.
    """
    return {
        "name": task.name,
        "render_modes": list(modes),
        "render_fps": frames_per_second(task),
    }


def frames_per_second(task: Task) -> int:
    """Return the number of control steps in a second of a match.

    Args:
        task: the task that is played.
    """
    return round(1.0 / task.config.time_step)
