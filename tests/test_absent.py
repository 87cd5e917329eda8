"""Robots that are not on the field: in matches, for scripts, in pictures, states and replays."""

import numpy as np
import pytest

import rsoccer
from rsoccer import Matches, Simulator, entities
from rsoccer.arrays import Floats
from rsoccer.controllers import Controllers
from rsoccer.frame import Frame
from rsoccer.global_state import StateEncoder
from rsoccer.render.scene import foreground_shapes
from rsoccer.render.scoreboard import Board
from rsoccer.replay import quantized
from rsoccer.rng import WorldRng
from rsoccer.tasks import VssSelfPlay
from tests.helpers import same, zeros

SCRIPTS = [
    ("VSSSelfPlay-v0", "scripted"),
    ("VSSSelfPlay-v0", "chase"),
    ("VSSSelfPlay-v0", "best"),
    ("SSLSelfPlay-v0", "best"),
    ("SSLSelfPlay-v0", "strike"),
    ("SSLSelfPlay-v0", "fetch"),
    ("SSLPassEnduranceMulti-v1", "passer"),
    ("SSLKeepaway-v0", "keep"),
    ("SSLKeepaway-v0", "take"),
    ("SSLDribbling-v0", "weave"),
    ("SSLContestedPossession-v0", "strike"),
]


def starts(task: rsoccer.Task, worlds: int, absent: list[int]) -> Frame:
    """Initial states of a task with some robots absent in all worlds."""
    frame = task.get_initial_positions_frame(WorldRng.seeded(1, worlds))
    frame.robots.absent[:, absent] = 1.0
    return frame


@pytest.mark.parametrize("engine", ["compact", "rapier"])
def test_a_smaller_team_plays_in_the_same_batch(engine: str) -> None:
    task = VssSelfPlay(engine=engine)
    frame = starts(task, 4, [])
    frame.robots.absent[2, [1, 5]] = 1.0
    matches = Matches(task, 4, controllers={"all": "scripted"}, autoreset="disabled")
    control = Matches(task, 4, controllers={"all": "scripted"}, autoreset="disabled")
    matches.reset(seed=0, rows=frame.rows)
    full = frame.copy()
    full.robots.absent[:] = 0.0
    control.reset(seed=0, rows=full.rows)
    bench = matches.frame.robots.position[2, [1, 5]].copy()
    for _ in range(60):
        matches.step(zeros(matches))
        control.step(zeros(control))
    others = [0, 1, 3]
    assert same(matches.frame.rows[others], control.frame.rows[others])
    assert not same(matches.frame.rows[2], control.frame.rows[2])
    assert same(matches.frame.robots.position[2, [1, 5]], bench)
    assert matches.frame.robots.absent[2].tolist() == [0, 1, 0, 0, 0, 1]
    assert (np.abs(bench[:, 0]) > task.config.field.half_length + 0.5).all()
    state = matches.state_dict()
    other = Matches(task, 4, controllers={"all": "scripted"}, autoreset="disabled")
    other.load_state_dict(state)
    other.step(zeros(other))
    matches.step(zeros(matches))
    assert same(other.frame.rows, matches.frame.rows)


@pytest.mark.parametrize(("name", "policy"), SCRIPTS)
def test_policies_play_with_robots_absent(name: str, policy: str) -> None:
    task = rsoccer.make_task(name)
    for absent in range(task.n_blue + task.n_yellow):
        teams: Controllers = {"all": "zero", "blue": policy}
        matches = Matches(task, 2, controllers=teams, autoreset="disabled")
        matches.reset(seed=0, rows=starts(task, 2, [absent]).rows)
        for _ in range(5):
            outcome = matches.step(zeros(matches))
        assert np.isfinite(matches.play.actions).all()
        assert np.isfinite(outcome.observations).all()
        assert np.isfinite(outcome.rewards).all()


def acted(task: rsoccer.Task, policy: str, frame: Frame) -> Floats:
    """Actions of the blue robots, as a policy chooses them at the start of a match."""
    controllers: Controllers = {"all": "zero", "blue": policy}
    matches = Matches(task, len(frame), controllers=controllers, autoreset="disabled")
    matches.reset(seed=0, rows=frame.rows)
    matches.step(zeros(matches))
    return matches.play.actions[:, : task.n_blue].copy()


@pytest.mark.parametrize("policy", ["scripted", "chase"])
def test_vss_scripts_ignore_absent_robots(policy: str) -> None:
    # Where an absent teammate or opponent is in the row makes no difference.
    task = VssSelfPlay()
    frame = starts(task, 20, [2, 4])
    actions = acted(task, policy, frame)
    present = frame.copy()
    present.robots.absent[:] = 0.0
    assert not same(acted(task, policy, present)[:, :2], actions[:, :2]), "they matter if present"
    few = rsoccer.make_task("VSSSelfPlay-v0", n_blue=2, n_yellow=2)
    kept = Frame.empty(20, 2, 2)
    kept.ball.data[:] = frame.ball.data
    kept.robots.data[:] = frame.robots.data[:, [0, 1, 3, 5]]
    assert same(acted(few, policy, kept), actions[:, :2])


def test_ssl_scripts_ignore_absent_robots() -> None:
    task = rsoccer.make_task("SSLSelfPlay-v0")
    frame = starts(task, 20, [task.n_blue])
    elsewhere = frame.copy()
    elsewhere.robots.position[:, task.n_blue] = 0.5
    assert same(acted(task, "strike", frame), acted(task, "strike", elsewhere))


