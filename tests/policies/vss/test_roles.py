import numpy as np
import pytest

from rsoccer.frame import Array, Frame
from rsoccer.matches import Matches
from rsoccer.policies.vss import roles
from rsoccer.policies.vss.driving import Place
from rsoccer.policies.vss.pitch import Pitch
from rsoccer.policies.vss.roles import ATTACKER, KEEPER, NONE, SUPPORT
from rsoccer.rng import WorldRng
from rsoccer.tasks import VssSelfPlay
from rsoccer.view import Viewpoint


def assigned(task: VssSelfPlay, frame: Frame, last: Array | None = None) -> Array:
    """Roles (n, robots, side) as each robot of both sides sees them."""
    viewpoint = Viewpoint(task.n_blue, task.n_yellow, range(task.n_blue + task.n_yellow))
    view = viewpoint.new_view(len(frame))
    viewpoint.fill(frame, view)
    side = max(task.n_blue, task.n_yellow)
    found = np.zeros((len(frame), task.n_blue + task.n_yellow, side), np.int8)
    found = found if last is None else last
    roles.assign(Pitch(task.config), view, found)
    return found


def started(task: VssSelfPlay, worlds: int = 40) -> Frame:
    return task.get_initial_positions_frame(WorldRng.seeded(3, worlds))


@pytest.mark.parametrize(("n_blue", "n_yellow"), [(1, 2), (2, 3), (3, 3), (3, 5), (5, 5), (4, 1)])
def test_each_side_has_each_role_once_and_agrees_on_it(n_blue: int, n_yellow: int) -> None:
    task = VssSelfPlay(n_blue=n_blue, n_yellow=n_yellow)
    found = assigned(task, started(task))
    for first, size in ((0, n_blue), (n_blue, n_yellow)):
        mine = np.sort(found[:, first : first + size, 0], axis=1)
        expected = (
            [KEEPER, ATTACKER, *range(SUPPORT, SUPPORT + 4)][:size] if size > 1 else [ATTACKER]
        )
        assert (mine == expected).all()
        for robot in range(size):
            others = found[:, first + robot, :size]  # teammates follow ego in a ring
            assert (np.roll(others, robot, axis=1) == found[:, first : first + size, 0]).all()
            assert (found[:, first + robot, size:] == NONE).all(), "nobody is not given a role"


def test_the_roles_go_to_those_who_are_near() -> None:
    task = VssSelfPlay()
    frame = Frame.empty(1, 3, 3)
    frame.ball.position[:] = [0.3, 0.2]
    frame.blue.position[:] = [[0.0, 0.5], [-0.6, 0.1], [0.2, 0.15]]
    frame.yellow.position[:] = [[0.6, 0.0], [0.5, 0.3], [-0.5, -0.5]]
    found = assigned(task, frame)[0, :, 0].tolist()
    assert found == [SUPPORT, KEEPER, ATTACKER, KEEPER, ATTACKER, SUPPORT]


def test_who_is_behind_the_ball_attacks_rather_than_who_is_before_it() -> None:
    frame = Frame.empty(1, 3, 0)
    frame.blue.position[:] = [[-0.7, 0.0], [0.15, 0.0], [-0.3, 0.0]]
    assert assigned(VssSelfPlay(n_yellow=0), frame)[0, :, 0].tolist() == [KEEPER, SUPPORT, ATTACKER]


def test_roles_do_not_flicker_between_two_that_are_as_near() -> None:
    task = VssSelfPlay(n_yellow=0)
    frame = Frame.empty(1, 3, 0)
    frame.blue.position[:] = [[-0.7, 0.0], [-0.2, 0.2], [-0.2, -0.2]]
    found = assigned(task, frame)
    first = found[0, :, 0].tolist()
    attacker = first.index(ATTACKER)
    frame.blue.position[0, attacker, 0] -= 0.05
    assert assigned(task, frame, found)[0, :, 0].tolist() == first
    frame.blue.position[0, attacker, 0] -= 0.2
    assert assigned(task, frame, found)[0, :, 0].tolist() != first


def test_over_a_match_each_side_keeps_one_keeper() -> None:
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


def test_support_waits_inside_and_at_places_apart_unless_the_ball_is_deep() -> None:
    rng = np.random.default_rng(0)
    ball: Place = (
        rng.uniform(-0.7, 0.7, (50, 1)).astype(np.float32),
        rng.uniform(-0.6, 0.6, (50, 1)).astype(np.float32),
    )
    spots = np.array([roles.spot(which, ball) for which in range(3)])
    assert np.abs(spots).max() == roles.SPREAD
    upfield = spots[:, :, ball[0] > 0.1]
    for one, other in ((0, 1), (0, 2), (1, 2)):
        assert np.hypot(*(upfield[one] - upfield[other])).min() > 0.14
