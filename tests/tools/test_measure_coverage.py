import json
import shutil
import subprocess
from pathlib import Path

import pytest

from tools import measure_coverage
from tools.measure_coverage import LlvmTools, artifacts, counting_environment


def artifact(name: str, kind: str, executable: str | None) -> str:
    """Return a message of cargo with the fields that are read."""
    files = [f"/target/{name}", f"/target/{name}.d"]
    target = {"kind": [kind], "name": name}
    message = {"reason": "compiler-artifact", "target": target, "filenames": files}
    return json.dumps({**message, "executable": executable})


def test_programs_and_modules_are_found_in_the_output_of_cargo() -> None:
    messages = [
        json.dumps({"reason": "build-script-executed", "package_id": "libm"}),
        artifact("libserde.rlib", "lib", None),
        artifact("all", "test", "/target/all"),
        artifact("lib_core.so", "cdylib", None),
        json.dumps({"reason": "build-finished", "success": True}),
    ]
    assert list(map(str, artifacts("\n".join(messages)))) == ["/target/all", "/target/lib_core.so"]


def test_missing_tools_are_reported_with_install_instructions(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Python coverage is measured nevertheless."""
    for name in ("FOLDER", "PAGES", "COUNTS"):
        monkeypatch.setattr(measure_coverage, name, tmp_path / name)
    monkeypatch.setenv("LLVM_COV", str(tmp_path / "gone"))
    calls: list[str] = []

    def run_python_tests() -> int:
        calls.append("run")
        return 3

    monkeypatch.setattr(measure_coverage, "run_python_tests", run_python_tests)
    monkeypatch.setattr(measure_coverage, "report_python", lambda: calls.append("report"))
    assert LlvmTools.find() is None
    assert measure_coverage.main() == 3, "the tests' status is lost"
    assert calls == ["run", "report"]
    assert "rustup component add llvm-tools" in capsys.readouterr().out


def test_only_workspace_crates_are_built_with_counters() -> None:
    # Third-party crates are shared with builds without counters.
    wrapper = counting_environment()["RUSTC_WORKSPACE_WRAPPER"]
    echo = shutil.which("echo") or "echo"
    ran = subprocess.run([wrapper, echo, "--crate-name", "x"], capture_output=True, check=True)
    assert ran.stdout.split() == [b"--crate-name", b"x", b"-C", b"instrument-coverage"]
