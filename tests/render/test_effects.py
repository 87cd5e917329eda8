import numpy as np
import pytest

from rsoccer import Matches, SimConfig, make_task
from rsoccer.arrays import Floats
from rsoccer.frame import Frame
from rsoccer.render import palette
from rsoccer.render.effects import FLASH_TIME, STREAK_TIME, Effects
from rsoccer.render.shapes import Arc, Line, Polygon, Shape

CONFIG = SimConfig("ssl_b", 2, 1)
STEP = CONFIG.time_step


def row_of(x: float, speed: float, *, holder: int | None = None) -> Floats:
    """A ball on the x axis; robot `holder` is behind it, faces it and has it in the mouth."""
    frame = Frame.empty(1, 2, 1)
    frame.robots.position[0] = [(0.0, 0.0), (-2.0, 1.0), (2.0, 1.0)]
    frame.ball.position[0] = x, 0.0
    frame.ball.velocity[0] = speed, 0.0
    if holder is not None:
        frame.robots.infrared[0, holder] = 1.0
    row: Floats = frame.rows[0]
    return row


def kicked(effects: Effects, steps: int) -> tuple[Shape, ...]:
    """Effects some steps after a kick by blue_0 with 4 m/s."""
    effects.update(row_of(0.1, 0.0, holder=0), 0.0)
    shapes: tuple[Shape, ...] = ()
    for step in range(1, steps + 1):
        shapes = effects.update(row_of(0.1 + 4.0 * step * STEP, 4.0), step * STEP)
    return shapes


def test_a_kick_has_a_flash_at_the_mouth_and_a_streak_up_to_the_ball() -> None:
    shapes = kicked(Effects(CONFIG), 3)
    rays = [s for s in shapes if isinstance(s, Line)]
    bands = [s for s in shapes if isinstance(s, Polygon)]
    assert len(rays) == 4
    assert all(0.1 < ray.start[0] < ray.end[0] < 0.6 for ray in rays)
    xs = [x for band in bands for x, _ in band.points]
    assert (min(xs), max(xs)) == pytest.approx((0.1, 0.1 + 12.0 * STEP))
    assert {s.color[:3] for s in shapes} == {palette.KICK[:3]}


def test_the_flash_ends_before_the_streak_and_both_end() -> None:
    after_flash = kicked(Effects(CONFIG), round(FLASH_TIME / STEP) + 2)
    assert after_flash
    assert not any(isinstance(s, Line) for s in after_flash)
    assert kicked(Effects(CONFIG), round(STREAK_TIME / STEP) + 3) == ()


def test_a_ball_that_speeds_up_away_from_all_robots_was_not_kicked() -> None:
    effects = Effects(CONFIG)
    effects.update(row_of(0.5, 0.0), 0.0)
    assert effects.update(row_of(0.6, 4.0), STEP) == ()


def test_a_robot_without_a_kicker_does_not_kick() -> None:
    config = SimConfig("vss_3v3", 2, 1)
    effects = Effects(config)
    effects.update(row_of(0.1, 0.0, holder=0), 0.0)
    assert effects.update(row_of(0.2, 4.0), STEP) == ()


@pytest.mark.parametrize("clock", [0.0, -1.0, 5.0], ids=["same time", "earlier", "a gap"])
def test_another_episode_begins_anew(clock: float) -> None:
    effects = Effects(CONFIG)
    effects.update(row_of(0.1, 0.0, holder=0), 0.0)
    assert effects.update(row_of(0.2, 4.0), clock) == ()
    assert effects.update(row_of(0.3, 4.0), clock + STEP) == ()


def test_the_same_row_again_gives_the_same_effects() -> None:
    effects = Effects(CONFIG)
    first = kicked(effects, 3)
    assert first
    row = row_of(0.1 + 12.0 * STEP, 4.0)
    assert effects.update(row, 3 * STEP) == first
    effects.clear()
    assert effects.update(row, 3 * STEP) == ()


@pytest.mark.parametrize(("dribbler", "held"), [(0.0, True), (1.0, False), (1.0, True)])
def test_dribbling_is_marked_where_the_dribbler_turns_and_has_the_ball(
    dribbler: float, held: bool
) -> None:
    commands = np.zeros((3, len(CONFIG.command_columns)), np.float32)
    commands[0, list(CONFIG.command_columns).index("dribbler")] = dribbler
    row = row_of(0.1, 0.0, holder=0 if held else None)
    shapes = Effects(CONFIG).update(row, 0.0, commands)
    assert len(shapes) == (1 if dribbler and held else 0)
    for shape in shapes:
        assert isinstance(shape, Arc)
        assert shape.center == pytest.approx((0.1, 0.0))
        assert shape.color == palette.DRIBBLER_LIT


def test_kicks_of_real_matches_are_found() -> None:
    task = make_task("SSLPassEndurance-v1")
    matches = Matches(task, controllers={"all": "passer"}, autoreset="disabled")
    matches.reset()
    effects, kicks, marks = Effects(task.config), 0, 0
    actions = np.zeros((1, 0, matches.action_size), np.float32)
    for step in range(120):
        matches.step(actions)
        commands = matches.play.commands[0]
        shapes = effects.update(matches.frame.rows[0], step * task.config.time_step, commands)
        kicks += any(s.color[:3] == palette.KICK[:3] for s in shapes)
        marks += any(isinstance(s, Arc) for s in shapes)
    assert kicks > 5
    assert marks > 5
