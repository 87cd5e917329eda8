"""Minari data sets of matches."""

from pathlib import Path

import gymnasium
import numpy as np
import pytest

import rsoccer
from rsoccer import cli
from rsoccer.datasets import record_episodes, save_minari
from tests.simulators import Blind

minari = pytest.importorskip("minari")

TASK = "SSLGoToBall-v0"
NAME = "rsoccer/SSLGoToBall/mixed-v0"


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("MINARI_DATASETS_PATH", str(tmp_path))
    return tmp_path


def test_a_data_set_holds_the_episodes() -> None:
    task = rsoccer.make_task(TASK, max_steps=50)
    episodes = [*record_episodes("fetch", task, 2, 1), *record_episodes("ou", task, 1, 3)]
    save_minari(NAME, episodes, task, author="somebody", description="Mixed skills.")
    read = minari.load_dataset(NAME)
    assert (read.total_episodes, read.total_steps) == (3, sum(map(len, episodes)))
    for episode, part in zip(read.iterate_episodes(), episodes, strict=True):
        assert np.array_equal(episode.observations, part.observations)
        assert np.array_equal(episode.actions, part.actions)
        assert np.allclose(episode.rewards, part.rewards)
        assert episode.terminations[-1] == part.terminated != episode.truncations[-1]
        assert not episode.terminations[:-1].any()
        assert not episode.truncations[:-1].any()
    metadata = list(read.storage.get_episode_metadata(range(3)))
    assert [each["policy"] for each in metadata] == ["fetch", "fetch", "ou"]
    assert [each["seed"] for each in metadata] == [1, 2, 3]
    assert metadata[0]["metric_reached"] == episodes[0].metrics["reached"]
    assert read.storage.metadata["rsoccer_task"] == TASK
    assert read.storage.metadata["algorithm_name"] == "fetch, ou"


def test_the_environment_can_be_made_again_from_a_data_set() -> None:
    save_minari(NAME, record_episodes("fetch", TASK, 1), TASK)
    env = minari.load_dataset(NAME).recover_environment()
    assert env.spec.id == f"rsoccer/{TASK}"
    assert env.observation_space == gymnasium.make(f"rsoccer/{TASK}").observation_space


def test_the_environment_has_the_conditions_of_the_matches() -> None:
    task = rsoccer.make_task("VSS-v0", max_steps=5)
    varied = {"robot.mass": (0.9, 1.1)}
    save_minari(
        NAME,
        record_episodes("ou", task, 2, opponent="zero", sensing="rc2021", randomization=varied),
        task,
    )
    read = minari.load_dataset(NAME)
    matches = read.recover_environment().unwrapped.matches
    assert matches.sensing == rsoccer.Sensing("rc2021")
    assert matches.randomization == {"robot.mass": [0.9, 1.1]}
    (others,) = [group for group in matches.assignment.groups if 3 in group.robots]
    assert type(others.policy).__name__ == "Zero"
    (metadata, _) = read.storage.get_episode_metadata(range(2))
    assert (metadata["opponent"], metadata["sensing"]) == ("zero", "rc2021")
    assert metadata["randomization"] == '{"robot.mass": [0.9, 1.1]}'


def test_matches_that_differ_have_no_common_environment() -> None:
    task = rsoccer.make_task("VSS-v0", max_steps=5)
    episodes = [
        *record_episodes("ou", task, 1, sensing="rc2021"),
        *record_episodes("ou", task, 1, 1),
    ]
    save_minari(NAME, episodes, task)
    assert minari.load_dataset(NAME).env_spec is None


def test_a_sensor_model_that_is_an_object_has_no_environment() -> None:
    task = rsoccer.make_task("VSS-v0", max_steps=5)
    save_minari(NAME, record_episodes("ou", task, 1, sensing=Blind()), task)
    assert minari.load_dataset(NAME).env_spec is None


def test_senses_of_the_environment_are_those_of_the_matches_to_the_last_digit() -> None:
    task = rsoccer.make_task("VSS-v0", max_steps=5)
    sensing = rsoccer.Sensing("rc2021", delay=0.033333333)
    save_minari(NAME, record_episodes("ou", task, 1, sensing=sensing), task)
    matches = minari.load_dataset(NAME).recover_environment().unwrapped.matches
    assert matches.sensing == sensing


def test_discrete_tasks_are_refused() -> None:
    task = rsoccer.make_task("VSS-v0", max_steps=5, discrete=True)
    with pytest.raises(ValueError, match="task: expected continuous actions, got VSS-v0"):
        save_minari(NAME, record_episodes("ou", task, 1), task)


def test_teams_have_no_gymnasium_environment() -> None:
    task = rsoccer.make_task("VSSSelfPlay-v0", max_steps=5)
    save_minari(NAME, record_episodes("chase", task, 1), task)
    read = minari.load_dataset(NAME)
    assert read.total_episodes == 3
    assert read.env_spec is None


def test_wrong_episodes_and_taken_names_are_refused() -> None:
    episodes = record_episodes("fetch", TASK, 1)
    with pytest.raises(ValueError, match="episodes: expected observations and actions of"):
        save_minari(NAME, episodes, "VSS-v0")
    with pytest.raises(ValueError, match="got no episode"):
        save_minari(NAME, [], TASK)
    save_minari(NAME, episodes, TASK)
    with pytest.raises(ValueError, match="dataset_id: expected a new one"):
        save_minari(NAME, episodes, TASK)


def test_the_command_writes_a_data_set(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    options = ["--task", TASK, "--minari", NAME, "--matches", "3", "--threads", "1"]
    folder = tmp_path / "elsewhere"
    folder.mkdir()
    assert cli.main(["record", "fetch", "ou", *options, "--folder", str(folder)]) == 0
    printed = capsys.readouterr().out.splitlines()
    assert printed[0] == NAME
    assert [line.split()[:2] for line in printed[3:]] == [["fetch", "3"], ["ou", "3"]]
    read = minari.load_dataset(NAME)
    assert {each["seed"] for each in read.storage.get_episode_metadata(range(6))} == {*range(6)}
    assert cli.main(["record", "fetch", *options]) == 2
    assert "dataset_id: expected a new one" in capsys.readouterr().err
