"""Shapes as pixels, smoothly, through pygame and without a display."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache

from rsoccer.render.library import pygame
from rsoccer.render.shapes import (
    Arc,
    Circle,
    Color,
    Line,
    Point,
    Polygon,
    Shape,
    Text,
    arc_points,
)

SMOOTHING = 4
"""Sub-pixels along each axis that an edge is averaged from."""
SMOOTHED_PIXELS = 4_000_000
"""Most sub-pixels at once, 4 bytes each: larger shapes are smoothed less."""


@dataclass(frozen=True, slots=True)
class Camera:
    """Where metres are in an image: `scale` pixels per metre, rows downwards."""

    scale: float
    left: float
    top: float

    def project(self, points: Iterable[Point]) -> list[Point]:
        """Points in pixels."""
        scale, left, top = self.scale, self.left, self.top
        return [((x - left) * scale, (top - y) * scale) for x, y in points]


class Painter:
    """Paints shapes on a canvas through one camera.

    Each shape is filled on its own small sheet at `SMOOTHING` times the size, averaged down and
    laid over the canvas, so edges are smooth and move by fractions of a pixel. Sheets hold colours
    already multiplied by their opacity: averaging then mixes no colour of transparent pixels in.
    """

    def __init__(self, camera: Camera) -> None:
        """Paint as `camera` sees."""
        pygame.font.init()
        self._camera = camera
        self._glyphs = lru_cache(maxsize=64)(_glyphs)  # per object: freed with it

    def paint(self, canvas: pygame.Surface, shapes: Iterable[Shape]) -> None:
        """Lay the shapes over the canvas, in their order."""
        for shape in shapes:
            self._paint_one(canvas, shape)

    def _paint_one(self, canvas: pygame.Surface, shape: Shape) -> None:
        match shape:
            case Polygon(points, color, blur):
                self._fill(canvas, points, color, blur)
            case Circle(center, radius, color, blur):
                self._fill(canvas, arc_points(center, radius, 0.0, math.tau), color, blur)
            case Arc():
                self._fill(canvas, _band(shape), shape.color)
            case Line():
                self._fill(canvas, _bar(shape), shape.color)
            case Text():
                self._write(canvas, shape)

    def _fill(
        self, canvas: pygame.Surface, points: Iterable[Point], color: Color, blur: float = 0.0
    ) -> None:
        """Fill an outline given in metres."""
        outline = self._camera.project(points)
        softness = math.ceil(blur * self._camera.scale)
        area = _cover(outline, 2 * softness).clip(canvas.get_rect().inflate(2, 2))
        if not area:  # out of sight
            return
        factor = _smoothing(area)
        sheet = pygame.Surface((area.width * factor, area.height * factor), pygame.SRCALPHA)
        corners = [((x - area.x) * factor, (y - area.y) * factor) for x, y in outline]
        pygame.draw.polygon(sheet, _multiplied(color), corners)
        _lay(canvas, sheet, area, softness)

    def _write(self, canvas: pygame.Surface, text: Text) -> None:
        """Write a text at sub-pixel places, so that a number glides with its robot."""
        scale = self._camera.scale
        glyphs = self._glyphs(text.text, text.color, text.height * scale, text.max_width * scale)
        ((x, y),) = self._camera.project((text.center,))
        half_width, half_height = (side / 2 / SMOOTHING for side in glyphs.get_size())
        corner = (x - half_width, y - half_height)
        area = _cover((corner, (x + half_width, y + half_height)), 0)
        sheet = pygame.Surface((area.width * SMOOTHING, area.height * SMOOTHING), pygame.SRCALPHA)
        place = [round((a - b) * SMOOTHING) for a, b in zip(corner, area.topleft, strict=True)]
        sheet.blit(glyphs, place, special_flags=pygame.BLEND_PREMULTIPLIED)
        _lay(canvas, sheet, area, 0)


def _lay(canvas: pygame.Surface, sheet: pygame.Surface, area: pygame.Rect, softness: int) -> None:
    """Average a sheet down to its area, soften it by that many pixels, lay it over the canvas."""
    if softness:
        coarse = [max(1, round(side / softness)) for side in area.size]
        sheet = pygame.transform.smoothscale(sheet, coarse)
    if sheet.get_size() != area.size:
        sheet = pygame.transform.smoothscale(sheet, area.size)
    canvas.blit(sheet, area, special_flags=pygame.BLEND_PREMULTIPLIED)


def _smoothing(area: pygame.Rect) -> int:
    """How many times larger than its area a sheet is: less for areas of millions of pixels."""
    affordable = math.isqrt(SMOOTHED_PIXELS // (area.width * area.height + 1))
    return min(SMOOTHING, max(1, affordable))


def _cover(points: Iterable[Point], border: int) -> pygame.Rect:
    """The whole pixels that hold the points and a border around them."""
    xs, ys = zip(*points, strict=True)
    left, top = math.floor(min(xs)) - border, math.floor(min(ys)) - border
    right, bottom = math.ceil(max(xs)) + border + 1, math.ceil(max(ys)) + border + 1
    return pygame.Rect(left, top, right - left, bottom - top)


def _multiplied(color: Color) -> Color:
    """The colour as a sheet holds it: already multiplied by its opacity."""
    red, green, blue, opacity = color
    return (red * opacity // 255, green * opacity // 255, blue * opacity // 255, opacity)


def _band(arc: Arc) -> tuple[Point, ...]:
    """The outline of an arc: along the outer edge and back along the inner one."""
    outer, inner = arc.radius + arc.width / 2, arc.radius - arc.width / 2
    return (
        *arc_points(arc.center, outer, arc.start, arc.end),
        *arc_points(arc.center, inner, arc.end, arc.start),
    )


def _bar(line: Line) -> tuple[Point, ...]:
    """The outline of a line, with square ends that make corners meet."""
    (x_0, y_0), (x_1, y_1) = line.start, line.end
    length = math.hypot(x_1 - x_0, y_1 - y_0) or 1.0
    along_x, along_y = (
        (x_1 - x_0) / length * line.width / 2,
        (y_1 - y_0) / length * line.width / 2,
    )
    return (
        (x_0 - along_x - along_y, y_0 - along_y + along_x),
        (x_0 - along_x + along_y, y_0 - along_y - along_x),
        (x_1 + along_x + along_y, y_1 + along_y - along_x),
        (x_1 + along_x - along_y, y_1 + along_y + along_x),
    )


def _glyphs(text: str, color: Color, height: float, max_width: float) -> pygame.Surface:
    """A text `SMOOTHING` times its size, with the middle of its capitals in the middle.

    `height` is that of the capitals in pixels; a text wider than `max_width` pixels is shrunk.
    """
    size = max(1, round(height * SMOOTHING / _capital_share()))
    font = pygame.font.Font(None, size)
    width = font.size(text)[0]
    if width > max_width * SMOOTHING:
        font = pygame.font.Font(None, max(1, int(size * max_width * SMOOTHING / width)))
    drawn = font.render(text, True, color)
    middle = _capitals(font).centery
    half = max(middle, drawn.get_height() - middle)
    sheet = pygame.Surface((drawn.get_width(), 2 * half), pygame.SRCALPHA)
    sheet.blit(drawn, (0, half - middle))
    return sheet.premul_alpha()


@lru_cache(maxsize=1)
def _capital_share() -> float:
    """Height of a capital by the nominal size of pygame's own font."""
    size = 200
    return _capitals(pygame.font.Font(None, size)).height / size


def _capitals(font: pygame.font.Font) -> pygame.Rect:
    """Where a capital is within a line of text, pixels."""
    return font.render("H", True, "white").get_bounding_rect()
