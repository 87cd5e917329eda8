import numpy as np
import pytest

from rsoccer import SimConfig, Simulator, spawn
from rsoccer._core import RobotModel
from rsoccer.frame import Frame
from rsoccer.rng import WorldRng
from tests.helpers import same

CONFIG = SimConfig()
RADII = [CONFIG.ball.radius] + [CONFIG.robot.bounding_radius] * 6


def test_things_are_apart_and_clear_of_walls_and_corners() -> None:
    field = CONFIG.field
    places = spawn.positions(WorldRng.seeded(0, 5000), field, RADII, 0.1).astype(np.float64)
    gaps = np.linalg.norm(places[:, :, None] - places[:, None], axis=-1) + np.eye(7)
    assert gaps.min() >= 0.1
    assert gaps[:, 1:, 1:].min() >= 2 * CONFIG.robot.bounding_radius
    radii = np.array(RADII)
    x, y = np.abs(places[..., 0]), np.abs(places[..., 1])
    assert (x + radii <= field.half_length).all()
    assert (y + radii <= field.half_width).all()
    # distance to the line through the corner block's face
    clear = (field.half_length + field.half_width - field.corner - x - y) / 2**0.5
    assert (clear >= radii).all()
    assert gaps.min() < 0.102, "things come as close as they may"
    assert clear.min() < 0.03, "corners are reached"


def test_all_of_the_field_is_used() -> None:
    places = spawn.positions(WorldRng.seeded(0, 2000), CONFIG.field, RADII, 0.1)
    counts = np.histogram2d(places[:, 0, 0], places[:, 0, 1], bins=4)[0]
    assert counts.min() > 0.5 * counts.mean()
    assert abs(places.mean()) < 0.01


def test_a_world_draws_from_its_own_stream_only() -> None:
    many = WorldRng.seeded(10, 300)
    places = spawn.positions(many, CONFIG.field, RADII, 0.15)
    redrawn = 0
    for i in range(300):
        one = WorldRng.seeded(10 + i, 1)
        assert same(places[i : i + 1], spawn.positions(one, CONFIG.field, RADII, 0.15))
        assert one.state[0] == many.state[i]
        once = WorldRng.seeded(10 + i, 1)
        once.uniform(0.0, 1.0, (7, 2))
        redrawn += one.state[0] != once.state[0]
    assert 50 < redrawn < 300, "some worlds had to draw again, others not"


def test_the_simulator_accepts_every_start() -> None:
    n = 500
    rng = WorldRng.seeded(3, n)
    simulator = Simulator(CONFIG, n)
    rows = np.zeros((n, CONFIG.row_size), np.float32)
    for _ in range(10):
        places = spawn.positions(rng, CONFIG.field, RADII)
        frame = Frame.empty(n, 3, 3)
        frame.ball.position[:] = places[:, 0]
        frame.robots.position[:] = places[:, 1:]
        frame.robots.heading[:] = spawn.headings(rng, 6)
        simulator.place(np.ones(n, np.bool_), frame.rows, rows)


def test_what_does_not_fit_is_an_error_not_an_endless_search() -> None:
    with pytest.raises(ValueError, match=r"no free positions for 40 discs.* 0.5 m apart.*1.5"):
        spawn.positions(WorldRng.seeded(0, 3), CONFIG.field, [0.05] * 40, 0.5)


def test_a_tight_start_is_found() -> None:
    places = spawn.positions(WorldRng.seeded(0, 50), CONFIG.field, RADII, 0.3)
    gaps = np.linalg.norm(places[:, :, None] - places[:, None], axis=-1) + np.eye(7)
    assert gaps.min() >= 0.3 - 1e-6


def test_headings_are_directions_of_all_kinds() -> None:
    headings = spawn.headings(WorldRng.seeded(0, 4000), 3)
    assert headings.shape == (4000, 3, 2)
    assert headings.dtype == np.float32
    assert np.allclose(np.hypot(headings[..., 0], headings[..., 1]), 1.0, atol=1e-6)
    assert np.abs(headings.mean(axis=(0, 1))).max() < 0.03


def test_velocities_are_at_most_so_fast() -> None:
    velocities = spawn.velocities(WorldRng.seeded(0, 4000), 0.5)
    speeds = np.hypot(velocities[:, 0], velocities[:, 1])
    assert velocities.shape == (4000, 2)
    assert 0.49 < speeds.max() <= 0.5 + 1e-6
    assert np.abs(velocities.mean(axis=0)).max() < 0.02
    assert not spawn.velocities(WorldRng.seeded(0, 9), 0.0).any()


def test_robots_of_different_sizes_start_apart() -> None:
    big = RobotModel("ssl_generic", radius=0.2)
    config = SimConfig("ssl_challenge", 2, 1, robot=[big, "ssl_generic", big])
    n = 300
    frame = spawn.random_frame(WorldRng.seeded(1, n), config, 0.0)
    rows = np.zeros((n, config.row_size), np.float32)
    Simulator(config, n).place(np.ones(n, np.bool_), frame.rows, rows)
    gaps = np.linalg.norm(frame.robots.position[:, 0] - frame.robots.position[:, 2], axis=-1)
    assert 0.4 <= gaps.min() < 0.5
