"""The plugin that makes skipped tests fail."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
WHOLE_FILE = "import pytest\npytest.importorskip('no_such_library')\ndef test_nothing(): pass\n"
ONE_TEST = "import pytest\ndef test_skipped(): pytest.skip('no display')\n"
EXPECTED_FAILURE = "import pytest\n@pytest.mark.xfail\ndef test_fails(): assert False\n"


def run(code: str, folder: Path, *options: str) -> subprocess.CompletedProcess[str]:
    (folder / "test_it.py").write_text(code)
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", *options]
    command += ["--rootdir", str(folder), str(folder / "test_it.py")]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)


@pytest.mark.parametrize(
    ("code", "reason"), [(WHOLE_FILE, "no_such_library"), (ONE_TEST, "no display")]
)
def test_a_skipped_test_fails_with_its_reason(code: str, reason: str, tmp_path: Path) -> None:
    assert run(code, tmp_path).returncode in (0, 5)  # 5: nothing was run
    strict = run(code, tmp_path, "-p", "tests.no_skips")
    assert strict.returncode in (1, 2)  # 2: while files are collected
    assert "skipped: " in strict.stdout
    assert reason in strict.stdout


def test_an_expected_failure_is_no_skip(tmp_path: Path) -> None:
    assert run(EXPECTED_FAILURE, tmp_path, "-p", "tests.no_skips").returncode == 0
