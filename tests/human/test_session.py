from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("pygame")

import pygame

from rsoccer import make_task
from rsoccer._core import Field
from rsoccer.human import gamepad, screen
from rsoccer.human.controls import Controls
from rsoccer.human.devices import Devices, SdlGamepad
from rsoccer.human.gamepad import Gamepad
from rsoccer.human.session import SPEEDS, Session
from rsoccer.human.teams import team_controllers
from rsoccer.render.shapes import Polygon, Text
from rsoccer.render.words import NOTHING

STEP = 0.025


@pytest.fixture(autouse=True)
def _headless(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """SDL's dummy driver: windows without a screen."""
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    yield
    pygame.display.quit()


def session_of(
    name: str = "VSSSelfPlay-v0", robot: str | None = None, **options: object
) -> Session:
    """A session against robots at rest, with a small picture."""
    task = make_task(name, **options)
    teams = team_controllers(task, robot or task.agents[0], "zero")
    return Session(task, teams, robot, width=128)


def press(session: Session, *keys: str) -> None:
    """Press and release keys, then let the session read them without playing."""
    for key in keys:
        session.devices.keyboard.press(key)
        session.devices.keyboard.release(key)
    session.advance(0.0)


def test_the_match_waits_for_the_first_input_and_then_plays_in_real_time() -> None:
    session = session_of()
    session.advance(1.0)
    assert session.shows_help
    assert session.clock == 0.0
    session.devices.keyboard.press("w")
    for _ in range(10):
        session.advance(STEP)
    assert not session.shows_help
    assert session.clock == pytest.approx(10 * STEP)
    assert session.matches.play.actions[0, 0].tolist() == [1.0, 1.0]


def test_keys_change_robot_speed_pause_and_help() -> None:
    session = session_of("SSLSelfPlay-v0", "yellow_0")
    press(session, "2")
    assert session.driver.robot == "yellow_2"
    press(session, "tab", "f")
    assert (session.driver.robot, session.driver.frame) == ("blue_0", "robot")
    press(session, "+", "+", "+")
    assert session.speed == SPEEDS[-1]
    press(session, *"------")
    assert session.speed == SPEEDS[0]
    press(session, "p")
    session.advance(1.0)
    assert session.paused
    assert session.clock == 0.0
    press(session, "n")
    assert session.clock == pytest.approx(STEP)
    press(session, "p", "n")
    assert session.clock == pytest.approx(STEP)
    press(session, "h")
    assert session.shows_help
    press(session, "h")
    assert not session.shows_help


def test_two_digits_choose_a_robot_from_ten_on() -> None:
    session = session_of("SSLSelfPlay-v0", field="ssl_a", n_blue=11, n_yellow=11)

    def choose(*digits: str, pause: float = 0.1) -> str:
        session.advance(10.0)
        for digit in digits:
            session.devices.keyboard.press(digit)
            session.devices.keyboard.release(digit)
            session.advance(pause)
        return session.driver.robot

    session.paused = True
    assert choose("1") == "blue_1"
    assert choose("1", "0") == "blue_10"
    assert choose("1", "0", "0") == "blue_0"
    assert choose("1", "2") == "blue_2"  # there is no robot 12
    assert choose("1", "0", pause=1.0) == "blue_0"
    assert choose("tab") == "blue_1"


@pytest.mark.parametrize(("speed", "steps"), [(0.5, 10), (1.0, 20), (4.0, 80)])
def test_speed_is_a_factor_on_the_steps(speed: float, steps: int) -> None:
    session = session_of()
    session.speed = speed
    session.devices.keyboard.press("w")
    for _ in range(20):
        session.advance(STEP)
    assert session.clock == pytest.approx(steps * STEP)


def test_an_episode_that_ends_is_shown_for_a_moment_and_the_next_one_begins() -> None:
    session = session_of(max_steps=3)
    press(session, "tab")
    for _ in range(3):
        session.advance(STEP)
    assert session.matches.done[0]
    before = session.matches.frame.rows.copy()
    session.advance(0.5)
    np.testing.assert_array_equal(session.matches.frame.rows, before)
    session.advance(0.5)
    assert not session.matches.done[0]
    assert session.score == (0, 0)
    assert (session.matches.frame.rows != before).any()


@pytest.mark.parametrize(("side", "score"), [(1.0, (1, 0)), (-1.0, (0, 1))])
def test_goals_are_counted_over_episodes(side: float, score: tuple[int, int]) -> None:
    session = session_of()
    press(session, "tab")
    for goals in (1, 2):
        frame = session.matches.frame
        rows = frame.rows.copy()
        ball = type(frame)(rows, 3, 3).ball
        ball.position[0] = side * 0.7, 0.0
        ball.velocity[0] = side * 3.0, 0.0
        robots = type(frame)(rows, 3, 3).robots
        robots.position[0, :, 0] = 0.0
        robots.position[0, :, 1] = np.linspace(-0.5, 0.5, 6)
        session.matches.reset(rows=rows)
        while not session.matches.done[0]:
            session.advance(STEP)
        assert session.score == (goals * score[0], goals * score[1])
        session.advance(1.0)


def test_reset_begins_a_new_episode_and_keeps_the_score() -> None:
    session = session_of()
    session.score = (2, 1)
    before = session.matches.frame.rows.copy()
    press(session, "r")
    assert (session.matches.frame.rows != before).any()
    assert session.score == (2, 1)


def test_events_of_the_window_drive_the_robot_until_escape() -> None:
    session = session_of("SSLSelfPlay-v0")
    session.window.show(session.image())
    window = session.window._window
    for kind, key in (
        (pygame.KEYDOWN, pygame.K_UP),
        (pygame.KEYDOWN, pygame.K_SPACE),
        (pygame.KEYUP, pygame.K_SPACE),
        (pygame.KEYDOWN, pygame.K_LSHIFT),
        (pygame.KEYDOWN, pygame.K_KP1),
    ):
        pygame.event.post(pygame.Event(kind, key=key, window=window))
    session.run(0.2)
    assert session.driver.controls == Controls(up=1.0, slow=True)
    assert session.driver.robot == "blue_1"
    assert session.clock >= 0.15
    assert session.window.closed


def test_a_window_that_loses_the_focus_releases_all_keys() -> None:
    devices = Devices()
    devices.handle_event(pygame.Event(pygame.KEYDOWN, key=pygame.K_w))
    assert devices.controls().up == 1.0
    devices.handle_event(pygame.Event(pygame.WINDOWFOCUSLOST))
    assert devices.controls() == Controls()


@pytest.mark.parametrize("seconds", [0.0, -1.0, float("nan")])
def test_a_duration_that_is_not_positive_is_refused(seconds: float) -> None:
    session = session_of()
    with pytest.raises(ValueError, match=f"seconds: expected a positive number, got {seconds}"):
        session.run(seconds)


def test_a_closed_window_ends_the_session() -> None:
    session = session_of()
    session.window.show(session.image())
    pygame.event.post(
        pygame.Event(pygame.KEYDOWN, key=pygame.K_ESCAPE, window=session.window._window)
    )
    session.run()
    assert session.window.closed


class FakeController:
    """A controller of SDL: axes are 16-bit integers."""

    def get_axis(self, axis: int) -> int:
        return {gamepad.LEFT_Y: -32767, gamepad.RIGHT_TRIGGER: 32767}.get(axis, 0)

    def get_button(self, button: int) -> int:
        return int(button == gamepad.RIGHT_SHOULDER)


def test_a_gamepad_drives_beside_the_keyboard() -> None:
    devices = Devices(Gamepad(SdlGamepad(FakeController())))
    task = make_task("SSLSelfPlay-v0")
    session = Session(task, team_controllers(task, "blue_0"), width=128, devices=devices)
    devices.keyboard.press("d")
    session.advance(STEP)
    assert session.driver.controls == Controls(right=1.0, up=1.0, kick=1.0)
    assert session.driver.robot == "blue_1"
    devices.find_gamepad()
    assert devices.gamepad is not None


def test_without_a_gamepad_there_is_the_keyboard() -> None:
    devices = Devices()
    devices.handle_event(pygame.Event(pygame.CONTROLLERDEVICEADDED))
    assert devices.gamepad is None
    assert devices.controls() == Controls()


def test_a_match_announces_what_the_referee_decides() -> None:
    rules = {"prepare_seconds": 0.2, "max_prepare_seconds": 0.2, "no_progress_seconds": 0.5}
    session = session_of("VSSMatch-v0", referee=rules)
    for _ in range(400):
        session.step()
        if session._announcement.text:
            break
    assert session._announcement.text
    announced = session.image()
    session._announcement = NOTHING
    assert (session.image() != announced).any()


def test_the_picture_shows_what_robots_know() -> None:
    task = make_task("VSSSelfPlay-v0")
    teams = team_controllers(task, "blue_0", "zero")
    plain, sensed = (
        Session(task, teams, width=128, sensing=sensing).image() for sensing in (None, "vsss")
    )
    assert (plain != sensed).any()


@pytest.mark.parametrize("name", ["VSSSelfPlay-v0", "SSLSelfPlay-v0", "SSLMatch-v0"])
def test_the_picture_shows_help_status_and_the_driven_robot(name: str) -> None:
    task = make_task(name)
    session = Session(task, team_controllers(task, "blue_0"))
    pictures = [session.image()]
    press(session, "x")
    pictures.append(session.image())
    press(session, "tab")
    pictures.append(session.image())
    press(session, "p")
    pictures.append(session.image())
    for i, picture in enumerate(pictures):
        assert not any((picture == other).all() for other in pictures[:i])


@pytest.mark.parametrize("lines", [screen.OMNI_HELP, screen.DIFFERENTIAL_HELP])
@pytest.mark.parametrize("name", Field.PRESETS)
def test_the_help_fits_on_the_field(name: str, lines: tuple[tuple[str, str], ...]) -> None:
    field = Field(name)
    panel, *texts = screen.help_shapes(field, lines)
    assert [t.text for t in texts if isinstance(t, Text)] == [*zip_columns(lines)]
    assert isinstance(panel, Polygon)
    assert max(x for x, _ in panel.points) < field.half_length
    assert max(y for _, y in panel.points) < field.half_width


def zip_columns(lines: tuple[tuple[str, str], ...]) -> Iterator[str]:
    """All keys, then all meanings."""
    for column in zip(*lines, strict=True):
        yield from column


def test_a_speed_that_is_not_positive_is_refused() -> None:
    task = make_task("VSS-v0")
    with pytest.raises(ValueError, match=r"speed: expected a positive number, got 0\.0"):
        Session(task, team_controllers(task, "blue_0"), speed=0.0)


def test_the_page_lists_the_keys_of_the_help() -> None:
    page = (Path(__file__).parents[2] / "docs" / "tutorials" / "play.md").read_text()
    for keys, meaning in {*screen.OMNI_HELP, *screen.DIFFERENTIAL_HELP}:
        assert any(keys in line and meaning in line for line in page.splitlines()), keys
