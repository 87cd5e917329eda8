import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from rsoccer.compat import robosim
from rsoccer.compat.legacy_models import SSL_BALL, SSL_FIELDS, SSL_ROBOT, VSS_BALL, VSS_FIELDS
from rsoccer.compat.robosim import SSL, VSS
from rsoccer.compat.separation import MAX_OVERLAP

Builder = Callable[..., VSS | SSL]

PAGE = Path(__file__).parents[2] / "docs" / "coming-from-rsoccer-gym.md"
BALL = [0.0, 0.5, 0.0, 0.0]


def vss(field_type: int = 0, blue: int = 1, yellow: int = 1, step: int = 25) -> VSS:
    return VSS(field_type, blue, yellow, step, BALL, poses(-1, blue), poses(1, yellow))


def ssl(field_type: int = 2, blue: int = 1, yellow: int = 1, step: int = 25) -> SSL:
    return SSL(field_type, blue, yellow, step, BALL, poses(-1, blue), poses(1, yellow))


def poses(side: int, n: int) -> list[list[float]]:
    return [[side * 0.2 * i, 0, 0] for i in range(1, n + 1)]


WORLDS = pytest.mark.parametrize("world", [vss, ssl])


def test_field_parameters_are_those_of_the_page() -> None:
    worlds = {f"VSS {kind}": vss(kind) for kind in (0, 1)}
    reported: dict[str, dict[str, float]] = {
        **{name: world.get_field_params() for name, world in worlds.items()},
        **{f"SSL {kind}": ssl(kind).get_field_params() for kind in (0, 1, 2)},
    }
    table = PAGE.read_text().split("## Numbers")[1]
    head, _, *lines = re.findall(r"^\|(.*)\|$", table, re.MULTILINE)
    columns = [cell.strip() for cell in head.split("|")][1:]
    rows = [[cell.strip() for cell in line.split("|")] for line in lines]
    documented = {
        column: {row[0]: float(row[i + 1]) for row in rows} for i, column in enumerate(columns)
    }
    assert documented == reported
    assert len(rows) == 17


def test_the_page_has_the_models_numbers() -> None:
    robot, text = SSL_ROBOT, PAGE.read_text()
    for phrase in (
        f"holds with {robot.dribbler_grip:g} N",
        f"up to {robot.max_kick_speed:g} m/s, then {robot.kicker_recharge_time:g} s",
        f"{robot.max_acceleration:.2f} m/s² up and {robot.max_deceleration:.2f} m/s² down",
        f"slides at {SSL_BALL.sliding_deceleration} m/s² (VSS: {VSS_BALL.sliding_deceleration})",
        f"{SSL_BALL.rolling_deceleration:.2f} m/s² (VSS: {VSS_BALL.rolling_deceleration:.2f})",
        f"by up to {MAX_OVERLAP * 100:g} cm",
        f"{VSS_FIELDS[0].wall_height:g} m high",
        f"corners of {VSS_FIELDS[0].corner_leg:g} m",
        f"{VSS_FIELDS[0].max_robots} a side (VSS), {SSL_FIELDS[0].max_robots} (SSL)",
    ):
        assert phrase in text


@pytest.mark.parametrize("n", [(0, 0), (1, 0), (0, 2), (3, 1)])
@WORLDS
def test_any_number_of_robots(world: Builder, n: tuple[int, int]) -> None:
    size, action = (6, 2) if world is vss else (11, 8)
    sim = world(0, *n)
    sim.step(np.zeros((sum(n), action)))
    sim.step([[0.0] * action] * sum(n))
    state = sim.get_state()
    assert isinstance(state, list) and len(state) == 5 + size * sum(n)
    assert all(type(number) is float for number in state)


def test_no_robots_may_be_any_empty_array() -> None:
    sim = ssl(2, 1, 0)
    empty: list[object] = [[], (), np.array([]), np.zeros((0, 3))]
    for robots in empty:
        sim.reset(BALL, ((0.5, 0, 90),), robots)
    assert sim.get_state()[5:8] == [0.5, 0.0, 90.0]


def test_a_state_lists_the_ball_then_blue_then_yellow() -> None:
    sim = vss(0, 2, 1)
    sim.reset([0.125, 0.25, 1.5, -0.5], [[-0.5, 0.25, 90], [0, 0, -45]], [[0.5, -0.25, 270]])
    state = sim.get_state()
    assert state[:5] == pytest.approx([0.125, 0.25, 0.0215, 1.5, -0.5])
    assert state[5:11] == [-0.5, 0.25, 90.0, 0.0, 0.0, 0.0]
    assert state[11:14] == pytest.approx([0.0, 0.0, 315.0])
    assert state[17:20] == [0.5, -0.25, 270.0]


@WORLDS
def test_velocities_are_true_at_once_and_reading_changes_nothing(world: Builder) -> None:
    sim = world()
    sim.reset([0.0, 0.5, 0.25, -1.0], [[-0.5, 0, 0]], [[0.5, 0, 0]])
    assert sim.get_state()[3:5] == [0.25, -1.0]
    sim.step([[1.0] * 2 if world is vss else [0, 1, 0, 0, 0, 0, 0, 0]] * 2)
    state = sim.get_state()
    assert state[8] > 0.01
    assert sim.get_state() == state


