import json
import shutil
import subprocess
from pathlib import Path

import pytest

from tools import measure_coverage
from tools.measure_coverage import LlvmTools, counting, made


def artifact(name: str, kind: str, executable: str | None) -> str:
    """A message of cargo, as far as it is read."""
    files = [f"/target/{name}", f"/target/{name}.d"]
    target = {"kind": [kind], "name": name}
    facts = {"reason": "compiler-artifact", "target": target, "filenames": files}
    return json.dumps({**facts, "executable": executable})


def test_programs_and_modules_are_found_in_what_cargo_says() -> None:
    said = [
        json.dumps({"reason": "build-script-executed", "package_id": "libm"}),
        artifact("libserde.rlib", "lib", None),
        artifact("all", "test", "/target/all"),
        artifact("lib_core.so", "cdylib", None),
        json.dumps({"reason": "build-finished", "success": True}),
    ]
    assert list(map(str, made("\n".join(said)))) == ["/target/all", "/target/lib_core.so"]


def test_missing_tools_are_told_with_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """And Python is measured all the same."""
    for name in ("FOLDER", "PAGES", "COUNTS"):
        monkeypatch.setattr(measure_coverage, name, tmp_path / name)
    monkeypatch.setenv("LLVM_COV", str(tmp_path / "gone"))
    asked: list[str] = []

    def run_python_tests() -> int:
        asked.append("run")
        return 3

    monkeypatch.setattr(measure_coverage, "run_python_tests", run_python_tests)
    monkeypatch.setattr(measure_coverage, "report_python", lambda: asked.append("report"))
    assert LlvmTools.found() is None
    assert measure_coverage.main() == 3, "the tests' status is lost"
    assert asked == ["run", "report"]
    assert "rustup component add llvm-tools" in capsys.readouterr().out


def test_only_our_crates_are_built_with_counters() -> None:
    """Others' are shared with plain builds so."""
    wrapper = counting()["RUSTC_WORKSPACE_WRAPPER"]
    echo = shutil.which("echo") or "echo"
    said = subprocess.run([wrapper, echo, "--crate-name", "x"], capture_output=True, check=True)
    assert said.stdout.split() == [b"--crate-name", b"x", b"-C", b"instrument-coverage"]
