import numpy as np
import pytest

from rsoccer import LEARN, Matches
from rsoccer.rng import WorldRng
from rsoccer.tasks import SslContestedPossession, SslStaticDefenders
from rsoccer.tasks.ssl_attack import SslAttack
from tests.tasks.ssl_scenes import STAND, expect_solved, play, run, scene

TASK = SslStaticDefenders()

# Both attacking challenges have these terminations.
attacks = pytest.mark.parametrize("task", [TASK, SslContestedPossession()])


def drive(x: float, y: float) -> tuple[float, ...]:
    return (x, y, 0.0, -1.0, -1.0)


@attacks
def test_a_goal_terminates(task: SslAttack) -> None:
    outcome, _ = run(task, scene(task, ball=(2.8, 0.1, 2.0, 0.0), blue_0=(1.0, 0.0)))
    assert outcome.terminated[0]
    assert outcome.metrics["goal_score"][0] == 1.0
    assert outcome.terms["goal"][0, 0] == 10.0
    assert outcome.terms["failed"][0, 0] == 0.0


@pytest.mark.parametrize(
    "ball",
    [
        (0.05, 1.0, -1.0, 0.0),  # over the center line
        (1.0, 1.9, 0.0, 1.5),
        (1.0, -1.9, 0.0, -1.5),
        (2.9, 1.5, 1.5, 0.0),  # over the goal line
    ],
)
@attacks
def test_the_ball_outside_the_half_terminates(task: SslAttack, ball: tuple[float, ...]) -> None:
    outcome, _ = run(task, scene(task, ball=ball, blue_0=(1.0, 0.0)))
    assert outcome.terminated[0]
    assert outcome.metrics["goal_score"][0] == 0.0
    assert outcome.terms["failed"][0, 0] == -1.0


@pytest.mark.parametrize(
    ("position", "direction"),
    [
        ((-0.1, 0.0), (-1.0, 0.0)),  # over the center line by more than 0.2 m
        ((1.0, 1.9), (0.0, 1.0)),
        ((1.0, -1.9), (0.0, -1.0)),
        ((2.9, 1.5), (1.0, 0.0)),
        ((2.1, 0.0), (1.0, 0.0)),  # into the goal area from the front
        ((2.5, -1.1), (0.0, 1.0)),  # and from the side
    ],
)
@attacks
def test_the_attacker_outside_its_area_terminates(
    task: SslAttack, position: tuple[float, float], direction: tuple[float, float]
) -> None:
    start = scene(task, ball=(1.0, 0.5), blue_0=position)
    assert not run(task, start, STAND, 1)[0].ended[0]
    outcome, _ = run(task, start, drive(*direction), 20)
    assert outcome.terminated[0]
    assert outcome.terms["failed"][0, 0] == -1.0


def test_a_soft_touch_of_an_opponent_terminates() -> None:
    start = scene(TASK, ball=(1.5, 1.0), blue_0=(1.0, 0.0), yellow_0=(1.25, 0.0))
    outcome, matches = run(TASK, start, drive(0.05, 0.0))
    assert outcome.terminated[0]
    assert matches.frame.blue.collision_speed[0, 0] < 0.3


def test_initial_positions_are_in_the_half_and_outside_the_goal_area() -> None:
    frame = TASK.get_initial_positions_frame(WorldRng.seeded(0, 500))
    positions = np.concatenate([frame.ball.position[:, None], frame.yellow.position], axis=1)
    x, y = positions[..., 0], np.abs(positions[..., 1])
    assert x.min() > 0.1
    assert not ((x > 2.2) & (y < 1.0)).any()
    gaps = np.linalg.norm(positions[:, :, None] - positions[:, None], axis=-1) + np.eye(7)
    assert gaps.min() >= 0.25 - 1e-6
    assert not frame.blue.position.any()


def test_official_scenarios_are_the_published_ones_rotated_by_180_degrees() -> None:
    """Spot checks against the rules, which attack -x (millimeters there)."""
    frame = SslStaticDefenders(scenario=1).get_initial_positions_frame(WorldRng.seeded(0, 1))
    assert frame.ball.position[0] == pytest.approx([0.2, 1.8])
    expected = np.array([[2.9, 0], [2, 0.75], [2, 0.55]])
    assert frame.yellow.position[0, :3] == pytest.approx(expected)
    angle = np.arctan2(*frame.yellow.heading[0, 0][::-1])
    assert angle == pytest.approx(np.pi - 0.785)
    frame = SslStaticDefenders(scenario=9).get_initial_positions_frame(WorldRng.seeded(0, 1))
    assert frame.ball.position[0] == pytest.approx([2.8, 1.75])
    assert frame.yellow.position[0, 2] == pytest.approx([0.8, -1.0])
    assert [opponents_in_half(i) for i in range(1, 11)] == [3, 3, 4, 4, 5, 5, 5, 6, 6, 6]


def opponents_in_half(scenario: int) -> int:
    """Opponents of a scenario that do not wait."""
    task = SslStaticDefenders(scenario=scenario)
    frame = task.get_initial_positions_frame(WorldRng.seeded(0, 1))
    return int((frame.yellow.position[0, :, 0] > 0.0).sum())


