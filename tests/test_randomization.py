"""Numbers that each episode draws for itself."""

import json
from typing import Any

import numpy as np
import pytest

from rsoccer import (
    BALL_PARAMETERS,
    ROBOT_PARAMETERS,
    BallModel,
    Matches,
    Sensing,
    SimConfig,
    WorldRng,
)
from rsoccer._core import SENSING_NUMBERS
from rsoccer.randomization import Randomization, Range, Ranges, written
from rsoccer.tasks import VssSelfPlay
from tests.robots import robots_of
from tests.sensors import LateAndNoisy

CONFIG = SimConfig("ssl_b", 2, 1)
WORLDS = 4000


def drawn(ranges: Ranges, config: SimConfig = CONFIG) -> np.ndarray[Any, np.dtype[np.float32]]:
    """Rows of parameters of many worlds."""
    variation = Randomization.of(ranges, config, None).parameters
    assert variation is not None
    return variation.draw(WorldRng.seeded(0, WORLDS))


def test_numbers_of_the_ball_are_values_and_those_of_robots_factors() -> None:
    rows = drawn({"ball.rolling_deceleration": (0.12, 0.4), "robot.mass": (0.9, 1.1)})
    rolling = rows[:, BALL_PARAMETERS.index("rolling_deceleration")]
    values = rolling * CONFIG.ball.rolling_deceleration
    assert 0.12 <= values.min() < 0.125
    assert 0.395 < values.max() <= 0.4 + 1e-6
    robots = rows[:, len(BALL_PARAMETERS) :].reshape(WORLDS, 3, len(ROBOT_PARAMETERS))
    masses = robots[..., ROBOT_PARAMETERS.index("mass")]
    assert 0.9 <= masses.min() < 0.901
    assert 1.099 < masses.max() <= 1.1
    assert abs(np.corrcoef(masses[:, 0], masses[:, 1])[0, 1]) < 0.06, "each robot draws its own"
    others = np.delete(rows, BALL_PARAMETERS.index("rolling_deceleration"), axis=1)
    assert (others[:, : len(BALL_PARAMETERS) - 1] == 1.0).all()
    assert (robots[..., ROBOT_PARAMETERS.index("height")] == 1.0).all()


@pytest.mark.parametrize(
    ("value", "mean", "deviation"),
    [
        (1.2, 1.2, 0.0),
        (("uniform", 0.8, 1.2), 1.0, 0.4 / 12**0.5),
        (("normal", 1.0, 0.1), 1.0, 0.0987),  # within three deviations
        (("log_uniform", 0.5, 2.0), 1.082, 0.425),
    ],
)
def test_distributions_have_their_moments(value: Range, mean: float, deviation: float) -> None:
    masses = drawn({"robot.mass": value})[:, len(BALL_PARAMETERS)]
    assert masses.mean() == pytest.approx(mean, abs=0.01)
    assert masses.std() == pytest.approx(deviation, abs=0.01)


@pytest.mark.parametrize(
    ("ranges", "error", "message"),
    [
        ({"robot.weight": (1, 2)}, ValueError, "expected one of ball.mass.*got 'robot.weight'"),
        ({"robot.mass": (1.1, 0.9)}, ValueError, "expected low <= high, got"),
        ({"robot.mass": ("beta", 1, 2)}, ValueError, "expected one of .*log_uniform.*got 'beta'"),
        ({"robot.mass": ("normal", 1, -1)}, ValueError, "expected a deviation of at least 0"),
        ({"robot.mass": ("log_uniform", 0, 1)}, ValueError, "above 0"),
        ({"robot.mass": (1, float("nan"))}, ValueError, "expected two finite numbers"),
        ({"robot.mass": 10**400}, ValueError, "expected two finite numbers, got 1000"),
        ({"robot.mass": (1, 10**400)}, ValueError, "expected two finite numbers"),
        ({"wind.mass": 1}, ValueError, "expected one of .*sensing.missing, got 'wind.mass'"),
        ({"robot.mass": (1, 2, 3)}, ValueError, "expected two finite numbers"),
        ({"robot.mass": "heavy"}, TypeError, r"expected \(low, high\)"),
        ({"robot.mass": (0.0, 1.0)}, ValueError, "expected values from 0.001 to 1e.03"),
        ({"ball.mass": (0.0, 1.0)}, ValueError, "expected values from"),
        ({"sensing.delay": (0.0, 3.0)}, ValueError, "sensing.delay must be at most 1 s"),
        ([1], TypeError, "expected distributions by name"),
        ({1: (0, 1)}, TypeError, "expected names of numbers, got 1"),
        ({"ball.wall_restitution": (0.5, 2.0)}, ValueError, "expected values of at most 1, got 2"),
        ({"sensing.cameras_along": (1.0, 2.5)}, ValueError, "must be a whole number, got 2.5"),
    ],
)
def test_wrong_distributions_are_refused(
    ranges: Ranges, error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message):
        Matches("VSS-v0", randomization=ranges)


