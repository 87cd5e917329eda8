"""Measures which lines the tests run, of Python and of Rust: `make coverage`.

Rust's tests and the Python tests count together. For the latter the compiled module is built
with counters, into a copy of the package, so that the environment's own stays as it is.
"""

import json
import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Final

ROOT: Final = Path(__file__).parents[1]
FOLDER: Final = ROOT / "target" / "coverage"
PAGES: Final = ROOT / "out" / "coverage"
COUNTS: Final = FOLDER / "counts"
"""Where every process that runs counting code leaves what it counted."""
MODULES: Final = (".so", ".dylib")
CARGO: Final = os.environ.get("CARGO", "cargo")

# Others' code, tests, examples, and scenes, which are for tests.
NOT_MEASURED: Final = r"(/\.cargo/|/rustc/|/rustlib/|/tests/|/benches/|/examples/|/scenes/)"


@dataclass(frozen=True)
class LlvmTools:
    """The two tools that read what counting Rust code writes."""

    profdata: Path
    cov: Path

    @classmethod
    def found(cls) -> "LlvmTools | None":
        """Those of the toolchain, or those that LLVM_PROFDATA and LLVM_COV name; else None."""
        paths = [tool("llvm-profdata"), tool("llvm-cov")]
        return cls(*paths) if all(path.is_file() for path in paths) else None


def main() -> int:
    """Run all tests with counting, print both reports, write the pages; the tests' status."""
    for old in (FOLDER, PAGES):
        shutil.rmtree(old, ignore_errors=True)
    COUNTS.mkdir(parents=True)
    tools = LlvmTools.found()
    if tools is None:
        print("Rust will not be measured, only Python: llvm-profdata and llvm-cov are missing.")
        print("`rustup component add llvm-tools` installs them; or set LLVM_PROFDATA and LLVM_COV.")
    shutil.copytree(ROOT / "python", FOLDER / "python", symlinks=True)
    objects = build() if tools else []
    status = run_rust_tests() if tools else 0
    status = run_python_tests() or status
    if tools:
        report_rust(tools, objects)
    report_python()
    print(f"pages with every line: {PAGES}")
    return status


def tool(name: str) -> Path:
    """Where one of LLVM's tools is, or would be."""
    if given := os.environ.get(name.replace("-", "_").upper()):
        return Path(given)
    rustc = os.environ.get("RUSTC", "rustc")
    root = said_by([rustc, "--print", "sysroot"]).strip()
    about = said_by([rustc, "-vV"]).splitlines()
    host = next(line.split()[1] for line in about if line.startswith("host:"))
    return Path(root) / "lib" / "rustlib" / host / "bin" / name


def said_by(command: list[str], environment: dict[str, str] | None = None) -> str:
    """What a command writes; its complaints go to the terminal."""
    ran = subprocess.run(
        command, cwd=ROOT, env=environment, stdout=subprocess.PIPE, text=True, check=True
    )
    return ran.stdout


def counting() -> dict[str, str]:
    """The environment in which our crates, and no others, are built with counters."""
    wrapper = str(ROOT / "tools" / "rustc_counting.sh")
    # %m keeps programs apart, %p processes that end at the same moment.
    counts = {"LLVM_PROFILE_FILE": str(COUNTS / "%m-%p.profraw")}
    return {**os.environ, **counts, "RUSTC_WORKSPACE_WRAPPER": wrapper}


def build() -> list[Path]:
    """Build tests and module with counters, put the module into the copy; what was built."""
    tests = built(["test", "--no-run"])
    # What measures speed refuses modules with assertions.
    fast = {"CARGO_PROFILE_TEST_DEBUG_ASSERTIONS": "false"}
    (module,) = built(["build", "--profile", "test", "--package", "rsim-py"], **fast)
    (target,) = (FOLDER / "python" / "rsoccer").glob("_core*.so")
    shutil.copyfile(module, target)
    return [*tests, target]


def built(command: list[str], **settings: str) -> list[Path]:
    """What programs and modules a command of cargo makes, under more settings."""
    line = [CARGO, *command, "--locked", "--message-format", "json-render-diagnostics"]
    return list(made(said_by(line, counting() | settings)))


def made(messages: str) -> list[Path]:
    """Programs and modules in cargo's messages, libraries between them left out."""
    found: list[Path] = []
    for message in map(json.loads, messages.splitlines()):
        if message["reason"] != "compiler-artifact":
            continue
        if message["executable"]:
            found.append(Path(message["executable"]))
        elif message["target"]["kind"] == ["cdylib"]:
            found += [
                Path(name) for name in message["filenames"] if name.endswith((".so", ".dylib"))
            ]
    return found


def run_rust_tests() -> int:
    """Run the physics tests with counting; their status."""
    return subprocess.run([CARGO, "test", "--locked"], cwd=ROOT, env=counting()).returncode


def run_python_tests() -> int:
    """Run the tests of the package with counting, on the copy; their status."""
    environment = {**counting(), "PYTHONPATH": str(FOLDER / "python")}
    command = ["coverage", "run", "-m", "pytest", "--numprocesses", "auto"]
    return subprocess.run([sys.executable, "-m", *command], cwd=ROOT, env=environment).returncode


def report_python() -> None:
    """Print what of Python was not run, and write the pages."""
    for command in (["combine", "--quiet"], ["report"], ["html", "--quiet"]):
        subprocess.run([sys.executable, "-m", "coverage", *command], cwd=ROOT, check=True)


def report_rust(tools: LlvmTools, objects: list[Path]) -> None:
    """Print how much of each Rust file was run, and write the pages."""
    merged = FOLDER / "rust.profdata"
    counts = [str(path) for path in COUNTS.glob("*.profraw")]
    command = [str(tools.profdata), "merge", "--sparse", "--output", str(merged), *counts]
    subprocess.run(command, check=True)
    named = [word for path in objects for word in ("--object", str(path))]
    what = ["--instr-profile", str(merged), "--ignore-filename-regex", NOT_MEASURED, *named]
    pages = ["--format", "html", "--output-dir", str(PAGES / "rust")]
    subprocess.run([str(tools.cov), "report", *what], cwd=ROOT, check=True)
    subprocess.run([str(tools.cov), "show", *pages, *what], cwd=ROOT, check=True)


if __name__ == "__main__":
    sys.exit(main())