def test_a_policy_of_the_random_task_fits_every_scenario() -> None:
    sizes = {SslStaticDefenders(scenario=i).layout.size for i in range(1, 11)}
    assert sizes == {TASK.layout.size}


def test_a_fraction_of_the_starts_is_near_a_scenario_mirrored_or_not() -> None:
    task = SslStaticDefenders(scenario_fraction=0.5)
    frame = task.get_initial_positions_frame(WorldRng.seeded(0, 2000))
    official = [
        SslStaticDefenders(scenario=i).get_initial_positions_frame(WorldRng.seeded(0, 1))
        for i in range(1, 11)
    ]
    found = np.zeros((2000, 10, 2), np.bool_)
    for index, start in enumerate(official):
        for mirrored, sign in enumerate(([1.0, 1.0], [1.0, -1.0])):
            ball = np.abs(frame.ball.position - start.ball.position * sign).max(axis=1)
            robots = frame.yellow.position - start.yellow.position * sign
            found[:, index, mirrored] = (ball <= 0.151) & (np.abs(robots).max((1, 2)) <= 0.151)
    near = np.flatnonzero(found.any(axis=(1, 2)))
    assert len(near) / 2000 == pytest.approx(0.5, abs=0.04)
    assert (found.mean(axis=0) > 0.01).all(), "each scenario, mirrored or not"
    assert (frame.yellow.position[near, :, 0].max(axis=1) > 2.7).all(), "goalkeepers"
    assert not frame.blue.position.any()
    Matches(task, 200, 3).reset()  # bodies do not overlap


def test_scenarios_need_all_opponents() -> None:
    with pytest.raises(ValueError, match="n_opponents: expected 6 with scenarios, got 3"):
        SslStaticDefenders(scenario=1, n_opponents=3)
    with pytest.raises(ValueError, match="n_opponents: expected 6 with scenarios, got 0"):
        SslStaticDefenders(scenario_fraction=0.1, n_opponents=0)
    with pytest.raises(ValueError, match="scenario_fraction: expected"):
        SslStaticDefenders(scenario_fraction=1.1)


def test_strike_solves_the_task() -> None:
    solved = expect_solved(TASK, "strike", "goal_score", 0.9)
    assert solved.largest_term() == "goal"


@pytest.mark.parametrize("scenario", range(1, 11))
def test_strike_solves_every_official_scenario(scenario: int) -> None:
    task = SslStaticDefenders(scenario=scenario)
    assert play(task, "strike", worlds=1).metrics["goal_score"][0] == 1.0


@pytest.mark.parametrize("n_opponents", [0, 2, 6])
def test_the_number_of_opponents_is_an_option(n_opponents: int) -> None:
    task = SslStaticDefenders(n_opponents=n_opponents)
    frame = task.get_initial_positions_frame(WorldRng.seeded(0, 20))
    assert frame.yellow.position.shape == (20, n_opponents, 2)


@pytest.mark.parametrize("n_opponents", [-1, 7])
def test_too_many_opponents_are_refused(n_opponents: int) -> None:
    with pytest.raises(ValueError, match="n_opponents: expected at"):
        SslStaticDefenders(n_opponents=n_opponents)


@pytest.mark.parametrize("scenario", [0, 11])
def test_other_scenarios_are_refused(scenario: int) -> None:
    with pytest.raises(ValueError, match="scenario: expected"):
        SslStaticDefenders(scenario=scenario)


def test_nearness_grows_toward_an_opponent_and_points_at_it() -> None:
    task = SslStaticDefenders(n_opponents=2)
    matches = Matches(task, 1, autoreset="disabled")
    frame = task.get_initial_positions_frame(WorldRng.seeded(0, 1))
    frame.blue.position[0, 0] = [1.0, 0.0]
    frame.yellow.position[0] = [[1.0, 0.43], [2.5, 0.0]]  # gaps of 0.25 m and 1.32 m
    frame.ball.position[0] = [0.5, 0.0]
    observation = matches.reset(rows=frame.rows)[0, 0]
    block = task.layout.blocks["nearness"]
    near, far = observation[block.columns].reshape(block.shape)[:2]
    np.testing.assert_allclose(near, [np.exp(-1.0), 0.0, np.exp(-1.0)], atol=1e-3)
    np.testing.assert_allclose(far, [np.exp(-5.28), np.exp(-5.28), 0.0], atol=1e-3)


@pytest.mark.parametrize("n_opponents", [0, 1, 6])
def test_nearness_has_a_row_for_each_opponent(n_opponents: int) -> None:
    task = SslStaticDefenders(n_opponents=n_opponents)
    matches = Matches(task, 5, controllers={"all": LEARN})
    observations = matches.reset(3)
    assert task.layout.blocks["nearness"].shape == (*task.layout.blocks["opponents"].shape[:1], 3)
    nearness = observations[..., task.layout.blocks["nearness"].columns].reshape(
        5, 1 + n_opponents, *task.layout.blocks["nearness"].shape
    )
    assert (nearness[:, 0, :n_opponents, 0] > 0.0).all()
    assert (nearness[:, 0, n_opponents:] == 0.0).all()
    assert (nearness[:, 1:, 1:] == 0.0).all(), "yellow robots have one opponent"
