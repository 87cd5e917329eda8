import importlib
import os
import pickle
import subprocess
import sys

import numpy as np
import pytest

from rsoccer import SimConfig
from rsoccer._core import Field, RobotModel
from rsoccer.arrays import Floats
from rsoccer.frame import Frame
from rsoccer.game import BLUE
from rsoccer.render import Image, Renderer, draw_image, palette
from rsoccer.render.image import DEFAULT_WIDTHS, WIDTHS, _renderer, default_width
from rsoccer.render.overlay import area_shapes
from rsoccer.render.pitch import is_table, wall_thickness
from rsoccer.render.scoreboard import scene_bounds
from rsoccer.render.shapes import Bounds, Circle, Color, Point, Pose, Text
from rsoccer.render.words import Words
from tests.render.referee import state_of

SIZES = [320, 640, 1280]
PLAY = {"in_play": True, "may_touch": (True,) * 6}
"""Fields of a state of the referee while all robots may play the ball."""


def pixel(image: Image, config: SimConfig, point: Point) -> Color:
    """The color at a point of the field."""
    bounds = scene_bounds(config.field)
    scale = image.shape[1] / bounds.width
    column, line = int((point[0] - bounds.left) * scale), int((bounds.top - point[1]) * scale)
    red, green, blue = image[line, column].tolist()
    return (red, green, blue, 255)


def close(color: Color, other: Color, tolerance: int = 30) -> bool:
    return max(abs(a - b) for a, b in zip(color, other, strict=True)) <= tolerance


def check_colors(config: SimConfig, row: Floats, width: int | None) -> None:
    """Every robot shows the color of its team, and the empty field does not."""
    image, empty = draw_image(config, row, width=width), ground_image(config, width)
    frame = Frame(row[None], config.n_blue, config.n_yellow)
    colors = [palette.BLUE] * config.n_blue + [palette.YELLOW] * config.n_yellow
    robots = zip(frame.robots.position[0].tolist(), frame.robots.heading[0].tolist(), strict=True)
    for model, (position, heading), color in zip(config.robots, robots, colors, strict=True):
        pose = Pose((position[0], position[1]), *heading)
        # Parts of the cover beside number and front.
        x, y = (
            (-0.34 * model.side_length, 0.24 * model.side_length)
            if hasattr(model, "side_length")
            else (-0.012, 0.058)
        )
        for place in pose.to_world(((x, y), (x, -y))):
            assert close(pixel(image, config, place), color), (place, color)
            assert not close(pixel(empty, config, place), color)


@pytest.mark.parametrize("width", SIZES)
def test_every_robot_shows_the_color_of_its_team(
    config: SimConfig, row: Floats, width: int
) -> None:
    check_colors(config, row, width)


def test_at_its_default_size_every_field_shows_its_robots_and_the_ball(
    any_config: SimConfig, any_row: Floats
) -> None:
    check_colors(any_config, any_row, None)
    x, y = Frame(any_row[None], 3, 3).ball.position[0].tolist()
    beside = 0.35 * any_config.ball.radius  # away from the highlight
    ball = pixel(draw_image(any_config, any_row), any_config, (x + beside, y - beside))
    assert close(ball, palette.ORANGE, 60)


@pytest.mark.parametrize("name", Field.PRESETS)
def test_a_default_image_is_large_enough_to_read_and_fits_a_screen(name: str) -> None:
    config = SimConfig(name, 1, 1)
    width = default_width(config)
    low, high = DEFAULT_WIDTHS
    assert low <= width <= high
    scale = width / scene_bounds(config.field).width
    assert 2 * reach(config.robot) * scale > 16
    assert Renderer(config).width == width
    assert Renderer(config).height <= 1080
    assert default_width(config, 1000) == max(1000, width)


def test_fields_ask_for_different_widths() -> None:
    widths = {name: default_width(SimConfig(name, 1, 1)) for name in Field.PRESETS}
    assert widths["vss_3v3"] == DEFAULT_WIDTHS[0] < widths["ssl_b"] < widths["ssl_a"]


def test_a_field_without_robots_is_drawn() -> None:
    config = SimConfig("ssl_b", 0, 0)
    assert draw_image(config, Frame.empty(1, 0, 0).rows[0]).shape[1] == DEFAULT_WIDTHS[0]


def reach(model: RobotModel) -> float:
    return model.side_length / 2 if hasattr(model, "side_length") else model.radius


@pytest.mark.parametrize("width", SIZES)
def test_the_ball_is_orange(config: SimConfig, row: Floats, width: int) -> None:
    ball = Frame(row[None], config.n_blue, config.n_yellow).ball.position[0].tolist()
    assert close(pixel(draw_image(config, row, width=width), config, ball), palette.ORANGE)
    assert not close(pixel(ground_image(config, width), config, ball), palette.ORANGE)


