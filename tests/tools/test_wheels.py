import re
import subprocess
import sys
from pathlib import Path

import pytest

from tools.paths import ROOT
from tools.wheels import build, tryout


def test_the_readmes_program_and_commands_are_tried() -> None:
    assert "rsoccer.parallel_env" in tryout.ten_lines()
    readme = (ROOT / "README.md").read_text()
    for line in tryout.COMMANDS:
        name, command, *_ = line.split()
        assert name == "rsoccer"
        assert command == "--version" or f"rsoccer {command} " in readme
    compile(tryout.LIGHT, "light", "exec")


def test_a_compiler_without_the_standard_library_is_recognized(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    library = tmp_path / "lib"
    library.mkdir()
    rustc = tmp_path / "rustc"
    rustc.write_text(f"#!/bin/sh\necho {library}\n")
    rustc.chmod(0o755)
    monkeypatch.setenv("RUSTC", str(rustc))
    assert not build.has_standard_library("aarch64")
    (library / "libstd-0123.rlib").touch()
    assert build.has_standard_library("aarch64")


def test_the_release_builds_a_wheel_of_each_architecture_for_the_same_platform() -> None:
    workflow = (ROOT / ".github" / "workflows" / "release.yml").read_text()
    targets = dict(re.findall(r"target: ([\w-]+), compatibility: \"?(\w+)", workflow))
    assert len(targets) == 6
    for architecture, platform in build.PLATFORMS.items():
        assert targets[build.target(architecture)] == platform
    systems = {target.split("-", 1)[1] for target in targets}
    assert systems == {"unknown-linux-gnu", "apple-darwin", "pc-windows-msvc"}


def test_maturin_is_that_of_the_environment_whatever_path_says(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("PATH", "")
    program = build.maturin_program()
    assert program.parent == Path(sys.executable).parent
    ran = subprocess.run([program, "--version"], capture_output=True, text=True, check=True)
    assert ran.stdout.startswith("maturin ")
