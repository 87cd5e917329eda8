"""Acceptance tests of the physics through Python, and of the page that shows them."""

import math
import re

import numpy as np
import pytest

from benches.scenarios import ENGINES
from rsoccer._core import BallModel, Field, RobotModel, SimConfig
from tools.physics import cited
from tools.physics.__main__ import PICTURES
from tools.physics.check import EXACT, Check, Criterion, Tolerance, absolute, percent
from tools.physics.closed_form import StraightKick, Surface, bounce, floor
from tools.physics.dribbler import BALL, BAR_SPEED, GRIP, max_angular_velocity
from tools.physics.kicker import front_offset
from tools.physics.page import PAGE, format_value, pages_equal, render_page
from tools.physics.scene import contact_engine, make_config
from tools.physics.tire_friction import Motion, motion_after
from tools.physics.topics import MODULES, TOPICS, all_checks, checks, engines_of

TEXT = PAGE.read_text()

# Sliding distance (m), speed at 3 m and 6 m (m/s), stopping distance (m).
TABULATED = {
    ("ssl_tigers", 6.5): (3.9, 4.92, 4.21, 40),
    ("ssl_tigers", 4.0): (1.48, 2.51, 2.18, 15.2),
    ("ssl_tigers", 2.0): (0.37, 0.64, None, 3.8),
    ("ssl_erforce", 6.5): (3.9, 5.05, 4.39, 35),
    ("ssl_erforce", 4.0): (1.46, 2.61, 2.20, 13.3),
    ("grsim", 6.5): (1.05, 4.24, 3.71, 15.8),
    ("grsim", 4.0): (0.40, 2.05, None, 6.0),
    ("grsim", 2.0): (0.10, None, None, 1.5),
}


MEASURED = [(topic, engine) for topic in TOPICS for engine in engines_of(topic)]


@pytest.mark.parametrize(("topic", "engine"), MEASURED)
def test_every_number_is_within_its_tolerance(topic: str, engine: str) -> None:
    found = checks(topic, engine)
    assert len(found) >= 10
    assert not [str(check) for check in found if not check.passed]


@pytest.mark.parametrize("module", MODULES, ids=lambda module: module.TOPIC)
def test_every_criterion_of_a_topic_is_measured(module: object) -> None:
    criteria = [value for value in vars(module).values() if isinstance(value, Criterion)]
    topic = criteria[0].topic
    assert {criterion.quantity for criterion in criteria} == {
        check.quantity for check in checks(topic)
    }
    assert len({criterion.quantity for criterion in criteria}) == len(criteria), (
        "quantities identify criteria"
    )


def test_scenes_have_the_contact_engine_of_their_measurement() -> None:
    assert make_config("ssl_b", 1, 0) == SimConfig("ssl_b", 1, 0)
    for engine in ENGINES:
        with contact_engine(engine):
            assert make_config("ssl_b", 1, 0) == SimConfig("ssl_b", 1, 0, engine=engine)
    assert make_config("ssl_b", 1, 0).engine == SimConfig().engine
    assert {engine for engine, _ in all_checks()} == set(ENGINES)


def test_a_deviation_above_the_tolerance_fails() -> None:
    def off(tolerance: Tolerance, reference: float, measured: float) -> Check:
        return Criterion("topic", "what", "m", tolerance)("case", reference, measured)

    assert off(percent(3), 2.0, 2.05).passed
    assert not off(percent(3), 2.0, 2.07).passed
    assert off(absolute(0.01), 0.3, 0.309).passed
    assert not off(absolute(0.01), 0.3, 0.311).passed
    assert off(EXACT, 6, 6).passed
    assert not off(EXACT, 6, 5).passed
    assert off(percent(1), 0.0, 0.0).passed
    assert not off(percent(1), 0.0, 1e-6).passed, "a relative tolerance of zero is zero"
    assert not off(absolute(0.01), 0.3, math.nan).passed
    assert not off(EXACT, 0.0, math.nan).passed


@pytest.mark.parametrize(("name", "kick"), TABULATED)
def test_the_closed_form_gives_the_tabulated_rows(name: str, kick: float) -> None:
    form = StraightKick(cited.BALLS[name], kick)
    slide, at_3, at_6, stop = TABULATED[name, kick]
    assert form.slide_distance == pytest.approx(slide, rel=0.02)
    assert form.stop_distance == pytest.approx(stop, rel=0.01)
    for distance, expected in ((3.0, at_3), (6.0, at_6)):
        speed = form.speed_at(distance)
        assert speed == (None if expected is None else pytest.approx(expected, abs=0.006))


def test_both_closed_forms_of_the_floor_agree() -> None:
    ball = cited.BALLS["ssl_tigers"]
    for time in (0.2, 1.0, 5.0):
        displacement, velocity, _ = floor(ball, np.array([4.0, 0, 0]), np.zeros(3), time)
        assert (displacement[0], velocity[0]) == pytest.approx(StraightKick(ball, 4.0).after(time))