@pytest.mark.parametrize("name", Field.PRESETS)
def test_goals_and_lines_are_visible(name: str) -> None:
    config = SimConfig(name, 1, 1)
    image = ground_image(config, 1280)
    field = config.field
    floor = pixel(image, config, (0.31 * field.length, 0.3 * field.width))
    assert close(floor, palette.TABLE if is_table(field) else palette.CARPET, 2)
    line = pixel(image, config, (0.0, 0.4 * field.width))
    assert sum(line) - sum(floor) > 180
    pocket = field.half_length + 0.45 * field.goal_depth
    left, right = (pixel(image, config, (x, 0.02)) for x in (-pocket, pocket))
    assert left[2] - floor[2] > 40  # blue's
    assert right[0] - floor[0] > 40  # yellow's
    wall = pixel(image, config, (0.3, field.max_y + wall_thickness(field) / 2))
    assert close(wall, palette.WALL, 8)


@pytest.mark.parametrize("name", Field.PRESETS)
def test_corner_blocks_have_the_walls_color_and_margins_the_carpets(name: str) -> None:
    field = Field(name)
    image, config = ground_image(SimConfig(name, 1, 1), 1280), SimConfig(name, 1, 1)
    if field.corner_leg:
        inside = field.corner_leg / 4
        block = (field.half_length - inside, field.half_width - inside)
        assert close(pixel(image, config, block), palette.WALL, 8)
    if field.touch_line_margin:
        beyond = (0.2 * field.length, field.half_width + field.touch_line_margin / 2)
        assert close(pixel(image, config, beyond), palette.CARPET, 2)
    assert field.corner_leg or field.touch_line_margin


def test_extras_are_drawn(config: SimConfig, row: Floats) -> None:
    extras = area_shapes(config.field, Bounds(-0.7, -0.6, -0.5, -0.4))
    plain, with_extras = draw_image(config, row), draw_image(config, row, extras=extras)
    inside, outside = (-0.62, -0.48), (0.62, -0.48)
    assert pixel(plain, config, inside) != pixel(with_extras, config, inside)
    assert pixel(plain, config, outside) == pixel(with_extras, config, outside)


def test_an_overlay_is_above_robots(config: SimConfig, row: Floats) -> None:
    x, y = Frame(row[None], config.n_blue, config.n_yellow).robots.position[0, 0].tolist()
    over = Circle((x, y), 0.1, (1, 200, 3, 255))
    renderer = Renderer(config)
    assert close(pixel(renderer.draw(row, overlay=[over]), config, (x, y)), over.color)
    assert not close(pixel(renderer.draw(row, extras=[over]), config, (x, y)), over.color)


@pytest.mark.parametrize("align", [0.0, 0.5, 1.0])
def test_a_text_is_aligned_at_its_point(config: SimConfig, row: Floats, align: float) -> None:
    renderer = Renderer(config, 640)
    plain = renderer.draw(row)
    text = Text((0.0, 0.5), 0.05, "HHHH", (1, 200, 3, 255), align=align)
    changed = (renderer.draw(row, overlay=[text]) != plain).any(axis=(0, 2))
    columns = np.flatnonzero(changed)
    share = (320 - columns[0]) / (columns[-1] - columns[0])
    assert share == pytest.approx(align, abs=0.05)


def ground_image(config: SimConfig, width: int | None) -> Image:
    """The field with all bodies in one corner of it."""
    frame = Frame.empty(1, config.n_blue, config.n_yellow)
    aside = (-0.8 * config.field.half_length, -0.8 * config.field.half_width)
    frame.ball.position[0] = frame.robots.position[0] = aside
    return draw_image(config, frame.rows[0], width=width)


@pytest.mark.parametrize("width", [64, 321, 640, 4096])
def test_an_image_has_even_sizes_and_the_shape_of_the_scene(
    config: SimConfig, row: Floats, width: int
) -> None:
    image = draw_image(config, row, width=width)
    bounds = scene_bounds(config.field)
    assert image.dtype == np.uint8
    assert image.shape[0] % 2 == image.shape[1] % 2 == 0
    assert abs(image.shape[1] - width) <= 1
    assert image.shape[0] == pytest.approx(image.shape[1] * bounds.height / bounds.width, abs=1)


def test_each_image_is_the_callers_own(config: SimConfig, row: Floats) -> None:
    renderer = Renderer(config, 160)
    first = renderer.draw(row)
    kept = first.copy()
    first[:] = 0
    second = renderer.draw(row)
    np.testing.assert_array_equal(second, kept)
    assert second.flags.c_contiguous


