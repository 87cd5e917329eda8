"""Files of an earlier run in the folder of a run: what continues, and what starts again."""

from pathlib import Path

import pytest

from benches.learning import conditions
from benches.learning.experiments import Experiment, Run
from benches.learning.run_files import Folders
from benches.learning.running import algorithms
from benches.learning.running.clock import spent
from benches.learning.running.workplace import IDENTITY_FILE
from rsoccer.train.run import checkpoint
from tests.benches.learning.tiny_table import TINY

pytest.importorskip("torch")


def learn(folder: Path, **changes: float) -> tuple[int, float]:
    """Run in a folder with changed settings; return the samples and the number of attempts."""
    task = "SSLGoToBall-v0"
    experiment = Experiment("ppo", task, task, settings={**TINY, **changes})
    run, folders = Run(experiment, 0), Folders(folder, folder)
    learned = algorithms.learn(run, folder, folders, conditions.conditions(run, folders))
    return learned.samples, spent(folder)["attempts"]


def test_a_checkpoint_of_the_same_settings_continues(tmp_path: Path) -> None:
    assert learn(tmp_path) == (600, 1)
    assert learn(tmp_path) == (600, 2)


@pytest.mark.parametrize(
    ("changes", "samples"),
    [({"samples": 400}, 400), ({"samples": 800}, 800), ({"ppo.gamma": 0.9}, 600)],
)
def test_other_settings_start_again(
    changes: dict[str, float], samples: int, tmp_path: Path
) -> None:
    learn(tmp_path)
    assert learn(tmp_path, **changes) == (samples, 1)


def test_another_observation_starts_again(tmp_path: Path) -> None:
    learn(tmp_path)
    path = tmp_path / IDENTITY_FILE
    identity = path.read_text()
    path.write_text(identity.replace('"observation": "', '"observation": "more 4, '))
    assert path.read_text() != identity
    assert learn(tmp_path) == (600, 1)


def test_a_checkpoint_that_cannot_be_read_starts_again(tmp_path: Path) -> None:
    learn(tmp_path)
    path = tmp_path / checkpoint.FILE_NAME
    path.write_bytes(path.read_bytes()[:100])
    assert learn(tmp_path)[0] == 600
    assert checkpoint.load(path).info["samples"] == 600
