"""Contact engines by option: equal interfaces, equal promises, different solvers."""

import pickle

import numpy as np
import pytest

import rsoccer
from rsoccer import Matches, SimConfig
from rsoccer._core import Simulator
from rsoccer.arrays import Floats
from rsoccer.testing.pressure import Pressing

TASKS = ["VSSSelfPlay-v0", "SSLSelfPlay-v0"]
STEPS = 60


def rows(task: rsoccer.Task, worlds: int, seed: int, threads: int = 1) -> Floats:
    """State rows (worlds, row) after robots have pushed at the ball."""
    matches, pressing = Matches(task, worlds, seed, threads), Pressing(task, seed=0)
    matches.reset()
    for _ in range(STEPS):
        matches.step(pressing.actions(matches))
    return matches.frame.rows.copy()


@pytest.mark.parametrize("name", TASKS)
def test_engines_play_out_differently_where_robots_push(name: str) -> None:
    reference = rows(rsoccer.make_task(name), 4, 1)
    compact = rows(rsoccer.make_task(name, engine="compact"), 4, 1)
    assert np.isfinite(compact).all()
    assert not np.array_equal(compact, reference)


@pytest.mark.parametrize("name", TASKS)
def test_a_row_of_a_batch_equals_a_single_world(name: str) -> None:
    task = rsoccer.make_task(name, engine="compact")
    assert np.array_equal(rows(task, 5, 3), rows(task, 5, 3, threads=2))
    for config in (task.config, pickle.loads(pickle.dumps(task.config))):
        batch, alone = Simulator(config, 5), Simulator(config, 1)
        commands = np.ones((5, config.n_robots, len(config.command_columns)), np.float32)
        start = Matches(task, 5, 3)
        start.reset()
        out, single = start.frame.rows.copy(), start.frame.rows[4:].copy()
        batch.place(np.ones(5, np.bool_), start.frame.rows, out)
        alone.place(np.ones(1, np.bool_), start.frame.rows[4:], single)
        for _ in range(STEPS):
            batch.step(commands, out)
            alone.step(commands[:1], single)
        assert np.array_equal(out[4:], single)


@pytest.mark.parametrize("name", TASKS)
def test_saved_matches_continue_exactly_and_only_with_their_engine(name: str) -> None:
    task = rsoccer.make_task(name, engine="compact")
    first, second = Matches(task, 3, 0), Matches(task, 3, 9)
    for matches in (first, second):
        matches.reset()
    actions = np.ones((3, len(first.agents), first.action_size), np.float32)
    first.step(actions)
    second.load_state_dict(first.state_dict())
    for _ in range(STEPS):
        first.step(actions)
        second.step(actions)
    assert np.array_equal(first.frame.rows, second.frame.rows)
    with pytest.raises(ValueError, match="configuration"):
        Matches(name, 3).load_state_dict(first.state_dict())


def test_the_default_is_the_reference() -> None:
    assert SimConfig().engine == rsoccer.make_task("VSS-v0").config.engine == "compact"
    assert SimConfig() != SimConfig(engine="compact")
    with pytest.raises(ValueError, match='engine must be "rapier" or "compact", got "box2d"'):
        SimConfig(engine="box2d")