@pytest.mark.parametrize("step", [1, 7, 16, 17, 25, 33, 40, 1000])
@WORLDS
def test_any_whole_number_of_milliseconds(world: Builder, step: int) -> None:
    sim = world(0, step=step)
    sim.reset([0.0, 0.5, 0.0, -0.125], *[poses(side, 1) for side in (-1, 1)])
    steps = -(-40 // step)
    for _ in range(steps):
        sim.step(np.zeros((2, 2 if world is vss else 8)))
    moved = 0.5 - sim.get_state()[1]
    stop_in = 0.125**2 / 2 / 0.14
    assert 0.002 < moved <= min(stop_in, 0.125 * steps * step / 1000)


@WORLDS
def test_arguments_may_be_named(world: Builder) -> None:
    named = type(world())(
        field_type=0,
        n_robots_blue=1,
        n_robots_yellow=1,
        time_step_ms=np.int64(25),  # type: ignore[arg-type]
        ball_pos=np.array(BALL),
        blue_robots_pos=np.array(poses(-1, 1)),
        yellow_robots_pos=np.array(poses(1, 1)),
    )
    assert named.get_state() == world(0).get_state()
    named.reset(ball_pos=BALL, blue_robots_pos=poses(-1, 1), yellow_robots_pos=poses(1, 1))
    assert named.get_state() == world(0).get_state()


@WORLDS
def test_arguments_are_not_changed(world: Builder) -> None:
    given = np.array([-0.1, 0.0, 0.0, 0.0]), np.array([[0.0, 0.0, 180.0]]), np.array(poses(1, 1))
    copies = [array.copy() for array in given]
    world().reset(*given)
    assert all((array == copy).all() for array, copy in zip(given, copies, strict=True))


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((3, 1, 1, 25), r"field_type: expected one of \{0: 'vss_3v3', 1: 'vss_5v5'\}, got 3"),
        ((-1, 1, 1, 25), "field_type: expected at least 0, got -1"),
        ((0, -1, 1, 25), "n_robots_blue: expected at least 0, got -1"),
        ((0, 1, 6, 25), "n_yellow must be at most 5"),
        ((0, 1, 1, 0), "time_step_ms: expected at least 1, got 0"),
    ],
)
def test_impossible_matches_are_refused(arguments: tuple[int, int, int, int], message: str) -> None:
    places = [poses(-1, 1), poses(1, max(arguments[2], 0))]
    with pytest.raises(ValueError, match=message):
        VSS(*arguments, BALL, *places)


def test_a_time_step_in_seconds_is_refused() -> None:
    with pytest.raises(TypeError, match=r"time_step_ms: expected a whole number, got 0\.025"):
        vss(step=0.025)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (([0, 0], [[0, 0, 0]], [[1, 0, 0]]), r"ball_pos: .*; got shape \(2,\)"),
        ((BALL, [[0, 0, 0]] * 2, [[1, 0, 0]]), r"blue_robots_pos: expected 1 x 3 .*\(2, 3\)"),
        ((BALL, [[0, 0, 0]], []), r"yellow_robots_pos: .*; got shape \(0,\)"),
        ((BALL, [[0, 0]], [[1, 0, 0]]), r"blue_robots_pos: .*; got shape \(1, 2\)"),
        ((BALL, [[0, 0, 0]], [["here", 0, 0]]), "yellow_robots_pos: .*'here'"),
        ((BALL, [[0, 0, np.nan]], [[1, 0, 0]]), r"blue_robots_pos: .*got nan at \(0, 2\)"),
        (([None, 0, 0, 0], [[0, 0, 0]], [[1, 0, 0]]), r"ball_pos: .*got nan at \(0,\)"),
        (([1e30, 0, 0, 0], [[0, 0, 0]], [[1, 0, 0]]), r"ball_pos: .*got 1e\+30 at \(0,\)"),
        ((BALL, [[0, 0, 0]], [[0.1, 0, 0]]), "blue_0 and yellow_0 overlap"),
        (([1.01, 0, 0, 0], [[0, 0, 0]], [[1, 0, 0]]), "ball and yellow_0 overlap"),
        ((BALL, [[9, 0, 0]], [[1, 0, 0]]), "blue_0 .*outside"),
    ],
)
def test_bad_positions_are_refused_and_the_match_goes_on(
    given: tuple[object, object, object], message: str
) -> None:
    sim, other = ssl(), ssl()
    for each in (sim, other):
        each.step([[1, 30, 30, -30, -30, 0, 0, 0], [0] * 8])
    with pytest.raises(ValueError, match=message):
        sim.reset(*given)
    for each in (sim, other):
        each.step(np.zeros((2, 8)))
    assert sim.get_state() == other.get_state()


@pytest.mark.parametrize(
    ("actions", "message"),
    [
        ([[0.0] * 8], r"actions: expected 2 x 8 numbers, .*; got shape \(1, 8\)"),
        ([[0.0] * 6] * 2, r"actions: .*; got shape \(2, 6\)"),
        ([[0.0] * 8, [0.0] * 7], "actions: expected 2 x 8 numbers"),
        ([[0.0] * 8, [0.0] * 7 + [np.inf]], r"actions: .*got inf at \(1, 7\)"),
    ],
)
def test_bad_actions_are_refused_and_nothing_moves(actions: object, message: str) -> None:
    sim = ssl()
    sim.step([[0, 1, 0, 0, 0, 0, 0, 0]] * 2)
    state = sim.get_state()
    with pytest.raises(ValueError, match=message):
        sim.step(actions)
    assert sim.get_state() == state


def test_installing_does_not_replace_another_robosim(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "robosim", ModuleType("robosim"))
    with pytest.raises(RuntimeError, match="robosim has been imported from an unknown place"):
        robosim.install()
    assert robosim.install(force=True) is robosim
    assert sys.modules["robosim"] is robosim
    assert robosim.install() is robosim, "twice does no harm"


def test_code_of_others_imports_it_by_the_old_name() -> None:
    program = (
        "from rsoccer.compat import robosim; robosim.install(); import robosim as found; "
        "print(found.VSS(0, 0, 0, 25, [0, 0, 0, 0], [], []).get_state())"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.stdout.startswith("[0.0, 0.0, 0.021")
    assert done.stderr == ""
