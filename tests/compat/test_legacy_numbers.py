"""Motion of robots and ball through the interface of rSim; "measured": on rSim (rc-robosim 1.2)."""

import numpy as np
import pytest

from rsoccer.compat.robosim import SSL, VSS

FAR_BALL = [0.0, -0.5, 0.0, 0.0]
STEP = 0.025
STILL = [0.0] * 8
FRONT = 0.081 + 0.0215  # distance of a ball that touches the front


def state_after(sim: VSS | SSL, action: list[float], steps: int) -> np.ndarray:
    for _ in range(steps):
        sim.step([action])
    return np.array(sim.get_state())


def vss() -> VSS:
    return VSS(1, 1, 0, 25, FAR_BALL, [[-0.9, 0, 0]], [])


def ssl(angle: float = 0.0, ball: list[float] = FAR_BALL) -> SSL:
    return SSL(0, 1, 0, 25, ball, [[0, 0, angle]], [])


def test_a_vss_robot_drives_straight_as_fast_as_its_wheels() -> None:
    state = state_after(vss(), [30.0, 30.0], 60)
    assert state[8] == pytest.approx(30.0 * 0.026, rel=1e-3)
    assert abs(state[6]) < 1e-4 and (state[7] + 180) % 360 - 180 == pytest.approx(0, abs=0.01)


def test_a_vss_robot_has_the_old_top_speed() -> None:
    assert state_after(vss(), [100.0, 100.0], 60)[8] == pytest.approx(1.198, abs=2e-3)  # measured


def test_a_vss_robot_spins_as_the_old_one() -> None:
    state = state_after(vss(), [-40.0, 40.0], 40)
    assert state[10] == pytest.approx(np.degrees(26.6), rel=5e-3)  # measured


def test_left_and_right_wheel_are_not_swapped() -> None:
    assert state_after(vss(), [10.0, 20.0], 10)[10] > 10.0


@pytest.mark.parametrize(("angle", "x", "y"), [(0, 1, 0), (90, 0, 1), (180, -1, 0), (270, 0, -1)])
def test_an_ssl_robot_drives_where_it_faces(angle: float, x: float, y: float) -> None:
    state = state_after(ssl(angle), [0, 1, 0, 0, 0, 0, 0, 0], 40)
    assert state[8:10] == pytest.approx([x, y], abs=1e-3)


def test_an_ssl_robot_speeds_up_as_the_old_one() -> None:
    sim, steps = ssl(), 0
    while sim.get_state()[8] < 0.9:
        sim.step([[0, 1, 0, 0, 0, 0, 0, 0]])
        steps += 1
    assert steps * STEP == pytest.approx(0.27, abs=0.03)  # measured


def test_an_ssl_robot_moves_to_its_left_and_turns() -> None:
    state = state_after(ssl(), [0, 0, 0.5, 0, 0, 0, 0, 0], 40)
    assert state[8:11] == pytest.approx([0.0, 0.5, 0.0], abs=1e-3)
    state = state_after(ssl(), [0, 0, 0, 2.0, 0, 0, 0, 0], 40)
    assert state[10] == pytest.approx(np.degrees(2.0), rel=1e-3)


def test_wheels_and_body_speeds_mean_the_same_and_may_alternate() -> None:
    by_body = [0, 0.5, 0.25, 1.0, 99.0, 0, 0, 0]  # index 4 is unused
    speeds = state_after(ssl(), by_body, 1)[-4:]
    by_wheels = [1, *speeds, 0, 0, 0]
    straight, mixed = ssl(), ssl()
    for i in range(40):
        straight.step([by_body])
        mixed.step([by_wheels if i % 2 else by_body])
    assert mixed.get_state() == pytest.approx(straight.get_state(), abs=1e-4)
    assert straight.get_state()[10] == pytest.approx(np.degrees(1.0), rel=1e-2)


def test_the_state_has_the_commanded_wheel_speeds() -> None:
    sim = ssl()
    assert sim.get_state()[-4:] == [0.0] * 4
    sim.step([[1, 1.0, -2.0, 3.0, 400.0, 0, 0, 0]])
    assert sim.get_state()[-4:] == [1.0, -2.0, 3.0, 400.0]
    sim.step([[0, 0, 0, 1.0, 0, 0, 0, 0]])
    assert sim.get_state()[-4:] == pytest.approx([0.09 / 0.02475] * 4)
    sim.reset(FAR_BALL, [[0, 0, 0]], [])
    assert sim.get_state()[-4:] == [0.0] * 4


def test_wheels_that_are_too_fast_do_not_bend_the_path() -> None:
    slow = state_after(ssl(), [0, 1.0, 0.5, 0, 0, 0, 0, 0], 4)[-4:]
    state = state_after(ssl(), [1, *(slow * 40), 0, 0, 0], 60)
    assert state[9] / state[8] == pytest.approx(0.5, abs=1e-3)
    assert state[8] > 3.0


