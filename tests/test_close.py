"""Each simulator is closed once by the interface or function that makes it, after an error too.

Those of other libraries are in `tests/wrappers`.
"""

import copy
import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pettingzoo
import pytest

import rsoccer
from rsoccer import cli
from rsoccer._core import Threads
from rsoccer.arrays import Floats, Mask
from rsoccer.controllers import Controllers
from rsoccer.human.teams import team_controllers
from rsoccer.recording import film_match, record_match
from rsoccer.replay import ReplayError, record_replay
from rsoccer.replay.evaluation import record_last_match
from tests.closing import PLANTED, TEXT, Closing, LostError, check_closing
from tests.environments import MAKERS, NAME
from tests.train.short_task import tiny

TEAMS: Controllers = {"blue": "chase", "yellow": "ou"}


def play(env: Any) -> None:  # noqa: ANN401
    """Play some steps with actions of zeros, by the interface that the environment has."""
    if isinstance(env, pettingzoo.AECEnv):
        for agent in env.agent_iter(30):
            env.step(np.zeros_like(env.action_space(agent).sample()))
    elif isinstance(env, pettingzoo.ParallelEnv):
        for _ in range(5):
            env.step({agent: np.zeros(2, np.float32) for agent in env.agents})
    else:
        for _ in range(5):
            env.step(np.zeros_like(env.action_space.sample()))


@pytest.mark.parametrize("fails_after", [None, 3])
@pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS)
def test_an_environment_closes_its_simulator_once(
    make: Callable[..., Any], fails_after: int | None
) -> None:
    PLANTED.clear(fails_after)
    env = make(simulator=PLANTED)
    env.reset(seed=0)
    if fails_after is None:
        play(env)
    check_closing(env.close, None if fails_after is None else lambda: play(env))


@pytest.mark.parametrize("begun", [False, True])
@pytest.mark.parametrize("name", ["single", "vector", "robots"])
def test_copies_of_an_environment_close_their_own(name: str, begun: bool) -> None:
    PLANTED.clear()
    env = MAKERS[name](simulator=TEXT)
    if begun:
        env.reset(seed=0)
    for twin in (copy.deepcopy(env), pickle.loads(pickle.dumps(env))):
        twin.close()
    assert PLANTED.closed() == [0] + [1] * (len(PLANTED.made) - 1)
    assert len(PLANTED.made) >= 3
    env.close()
    assert PLANTED.closed() == [1] * len(PLANTED.made)


def evaluate(folder: Path) -> None:
    rsoccer.evaluate("chase", "ou", 6, task=NAME, worlds=2, simulator=TEXT)


def tournament(folder: Path) -> None:
    rsoccer.tournament(["chase", "ou"], 2, task=NAME, simulator=TEXT)


def replay(folder: Path) -> None:
    record_replay(NAME, TEAMS, seconds=0.5, simulator=TEXT)


def last_match(folder: Path) -> None:
    record_last_match("chase", "ou", 2, task=NAME, simulator=TEXT)


def video(folder: Path) -> None:
    pytest.importorskip("pygame")
    record_match(folder / "match.gif", NAME, TEAMS, seconds=0.2, width=96, simulator=TEXT)


def film(folder: Path) -> None:
    pytest.importorskip("pygame")
    images, _ = film_match(NAME, TEAMS, seconds=0.2, width=96, simulator=TEXT)
    assert PLANTED.closed() == [0]
    assert len(list(images)) == 9


def train(folder: Path) -> None:
    pytest.importorskip("torch")
    from rsoccer.train import train

    train(tiny(folder, task=NAME, simulator=TEXT, match_page=True))
    assert len(PLANTED.made) == 5, "one learner, whole teams, the ladder twice, the match"


def session(folder: Path) -> None:
    pytest.importorskip("pygame")
    from rsoccer.human.session import Session

    task = rsoccer.make_task(NAME)
    teams = team_controllers(task, "blue_0", "zero")
    with Session(task, teams, width=96, simulator=TEXT) as opened:
        opened.devices.keyboard.press("w")
        opened.advance(0.2)
        opened.run(0.1)
    assert opened.window.closed


def command(*words: str) -> Callable[[Path], None]:
    """A command of the command line, which raises the errors that its simulator raises."""

    def run(folder: Path) -> None:
        assert cli.main([*words, "--simulator", TEXT, "--save", str(folder / "match.rsr")]) == 0

    return run