def test_a_steep_bounce_sticks_and_a_flat_one_slips() -> None:
    ball, wall = cited.BALLS["ssl_tigers"], Surface(0.3, 0.35)
    normal = np.array([0.0, -1.0, 0.0])
    steep, spin = bounce(ball, wall, np.array([0.5, 4.0, 0.0]), np.zeros(3), normal)
    assert steep == pytest.approx([0.5 * 5 / 7, -1.2, 0.0])
    assert spin[2] * ball.radius == pytest.approx(0.5 * 5 / 7), "the ball rolls along the wall"
    flat, _ = bounce(ball, wall, np.array([4.0, 1.0, 0.0]), np.zeros(3), normal)
    assert flat == pytest.approx([4.0 - 0.35 * 1.3, -0.3, 0.0])


def test_sliding_tires_agree_with_closed_forms() -> None:
    robot = cited.VSS_ROBOTS["vss_440rpm"]
    ahead = motion_after(robot, 1.0, Motion(), 0.1)
    assert ahead.forward == pytest.approx(robot.longitudinal_grip * 0.1, rel=1e-3), "acceleration"
    assert motion_after(robot, 1.0, Motion(), 0.3).forward == pytest.approx(1.0), (
        "then the wheels roll"
    )
    aside = motion_after(robot, 0.0, Motion(left=1.0), 0.05)
    assert aside.left == pytest.approx(1.0 - robot.lateral_grip * 0.05, rel=1e-3)
    inertia = robot.side_length**2 / 6
    turned = motion_after(robot, 0.0, Motion(angular_velocity=20.0), 0.05)
    lost = robot.longitudinal_grip * robot.track_width / 2 / inertia * 0.05
    assert turned.angular_velocity == pytest.approx(20.0 - lost, rel=1e-3)


def test_maximum_angular_velocity_balances_grip_floor_and_centripetal_force() -> None:
    turn = max_angular_velocity()
    slip = math.hypot(turn * front_offset(), BAR_SPEED)
    floor = BALL.mass * BALL.sliding_deceleration
    along = floor * turn * front_offset() / slip
    across = BALL.mass * turn**2 * front_offset() - floor * BAR_SPEED / slip
    assert math.hypot(along, across) == pytest.approx(GRIP)


def test_every_preset_is_cited() -> None:
    assert set(BallModel.PRESETS) == set(cited.BALLS)
    robots = (cited.SSL_ROBOTS, cited.SSL_MIMICS, cited.VSS_ROBOTS, cited.VSS_MIMICS)
    assert sorted(RobotModel.PRESETS) == sorted(name for each in robots for name in each)
    assert set(Field.PRESETS) == set(cited.FIELDS)


def test_the_page_shows_the_current_measurements_of_every_topic() -> None:
    parts = re.findall(r"<!-- begin:(\w+) -->", TEXT)
    assert set(TOPICS) <= set(parts)
    assert pages_equal(TEXT, render_page(TEXT)), "docs/physics.md is stale: run `make physics`"


def test_a_stale_page_is_detected() -> None:
    row = "| top speed | 2 | `vss_440rpm` | 1.198 m/s | 1.198 m/s |"
    assert row in TEXT
    assert pages_equal(row, row.replace("1.198 m/s |", "1.199 m/s |")), (
        "another processor's last digit"
    )
    assert not pages_equal(TEXT, TEXT.replace(row, row.replace("1.198", "1.190")))
    assert not pages_equal("| 3 / 0.26 |", "| 3 / 0.27 |"), "presets are exact"
    assert not pages_equal(TEXT, TEXT.replace("top speed", "maximum speed"))


def test_numbers_show_their_significant_digits() -> None:
    assert format_value(1.19799, percent(1)) == "1.198"
    assert format_value(-1e-7, absolute(0.01)) == "0.000"
    assert format_value(0.30001, absolute(0.01)) == "0.300"
    assert format_value(1000.0, EXACT) == "1000"


def test_the_page_shows_every_picture_and_all_are_small() -> None:
    shown_pictures = re.findall(r"\]\((physics_\w+\.png)\)", TEXT)
    assert sorted(shown_pictures) == sorted(f"physics_{name}.png" for name in PICTURES)
    for name in shown_pictures:
        assert 10_000 < (PAGE.parent / name).stat().st_size < 150_000


@pytest.mark.parametrize("name", PICTURES)
def test_pictures_draw_finite_lines(name: str) -> None:
    lines = [line for axes in PICTURES[name]().axes for line in axes.get_lines()]
    assert len(lines) >= 3
    for line in lines:
        assert np.isfinite(np.asarray(line.get_xydata())).all()
