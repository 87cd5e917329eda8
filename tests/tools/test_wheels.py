import re
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import pytest

import rsoccer
from tools.paths import ROOT
from tools.wheels import build, maturin, profile, tryout, typical_play


def test_the_readmes_program_and_commands_are_tried() -> None:
    assert "rsoccer.parallel_env" in tryout.ten_lines()
    readme = (ROOT / "README.md").read_text()
    for line in tryout.COMMANDS:
        name, command, *_ = line.split()
        assert name == "rsoccer"
        assert command == "--version" or f"rsoccer {command} " in readme
    compile(tryout.LIGHT, "light", "exec")
    exec(tryout.same_bits(), {})  # of the module that the tests have built
    assert "rapier_vss_random" in tryout.same_bits()


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


def test_a_profile_needs_the_tools_of_a_compiler_for_this_machine(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    rustc = tmp_path / "rustc"
    rustc.write_text(f"#!/bin/sh\necho {tmp_path}\n")
    rustc.chmod(0o755)
    monkeypatch.setenv("RUSTC", str(rustc))
    monkeypatch.setattr("platform.machine", lambda: "x86_64")
    here, other = (build.target(name) for name in ("x86_64", "aarch64"))
    assert profile.merging_tool(here) is None
    tools = {name: tmp_path / "lib" / "rustlib" / name / "bin" for name in (here, other)}
    for folder in tools.values():
        folder.mkdir(parents=True)
        (folder / "llvm-profdata").touch()
    assert profile.merging_tool(here) == tools[here] / "llvm-profdata"
    assert profile.merging_tool(other) is None, "counters of another machine cannot run"


def test_a_profile_adds_a_flag_to_those_of_the_caller(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    built: list[dict[str, str]] = []

    def build_nothing(*_: str, **variables: str) -> None:
        built.append(variables)
        (tmp_path / "wheels").mkdir()

    monkeypatch.setattr(maturin, "run", build_nothing)
    monkeypatch.setattr(subprocess, "run", lambda *_, **__: None)
    monkeypatch.setenv("RUSTFLAGS", "-Ctarget-cpu=native")
    with pytest.raises(RuntimeError, match="expected counts of the play"):
        profile.flag("system", tmp_path / "tool", tmp_path)
    (tmp_path / "wheels").rmdir()
    counts = tmp_path / "counts"
    counts.mkdir()
    (counts / "1.profraw").touch()
    flag = profile.flag("system", tmp_path / "tool", tmp_path)
    assert profile.with_flag(flag) == f"-Ctarget-cpu=native -Cprofile-use={tmp_path / 'profile'}"
    [first, _] = (variables["RUSTFLAGS"] for variables in built)
    assert first == f"-Ctarget-cpu=native -Cprofile-generate={counts}"
    monkeypatch.delenv("RUSTFLAGS")
    assert profile.with_flag("-C") == "-C"


def test_the_profile_is_of_all_tasks_and_sides(monkeypatch: pytest.MonkeyPatch) -> None:
    played: list[tuple[str, str, str | None]] = []
    play = typical_play.play

    def briefly(
        task: str, options: dict[str, Any], side: str, sensing: str | None, *_: int, **__: int
    ) -> None:
        played.append((task, side, sensing))
        play(task, options, side, sensing, steps=2)

    monkeypatch.setattr(typical_play, "play", briefly)
    monkeypatch.setattr(typical_play, "WORLDS", 2)
    typical_play.main()
    assert {task for task, _, _ in played} == set(rsoccer.list_tasks())
    assert {side for _, side, _ in played} == {"random", "crowd", "scripted"}
    for _, _, sensing in played:
        assert sensing is None or sensing.startswith(("vsss", "rc2021"))
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text())
    assert settings["tool"]["maturin"]["pgo-command"].endswith(typical_play.__name__)
    assert settings["tool"]["maturin"]["pgo-dependency-group"] not in settings["dependency-groups"]


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
    program = maturin.program()
    assert program.parent == Path(sys.executable).parent
    ran = subprocess.run([program, "--version"], capture_output=True, text=True, check=True)
    assert ran.stdout.startswith("maturin ")