def test_numbers_of_numpy_are_numbers() -> None:
    expected = drawn({"robot.mass": (0.5, 2.0), "ball.mass": 0.5})
    half: Any = np.float32(0.5)
    two: Any = np.int64(2)
    got = drawn({"robot.mass": (half, two), "ball.mass": half})
    assert np.array_equal(got, expected)
    assert json.dumps(written({"robot.mass": ("normal", two, half)}))


def test_no_episode_draws_a_number_beyond_the_bounds() -> None:
    """Three deviations below .021 are 0, and the sum of the floats is just below it."""
    ranges = {"sensing.delay": ("normal", 0.021, 0.007)}
    numbers = Randomization.of(ranges, VssSelfPlay().config, Sensing()).sensing
    assert numbers is not None
    delays = numbers.draw(WorldRng.seeded(0, 20_000))[:, SENSING_NUMBERS.index("delay")]
    assert (delays == 0.0).any(), "some are at the bound"
    assert (delays >= 0.0).all()


def test_whole_numbers_of_senses_are_drawn_whole() -> None:
    config = VssSelfPlay().config
    found = Randomization.of({"sensing.cameras_along": (1, 3)}, config, None).sensing
    assert found is not None
    column = found.draw(WorldRng.seeded(0, 3000))[:, SENSING_NUMBERS.index("cameras_along")]
    assert [(column == count).mean() for count in (1, 2, 3)] == pytest.approx([1 / 3] * 3, abs=0.04)
    both = {"sensing.cameras_along": (1, 3), "sensing.cameras_across": ("normal", 2, 0)}
    Matches("VSS-v0", 4, randomization=both).reset()


@pytest.mark.parametrize("number", SENSING_NUMBERS)
def test_every_number_of_senses_can_vary(number: str) -> None:
    values = json.loads(Sensing().to_json())[number]
    for high in (values + 1.0, values + 0.5, 0.5):
        try:
            matches = Matches("VSS-v0", 4, randomization={f"sensing.{number}": (values, high)})
        except ValueError:  # out of range, as it is for all worlds
            continue
        matches.reset()
        return
    pytest.fail("no range is accepted")


def test_a_number_of_the_ball_that_is_0_cannot_vary() -> None:
    config = SimConfig("ssl_b", 1, 1, ball=BallModel("ssl_tigers", wall_friction=0.0))
    with pytest.raises(ValueError, match=r"ball\.wall_friction is 0 for the ball 'ssl_tigers'"):
        Randomization.of({"ball.wall_friction": (0.1, 0.2)}, config, None)


def speeds(
    seed: int, worlds: int, randomization: Ranges | None = None
) -> np.ndarray[Any, np.dtype[np.float32]]:
    """Speeds of blue_0 after some steps at full throttle, by world."""
    matches = Matches(VssSelfPlay(), worlds, seed, randomization=randomization)
    matches.reset()
    for _ in range(12):
        matches.step(np.ones((worlds, 6, 2), np.float32))
    return np.asarray(np.linalg.norm(matches.frame.blue.velocity[:, 0], axis=-1))


