"""Errors of the command line: one line on standard error, and an exit status."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from rsoccer import cli, interrupts


def one_line(text: str) -> str:
    """Return an error message after checking that it is one line."""
    assert text.startswith("rsoccer: ")
    assert text.endswith("\n")
    assert text.count("\n") == 1
    return text


@pytest.mark.parametrize("arguments", [[], ["fly"], ["watch", "--seed", "one"]])
def test_arguments_that_cannot_be_parsed_exit_with_2(
    arguments: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as exit_:
        cli.main(arguments)
    assert exit_.value.code == 2
    printed = capsys.readouterr()
    assert "--help" in printed.err
    assert printed.out == ""


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["evaluate", "unknown"], "unknown policy 'unknown'.*chase"),
        (["evaluate", "chase", "--opponents", "unknown"], "unknown policy 'unknown'"),
        (["evaluate", "chase", "--matches", "1"], "matches: expected at least 2, got 1"),
        (["evaluate", "chase", "--task", "VSS-v9"], "unknown task 'VSS-v9'"),
        (["evaluate", "no/such.safetensors"], "no/such.safetensors"),
        (["watch", "unknown", "--video", "never.mp4"], "unknown policy 'unknown'"),
    ],
)
def test_invalid_input_is_reported_in_one_line(
    arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(arguments) == cli.WRONG_INPUT
    printed = capsys.readouterr()
    assert printed.out == ""
    assert message.split(".*")[0] in one_line(printed.err)


def test_a_damaged_policy_file_is_reported_in_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "policy.safetensors"
    file.write_bytes(b"not a policy")
    assert cli.main(["evaluate", str(file)]) == 2
    assert "policy.safetensors is not a usable policy file" in one_line(capsys.readouterr().err)


@pytest.mark.parametrize(
    ("module", "arguments", "extra"),
    [
        ("torch", ["train", "--samples", "1"], "rsoccer[train]"),
        ("pygame", ["watch", "--video", "never.mp4"], "rsoccer[render]"),
        ("tyro", ["list"], "rsoccer[cli]"),
    ],
)
def test_the_extra_of_a_missing_package_is_named(
    module: str, arguments: list[str], extra: str, tmp_path: Path
) -> None:
    policy = tmp_path / "policy.safetensors"
    policy.write_bytes(b"")
    words = [part.format(policy=policy) for part in arguments]
    code = f"import sys; sys.modules[{module!r}] = None\nfrom rsoccer.cli import main\n"
    done = subprocess.run(
        [sys.executable, "-c", f"{code}sys.exit(main({words!r}))"],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        check=False,
    )
    assert done.returncode == 2
    assert f"pip install '{extra}'" in one_line(done.stderr)


# Shells start background jobs with SIGINT ignored, and their children inherit that.
WITH_SIGINT = """
import runpy, signal
signal.signal(signal.SIGINT, signal.default_int_handler)
runpy.run_module("rsoccer", run_name="__main__", alter_sys=True)
"""


def test_ctrl_c_exits_with_130() -> None:
    worker = subprocess.Popen(
        [sys.executable, "-c", WITH_SIGINT, "evaluate", "chase", "--matches", "1000000"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        _wait_until_playing(worker.pid)
        worker.send_signal(signal.SIGINT)
        printed = worker.communicate(timeout=30)
    finally:
        worker.kill()
        worker.wait()
    assert worker.returncode == interrupts.INTERRUPTED
    assert "Traceback" not in printed[1]


def _wait_until_playing(process: int) -> None:
    """Wait until the process has used more processor time than its start needs."""
    deadline = time.monotonic() + 60
    stat = Path(f"/proc/{process}/stat")
    if not stat.exists():
        time.sleep(10)
        return
    while time.monotonic() < deadline:
        ticks = stat.read_text().rpartition(")")[2].split()[11]
        if int(ticks) / os.sysconf("SC_CLK_TCK") > 2.5:
            return
        time.sleep(0.05)
    pytest.fail("timeout before the first match")


def test_a_closed_pipe_is_no_error() -> None:
    command = f"{sys.executable} -m rsoccer list | true"
    done = subprocess.run(
        ["bash", "-c", f"set -o pipefail; {command}"], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")


def test_an_option_that_is_given_twice_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["benchmark", "fetch", "--task", "SSLGoToBall-v0", "--task=SSLDribbling-v0"]
    assert cli.main(words) == cli.WRONG_INPUT
    assert "--task: expected once, got 2 times" in capsys.readouterr().err
