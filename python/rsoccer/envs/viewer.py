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
    from rsoccer.render.window import Window

Image = NDArray[np.uint8]

RENDER_MODES: Final = ("human", "rgb_array")


class Viewer:
    """Shows matches in the way that was asked for, until it is closed for good.

    What draws is imported only when there is something to show.
    """

    def __init__(self, mode: str | None, task: Task, modes: Sequence[str] = RENDER_MODES) -> None:
        """`mode` is one of `modes` or None."""
        if mode is not None and mode not in modes:
            raise ValueError(f"render_mode: expected one of {modes} or None, got {mode!r}")
        self._mode, self._modes, self._fps = mode, modes, frames_per_second(task)
        self._window: Window | None = None
        self.closed = False

    def show(self, matches: EnvMatches) -> Image | None:
        """A lone match as an image (height, width, 3), or in a window."""
        self.expect_open("render")
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
        """One of the matches as an image (height, width, 3)."""
        self.expect_open("render")
        if not matches.begun:
            raise RuntimeError("render before reset: call reset() to begin an episode")
        from rsoccer.render.image import draw_image
        from rsoccer.render.overlay import task_overlay

        return draw_image(
            matches.task.config,
            matches.frame.rows[world],
            score=matches.score(world),
            clock=matches.clock(world),
            extras=task_overlay(matches, world),
        )

    def expect_open(self, call: str) -> None:
        """ClosedEnvironmentError, Gymnasium's own, for calls that come after `close`."""
        if self.closed:
            raise ClosedEnvironmentError(f"{call} after close: make another environment")

    def close(self) -> None:
        """Close the window, if there is one; may be repeated."""
        self.closed = True
        if self._window is not None:
            self._window.close()
            self._window = None

    def __getstate__(self) -> dict[str, Any]:
        """All but the window: a copy opens its own."""
        return {**self.__dict__, "_window": None}


def metadata(task: Task, modes: Sequence[str] = RENDER_MODES) -> dict[str, Any]:
    """What environments of all libraries tell of themselves."""
    return {
        "name": task.name,
        "render_modes": list(modes),
        "render_fps": frames_per_second(task),
    }


def frames_per_second(task: Task) -> int:
    """Steps in a second of the match."""
    return round(1.0 / task.config.time_step)