def test_score_clock_names_and_caption_change_the_image(config: SimConfig, row: Floats) -> None:
    renderer = Renderer(config, 640)
    plain = renderer.draw(row)
    others = [
        renderer.draw(row, score=(1, 0)),
        renderer.draw(row, score=(0, 1)),
        renderer.draw(row, clock=61.0),
        renderer.draw(row, names=("", "a name much longer than its place on the board")),
        renderer.draw(row, caption="goal"),
    ]
    height = plain.shape[0]
    for other in others[:4]:
        assert (plain != other).any()
        np.testing.assert_array_equal(plain[height // 8 :], other[height // 8 :])
    assert (plain[height // 2] != others[4][height // 2]).any()


def test_a_referee_is_shown_on_board_floor_and_ticker(config: SimConfig, row: Floats) -> None:
    state = state_of(**PLAY)
    renderer = Renderer(config, 640, has_referee=True)
    plain = renderer.draw(row, referee=state)
    height = plain.shape[0]
    top, bottom = height // 8, height - height // 14
    assert height > Renderer(config, 640).height
    cards = renderer.draw(row, referee=state_of(**PLAY, yellow_cards=(1, 0)))
    announced = renderer.draw(row, referee=state, announcement=Words("Goal Blue", BLUE))
    kick = renderer.draw(row, referee=state_of(designated_position=(-0.3, -0.3), ball_distance=0.0))
    assert (plain[:top] != cards[:top]).any()
    np.testing.assert_array_equal(plain[top:], cards[top:])
    assert (plain[bottom:] != announced[bottom:]).any()
    np.testing.assert_array_equal(plain[:bottom], announced[:bottom])
    assert (plain[bottom:] != kick[bottom:]).any()
    assert (plain[top:bottom] != kick[top:bottom]).any()
    np.testing.assert_array_equal(plain[:top], kick[:top])
    np.testing.assert_array_equal(draw_image(config, row, referee=state, width=640), plain)


def test_a_state_is_expected_exactly_with_a_referee(config: SimConfig, row: Floats) -> None:
    with pytest.raises(ValueError, match="referee: expected a state, got None"):
        Renderer(config, 160, has_referee=True).draw(row)
    with pytest.raises(ValueError, match="referee: expected None, got RefereeState"):
        Renderer(config, 160).draw(row, referee=state_of())


def test_a_body_out_of_the_picture_is_left_out(config: SimConfig, row: Floats) -> None:
    frame = Frame(row[None].copy(), config.n_blue, config.n_yellow)
    frame.ball.position[0] = 40.0, -3e6
    frame.robots.position[0, 0] = -500.0, 0.0
    assert draw_image(config, frame.rows[0], width=160).shape[1] == 160


def test_a_renderer_survives_pickling(config: SimConfig, row: Floats) -> None:
    renderer = Renderer(config, 160)
    again = pickle.loads(pickle.dumps(renderer))
    np.testing.assert_array_equal(again.draw(row), renderer.draw(row))
    with_referee = pickle.loads(pickle.dumps(Renderer(config, 160, has_referee=True)))
    assert with_referee.has_referee
    assert with_referee.height > again.height


def test_few_renderers_are_kept(config: SimConfig, row: Floats) -> None:
    for width in range(64, 84, 2):
        draw_image(config, row, width=width)
    assert 0 < _renderer.cache_info().currsize <= 4


@pytest.mark.parametrize("width", [0, -640, WIDTHS[0] - 1, WIDTHS[1] + 1])
def test_a_width_out_of_range_is_refused(config: SimConfig, width: int) -> None:
    with pytest.raises(ValueError, match="width: expected 64 to 4096 pixels, got"):
        Renderer(config, width)


def test_drawing_needs_no_display_and_prints_nothing() -> None:
    code = """
import sys
from rsoccer import SimConfig, Simulator
import numpy as np
from rsoccer.render import draw_image
config = SimConfig()
rows = np.empty((1, config.row_size), np.float32)
Simulator(config).read(rows)
image = draw_image(config, rows[0])
import pygame
sys.exit(not (image.std() > 10 and not pygame.display.get_init()))
"""
    hidden = ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER", "PYGAME_HIDE_SUPPORT_PROMPT")
    environment = {name: value for name, value in os.environ.items() if name not in hidden}
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", code],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_a_missing_pygame_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("image", "rasterizer", "pygame_import"):
        monkeypatch.delitem(sys.modules, f"rsoccer.render.{name}", raising=False)
    monkeypatch.setitem(sys.modules, "pygame", None)
    with pytest.raises(ModuleNotFoundError, match=r"pip install 'rsoccer\[render\]'"):
        importlib.import_module("rsoccer.render.image")
