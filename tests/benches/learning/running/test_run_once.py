import json
import shutil
from pathlib import Path

import pytest

from benches.learning import conditions
from benches.learning.__main__ import main
from rsoccer.train import PpoSettings

TABLE = "tests.benches.learning.tiny_table"


@pytest.fixture(scope="module")
def folders(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    """Options with the folders of a study whose first seeds of VSS-v0 are finished."""
    folder = tmp_path_factory.mktemp("study")
    options = ["--table", TABLE, "--results", f"{folder}/results", "--work", f"{folder}/work"]
    assert main([*options, "--only", "ppo/VSS-v0", "--seeds", "1", "--jobs", "1"]) == 0
    return options


def result_of(options: list[str], key: str) -> Path:
    return Path(options[3]) / "runs" / f"{key}.json"


def test_a_run_leaves_its_result_and_its_policy(folders: list[str]) -> None:
    result = json.loads(result_of(folders, "ppo/VSS-v0/seed-0").read_text())
    assert result["samples"] == 600
    assert result["settings"]["network.hidden_sizes"] == [8]
    assert result["seconds"]["cpu"] > 0
    modes = [(row["opponent"], row["mode"], row["matches"]) for row in result["evaluations"]]
    assert modes == [(name, mode, 4) for name in ("ou", "zero") for mode in ("sample", "mean")]
    assert (Path(folders[5]) / "ppo/VSS-v0/seed-0/policy.safetensors").is_file()


def test_the_list_shows_finished_and_open_runs(
    folders: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*folders, "--list", "--group", "ppo", "--jobs", "2"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[:2] for line in lines[:3]] == [
        ["ppo/VSS-v0/seed-0", "done"],
        ["ppo/SSLGoToBall-v0/seed-0", "open"],
        ["ppo/VSS-v0/seed-1", "open"],
    ]
    assert lines[3].startswith("1 done, 2 open; ")


def test_the_best_run_is_named_with_its_policy(
    folders: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*folders, "--best", "--group", "ppo"]) == 0
    name, _, path = capsys.readouterr().out.split()
    assert name == "ppo/VSS-v0/seed-0"
    assert Path(path).is_file()


def test_clones_are_evaluated_against_the_policy_of_their_seed(folders: list[str]) -> None:
    assert main([*folders, "--only", "clones", "--jobs", "1"]) == 0
    result = json.loads(result_of(folders, "cooperation/clones/seed-0").read_text())
    assert result["samples"] == 0
    assert [row["opponent"] for row in result["evaluations"]] == ["@ppo/VSS-v0"] * 2


def test_a_finished_run_is_not_repeated(
    folders: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    path = result_of(folders, "ppo/VSS-v0/seed-0")
    before = path.read_bytes()
    assert main([*folders, "--only", "ppo/VSS-v0", "--seeds", "1"]) == 0
    assert path.read_bytes() == before
    assert capsys.readouterr().out.startswith("nothing to do")


def test_a_finished_run_is_repeated_where_its_policy_is_missing(
    folders: list[str], capfd: pytest.CaptureFixture[str]
) -> None:
    policy = Path(folders[5]) / "ppo/VSS-v0/seed-0/policy.safetensors"
    weights = policy.read_bytes()
    again = [*folders, "--again", "--only", "ppo/VSS-v0", "--seeds", "1", "--jobs", "1"]
    assert main(again) == 0
    assert "nothing to do" in capfd.readouterr().out
    shutil.rmtree(policy.parent)
    assert main([*folders, "--only", "cooperation/clones", "--jobs", "1", "--list"]) == 0
    assert main(again) == 0
    assert "the same evaluations as in the earlier result" in capfd.readouterr().out
    assert policy.read_bytes() == weights


def test_a_finished_run_is_not_repeated_without_its_library(
    folders: list[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr(conditions, "find_spec", lambda _: None)
    options = [*folders[:4], "--work", f"{tmp_path}/work", "--only", "ppo/VSS-v0", "--seeds", "1"]
    assert main([*options, "--again", "--jobs", "1"]) == 0
    printed = capsys.readouterr()
    assert printed.err == "unavailable: ppo/VSS-v0/seed-0: torch is not installed\n"
    assert printed.out.startswith("nothing to do")


def test_runs_that_need_others_say_so(
    folders: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    options = [*folders[:2], "--results", f"{tmp_path}/results", "--work", f"{tmp_path}/work"]
    assert main([*options, "--only", "cooperation/clones"]) == 0
    needed = "not started: cooperation/clones/seed-0 needs ppo/VSS-v0/seed-0"
    assert needed in capsys.readouterr().out


def test_a_selection_without_runs_is_refused(
    folders: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    for options in (["--only", "typo"], ["--group", "typo"]):
        assert main([*folders, *options]) == 2
        assert "expected a run of the study, got none" in capsys.readouterr().err


WRONG = {
    "misspelt": "'gama'",
    "unknown": "'VSS-v9'",
    "dependent": "needs a/misspelt/seed-0",
    "mask": "expected blocks of",
    "rows": "rows must be an integer, got 'x'",
}


@pytest.mark.parametrize("only", WRONG)
def test_experiments_with_wrong_settings_are_named(
    only: str, folders: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    table = ["--table", "tests.benches.learning.wrong_table"]
    assert main([*table, *folders[2:], "--only", only]) == 1
    printed = capsys.readouterr()
    assert f"invalid: a/{only}/seed-0: " in printed.err
    assert WRONG[only] in printed.err
    assert main([*table, *folders[2:], "--list"]) == 0
    assert f"{len(WRONG)} invalid; 0.0 core-hours left" in capsys.readouterr().out


@pytest.mark.parametrize("table", ["no_such_module", "json"])
def test_a_table_without_a_study_is_refused(
    table: str, folders: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["--table", table, *folders[2:], "--list"]) == 2
    assert f"--table: expected a module with a STUDY, got {table}" in capsys.readouterr().err


@pytest.mark.parametrize("text", ["{", "[]", "{}"])
def test_a_damaged_result_is_named(
    text: str, folders: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    path = result_of(folders, "ppo/VSS-v0/seed-0")
    before = path.read_text()
    path.write_text(text)
    try:
        assert main([*folders, "--list"]) == 2
        assert f"{path} is damaged" in capsys.readouterr().err
    finally:
        path.write_text(before)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--jobs", "0"], "--jobs must be at least 1, got 0"),
        (["--seeds", "0"], "--seeds must be at least 1, got 0"),
        (["--budget-minutes", "nan"], "--budget-minutes must be at least 0.0, got nan"),
        (["--report"], "--report writes the pages of this study"),
    ],
)
def test_wrong_options_are_refused(
    folders: list[str], options: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit):
        main([*folders, *options])
    assert message in capsys.readouterr().err


def test_changed_settings_make_a_run_stale(
    folders: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    path = result_of(folders, "ppo/VSS-v0/seed-0")
    before = path.read_text()
    path.write_text(before.replace(f'"ppo.gamma": {PpoSettings.gamma}', '"ppo.gamma": 0.9'))
    try:
        main([*folders, "--list", "--only", "VSS-v0/seed-0"])
        assert f"stale  ppo.gamma was 0.9, now {PpoSettings.gamma}" in capsys.readouterr().out
        assert main([*folders, "--only", "VSS-v0/seed-0"]) == 0
        printed = capsys.readouterr().out
        assert "stale, kept as it is: ppo/VSS-v0/seed-0" in printed
        assert "start" not in printed
    finally:
        path.write_text(before)
