import numpy as np
import pytest

from rsoccer import SimConfig, Simulator, spawn
from rsoccer._core import RobotModel
from rsoccer.frame import Frame
from rsoccer.registry import make_task
from rsoccer.rng import WorldRng
from tests.helpers import same

CONFIG = SimConfig()
RADII = [CONFIG.ball.radius] + [CONFIG.robot.bounding_radius] * 6


def test_positions_are_apart_and_clear_of_walls_and_corners() -> None:
    field = CONFIG.field
    positions = spawn.positions(WorldRng.seeded(0, 5000), field, RADII, 0.1).astype(np.float64)
    gaps = np.linalg.norm(positions[:, :, None] - positions[:, None], axis=-1) + np.eye(7)
    assert gaps.min() >= 0.1
    assert gaps[:, 1:, 1:].min() >= 2 * CONFIG.robot.bounding_radius
    radii = np.array(RADII)
    x, y = np.abs(positions[..., 0]), np.abs(positions[..., 1])
    assert (x + radii <= field.half_length).all()
    assert (y + radii <= field.half_width).all()
    # distance from the face of the corner block
    clear = (field.half_length + field.half_width - field.corner_leg - x - y) / 2**0.5
    assert (clear >= radii).all()
    assert gaps.min() < 0.102, "the minimal distance is reached"
    assert clear.min() < 0.03, "corners are reached"


def test_positions_cover_the_field() -> None:
    positions = spawn.positions(WorldRng.seeded(0, 2000), CONFIG.field, RADII, 0.1)
    counts = np.histogram2d(positions[:, 0, 0], positions[:, 0, 1], bins=4)[0]
    assert counts.min() > 0.5 * counts.mean()
    assert abs(positions.mean()) < 0.01


def test_a_world_draws_from_its_own_stream_only() -> None:
    many = WorldRng.seeded(10, 300)
    positions = spawn.positions(many, CONFIG.field, RADII, 0.15)
    redrawn = 0
    for i in range(300):
        one = WorldRng.seeded(10 + i, 1)
        assert same(positions[i : i + 1], spawn.positions(one, CONFIG.field, RADII, 0.15))
        assert one.state[0] == many.state[i]
        once = WorldRng.seeded(10 + i, 1)
        once.uniform(0.0, 1.0, (7, 2))
        redrawn += one.state[0] != once.state[0]
    assert 50 < redrawn < 300, "some worlds had to draw again, others not"


def test_the_simulator_accepts_every_initial_state() -> None:
    n = 500
    rng = WorldRng.seeded(3, n)
    simulator = Simulator(CONFIG, n)
    rows = np.zeros((n, CONFIG.row_size), np.float32)
    for _ in range(10):
        positions = spawn.positions(rng, CONFIG.field, RADII)
        frame = Frame.empty(n, 3, 3)
        frame.ball.position[:] = positions[:, 0]
        frame.robots.position[:] = positions[:, 1:]
        frame.robots.heading[:] = spawn.headings(rng, 6)
        simulator.place(np.ones(n, np.bool_), frame.rows, rows)


def test_an_impossible_start_raises() -> None:
    with pytest.raises(ValueError, match=r"no free positions for 40 discs.* 0.5 m apart.*1.5"):
        spawn.positions(WorldRng.seeded(0, 3), CONFIG.field, [0.05] * 40, 0.5)


def test_a_tight_start_is_found() -> None:
    positions = spawn.positions(WorldRng.seeded(0, 50), CONFIG.field, RADII, 0.3)
    gaps = np.linalg.norm(positions[:, :, None] - positions[:, None], axis=-1) + np.eye(7)
    assert gaps.min() >= 0.3 - 1e-6


def test_headings_are_uniform() -> None:
    headings = spawn.headings(WorldRng.seeded(0, 4000), 3)
    assert headings.shape == (4000, 3, 2)
    assert headings.dtype == np.float32
    assert np.allclose(np.hypot(headings[..., 0], headings[..., 1]), 1.0, atol=1e-6)
    assert np.abs(headings.mean(axis=(0, 1))).max() < 0.03


def test_velocities_are_limited() -> None:
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


def test_discs_that_leave_no_room_are_drawn_anew() -> None:
    """Eleven discs in a square: some first draws have no place for the last ones."""
    task = make_task("SSLKeepaway-v0", n_keepers=6, n_takers=5, area_length=2.5, area_width=2.5)
    frame = task.get_initial_positions_frame(WorldRng.seeded(0, 2000))
    alone = task.get_initial_positions_frame(WorldRng.seeded(1234, 1))
    assert np.array_equal(frame.rows[1234], alone.rows[0])
