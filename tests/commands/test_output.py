"""Files that commands write: refused by the option's name, before anything is played."""

from pathlib import Path

import pytest

from rsoccer import Matches, cli
from rsoccer.commands.output import check_output

OPTIONS = [
    ("evaluate", "json", ""),
    ("evaluate", "html", ".html"),
    ("evaluate", "save", ".rsr"),
    ("tournament", "json", ""),
    ("tournament", "picture", ".png"),
    ("watch", "video", ".mp4"),
    ("watch", "video", ".gif"),
    ("watch", "html", ".html"),
    ("watch", "save", ".rsr"),
]


def refused(
    command: str,
    option: str,
    path: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> str:
    """Return the message of a command that must not play."""
    monkeypatch.setattr(Matches, "__init__", lambda *_, **__: pytest.fail("it played"))
    policies = ["chase", "ou"] if command == "tournament" else ["chase"]
    assert cli.main([command, *policies, f"--{option}", path]) == cli.WRONG_INPUT
    return capsys.readouterr().err


@pytest.mark.parametrize(("command", "option", "suffix"), OPTIONS)
def test_a_folder_is_refused_before_anything_is_played(
    command: str,
    option: str,
    suffix: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Formerly the results of all matches were lost."""
    folder = tmp_path / f"results{suffix}"
    folder.mkdir()
    message = refused(command, option, str(folder), monkeypatch, capsys)
    assert message == f"rsoccer: {option}: expected a file, got {folder}\n"
    assert list(tmp_path.rglob("*")) == [folder]


@pytest.mark.parametrize(("command", "option", "suffix"), OPTIONS)
def test_an_empty_name_and_an_absent_folder_are_refused_before_anything_is_played(
    command: str,
    option: str,
    suffix: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert f"{option}: expected a file, got ." in refused(command, option, "", monkeypatch, capsys)
    absent = str(tmp_path / "absent" / f"results{suffix}")
    message = refused(command, option, absent, monkeypatch, capsys)
    assert f"{option}: expected a file in a folder that exists, got {absent}" in message


def test_files_that_the_system_refuses_are_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with pytest.raises(ValueError, match=r"json: cannot write .*: File name too long"):
        check_output("json", tmp_path / ("n" * 300))

    def refuse(**_: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("rsoccer.files.tempfile.NamedTemporaryFile", refuse)
    with pytest.raises(ValueError, match=r"json: cannot write .*results: Permission denied"):
        check_output("json", tmp_path / "results")


def test_new_and_old_files_pass(tmp_path: Path) -> None:
    file = tmp_path / "results.json"
    check_output("json", file)
    assert not file.exists()
    file.write_text("old")
    check_output("json", file, ".json", ".txt")
    check_output("json", None)
    assert file.read_text() == "old" and list(tmp_path.iterdir()) == [file]
    with pytest.raises(ValueError, match=r"ending in \.txt or \.csv, got"):
        check_output("json", file, ".txt", ".csv")