@pytest.mark.parametrize("distance", [0.09, 0.1, FRONT])
@pytest.mark.parametrize("angle", [0.0, 90.0, 200.0])
def test_a_ball_at_the_kicker_starts_in_the_beam(distance: float, angle: float) -> None:
    ahead = np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
    state = ssl(angle, [*(distance * ahead), 0, 0]).get_state()
    assert state[11] == 1.0
    assert state[:2] == pytest.approx(FRONT * ahead, abs=1e-5)


@pytest.mark.parametrize(("distance", "infrared"), [(FRONT + 0.009, 1.0), (FRONT + 0.011, 0.0)])
def test_the_beam_reaches_as_far_as_the_old_one(distance: float, infrared: float) -> None:
    assert ssl(0, [distance, 0, 0, 0]).get_state()[11] == infrared
    assert ssl(180, [distance, 0, 0, 0]).get_state()[11] == 0.0


def test_a_kick_shoots_the_ball_ahead() -> None:
    sim = ssl(90, [0, FRONT, 0, 0])
    state = state_after(sim, [0, 0, 0, 0, 0, 5.0, 0, 0], 1)
    assert state[3] == pytest.approx(0.0, abs=1e-4)
    assert 5.0 - 10.3 * STEP - 0.01 <= state[4] <= 5.0  # it slides already
    assert state_after(sim, STILL, 1)[11] == 0.0


def test_a_kick_adds_to_the_robots_speed() -> None:
    sim = ssl(0, [FRONT, 0, 0, 0])
    driven = state_after(sim, [0, 1.0, 0, 0, 0, 0, 0, 1], 40)
    assert driven[8] == pytest.approx(1.0, abs=0.02) and driven[11] == 1.0
    kicked = state_after(sim, [0, 1.0, 0, 0, 0, 3.0, 0, 1], 1)
    assert 4.0 - 10.3 * STEP - 0.05 <= kicked[3] <= 4.05


def test_a_chip_flies() -> None:
    sim = ssl(0, [FRONT, 0, 0, 0])
    heights = [state_after(sim, [0, 0, 0, 0, 0, 3.0, 3.0, 0], 1)[2]]
    heights += [state_after(sim, STILL, 1)[2] for _ in range(20)]
    assert max(heights) == pytest.approx(3.0**2 / 2 / 9.81 + 0.0215, abs=0.02)  # 0.44 m measured


def test_a_kick_needs_the_ball_and_a_positive_speed() -> None:
    for distance, kick in (FRONT + 0.05, 5.0), (FRONT, -5.0):
        state = state_after(ssl(0, [distance, 0, 0, 0]), [0, 0, 0, 0, 0, kick, 0, 0], 2)
        assert abs(state[3:5]).max() < 0.01


def test_the_dribbler_holds_until_it_is_off() -> None:
    back = [0, -0.5, 0, 0, 0, 0, 0]
    sim = ssl(0, [FRONT, 0, 0, 0])
    for speed in np.linspace(0.0, -0.5, 20):  # slowly, as its force is limited
        state = state_after(sim, [0, speed, 0, 0, 0, 0, 0, 1], 1)
    held = state_after(sim, [*back, 1], 20)
    assert held[11] == 1.0 and held[0] - held[5] == pytest.approx(FRONT, abs=0.003)
    assert held[8] == pytest.approx(-0.5, abs=0.02), "holding does not slow it"
    assert state[11] == 1.0
    released = state_after(sim, [*back, 0], 40)
    assert released[11] == 0.0 and released[0] - released[5] > FRONT + 0.02


@pytest.mark.parametrize("angle", [0.0, 30.0, 45.0, 90.0])
@pytest.mark.parametrize(("simulator", "deceleration"), [(VSS, 0.14), (SSL, 0.70)])
def test_the_ball_rolls_equally_in_all_directions(
    simulator: type[VSS | SSL], deceleration: float, angle: float
) -> None:
    ahead = np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
    sim = simulator(1, 0, 0, 25, [0, 0, *(0.6 * ahead)], [], [])
    speeds = []
    for _ in range(20):
        sim.step([])
        v_x, v_y = sim.get_state()[3:5]
        speeds.append(np.hypot(v_x, v_y))
    assert (speeds[-11] - speeds[-1]) / (10 * STEP) == pytest.approx(deceleration, rel=1e-2)


def test_starts_of_old_environments_are_accepted() -> None:
    """VSS: at least 0.1 m apart, which lets two squares overlap at their corners."""
    rng = np.random.default_rng(0)
    blue, yellow = ([[side * 0.2 * i, 0, 0] for i in (1, 2, 3)] for side in (-1, 1))
    sim, moved = VSS(0, 3, 3, 25, FAR_BALL, blue, yellow), 0
    for _ in range(100):
        spots = np.cumsum(np.full(6, 0.1)) - 0.35
        robots = np.stack([spots, np.zeros(6), rng.uniform(0, 360, 6)], axis=1)
        sim.reset(FAR_BALL, robots[:3], robots[3:])
        state = np.array(sim.get_state())[5:].reshape(6, 6)
        assert abs(state[:, :2] - robots[:, :2]).max() < 0.01
        moved += bool(abs(state[:, 0] - robots[:, 0]).max() > 1e-6)
    assert moved > 0
