"""Columns derived from two frames against those of the simulator, which knows every tick."""

from typing import NamedTuple

import numpy as np
import pytest

from rsoccer import Frame, Matches, derived
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.controllers import Controllers
from rsoccer.simulator_interface import Stepper

SCENES = [
    ("VSSSelfPlay-v0", {"all": "chase"}),
    ("VSSSelfPlay-v0", {"all": "ou"}),
    ("SSLSelfPlay-v0", {"all": "strike"}),
    ("SSLPassEnduranceMulti-v1", {"all": "passer"}),
]


class Pair(NamedTuple):
    """Two consecutive frames of n worlds."""

    last: Frame
    frame: Frame


class Watching:
    """The package's simulator, whose steps are kept as pairs of frames."""

    def __init__(self, matches: Matches) -> None:
        self._inner: Stepper = matches._simulator
        self._config = matches.task.config
        self.pairs: list[Pair] = []
        self._matches = matches
        matches._simulator = self

    def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> None:
        last = self._matches.frame.copy()
        self._inner.step(commands, out, active)
        frame = Frame(out.copy(), self._config.n_blue, self._config.n_yellow)
        self.pairs.append(Pair(last, frame))


class Play(NamedTuple):
    """A scene that was played."""

    matches: Matches
    pair: Pair
    """All of its steps, one after the other."""


@pytest.fixture(
    scope="module", params=SCENES, ids=lambda scene: "-".join([scene[0], *scene[1].values()])
)
def play(request: pytest.FixtureRequest) -> Play:
    name, controllers = request.param
    given: Controllers = controllers
    matches = Matches(name, 12, seed=1, controllers=given)
    watching = Watching(matches)
    matches.reset()
    for _ in range(200):
        matches.step(np.zeros((12, 0, matches.action_size), np.float32))
    config = matches.task.config
    last, frame = (
        Frame(np.concatenate([part.rows for part in parts]), config.n_blue, config.n_yellow)
        for parts in zip(*watching.pairs, strict=True)
    )
    return Play(matches, Pair(last, frame))


def agreement(found: Array, true: Array) -> tuple[float, float]:
    """Precision and recall of what was found."""
    both = (found & true).sum()
    return both / max(found.sum(), 1), both / max(true.sum(), 1)


def test_crossings_and_beams_are_exact(play: Play) -> None:
    config, (last, frame) = play.matches.task.config, play.pair
    crossing = derived.crossing(last, frame, config.field)
    assert (crossing.line == frame.ball.crossed).all()
    crossed = crossing.line > 0
    at = frame.ball.crossed_at[crossed]
    np.testing.assert_allclose(crossing.at[crossed][:, :2], at, atol=0.02)
    assert (derived.beam_broken(frame, config) == (frame.robots.infrared > 0.5)).all()


def test_touches_of_the_ball_agree_but_for_grazes_within_a_step(play: Play) -> None:
    config, (last, frame) = play.matches.task.config, play.pair
    touched = derived.ball_touches(last, frame, config, config.time_step)
    true = frame.robots.touched_ball > 0.5
    # A robot that creeps into a ball in its mouth touches it in some steps, as poses do not show.
    assert (touched == true).mean() >= 0.98
    if true.sum() > 100:
        precision, recall = agreement(touched, true)
        assert precision >= 0.85
        assert recall >= 0.85


def test_the_last_touch_agrees_where_one_robot_has_the_ball(play: Play) -> None:
    config, (last, frame) = play.matches.task.config, play.pair
    touched = derived.ball_touches(last, frame, config, config.time_step)
    robot = derived.last_touch(last.ball.last_touch, touched, frame, config)
    single = frame.robots.touched_ball.sum(axis=1) <= 1.0
    assert (robot == frame.ball.last_touch)[single].mean() >= 0.99


def test_time_speed_and_height_since_a_touch_agree_but_for_the_rest_of_its_step(play: Play) -> None:
    config, (last, frame) = play.matches.task.config, play.pair
    touched = frame.robots.touched_ball > 0.5
    found = derived.since_touch(last, frame, touched, config.time_step)
    ball, anew = frame.ball, touched.any(axis=1)
    step = config.time_step + 1e-3
    assert (np.abs(found.seconds - ball.seconds_since_touch) < step).all()
    assert (found.seconds[anew] <= ball.seconds_since_touch[anew]).all()
    slower = ball.speed_after_touch - found.speed
    assert np.median(np.abs(slower[anew])) < 0.05
    assert (slower[~anew] == 0.0).all()
    # The ball's height in the step is that of its end, or of the moment of a touch or a peak.
    assert (found.height <= ball.height_since_touch + 1e-6).all()
    assert np.quantile(ball.height_since_touch - found.height, 0.99) < 0.05


def test_contacts_of_opponents_and_their_speeds_agree(play: Play) -> None:
    config, (last, frame) = play.matches.task.config, play.pair
    found = derived.collisions(last, frame, config, config.time_step)
    true = frame.robots.touched_opponent > 0.5
    # Robots at rest side by side: whether they press on each other cannot be seen.
    assert (found.opponent == true).mean() >= 0.98
    if true.sum() > 100:
        assert agreement(found.opponent, true)[1] >= 0.85
    speed = frame.robots.collision_speed
    hard = speed > 0.3
    if hard.sum() > 100:
        assert (found.speed[hard] > 0.0).mean() >= 0.8
        assert np.median(np.abs(found.speed - speed)[hard]) < 0.15
        assert np.corrcoef(found.speed[hard], speed[hard])[0, 1] > 0.5
    assert (found.speed[speed == 0.0] < 0.3).mean() >= 0.999


def test_velocities_are_the_means_of_the_step(play: Play) -> None:
    config, (last, frame) = play.matches.task.config, play.pair
    seen = frame.copy()
    seen.ball.velocity[:] = seen.robots.velocity[:] = seen.robots.angular_velocity[:] = np.nan
    derived.differentiate(last, seen, config.time_step)
    error = np.abs(seen.robots.velocity - frame.robots.velocity)
    assert np.median(error) < 0.03
    turn = np.abs(seen.robots.angular_velocity - frame.robots.angular_velocity)
    assert np.median(turn) < 0.5
    untouched = ~frame.robots.touched_ball.any(axis=1)
    ball = np.abs(seen.ball.velocity - frame.ball.velocity)[untouched]
    assert np.median(ball) < 0.03
