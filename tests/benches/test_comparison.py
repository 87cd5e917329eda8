import re
import subprocess
from pathlib import Path
from typing import Any

import pytest

from benches import comparison
from benches.comparison import Case, Ratio, Stepper, built, cases, compare, row
from benches.result_files import ROOT

PACKAGE = ROOT / "python"


@pytest.mark.parametrize(
    ("interface", "task", "worlds"),
    [
        ("Matches", "SSLGoToBall-v0", 3),
        ("single_env", "SSLGoToBall-v0", 1),
        ("parallel_env", "VSSSelfPlay-v0", 1),
        ("env", "VSSSelfPlay-v0", 1),
        ("Simulator", "SSL 1 v 1 crowd", 2),
    ],
)
def test_every_interface_is_stepped_over_the_end_of_an_episode(
    interface: str, task: str, worlds: int
) -> None:
    with Stepper(PACKAGE, Case(interface, task, worlds)) as stepper:
        assert stepper.imported == PACKAGE / "rsoccer/__init__.py"
        assert 0.0 < stepper.seconds(1) < stepper.seconds(1300)


def test_a_process_that_fails_is_an_error(capfd: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(RuntimeError, match="a process ended with status 1"):
        compare(PACKAGE, PACKAGE, Case("Matches", "Curling-v0", 1), 1)
    assert "Curling-v0" in capfd.readouterr().err


def test_the_median_has_an_interval_that_few_outliers_do_not_move() -> None:
    assert Ratio.of([1.0]) == Ratio(1.0, 1.0, 1.0)
    ratios = [1.0 + i / 100 for i in range(99)] + [50.0]
    found = Ratio.of(ratios[::-1])
    assert (found.median, found.low, found.high) == pytest.approx((1.495, 1.4, 1.59))


def test_a_row_has_the_speed_relative_to_before() -> None:
    cells = row(Case("Matches", "VSS-v0", 64), [2e-4, 2e-4], [1e-4, 1.6e-4])
    assert cells == ("Matches", "VSS-v0", "64", "200", "130", "1.625 (1.250 to 2.000)")


def test_cases_have_the_interfaces_that_fit_the_task() -> None:
    titles = {case.title for case in cases(PACKAGE)}
    assert {"Matches, VSS-v0, 512", "single_env, VSS-v0, 1", "env, VSSMulti-v0, 1"} <= titles
    assert "Simulator, VSSS 3 v 3 random, 256" in titles
    assert not {"single_env, VSSMulti-v0, 1", "parallel_env, VSS-v0, 1"} & titles


def test_both_versions_are_compared(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(comparison, "built", lambda _: ROOT)
    monkeypatch.setattr(comparison, "TURN", 0.001)
    comparison.main(["HEAD", "--only", "Matches, SSLGoToBall-v0, 1", "--rounds", "2"])
    table = capsys.readouterr().out.splitlines()
    assert len(table) == 3
    assert re.fullmatch(
        r"\| Matches \| SSLGoToBall-v0 \| 1 \| [\d.,]+ \| [\d.,]+ "
        r"\| [\d.]+ \([\d.]+ to [\d.]+\) \|",
        table[2],
    )


def test_an_earlier_version_is_built_once(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(comparison, "FOLDER", tmp_path)
    run = subprocess.run
    builds = []

    def without_build(command: list[str], **options: Any) -> Any:  # noqa: ANN401
        if command[0] == "git":
            return run(command, **options)
        builds.append(command)
        (tmp_path / commit / "python/rsoccer/_core.abi3.so").touch()
        return None

    named = run(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, capture_output=True, text=True)
    commit = named.stdout.strip()
    monkeypatch.setattr(subprocess, "run", without_build)
    for _ in range(2):
        assert built("HEAD") == tmp_path / commit
    assert (tmp_path / commit / "Cargo.toml").exists()
    assert len(builds) == 1


@pytest.mark.parametrize("arguments", [["no-such-commit"], ["HEAD", "--rounds", "0"]])
def test_bad_arguments_are_refused(arguments: list[str]) -> None:
    with pytest.raises(SystemExit):
        comparison.main(arguments)
