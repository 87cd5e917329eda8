"""The folder of a run: the match at its end, and refused settings and files."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from rsoccer.lineup import lineup
from rsoccer.policies.network import Network
from rsoccer.registry import make_task
from rsoccer.replay import Replay, record_replay
from rsoccer.train import PpoSettings, train
from rsoccer.train.run import checkpoint, training
from rsoccer.train.run.folder import POLICY_FILE
from rsoccer.train.run.loop import Loop
from rsoccer.train.run.stop_signal import Stopped
from rsoccer.train.run.trainer import Trainer
from tests.simulators import Elsewhere
from tests.train.runs import StopAfter, digest, progress
from tests.train.short_task import NAME, TINY, tiny


def test_a_run_ends_with_a_match_of_its_policy(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(training, "MATCH_SECONDS", 2.0)
    policy = train(tiny(tmp_path, match_page=True))
    replay = Replay.load(tmp_path / "match.rsr")
    assert (replay.task, replay.seconds, replay.names) == (NAME, 2.0, ("TRAINED", "OU"))
    assert (tmp_path / "match.html").read_text() == replay.to_html()
    rows = record_replay(NAME, lineup(make_task(NAME), str(policy)), seconds=2.0).rows
    np.testing.assert_allclose(replay.rows, rows, atol=0.06)


def test_the_match_at_the_end_has_no_options_for_training_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(training, "MATCH_SECONDS", 0.1)
    options = {"max_steps": 20, "reward_weights": {"goal": 3.0}}
    train(tiny(tmp_path, match_page=True, samples=1, task_options=options))
    replay = Replay.load(tmp_path / "match.rsr")
    assert replay.options == {"max_steps": 20}


def test_a_folder_with_a_run_is_not_overwritten_by_default(finished: Path) -> None:
    before = digest(finished)
    with pytest.raises(ValueError, match="holds a run"):
        train(tiny(finished))
    assert digest(finished) == before


def test_resuming_needs_a_checkpoint(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="does not exist"):
        train(tiny(tmp_path / "run", resume=True))
    assert not (tmp_path / "run").exists()


def test_resuming_with_other_settings_is_refused(finished: Path) -> None:
    with pytest.raises(ValueError, match=f"ppo.gamma was {PpoSettings.gamma}, now 0.9"):
        train(tiny(finished, resume=True, gamma=0.9))
    with pytest.raises(ValueError, match="task was 'ShortSelfPlay-v0', now 'VSSMulti-v0'"):
        train(tiny(finished, resume=True, task="VSSMulti-v0"))


@pytest.mark.parametrize("missing", ["model.log_std", "worlds.simulator", "run.generator"])
def test_an_incomplete_checkpoint_is_refused(missing: str, finished: Path, tmp_path: Path) -> None:
    saved = checkpoint.load(finished / checkpoint.FILE_NAME)
    del saved.arrays[missing]
    checkpoint.save(tmp_path / checkpoint.FILE_NAME, saved)
    with pytest.raises(ValueError, match="does not fit"):
        train(tiny(tmp_path, resume=True))


def test_matches_that_cannot_be_saved_begin_again(tmp_path: Path) -> None:
    settings = {"simulator": "tests.simulators:Elsewhere", "samples": 2 * 6 * 3 * 8}
    train(tiny(tmp_path, **settings))
    saved = checkpoint.load(tmp_path / checkpoint.FILE_NAME)
    parts = {name.partition(".")[0] for name in saved.arrays}
    assert "model" in parts
    assert "worlds" not in parts
    train(tiny(tmp_path, **{**settings, "samples": TINY["samples"], "resume": True}))
    assert len(progress(tmp_path)) == 6


@pytest.mark.parametrize(
    "error", [ConnectionError("nobody answers"), RuntimeError("all commands are refused")]
)
def test_a_run_is_saved_when_robots_fail(
    error: Exception, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Elsewhere, "left", 60)
    monkeypatch.setattr(Elsewhere, "error", error)
    settings = {"simulator": "tests.simulators:Elsewhere", "ladder_interval": 0}
    with pytest.raises(type(error), match=str(error)):
        train(tiny(tmp_path, **settings))
    saved = checkpoint.load(tmp_path / checkpoint.FILE_NAME)
    assert saved.info["updates"] == len(progress(tmp_path)) == 2
    weights = Network.load(tmp_path / POLICY_FILE).layers[0][0]
    np.testing.assert_array_equal(weights.ravel(), saved.arrays["model.actor.0.weight"].ravel())
    with pytest.raises(type(error), match=str(error)):  # not: the checkpoint does not fit
        train(tiny(tmp_path, **settings, resume=True))
    monkeypatch.setattr(Elsewhere, "left", math.inf)
    train(tiny(tmp_path, **settings, resume=True))
    assert len(progress(tmp_path)) == 6


def test_a_signal_saves_a_run_whose_robots_have_gone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Gone(StopAfter):
        def check(self) -> None:
            try:
                super().check()
            except Stopped:
                Elsewhere.left = -1  # the signal has ended the simulator, too
                raise

    monkeypatch.setattr(Elsewhere, "left", math.inf)
    args = tiny(tmp_path, simulator="tests.simulators:Elsewhere", ladder_interval=0)
    with pytest.raises(Stopped):
        Loop(Trainer(args), {}).run(Gone(40), 0)
    saved = checkpoint.load(tmp_path / checkpoint.FILE_NAME)
    assert saved.info["updates"] == len(progress(tmp_path)) > 0


def test_a_run_that_goes_on_elsewhere_begins_with_other_episodes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    starts: list[bytes] = []
    monkeypatch.setattr(Elsewhere, "starts", starts)
    settings = {"simulator": "tests.simulators:Elsewhere", "ladder_interval": 0}
    update = 6 * 3 * 8
    train(tiny(tmp_path, **settings, samples=update, solo_fraction=0.0))
    first = len(starts)
    for updates in (2, 3):
        more = {"samples": updates * update, "resume": True, "solo_fraction": 0.0}
        train(tiny(tmp_path, **settings, **more))
    assert len(starts) > first > 1
    # A new run and each that resumes put bodies once before the checkpoint is read.
    again = [start for start in starts[1:first] if start in starts[first:]]
    assert not again


def test_a_team_learns_where_one_match_is_played(tmp_path: Path) -> None:
    settings = {"simulator": "tests.simulators:OneMatch", "worlds": 1, "samples": 3 * 8 * 3}
    train(tiny(tmp_path, **settings))
    assert [row["samples"] for row in progress(tmp_path)] == ["24", "48", "72"]
    with pytest.raises(ValueError, match=r"rollout\.worlds: expected 1 with the simulator"):
        tiny(tmp_path, **{**settings, "worlds": 2})


@pytest.mark.parametrize("info", ["[]", "{}", '{"args": 3, "log_size": 0}', '{"args": {}}'])
def test_a_checkpoint_without_its_settings_is_refused(
    info: str, finished: Path, tmp_path: Path
) -> None:
    saved = checkpoint.load(finished / checkpoint.FILE_NAME)
    wrong = checkpoint.Checkpoint(saved.arrays, json.loads(info))
    checkpoint.save(tmp_path / checkpoint.FILE_NAME, wrong)
    with pytest.raises(ValueError, match="is damaged or not a checkpoint"):
        train(tiny(tmp_path, resume=True))


def test_an_unwritable_folder_is_refused_before_training(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(ValueError, match="out must be a folder to write in"):
        train(tiny(tmp_path / "file" / "run"))


def test_an_unknown_task_is_refused_with_the_valid_ones(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="VSSSelfPlay-v0"):
        train(tiny(tmp_path, task="Chess-v0"))
