"""The folder of a run: one process at a time, and files of earlier runs."""

import shutil
from pathlib import Path

import pytest

from rsoccer.policies.network import Network
from rsoccer.registry import make_task
from rsoccer.train import Args, OpponentSettings, train
from rsoccer.train.run import checkpoint
from rsoccer.train.run import folder as folder_module
from rsoccer.train.run.folder import MATCH_FILES, opened, policy_digests
from tests.policies.networks import network_for
from tests.train.runs import digest, progress
from tests.train.short_task import NAME, tiny


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}


def test_a_run_without_its_checkpoint_is_not_replaced(finished: Path, tmp_path: Path) -> None:
    folder = tmp_path / "copy"
    shutil.copytree(finished, folder)
    (folder / checkpoint.FILE_NAME).unlink()
    before = contents(folder)
    with pytest.raises(
        ValueError, match=r"out: .*copy holds a run \(policy.safetensors, args.json"
    ):
        train(tiny(folder))
    assert before == {name: text for name, text in contents(folder).items() if name in before}


def test_a_second_process_is_kept_out(finished: Path, tmp_path: Path) -> None:
    folder = tmp_path / "copy"
    shutil.copytree(finished, folder)
    before = digest(folder)
    for changes in ({"resume": True}, {"overwrite": True}):
        with (
            opened(tiny(folder, resume=True), {}),
            pytest.raises(ValueError, match="out: another process trains in"),
        ):
            train(tiny(folder, **changes))
    assert digest(folder) == before
    with opened(tiny(folder, resume=True), {}) as saved:
        assert saved is not None


def test_overwriting_removes_the_match_of_the_earlier_policy(tmp_path: Path) -> None:
    for name in MATCH_FILES:
        (tmp_path / name).touch()
    with opened(tiny(tmp_path, overwrite=True), {}) as saved:
        assert saved is None
    assert not any((tmp_path / name).exists() for name in MATCH_FILES)


def test_a_run_that_overwrites_another_equals_a_new_one(finished: Path, tmp_path: Path) -> None:
    """Also where the earlier one has another seed and no match of its policy."""
    train(tiny(tmp_path, seed=5))
    assert digest(tmp_path) != digest(finished)
    train(tiny(tmp_path, overwrite=True))
    assert digest(tmp_path) == digest(finished)
    assert progress(tmp_path) == progress(finished)


@pytest.mark.parametrize("content", [None, "{", "{}"])
def test_the_error_says_that_the_settings_of_a_run_are_lost(
    content: str | None, finished: Path, tmp_path: Path
) -> None:
    shutil.copytree(finished, tmp_path, dirs_exist_ok=True)
    settings = tmp_path / "args.json"
    settings.unlink()
    if content is not None:
        settings.write_text(content)
    with pytest.raises(ValueError, match=r"other settings: .*args.json beside it is missing or"):
        train(tiny(tmp_path, resume=True, seed=9))


def test_another_policy_at_the_same_path_is_refused(tmp_path: Path) -> None:
    opponent, task = tmp_path / "opponent.safetensors", make_task(NAME)
    network_for(task).save(opponent)
    args = {"fixed": {f"{opponent}:mean": 1.0, "ou": 1.0}}
    folder = tmp_path / "run"
    train(tiny(folder, **args))
    assert list(policy_digests(tiny(folder, **args))) == [f"{opponent}:mean"]
    train(tiny(folder, resume=True, **args))
    other = Network.load(opponent)
    other.metadata["clip"] = "5"
    other.save(opponent)
    with pytest.raises(ValueError, match=r"other policies: the content of .*opponent.safetensors"):
        train(tiny(folder, resume=True, **args))


def test_a_checkpoint_that_names_no_policies_can_be_resumed(finished: Path, tmp_path: Path) -> None:
    saved = checkpoint.load(finished / checkpoint.FILE_NAME)
    del saved.info["policy_files"]
    checkpoint.save(tmp_path / checkpoint.FILE_NAME, saved)
    with opened(tiny(tmp_path, resume=True), {"opponent.safetensors": "a digest"}) as found:
        assert found is not None


@pytest.mark.parametrize("option", ["opponent", "teammates"])
def test_a_policy_in_an_option_of_the_task_counts(option: str, tmp_path: Path) -> None:
    path = tmp_path / "policy.safetensors"
    network_for(make_task("VSS-v0")).save(path)
    args = Args("VSS-v0", task_options={option: str(path)})
    assert list(policy_digests(args)) == [str(path)]


def test_a_file_with_the_name_of_a_policy_of_the_package_does_not_count(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("ou").touch()
    assert (
        policy_digests(
            Args("VSS-v0", opponents=OpponentSettings(fixed={"ou": 1.0, "best:mean": 1.0}))
        )
        == {}
    )


def test_a_system_without_locks_trains(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(folder_module, "fcntl", None)
    with opened(tiny(tmp_path), {}) as saved:
        assert saved is None