def test_episodes_play_with_what_they_drew() -> None:
    same, varied = speeds(0, 20), speeds(0, 20, {"robot.speed": (0.3, 0.9)})
    free = same > 1.1  # they meet nobody
    assert free.sum() >= 5
    assert np.ptp(same[free]) < 0.1
    assert np.ptp(varied[free]) > 0.3


def test_a_world_draws_the_same_alone_and_again() -> None:
    ranges = {"robot.speed": (0.5, 1.5), "sensing.robot_position_noise": (0.0, 0.02)}
    many = speeds(3, 8, ranges)
    assert many[5] == speeds(8, 1, ranges)[0]
    assert (many == speeds(3, 8, ranges)).all()


def test_an_episode_keeps_its_numbers_and_the_next_one_draws_new_ones() -> None:
    matches = Matches(VssSelfPlay(max_steps=6), 2, 0, randomization={"robot.speed": (0.5, 1.5)})
    matches.reset()
    full = np.ones((2, 6, 2), np.float32)
    ends: list[float] = []
    for step in range(30):
        before = matches.frame.blue.velocity[0, 0].copy()
        if matches.step(full).ended[0]:
            ends.append(float(np.linalg.norm(before)))
            assert step % 6 == 5
    assert len(ends) == 5
    assert len(set(ends)) == 5


def test_the_order_of_the_names_does_not_matter() -> None:
    ranges = {"robot.speed": (0.5, 1.5), "ball.rolling_deceleration": (0.1, 0.3)}
    reverse = dict(reversed(ranges.items()))
    assert list(reverse) != list(ranges)
    assert (speeds(3, 8, ranges) == speeds(3, 8, reverse)).all()


@pytest.mark.parametrize("reverse", [False, True])
def test_the_noise_of_one_body_comes_before_that_of_both(reverse: bool) -> None:
    names = ["sensing.position_noise", "sensing.ball_position_noise"]
    values = {"sensing.position_noise": (0.2, 0.3), "sensing.ball_position_noise": (0.0, 0.1)}
    ranges = {name: values[name] for name in (reversed(names) if reverse else names)}
    numbers = Randomization.of(ranges, VssSelfPlay().config, None).sensing
    assert numbers is not None
    rows = numbers.draw(WorldRng.seeded(0, 50))
    ball, robots = (
        rows[:, SENSING_NUMBERS.index(f"{body}_position_noise")] for body in ("ball", "robot")
    )
    assert ball.max() <= 0.1
    assert robots.min() >= 0.2


def test_what_cannot_vary_is_refused() -> None:
    task = VssSelfPlay()
    model = LateAndNoisy(task.config.row_size)
    words = r"randomization: .* a sensor model of one's own, got \['sensing.delay'\]"
    with pytest.raises(ValueError, match=words):
        Matches(task, sensing=model, randomization={"sensing.delay": (0.0, 0.1)})
    with pytest.raises(ValueError, match="randomization: Robots cannot place bodies"):
        Matches(task, 2, simulator=robots_of(task, 2), randomization={"robot.mass": (0.5, 2.0)})
    Matches(task, sensing=model, randomization={"robot.mass": (0.5, 2.0)}).reset()


def test_senses_can_vary_alone() -> None:
    matches = Matches("VSS-v0", 6, randomization={"sensing.position_noise": (0.01, 0.02)})
    assert matches.play.senses is not None
    matches.reset()
    error = matches.play.sensed.blue.position - matches.frame.blue.position
    assert (np.abs(error) > 0).all()


def test_saved_matches_go_on_with_their_numbers() -> None:
    def make() -> Matches:
        ranges: Ranges = {"robot.speed": (0.5, 1.5), "sensing.delay": (0.0, 0.1)}
        return Matches(VssSelfPlay(), 3, 1, sensing=Sensing("vsss"), randomization=ranges)

    matches, other = make(), make()
    matches.reset()
    actions = np.ones((3, 6, 2), np.float32)
    for _ in range(7):
        matches.step(actions)
    other.reset(seed=99)
    other.load_state_dict(matches.state_dict())
    for _ in range(40):
        one, two = matches.step(actions), other.step(actions)
        assert one.observations.tobytes() == two.observations.tobytes()
        assert matches.frame.rows.tobytes() == other.frame.rows.tobytes()
