import numpy as np
import pytest

from rsoccer.arrays import Array
from rsoccer.frame import Frame
from rsoccer.matches import Matches
from rsoccer.policies.vss.field_geometry import FieldGeometry
from rsoccer.policies.vss.roles import (
    ATTACKER,
    KEEPER,
    NONE,
    SUPPORT,
    SUPPORT_LIMIT,
    assign_roles,
    support_position,
)
from rsoccer.rng import WorldRng
from rsoccer.tasks import VssSelfPlay
from rsoccer.vectors import XY
from rsoccer.view import Viewpoint


def assigned(task: VssSelfPlay, frame: Frame, last: Array | None = None) -> Array:
    """Roles (n, robots, team) as each robot of both teams assigns them."""
    viewpoint = Viewpoint(task.n_blue, task.n_yellow, range(task.n_blue + task.n_yellow))
    view = viewpoint.new_view(len(frame))
    viewpoint.fill(frame, view)
    team = max(task.n_blue, task.n_yellow)
    new = np.zeros((len(frame), task.n_blue + task.n_yellow, team), np.int8)
    roles = new if last is None else last
    assign_roles(FieldGeometry(task.config), view, roles)
    return roles


def start_frame(task: VssSelfPlay, worlds: int = 40) -> Frame:
    return task.get_initial_positions_frame(WorldRng.seeded(3, worlds))


@pytest.mark.parametrize(("n_blue", "n_yellow"), [(1, 2), (2, 3), (3, 3), (3, 5), (5, 5), (4, 1)])
def test_each_team_has_each_role_once_and_agrees_on_it(n_blue: int, n_yellow: int) -> None:
    task = VssSelfPlay(n_blue=n_blue, n_yellow=n_yellow)
    roles = assigned(task, start_frame(task))
    for first, size in ((0, n_blue), (n_blue, n_yellow)):
        own_roles = np.sort(roles[:, first : first + size, 0], axis=1)
        expected = (
            [KEEPER, ATTACKER, *range(SUPPORT, SUPPORT + 4)][:size] if size > 1 else [ATTACKER]
        )
        assert (own_roles == expected).all()
        for robot in range(size):
            team_roles = roles[:, first + robot, :size]  # teammates follow ego in a ring
            assert (np.roll(team_roles, robot, axis=1) == roles[:, first : first + size, 0]).all()
            assert (roles[:, first + robot, size:] == NONE).all(), "an empty slot has a role"


def test_roles_go_to_near_robots() -> None:
    task = VssSelfPlay()
    frame = Frame.empty(1, 3, 3)
    frame.ball.position[:] = [0.3, 0.2]
    frame.blue.position[:] = [[0.0, 0.5], [-0.6, 0.1], [0.2, 0.15]]
    frame.yellow.position[:] = [[0.6, 0.0], [0.5, 0.3], [-0.5, -0.5]]
    roles = assigned(task, frame)[0, :, 0].tolist()
    assert roles == [SUPPORT, KEEPER, ATTACKER, KEEPER, ATTACKER, SUPPORT]


def test_a_robot_behind_the_ball_attacks_rather_than_one_in_front_of_it() -> None:
    frame = Frame.empty(1, 3, 0)
    frame.blue.position[:] = [[-0.7, 0.0], [0.15, 0.0], [-0.3, 0.0]]
    assert assigned(VssSelfPlay(n_yellow=0), frame)[0, :, 0].tolist() == [KEEPER, SUPPORT, ATTACKER]


def test_a_loyal_keeper_stays_the_keeper_of_its_team() -> None:
    task = VssSelfPlay(n_yellow=0)
    frame = Frame.empty(1, 3, 0)
    frame.blue.position[:] = [[-0.6, 0.3], [-0.6, 0.1], [0.0, 0.0]]
    viewpoint = Viewpoint(3, 0, range(3))
    view = viewpoint.new_view(1)
    viewpoint.fill(frame, view)
    for hysteresis, expected in ((0.1, False), (0.5, True)):
        roles = np.array([[[KEEPER, ATTACKER, SUPPORT]]], np.int8).repeat(3, axis=1)
        assign_roles(FieldGeometry(task.config), view, roles, np.float32(hysteresis))
        assert (roles[0, 0, 0] == KEEPER) is np.bool_(expected)


def test_roles_do_not_flicker_between_two_robots_equally_near() -> None:
    task = VssSelfPlay(n_yellow=0)
    frame = Frame.empty(1, 3, 0)
    frame.blue.position[:] = [[-0.7, 0.0], [-0.2, 0.2], [-0.2, -0.2]]
    roles = assigned(task, frame)
    first = roles[0, :, 0].tolist()
    attacker = first.index(ATTACKER)
    frame.blue.position[0, attacker, 0] -= 0.05
    assert assigned(task, frame, roles)[0, :, 0].tolist() == first
    frame.blue.position[0, attacker, 0] -= 0.2
    assert assigned(task, frame, roles)[0, :, 0].tolist() != first


def test_each_team_has_one_keeper_throughout_a_match() -> None:
    controllers = {"all": "scripted"}
    matches = Matches(VssSelfPlay(), 8, 1, controllers=controllers, autoreset="disabled")
    matches.reset()
    changes, before = 0, None
    for _ in range(200):
        matches.step(np.zeros((8, 0, 2), np.float32))
        all_roles = matches.state_dict()["blue_0.roles"].reshape(8, 2, 3, 3)
        now = all_roles[..., 0]
        assert (np.sort(now, axis=2) == [KEEPER, ATTACKER, SUPPORT]).all()
        for robot in range(3):
            assert (np.roll(all_roles[:, :, robot], robot, axis=2) == now).all(), "teammates agree"
        changes += 0 if before is None else int((now != before).any(axis=2).sum())
        before = now
    assert 10 < changes < 0.1 * 200 * 16, "roles follow the game, but not at every step"


def test_support_positions_are_limited_and_apart_unless_the_ball_is_deep() -> None:
    rng = np.random.default_rng(0)
    ball: XY = (
        rng.uniform(-0.7, 0.7, (50, 1)).astype(np.float32),
        rng.uniform(-0.6, 0.6, (50, 1)).astype(np.float32),
    )
    positions = np.array([support_position(index, ball) for index in range(3)])
    assert np.abs(positions).max() == SUPPORT_LIMIT
    upfield = positions[:, :, ball[0] > 0.1]
    for one, other in ((0, 1), (0, 2), (1, 2)):
        assert np.hypot(*(upfield[one] - upfield[other])).min() > 0.14
