import numpy as np
import pytest

from benches.games import CROWD, GAMES, RANDOM, Driver, Game, Seen
from rsoccer import WorldRng

VSSS, SSL = CROWD[0], CROWD[3]


def at(game: Game, robots: list[list[float]], ball: list[float]) -> Seen:
    """One world with the first robots somewhere, facing +x, and the others far off and apart."""
    n = game.config.n_robots
    places = np.stack([50.0 + np.arange(n), np.zeros(n)], axis=-1).astype(np.float32)
    places[: len(robots)] = np.reshape(robots, (-1, 2))
    headings = np.zeros((1, n, 2), np.float32)
    headings[..., 0] = 1.0
    return Seen(np.array([ball], np.float32), places[None], headings)


@pytest.mark.parametrize("game", GAMES, ids=lambda game: game.name)
def test_starts_can_be_placed_and_differ(game: Game) -> None:
    rng = WorldRng.seeded(0, 2)
    first, second = game.start(rng), game.start(rng)
    assert (game.config.ticks_per_step, game.config.n_robots) == (5, 2 * game.robots)
    assert not np.allclose(first.robots.position[0], first.robots.position[1])
    assert not np.allclose(first.robots.position, second.robots.position)


@pytest.mark.parametrize("game", RANDOM, ids=lambda game: game.name)
def test_random_commands_are_kept_for_ten_steps(game: Game) -> None:
    driver, seen = Driver(game, 3), at(game, [], [0.0, 0.0])
    shape = (3, game.config.n_robots, len(game.config.command_columns))
    told = [driver.commands(step, seen) for step in (0, 9, 10)]
    assert told[0].shape == shape
    assert np.array_equal(told[0], told[1])
    assert not np.array_equal(told[0], told[2])
    assert len(np.unique(told[0][..., 0])) == 3 * game.config.n_robots


def test_a_crowd_drives_at_the_ball() -> None:
    seen = at(VSSS, [[0.0, 0.0], [0.0, 0.0]], [0.0, 1.0])
    left, right = Driver(VSSS, 1).commands(0, seen)[0, 0]
    assert right > left > 0, "the ball is to the left"
    seen = at(SSL, [[0.0, 0.0]], [3.0, 4.0])
    told = Driver(SSL, 1).commands(0, seen)[0, 0]
    assert told[:2] == pytest.approx([1.5, 2.0])
    assert told[2] > 0
    assert not told[3:].any()


def test_touching_is_told_from_places() -> None:
    r = float(SSL.radius)
    assert SSL.touching(at(SSL, [[0.0, 0.0], [1.0, 0.0]], [5.0, 5.0])) == 0.0
    assert SSL.touching(at(SSL, [[0.0, 0.0], [2 * r, 0.0]], [5.0, 5.0])) == pytest.approx(2 / 12)
    assert SSL.touching(at(SSL, [[0.0, 0.0]], [0.0, r + 0.021])) == pytest.approx(1 / 12)
