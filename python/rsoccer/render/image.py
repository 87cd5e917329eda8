"""Images of state rows, drawn off-screen: no display, no window, no OpenGL."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache, partial
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import NDArray

from rsoccer import checks
from rsoccer.arrays import Array
from rsoccer.render.pygame_import import pygame
from rsoccer.render.rasterizer import Camera, Rasterizer
from rsoccer.render.robot import robot_outlines
from rsoccer.render.scene import background_shapes, foreground_shapes
from rsoccer.render.scoreboard import Board, scene_bounds
from rsoccer.render.shapes import Shape
from rsoccer.render.words import NOTHING, Words

if TYPE_CHECKING:
    from rsoccer._core import SimConfig
    from rsoccer.render.referee_state import RefereeState

Image: TypeAlias = NDArray[np.uint8]
"""(height, width, 3), red, green and blue, 0 to 255."""

WIDTHS = (64, 4096)
"""Smallest and largest width of an image, pixels."""
DEFAULT_WIDTHS = (640, 1280)
"""Smallest and largest default width of an image, pixels."""
ROBOT_PIXELS = 22
"""Pixels across the smallest robot at which its number, heading and dribbler are distinct."""


def default_width(config: SimConfig, min_width: int = DEFAULT_WIDTHS[0]) -> int:
    """Compute the width at which the robots are large enough to read.

    Args:
        config: the configuration: its field and robots.
        min_width: width to use where it is enough, pixels.

    Returns:
        `min_width`, or more on a large field, pixels; even, and at most 1280 unless `min_width`
        is larger.
    """
    sizes = (robot_outlines(robot).size for robot in config.robots)
    smallest = min(sizes, default=math.inf)
    width = scene_bounds(config.field).width / smallest * ROBOT_PIXELS
    return max(min_width, min(2 * round(width / 2), DEFAULT_WIDTHS[1]))


class Renderer:
    """A renderer of rows of one configuration at one size; draws the static background once.

    Example:
        >>> import rsoccer
        >>> matches = rsoccer.Matches("VSSSelfPlay-v0")
        >>> observations = matches.reset()
        >>> renderer = Renderer(matches.task.config, width=640)
        >>> image = renderer.draw(matches.frame.rows[0], score=(1, 0), clock=12.5)

    Attributes:
        config: the configuration.
        has_referee: whether images show the state of a referee.
        width: width of the images, pixels; even.
        height: height of the images, pixels; even.
    """

    def __init__(
        self, config: SimConfig, width: int | None = None, *, has_referee: bool = False
    ) -> None:
        """Draw the background: field and empty score board.

        Args:
            config: the configuration of the rows to draw.
            width: width of the images, 64 to 4096 pixels, rounded to an even number; the height
                follows from the field. By default `default_width`.
            has_referee: whether images show the state of a referee: they are higher, for the words
                under the field.

        Raises:
            ValueError: the width is out of range.
        """
        low, high = WIDTHS
        width = default_width(config) if width is None else width
        if not low <= width <= high:
            raise ValueError(f"width: expected {low} to {high} pixels, got {width}")
        bounds = scene_bounds(config.field, ticker=has_referee)
        self.config, self.has_referee = config, has_referee
        self.width = 2 * round(width / 2)
        self.height = 2 * round(self.width * bounds.height / bounds.width / 2)
        camera = Camera(self.width / bounds.width, bounds.left, bounds.top)
        self._rasterizer = Rasterizer(camera)
        self._background = pygame.Surface((self.width, self.height), 0, 32)
        self._rasterizer.draw(self._background, background_shapes(config, referee=has_referee))

    def __reduce__(self) -> tuple[partial[Renderer], tuple[SimConfig, int]]:
        # Surfaces do not pickle; an environment that holds a renderer must.
        return (partial(Renderer, has_referee=self.has_referee), (self.config, self.width))

    def draw(
        self,
        row: Array,
        *,
        score: tuple[int, int] = (0, 0),
        clock: float = 0.0,
        names: tuple[str, str] = ("BLUE", "YELLOW"),
        caption: str = "",
        referee: RefereeState | None = None,
        announcement: Words = NOTHING,
        extras: Sequence[Shape] = (),
        overlay: Sequence[Shape] = (),
    ) -> Image:
        """Draw one world.

        Args:
            row: state of the world (row,).
            score: goals of blue and of yellow.
            clock: seconds of play.
            names: names of blue and of yellow on the score board.
            caption: large text across the field; none if empty.
            referee: state of the referee, whose score and clock are shown; exactly where the
                renderer `has_referee`.
            announcement: what has just happened, shown with a referee.
            extras: further shapes on the floor, such as those of `rsoccer.render.overlay`.
            overlay: further shapes above all others.

        Returns:
            A new image (height, width, 3), uint8.

        Raises:
            ValueError: the row has another shape or is not finite, or the state of a referee is
                missing or not expected.
        """
        if (referee is not None) is not self.has_referee:
            raise ValueError(
                f"referee: expected {'a state' if self.has_referee else 'None'}, got {referee}"
            )
        names = checks.team_names(names)
        board = Board(score, clock, names, caption, referee, announcement)
        canvas = self._background.copy()
        self._rasterizer.draw(canvas, foreground_shapes(self.config, row, board, extras))
        self._rasterizer.draw(canvas, overlay)
        return _pixels(canvas)


def draw_image(
    config: SimConfig,
    row: Array,
    *,
    score: tuple[int, int] = (0, 0),
    clock: float = 0.0,
    names: tuple[str, str] = ("BLUE", "YELLOW"),
    caption: str = "",
    referee: RefereeState | None = None,
    announcement: Words = NOTHING,
    extras: Sequence[Shape] = (),
    width: int | None = None,
) -> Image:
    """Draw one row; a `Renderer` is faster for many.

    Args:
        config: the configuration of the row.
        row: state of one world (row,).
        score: goals of blue and of yellow.
        clock: seconds of play.
        names: names of blue and of yellow on the score board.
        caption: large text across the field; none if empty.
        referee: state of the referee, whose score and clock are shown; None without one.
        announcement: what has just happened, shown with a referee.
        extras: further shapes on the floor, such as those of `rsoccer.render.overlay`.
        width: width of the image, 64 to 4096 pixels; by default `default_width`.

    Returns:
        A new image (height, width, 3), uint8.

    Raises:
        ValueError: the width is out of range, or the row has another shape or is not finite.
    """
    renderer = _renderer(config, width, referee is not None)
    return renderer.draw(
        row,
        score=score,
        clock=clock,
        names=names,
        caption=caption,
        referee=referee,
        announcement=announcement,
        extras=extras,
    )


@lru_cache(maxsize=4)
def _renderer(config: SimConfig, width: int | None, has_referee: bool) -> Renderer:
    """A renderer, cached: the background costs more than the rest of the picture."""
    return Renderer(config, width, has_referee=has_referee)


def _pixels(canvas: pygame.Surface) -> Image:
    """A copy of the canvas as an array; copying by channel is four times as fast as at once."""
    pixels = pygame.surfarray.pixels3d(canvas)  # (width, height, 3)
    image = np.empty((canvas.get_height(), canvas.get_width(), 3), np.uint8)
    for channel in range(3):
        image[..., channel] = pixels[..., channel].T
    return image