def test_a_passer_without_its_teammate_keeps_the_ball() -> None:
    task = rsoccer.make_task("SSLPassEnduranceMulti-v1")
    frame = starts(task, 1, [1])
    ball, robot = frame.ball.position, frame.blue.position
    robot[0, 0], frame.blue.heading[0, 0] = (-2.0, 0.0), (1.0, 0.0)
    reach = task.config.robot.front_distance + task.config.ball.radius
    ball[0] = (-2.0 + reach, 0.0)
    frame.ball.velocity[:] = 0.0
    matches = Matches(task, 1, controllers={"blue": "passer"}, autoreset="disabled")
    matches.reset(seed=0, rows=frame.rows)
    for _ in range(80):
        matches.step(zeros(matches))
        assert matches.play.actions[0, 0, 3] <= 0.0, "no kick at nobody"
    assert np.abs(matches.frame.ball.velocity).max() < 1.0


def test_pictures_leave_absent_robots_out() -> None:
    config = rsoccer.make_task("VSSSelfPlay-v0").config
    frame = starts(VssSelfPlay(), 1, [])
    board = Board()
    everyone = foreground_shapes(config, frame.rows[0], board)
    frame.robots.absent[0, [0, 4]] = 1.0
    without = foreground_shapes(config, frame.rows[0], board)
    assert len(everyone) - len(without) >= 4
    assert set(without) < set(everyone)


def test_the_global_state_of_an_absent_robot_is_zero() -> None:
    for name in ("VSSSelfPlay-v0", "SSLSelfPlay-v0"):
        config = rsoccer.make_task(name).config
        rows = np.random.default_rng(0).uniform(0.1, 0.9, (3, config.row_size)).astype(np.float32)
        frame, encoder = Frame(rows, config.n_blue, config.n_yellow), StateEncoder(config)
        frame.robots.absent[:] = 0.0
        full = encoder.encode(rows)
        frame.robots.absent[1, 2] = 1.0
        states = encoder.encode(rows)
        assert same(states[[0, 2]], full[[0, 2]])
        per_robot = 8 if config.robot.has_mouth else 7
        first = encoder.size - per_robot * (config.n_robots - 2)
        changed = np.flatnonzero(states[1] != full[1])
        assert changed.tolist() == list(range(first, first + per_robot))
        assert not states[1, changed].any()


def test_entities_and_replays_keep_who_is_absent() -> None:
    frame = starts(VssSelfPlay(), 1, [1, 3])
    state = entities.from_frame(frame, 0)
    assert [robot.absent for robot in state.robots_blue.values()] == [False, True, False]
    assert str(state.robots_yellow[0]) == "yellow 0 absent"
    row = entities.to_row(state, 3, 3)
    assert Frame(row[None], 3, 3).robots.absent[0].tolist() == [0, 1, 0, 1, 0, 0]
    stored = quantized.stored_rows(frame.rows)
    steps = quantized.row_steps(6)
    content = quantized.encode("rows", stored, steps)
    read = quantized.rows_of(quantized.decode("rows", content, 1, steps), 3, 3)
    assert same(Frame(read, 3, 3).robots.absent, frame.robots.absent)


def test_a_referee_takes_a_robot_out_and_puts_it_back() -> None:
    task = VssSelfPlay()
    simulator, rows = Simulator(task.config, 2), starts(task, 2, []).rows
    simulator.place(np.ones(2, np.bool_), rows, rows)
    frame, before = Frame(rows, 3, 3), rows.copy()
    mask, robots = np.array([False, True]), np.zeros((1, 6), np.bool_)
    robots[0, 4] = True
    out = rows[1:].copy()
    Frame(out, 3, 3).robots.absent[0, 4] = 1.0
    simulator.reposition_robots(mask, robots, out, rows)
    assert same(rows[0], before[0])
    assert frame.robots.absent[1].tolist() == [0, 0, 0, 0, 1, 0]
    assert same(
        np.delete(frame.robots.data[1], 4, 0), np.delete(Frame(before, 3, 3).robots.data[1], 4, 0)
    )
    simulator.reposition_robots(mask, robots, before[1:], rows)
    assert same(rows, before)
    with pytest.raises(ValueError, match=r"robots must have shape \(1, 6\), got \(1, 5\)"):
        simulator.reposition_robots(mask, robots[:, :5], before[1:], rows)
    with pytest.raises(TypeError, match="robots must be an array of bool"):
        simulator.reposition_robots(mask, robots.astype(np.float32), before[1:], rows)
    simulator.reposition_robots(np.ones(2, np.bool_), np.ones((2, 6), np.bool_), rows, rows)
    assert same(rows, before)


def test_rows_of_a_learner_that_is_absent_are_zeros() -> None:
    task = VssSelfPlay()
    matches = Matches(task, 1, controllers={"all": rsoccer.LEARN}, autoreset="disabled")
    observations = matches.reset(rows=starts(task, 1, [2]).rows)
    assert not observations[0, 2].any()
    assert observations[0, [0, 1, 3, 4, 5]].any(axis=1).all()
    outcome = matches.step(zeros(matches) + 1.0)
    assert outcome.observations[0, 2].any(), "its last action"
    assert not outcome.observations[0, 2, : -task.action_size].any()
    assert outcome.terms["approach"][0, 2] == 0.0
