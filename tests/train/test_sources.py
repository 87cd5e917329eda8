"""Runs with a simulator and a sensor model of one's own, named by texts."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rsoccer import Matches, Sensing, SimConfig, Simulator
from rsoccer._core import Threads
from rsoccer.policies.network import Network
from rsoccer.replay import Replay
from rsoccer.train import Args, train
from rsoccer.train.clock import Clock, TimedSimulator
from rsoccer.train.run.loop import Loop
from rsoccer.train.run.trainer import Trainer
from tests.simulators import BLIND, Blind, Still, still
from tests.test_simulator_interface import Frozen
from tests.train.short_task import tiny

NAMED = {"simulator": "tests.simulators:still", "sensing": "tests.simulators:Blind"}


def test_the_matches_of_a_run_have_the_simulator_and_the_senses(tmp_path: Path) -> None:
    trainer = Trainer(tiny(tmp_path, **NAMED))
    for matches in (trainer.curriculum.solo(3), trainer.curriculum.team(3)):
        matches.reset()
        before = matches.frame.robots.position.copy()
        for _ in range(5):
            matches.step(np.ones((matches.worlds, len(matches.agents), 2), np.float32))
        np.testing.assert_allclose(matches.frame.robots.position, before, atol=0.02)
        assert not matches.play.sensed.ball.position.any()


def test_the_ladder_is_measured_with_both(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    used: list[Any] = []
    monkeypatch.setattr("rsoccer.matches.loop.make_simulator", lambda *given: _noted(used, given))
    monkeypatch.setattr(
        "rsoccer.matches.loop.make_sensing", lambda given: _noted_blind(used, given)
    )
    trainer = Trainer(tiny(tmp_path, **NAMED))
    used.clear()
    Loop(trainer, {}).ladder.measure(trainer.network())
    assert sorted(used) == sorted(NAMED.values()), "each of them once"


def test_the_match_of_the_policy_is_played_with_both(tmp_path: Path) -> None:
    train(tiny(tmp_path, samples=1, match_page=True, **NAMED))
    replay = Replay.load(tmp_path / "match.rsr")
    assert np.abs(replay.commands).max() > 1.0
    first = replay.frame.robots.position[: replay.episodes[0].stop]
    assert len(first) > 5
    assert np.abs(first - first[0]).max() < 0.02


def test_the_policy_file_notes_senses_and_varied_numbers(tmp_path: Path) -> None:
    conditions = {"sensing": "vsss", "randomization": {"robot.mass": (0.9, 1.1)}}
    train(tiny(tmp_path, samples=1, **conditions))
    network = Network.load(tmp_path / "policy.safetensors")
    assert network.sensing == Sensing("vsss")
    assert network.randomization == {"robot.mass": [0.9, 1.1]}
    assert Trainer(tiny(tmp_path, **NAMED)).network().sensing == NAMED["sensing"]
    assert "sensing" not in Trainer(tiny(tmp_path)).network().metadata


def _noted(used: list[Any], given: Any) -> Still:  # noqa: ANN401
    used.append(given[0])
    return Still(*given[1:])


def _noted_blind(used: list[Any], given: Any) -> Blind:  # noqa: ANN401
    used.append(given)
    return Blind()


def test_a_run_resumes_with_the_same_texts_only(tmp_path: Path) -> None:
    train(tiny(tmp_path, samples=1, **NAMED))
    for name in NAMED:
        with pytest.raises(ValueError, match=f"{name} was 'tests.simulators:.*', now None"):
            train(tiny(tmp_path, resume=True, **{**NAMED, name: None}))
    train(tiny(tmp_path, resume=True, **NAMED))


@pytest.mark.parametrize(
    ("name", "given"), [("simulator", still), ("sensing", BLIND), ("sensing", Blind)]
)
def test_what_json_cannot_hold_is_refused(name: str, given: Any) -> None:  # noqa: ANN401
    with pytest.raises(ValueError, match=f"^{name} must be a text, by which a resumed"):
        Args(**{name: given})


def test_a_text_that_names_nothing_is_refused() -> None:
    for name in NAMED:
        with pytest.raises(ImportError, match=f"^{name}: .* has no 'missing'"):
            Args(**{name: "tests.simulators:missing"})  # type: ignore[arg-type]
    with pytest.raises(TypeError, match=r"^sensing: expected a"):
        Args(sensing="tests.simulators:NOTHING")


def test_a_timed_simulator_can_do_what_the_simulator_can() -> None:
    clock, frozen = Clock(), Frozen()
    timed = TimedSimulator(frozen, clock)
    rows = np.zeros((1, 3), np.float32)
    timed.step(rows, out=rows)
    assert frozen.calls == ["step"]
    assert clock.seconds["physics"] > 0.0
    assert not hasattr(timed, "snapshot")


@pytest.mark.parametrize(("made", "expected"), [(Simulator, 0), (still, 1)])
def test_rows_are_checked_of_a_timed_simulator_that_does_not_check_them_itself(
    made: Any,  # noqa: ANN401  (a class or a function)
    expected: int,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    checked: list[str] = []
    monkeypatch.setattr("rsoccer.checks.rows", lambda source, _: checked.append(source))

    def timed(config: SimConfig, worlds: int, threads: Threads) -> TimedSimulator:
        return TimedSimulator(made(config, worlds, threads), Clock())

    matches = Matches("VSSSelfPlay-v0", 2, simulator=timed)
    matches.reset()
    checked.clear()
    matches.step(np.zeros((2, len(matches.agents), 2), np.float32))
    assert checked == ["TimedSimulator.step"] * expected
