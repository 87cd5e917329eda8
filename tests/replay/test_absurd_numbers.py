"""Replays with numbers that no match has: they are drawn, or refused by name."""

import json
from collections.abc import Callable
from dataclasses import replace
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rsoccer import SimConfig
from rsoccer.replay import Replay, ReplayError
from rsoccer.replay.page import to_html
from tests.replay.browser import show
from tests.replay.conftest import sensed_vss, ssl, vss

VALUES = [1e4, 1e9, 1e30, -3e38]
RECORDED = pytest.mark.parametrize(
    "recorded", [vss, ssl, sensed_vss], ids=["VSSS", "SSL", "senses"]
)


def absurd(replay: Replay, value: float) -> Replay:
    """The replay with ball and robots far away, fast and high."""
    changed = replace(replay, rows=replay.rows.copy())
    ball, robots = changed.frame.ball, changed.frame.robots
    ball.position[::2] = ball.velocity[:] = value
    ball.height[:] = abs(value)
    robots.position[:, 0] = robots.velocity[:, 1] = value
    robots.position[:, 1, 0] = -value
    assert np.abs(changed.rows).max() >= abs(value) / 2
    if replay.sensed is None:
        return changed
    far = np.full_like(replay.sensed.robots, value)
    return replace(changed, sensed=replace(replay.sensed, ball=far[:, 0], robots=far))


@RECORDED
@pytest.mark.parametrize("value", VALUES)
def test_far_bodies_are_drawn(recorded: Callable[[], Replay], value: float) -> None:
    pytest.importorskip("pygame")
    from rsoccer.replay.film import film_replay

    images = list(islice(film_replay(absurd(recorded(), value), 96)[0], 8))
    near = next(film_replay(recorded(), 96)[0])
    assert len(images) == 8
    assert (images[0] != near).any()
    assert (images[0] == near).mean() > 0.5, "the field is not in the image"


@RECORDED
def test_the_page_draws_far_bodies(
    recorded: Callable[[], Replay], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from rsoccer.replay import quantized, sensed_poses

    wide = dict.fromkeys(("x", "y", "z", "v_x", "v_y", "v_z"), 1e25)
    monkeypatch.setattr(quantized, "STEPS", quantized.STEPS | wide)
    monkeypatch.setattr(sensed_poses, "POSITION_STEP", 1e25)
    replay = absurd(recorded(), 1e30)
    large = {name: np.full_like(term, 1e32) for name, term in replay.terms.items()}
    replay = replace(replay, terms=large)
    assert np.abs(Replay.from_bytes(replay.to_bytes(snapshots=False)).rows).max() > 1e29
    script = """
      player.pause();
      player.select(0);
      player.zoom();
      for (let frame = 0; frame < 12; frame++) { player.seek(frame); player.draw(); }
      player.play();
      await wait(300);
      return [player.drawn, document.getElementById("message").hidden];
    """
    shown = show(to_html(replay), script, tmp_path)
    assert shown.console == []
    drawn, without_message = shown.result
    assert drawn > 5
    assert without_message


def test_far_corners_do_not_change_what_is_near() -> None:
    pygame = pytest.importorskip("pygame")
    from rsoccer.render.rasterizer import Camera, Rasterizer
    from rsoccer.render.shapes import Polygon

    def drawn(far: float) -> bytes:
        canvas = pygame.Surface((40, 30), pygame.SRCALPHA)
        corners = ((0.1, 0.05), (0.1, -far), (-far, -far), (-far, 0.05))
        Rasterizer(Camera(100.0, -0.2, 0.15)).draw(canvas, [Polygon(corners, (255, 0, 0, 255))])
        content: bytes = pygame.image.tobytes(canvas, "RGBA")
        return content

    near = drawn(1.0)
    assert 0 < sum(near[3::4]) < 255 * 40 * 30
    for far in (1e5, 1e9, 1e30, 1e300):
        assert drawn(far) == near


def test_a_number_that_is_not_finite_is_refused() -> None:
    replay = absurd(vss(), 1.0)
    replay.rows[3, 0] = np.nan
    with pytest.raises(ReplayError, match="rows: expected finite numbers"):
        replay.to_bytes()


CONFIGS: list[tuple[str, dict[str, Any], str]] = [
    ("field", {"length": 1e6}, "field length of 0.1 to 1000, got 1e+06"),
    ("field", {"width": 1e30}, "field width of 0.1 to 1000"),
    ("field", {"length": 1e-3, "corner_leg": 0.0}, "field length"),
    ("field", {"touch_line_margin": 1e9}, "field touch_line_margin"),
    ("", {"time_step": 1e-5, "tick": 1e-5}, "time_step of at least 0.0001 s"),
]


@pytest.mark.parametrize(("part", "changes", "message"), CONFIGS)
def test_sizes_that_no_image_shows_are_refused(
    part: str, changes: dict[str, Any], message: str
) -> None:
    content = json.loads(vss().config.to_json())
    (content[part] if part else content).update(changes)
    config = SimConfig.from_json(json.dumps(content))  # the simulator takes them
    with pytest.raises(ReplayError, match=message.replace("+", r"\+")):
        Replay.from_bytes(replace(vss(), config=config).to_bytes(snapshots=False))


@pytest.mark.parametrize("part", ["blue", "field"])
def test_large_robots_and_shallow_goals_are_drawn(part: str) -> None:
    pytest.importorskip("pygame")
    from rsoccer.replay.film import film_replay

    content = json.loads(vss().config.to_json())
    if part == "blue":
        content["blue"][0]["body"]["Square"]["side_length"] = 1e30
    else:
        content["field"]["goal_depth"] = 1e-30
    replay = replace(vss(), config=SimConfig.from_json(json.dumps(content)))
    assert len(list(islice(film_replay(replay, 96)[0], 3))) == 3