PLAYERS: dict[str, Callable[[Path], None]] = {
    **{each.__name__: each for each in (evaluate, tournament, replay, last_match, video, film)},
    **{each.__name__: each for each in (train, session)},
    "rsoccer evaluate": command("evaluate", "chase", "--matches", "2"),
    "rsoccer watch": command("watch", "--seconds", "0.2"),
}


@pytest.mark.parametrize("fails_after", [None, 3])
@pytest.mark.parametrize("player", PLAYERS.values(), ids=PLAYERS)
def test_what_plays_matches_closes_the_simulators_that_it_makes(
    player: Callable[[Path], None],
    fails_after: int | None,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    PLANTED.clear(fails_after)
    if fails_after is None:
        player(tmp_path)
    else:
        with pytest.raises(LostError):
            player(tmp_path)
    assert PLANTED.closed() == [1] * len(PLANTED.made)


def test_a_film_that_is_left_early_closes_its_simulator() -> None:
    pytest.importorskip("pygame")
    for taken in (0, 3):
        PLANTED.clear()
        images, _ = film_match(NAME, TEAMS, width=96, simulator=TEXT)
        for _ in range(taken):
            next(images)
        assert PLANTED.closed() == [0]
        images.close()
        assert PLANTED.closed() == [1]


@pytest.mark.parametrize(
    "record",
    [
        lambda folder: record_replay(NAME, simulator=TEXT),
        lambda folder: record_match(folder / "a.gif", NAME, TEAMS, width=1, simulator=TEXT),
        lambda folder: record_match(folder / "a.txt", NAME, TEAMS, simulator=TEXT),
    ],
    ids=["learners", "width", "suffix"],
)
def test_a_recording_that_is_refused_closes_its_simulator(
    record: Callable[[Path], Any], tmp_path: Path
) -> None:
    pytest.importorskip("pygame")
    PLANTED.clear()
    with pytest.raises(ValueError, match=r"controllers|width|path"):
        record(tmp_path)
    assert PLANTED.closed() == [1]


def test_a_run_that_cannot_begin_closes_its_simulator(tmp_path: Path) -> None:
    pytest.importorskip("torch")
    from rsoccer.train import train

    PLANTED.clear()
    with pytest.raises(ValueError, match="masked_observations"):
        train(tiny(tmp_path, task=NAME, simulator=TEXT, masked_observations=("nothing",)))
    assert PLANTED.closed() == [1]


def test_a_match_that_cannot_be_resumed_closes_its_simulator() -> None:
    PLANTED.clear()
    recorded = record_replay(NAME, TEAMS, seconds=0.1, snapshot_interval=1.0, simulator=TEXT)
    PLANTED.clear()
    with pytest.raises(ReplayError, match="resume: state"):
        recorded.resume(0, controllers={"blue": rsoccer.LEARN, "yellow": "ou"}, simulator=TEXT)
    assert PLANTED.closed() == [1]
    resumed = recorded.resume(0, simulator=TEXT)
    assert PLANTED.closed() == [1, 0], "it is the caller's"
    resumed.close()
    assert PLANTED.closed() == [1, 1]


def test_a_simulator_that_is_given_itself_is_its_owners() -> None:
    task = rsoccer.make_task(NAME, max_steps=20)
    own = Closing(task.config, 1, Threads(1))
    rsoccer.evaluate("chase", "ou", 2, task=task, worlds=1, simulator=own)
    record_replay(task, TEAMS, seconds=0.1, simulator=own)
    record_last_match("chase", "ou", 2, task=task, simulator=own)
    assert own.closed == 0
    rsoccer.Matches(task, simulator=own).close()
    assert own.closed == 1


class StepOnly:
    """A simulator that neither places bodies nor reads their state."""

    closed = 0

    def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> None:
        raise AssertionError("it is refused")

    def close(self) -> None:
        self.closed += 1


def test_matches_that_refuse_their_simulator_close_it_if_they_made_it() -> None:
    made = StepOnly()
    with pytest.raises(TypeError, match="StepOnly with neither"):
        rsoccer.Matches(NAME, simulator=lambda config, worlds, threads: made)
    assert made.closed == 1
    given = StepOnly()
    with pytest.raises(TypeError, match="StepOnly with neither"):
        rsoccer.Matches(NAME, simulator=given)
    assert given.closed == 0


def test_matches_that_refuse_other_arguments_make_no_simulator() -> None:
    PLANTED.clear()
    with pytest.raises(TypeError, match="sensing"):
        rsoccer.Matches(NAME, simulator=PLANTED, sensing=3)  # type: ignore[arg-type]  # wrong
    assert not PLANTED.made
