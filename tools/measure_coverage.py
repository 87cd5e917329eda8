"""Measure the line coverage of the tests, for Python and Rust: `make coverage`.

The coverage of Rust includes the Rust tests and the Python tests. For the Python tests the compiled
module is built with counters into a copy of the package, so that the installed one does not change.
"""

import json
import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from tools.paths import ROOT

FOLDER: Final = ROOT / "target" / "coverage"
PAGES: Final = ROOT / "out" / "coverage"
COUNTS: Final = FOLDER / "counts"
"""Folder to which every process with counters writes its counts."""
MODULES: Final = (".so", ".dylib")  # suffixes of compiled modules
CARGO: Final = os.environ.get("CARGO", "cargo")

# Third-party code, tests, examples, and the scenes used by tests.
NOT_MEASURED: Final = r"(/\.cargo/|/rustc/|/rustlib/|/tests/|/benches/|/examples/|/scenes/)"


@dataclass(frozen=True)
class LlvmTools:
    """The two LLVM tools that read the counts of Rust code."""

    profdata: Path
    cov: Path

    @classmethod
    def find(cls) -> "LlvmTools | None":
        """Find the tools of the toolchain, or those named by LLVM_PROFDATA and LLVM_COV.

        Returns:
            The tools, or None if one is missing.
        """
        paths = [tool_path("llvm-profdata"), tool_path("llvm-cov")]
        return cls(*paths) if all(path.is_file() for path in paths) else None


def main() -> int:
    """Run all tests with counters, report the coverage, and return the tests' status."""
    for old in (FOLDER, PAGES):
        shutil.rmtree(old, ignore_errors=True)
    COUNTS.mkdir(parents=True)
    tools = LlvmTools.find()
    if tools is None:
        print("Rust coverage is skipped: llvm-profdata and llvm-cov are missing.")
        print(
            "Install them by `rustup component add llvm-tools`, or set LLVM_PROFDATA and LLVM_COV."
        )
    shutil.copytree(ROOT / "python", FOLDER / "python", symlinks=True)
    objects = build() if tools else []
    status = run_rust_tests() if tools else 0
    status = run_python_tests() or status
    if tools:
        report_rust(tools, objects)
    report_python()
    print(f"coverage pages: {PAGES}")
    return status


def tool_path(name: str) -> Path:
    """Return the path of an LLVM tool, which may not exist."""
    if given := os.environ.get(name.replace("-", "_").upper()):
        return Path(given)
    rustc = os.environ.get("RUSTC", "rustc")
    root = output_of([rustc, "--print", "sysroot"]).strip()
    version = output_of([rustc, "-vV"]).splitlines()
    host = next(line.split()[1] for line in version if line.startswith("host:"))
    return Path(root) / "lib" / "rustlib" / host / "bin" / name


def output_of(command: list[str], environment: dict[str, str] | None = None) -> str:
    """Return the output of a command; its error stream goes to the terminal."""
    ran = subprocess.run(
        command, cwd=ROOT, env=environment, stdout=subprocess.PIPE, text=True, check=True
    )
    return ran.stdout


def counting_environment() -> dict[str, str]:
    """Return the environment variables that build this workspace's crates with counters."""
    wrapper = str(ROOT / "tools" / "rustc_counting.sh")
    # %m separates programs, %p processes that end at the same moment.
    counts = {"LLVM_PROFILE_FILE": str(COUNTS / "%m-%p.profraw")}
    return {**os.environ, **counts, "RUSTC_WORKSPACE_WRAPPER": wrapper}


def build() -> list[Path]:
    """Build tests and module with counters and install the module into the copy.

    Returns:
        Paths of the built programs and of the installed module.
    """
    tests = run_cargo(["test", "--no-run"])
    # Tests of the benchmarks refuse modules with assertions.
    settings = {"CARGO_PROFILE_TEST_DEBUG_ASSERTIONS": "false"}
    (module,) = run_cargo(["build", "--profile", "test", "--package", "rsim-py"], **settings)
    (target,) = (FOLDER / "python" / "rsoccer").glob("_core*.so")
    shutil.copyfile(module, target)
    return [*tests, target]


def run_cargo(command: list[str], **settings: str) -> list[Path]:
    """Run a cargo command with extra variables; return the programs and modules it built."""
    line = [CARGO, *command, "--locked", "--message-format", "json-render-diagnostics"]
    return list(artifacts(output_of(line, counting_environment() | settings)))


def artifacts(messages: str) -> list[Path]:
    """Return the programs and modules in cargo's messages, without libraries."""
    found: list[Path] = []
    for message in map(json.loads, messages.splitlines()):
        if message["reason"] != "compiler-artifact":
            continue
        if message["executable"]:
            found.append(Path(message["executable"]))
        elif message["target"]["kind"] == ["cdylib"]:
            found += [Path(name) for name in message["filenames"] if name.endswith(MODULES)]
    return found


def run_rust_tests() -> int:
    """Run the Rust tests with counters; return their status."""
    return subprocess.run(
        [CARGO, "test", "--locked"], cwd=ROOT, env=counting_environment()
    ).returncode


def run_python_tests() -> int:
    """Run the Python tests with counters on the copy of the package; return their status."""
    environment = {**counting_environment(), "PYTHONPATH": str(FOLDER / "python")}
    command = ["coverage", "run", "-m", "pytest", "--numprocesses", "auto"]
    return subprocess.run([sys.executable, "-m", *command], cwd=ROOT, env=environment).returncode


def report_python() -> None:
    """Print the Python lines without coverage and write the pages."""
    for command in (["combine", "--quiet"], ["report"], ["html", "--quiet"]):
        subprocess.run([sys.executable, "-m", "coverage", *command], cwd=ROOT, check=True)


def report_rust(tools: LlvmTools, objects: list[Path]) -> None:
    """Print the coverage of each Rust file and write the pages."""
    merged = FOLDER / "rust.profdata"
    counts = [str(path) for path in COUNTS.glob("*.profraw")]
    command = [str(tools.profdata), "merge", "--sparse", "--output", str(merged), *counts]
    subprocess.run(command, check=True)
    arguments = [word for path in objects for word in ("--object", str(path))]
    options = ["--instr-profile", str(merged), "--ignore-filename-regex", NOT_MEASURED, *arguments]
    pages = ["--format", "html", "--output-dir", str(PAGES / "rust")]
    subprocess.run([str(tools.cov), "report", *options], cwd=ROOT, check=True)
    subprocess.run([str(tools.cov), "show", *pages, *options], cwd=ROOT, check=True)


if __name__ == "__main__":
    sys.exit(main())
