from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image as Pillow

from rsoccer import Matches
from rsoccer.arrays import Floats
from rsoccer.recording import _images, film_match, record_match
from rsoccer.registry import make_task
from rsoccer.render import Image, Renderer
from rsoccer.render.scoreboard import GOAL_PAUSE
from rsoccer.render.video import MIN_WIDTH
from tests.policies.networks import network_for

CHASE = {"all": "chase"}
SCORING_SEED = 3
"""A match in which two chasing sides score within 16 seconds."""


@dataclass
class Spy:
    """A renderer that records its arguments."""

    drawn: list[dict[str, Any]] = field(default_factory=list)
    rows: list[Floats] = field(default_factory=list)

    def draw(self, row: Floats, **arguments: Any) -> Image:  # noqa: ANN401
        self.rows.append(row.copy())
        self.drawn.append({"score": (0, 0), "clock": 0.0, "caption": "", **arguments})
        return np.full((2, 2, 3), len(self.drawn) % 256, np.uint8)


def film(seconds: float, spy: Spy) -> list[Image]:
    matches = Matches("VSSSelfPlay-v0", seed=SCORING_SEED, controllers=CHASE, autoreset="disabled")
    renderer: Any = spy
    return list(_images(matches, renderer, seconds, ("A", "B")))


def test_the_default_task_is_that_of_a_trained_policy(tmp_path: Path) -> None:
    file = tmp_path / "policy.safetensors"
    network_for(make_task("SSLPassEndurance-v1")).save(file)
    images, _ = film_match(controllers={"blue_0": f"{file}:mean"}, seconds=0.05)
    assert len(list(images)) == 3
    with pytest.raises(ValueError, match=r"chase.*SSLPassEndurance|SSLPassEndurance.*chase"):
        film_match(controllers={"blue_0": str(file), "blue_1": "chase"})


def test_goals_are_counted_over_episodes_and_the_clock_runs_on() -> None:
    spy = Spy()
    images = film(60.0, spy)
    scores = np.array([drawn["score"] for drawn in spy.drawn])
    goals = [i for i, drawn in enumerate(spy.drawn) if drawn["caption"]]
    assert len(goals) >= 2, "too few goals to show that any is kept"
    assert scores[-1].sum() == len(goals)
    assert (np.flatnonzero(np.diff(scores.sum(axis=1))) + 1).tolist() == goals
    clocks = [drawn["clock"] for drawn in spy.drawn]
    np.testing.assert_allclose(clocks, 0.025 * np.arange(2401))
    pause = round(GOAL_PAUSE / 0.025)
    assert len(images) == len(spy.drawn) + len(goals) * (pause - 1)
    assert {drawn["names"] for drawn in spy.drawn} == {("A", "B")}


def test_after_a_goal_a_new_episode_begins() -> None:
    spy = Spy()
    film(60.0, spy)
    goals = [i for i, drawn in enumerate(spy.drawn) if drawn["caption"]]
    moved = [float(np.abs(b[:2] - a[:2]).max()) for a, b in pairwise(spy.rows)]
    assert all(moved[i] > 0.1 for i in goals if i < len(moved))  # the ball is placed again


def test_a_match_shows_its_referee_and_what_has_just_happened() -> None:
    rules = {"prepare_seconds": 0.5, "max_prepare_seconds": 0.5, "stop_seconds": 0.5}
    task = make_task("VSSMatch-v0", half_seconds=1.0, halves=1, referee=rules)
    matches = Matches(task, controllers={"all": "ou"}, autoreset="disabled")
    spy = Spy()
    renderer: Any = spy
    images = list(_images(matches, renderer, 3.0, ("A", "B")))
    states = [drawn["referee"] for drawn in spy.drawn]
    assert len({state.command for state in states}) > 2
    over = [drawn["caption"] for drawn in spy.drawn if drawn["referee"].is_over]
    assert over
    assert set(over) == {"full time"}
    pause = round(GOAL_PAUSE / 0.025)
    assert len(images) == len(spy.drawn) + len(over) * (pause - 1)


def test_a_film_of_a_match_has_room_for_the_words_of_the_referee() -> None:
    def height(name: str) -> int:
        images, _ = film_match(name, {"all": "ou"}, seconds=0.05, width=96)
        return len(list(images)[-1])

    assert height("VSSMatch-v0") > height("VSSSelfPlay-v0")


@pytest.mark.parametrize("name", ["match.gif"])
def test_a_recorded_match_has_an_image_for_each_step(tmp_path: Path, name: str) -> None:
    path = record_match(tmp_path / name, controllers=CHASE, seed=1, seconds=0.5, width=96)
    assert path == tmp_path / name
    with Pillow.open(path) as video:
        assert getattr(video, "n_frames", 1) == 21
        assert video.size[0] == 96


def test_the_same_seed_records_the_same_match(tmp_path: Path) -> None:
    videos = [
        record_match(
            tmp_path / f"{i}.gif", controllers={"all": "ou"}, seed=seed, seconds=0.3, width=96
        ).read_bytes()
        for i, seed in enumerate((5, 5, 6))
    ]
    assert videos[0] == videos[1] != videos[2]


def test_the_default_width_of_a_video_is_readable() -> None:
    images, fps = film_match(controllers=CHASE, seconds=0.1)
    assert next(images).shape[1] == MIN_WIDTH
    assert fps == pytest.approx(40.0)


def test_a_robot_without_a_policy_is_named(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"controllers: expected a policy .*'yellow_0'"):
        record_match(tmp_path / "a.mp4", controllers={"blue": "zero"})
    assert list(tmp_path.iterdir()) == []


def test_controllers_that_are_no_mapping_are_named(tmp_path: Path) -> None:
    with pytest.raises(TypeError, match=r"controllers: expected a mapping.*, got \['ou'\]"):
        record_match(tmp_path / "a.mp4", controllers=["ou"])  # type: ignore[arg-type]
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("seconds", [0.0, -3.0, float("nan"), float("inf")])
def test_a_duration_that_is_not_positive_is_refused(tmp_path: Path, seconds: float) -> None:
    with pytest.raises(ValueError, match="seconds: expected a positive number, got"):
        record_match(tmp_path / "a.mp4", controllers=CHASE, seconds=seconds)


def test_the_first_image_shows_the_start() -> None:
    matches = Matches("VSSSelfPlay-v0", seed=2, controllers=CHASE, autoreset="disabled")
    renderer = Renderer(matches.task.config, 96)
    first = next(_images(matches, renderer, 1.0, ("A", "B")))
    np.testing.assert_array_equal(first, renderer.draw(matches.frame.rows[0], names=("A", "B")))
