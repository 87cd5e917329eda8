import numpy as np
import pytest

from benches.scenarios import CROWD, RANDOM, SCENARIOS, Driver, Positions, Scenario
from rsoccer import WorldRng

VSSS, SSL = CROWD[0], CROWD[3]


def at(scenario: Scenario, robots: list[list[float]], ball: list[float]) -> Positions:
    """Return one world with the first robots as given, facing +x, and the others far away."""
    n = scenario.config.n_robots
    robot_positions = np.stack([50.0 + np.arange(n), np.zeros(n)], axis=-1).astype(np.float32)
    robot_positions[: len(robots)] = np.reshape(robots, (-1, 2))
    headings = np.zeros((1, n, 2), np.float32)
    headings[..., 0] = 1.0
    return Positions(np.array([ball], np.float32), robot_positions[None], headings)


@pytest.mark.parametrize("scenario", SCENARIOS, ids=lambda scenario: scenario.name)
def test_starts_can_be_placed_and_differ(scenario: Scenario) -> None:
    rng = WorldRng.seeded(0, 2)
    first, second = scenario.start(rng), scenario.start(rng)
    assert (scenario.config.ticks_per_step, scenario.config.n_robots) == (5, 2 * scenario.robots)
    assert not np.allclose(first.robots.position[0], first.robots.position[1])
    assert not np.allclose(first.robots.position, second.robots.position)


@pytest.mark.parametrize("scenario", RANDOM, ids=lambda scenario: scenario.name)
def test_random_commands_are_held_for_ten_steps(scenario: Scenario) -> None:
    driver, positions = Driver(scenario, 3), at(scenario, [], [0.0, 0.0])
    shape = (3, scenario.config.n_robots, len(scenario.config.command_columns))
    commands = [driver.commands(step, positions) for step in (0, 9, 10)]
    assert commands[0].shape == shape
    assert np.array_equal(commands[0], commands[1])
    assert not np.array_equal(commands[0], commands[2])
    assert len(np.unique(commands[0][..., 0])) == 3 * scenario.config.n_robots


def test_a_crowd_drives_at_the_ball() -> None:
    positions = at(VSSS, [[0.0, 0.0], [0.0, 0.0]], [0.0, 1.0])
    left, right = Driver(VSSS, 1).commands(0, positions)[0, 0]
    assert right > left > 0, "the ball is to the left"
    positions = at(SSL, [[0.0, 0.0]], [3.0, 4.0])
    commands = Driver(SSL, 1).commands(0, positions)[0, 0]
    assert commands[:2] == pytest.approx([1.5, 2.0])
    assert commands[2] > 0
    assert not commands[3:].any()


def test_the_contact_share_follows_from_positions() -> None:
    r = float(SSL.radius)
    assert SSL.contact_share(at(SSL, [[0.0, 0.0], [1.0, 0.0]], [5.0, 5.0])) == 0.0
    assert SSL.contact_share(at(SSL, [[0.0, 0.0], [2 * r, 0.0]], [5.0, 5.0])) == pytest.approx(
        2 / 12
    )
    assert SSL.contact_share(at(SSL, [[0.0, 0.0]], [0.0, r + 0.021])) == pytest.approx(1 / 12)
