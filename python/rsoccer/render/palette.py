"""Colors of pictures: red, green, blue and opacity, 0 to 255."""

from __future__ import annotations

from rsoccer.render.shapes import Color

BLUE: Color = (47, 111, 228, 255)
YELLOW: Color = (242, 194, 48, 255)
ORANGE: Color = (255, 112, 32, 255)
WHITE: Color = (240, 244, 248, 255)
INK: Color = (22, 25, 30, 255)

BACKDROP: Color = (14, 17, 22, 255)
WALL: Color = (62, 71, 84, 255)
WALL_EDGE: Color = (106, 119, 136, 255)
TABLE: Color = (32, 38, 46, 255)
CARPET: Color = (36, 92, 62, 255)
LINES: Color = (222, 228, 235, 255)
BOARD: Color = (36, 43, 53, 255)
MUTED: Color = (172, 183, 197, 255)
SHADOW: Color = (4, 6, 9, 150)
TIRE: Color = (14, 16, 19, 255)
HIGHLIGHT: Color = (255, 226, 200, 150)
TRAIL: Color = (255, 112, 32, 42)
HALO: Color = (255, 240, 222, 46)
RING: Color = (255, 250, 240, 225)
BALL_OUTLINE: Color = (40, 14, 4, 190)
LABEL: Color = (14, 17, 22, 200)
CAPTION_BAND: Color = (14, 17, 22, 205)
SELECTED: Color = (120, 226, 255, 255)
KICK: Color = (255, 238, 150, 235)
DRIBBLER: Color = (196, 205, 215, 255)
DRIBBLER_LIT: Color = (88, 255, 168, 255)
YELLOW_CARD: Color = (255, 214, 46, 255)
RED_CARD: Color = (226, 54, 54, 255)

PENDING: Color = (255, 92, 190, 255)
DONE: Color = (126, 242, 176, 255)


def mix(color: Color, other: Color, share: float) -> Color:
    """Mix two colors.

    Args:
        color: the color to start from; its opacity is kept.
        other: the color to mix in.
        share: share of `other`, 0 to 1.

    Returns:
        The mixed color.
    """
    red, green, blue = (
        round(a + (b - a) * share) for a, b in zip(color[:3], other[:3], strict=True)
    )
    return (red, green, blue, color[3])


def fade(color: Color, opacity: float) -> Color:
    """Make a color more transparent.

    Args:
        color: the color.
        opacity: factor on its opacity, 0 to 1.

    Returns:
        The same red, green and blue with less opacity.
    """
    return (*color[:3], round(color[3] * opacity))
