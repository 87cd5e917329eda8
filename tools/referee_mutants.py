"""Test the tests of the referee by mutants: `python -m tools.referee_mutants`.

cargo-mutants lists the mutants of `crates/rsim-referee`: changes of a function's value, of an
operator, of a branch. A mutant that compiles is viable, and caught if a test of the crate fails or
does not end. The crate is built as a dynamic library under tests that are compiled once, so that a
mutant takes a second. Where test programs have code of the library inside, all is compiled anew.
"""

import argparse
import hashlib
import json
import os
import random
import re
import shutil
import subprocess
import sys
import time
from collections import Counter, defaultdict
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Final, Literal, cast

from benches.markdown import table
from tools.paths import ROOT

PACKAGE: Final = "rsim-referee"
CRATE: Final = Path("crates") / PACKAGE
FOLDER: Final = ROOT / "target" / "mutants"
CARGO: Final = os.environ.get("CARGO", "cargo")
GENERIC: Final = ("column.rs",)
"""Files with generic functions, which test programs have inside."""
LIMIT: Final = 60.0
"""Time after which a test program does not end, s."""

Outcome = Literal["caught", "timeout", "missed", "unviable"]


@dataclass(frozen=True)
class Mutant:
    """A change of the source."""

    name: str
    """Its file, place and change, as cargo-mutants calls it."""
    file: Path
    """File from the root of the repository."""
    start: tuple[int, int]
    """Line and column at which the changed text begins, from 1."""
    end: tuple[int, int]
    """Line and column behind the changed text."""
    replacement: str

    @classmethod
    def read(cls, entry: dict[str, Any]) -> "Mutant":
        """Read an entry of `cargo mutants --list --json`.

        Args:
            entry: the entry.
        """
        span = entry["span"]
        start, end = ((span[at]["line"], span[at]["column"]) for at in ("start", "end"))
        return cls(entry["name"], Path(entry["file"]), start, end, entry["replacement"])

    def apply(self, source: str) -> str:
        """Return the source with the change.

        Args:
            source: text of the file.
        """
        first, last = (_offset(source, at) for at in (self.start, self.end))
        return f"{source[:first]}{self.replacement}{source[last:]}"


def _offset(source: str, at: tuple[int, int]) -> int:
    """The place of a line and column in a text."""
    lines = source.splitlines(keepends=True)
    return sum(map(len, lines[: at[0] - 1])) + at[1] - 1


class UnlinkedError(RuntimeError):
    """A compiled test program needs a function that the library no longer has.

    The library has those copies of generic functions that it uses itself, and a mutant may use
    others.
    """


class Workshop:
    """A copy of the crate that is a dynamic library, and its compiled tests."""

    def __init__(self, folder: Path) -> None:
        """Copy the crate and build the tests.

        Args:
            folder: place of the copy.

        Raises:
            RuntimeError: the tests fail without any change.
        """
        self.folder = folder
        self.catchers: defaultdict[tuple[Path, Path], list[str]] = defaultdict(list)
        """Tests of a program that caught mutants of a file: the first to run for its next ones."""
        shutil.rmtree(folder / CRATE, ignore_errors=True)
        shutil.copytree(ROOT / CRATE, folder / CRATE)
        for path in (folder / CRATE).rglob("*.rs"):
            path.write_text(path.read_text().replace("#[inline]", ""))
        shutil.copyfile(ROOT / "Cargo.lock", folder / "Cargo.lock")
        whole = (ROOT / "Cargo.toml").read_text()
        members = f'members = ["{CRATE}"]'
        text = re.sub(
            r"(?m)^(default-)?members = .*$", lambda found: (found[1] or "") + members, whole
        )
        (folder / "Cargo.toml").write_text(text)
        with (folder / CRATE / "Cargo.toml").open("a") as manifest:
            manifest.write('\n[lib]\ncrate-type = ["dylib"]\n')
        built = self.build("test", "--no-run", "--test", "*") or []
        # Copies, since tests that are compiled anew for a mutant may have its code inside.
        (folder / "programs").mkdir(exist_ok=True)
        self.programs = [Path(shutil.copy2(path, folder / "programs")) for path in built]
        if not self.programs or any(map(self.run, self.programs)) or self.test("--lib"):
            raise RuntimeError("the tests fail without any change")

    def build(self, *command: str) -> list[Path] | None:
        """Run cargo on the copy. Returns the programs that it built; None if it does not compile.

        Args:
            command: the command of cargo and its options.
        """
        ran = subprocess.run(
            [CARGO, *command, "--package", PACKAGE, "--message-format", "json"],
            cwd=self.folder,
            env={**os.environ, "RUSTFLAGS": "-C prefer-dynamic", "CARGO_PROFILE_TEST_DEBUG": "0"},
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        if ran.returncode:
            return None
        messages = map(json.loads, ran.stdout.splitlines())
        return [Path(found) for message in messages if (found := message.get("executable"))]

    def judge(self, mutant: Mutant) -> Outcome:
        """Return what the tests say of a mutant. The copy is as before afterwards.

        Args:
            mutant: the mutant.
        """
        path = self.folder / mutant.file
        source = path.read_text()
        path.write_text(mutant.apply(source))
        try:
            if self.build("build", "--lib", "--profile", "test") is None:
                return "unviable"
            if mutant.file.name not in GENERIC:
                with suppress(UnlinkedError):
                    return self.try_known(mutant.file) or self.test("--lib") or "missed"
            return self.test("--lib") or self.test("--test", "*") or "missed"
        finally:
            path.write_text(source)

    def test(self, *which: str) -> Outcome | None:
        """Compile test programs and return what they say; None if they pass.

        Args:
            which: options of cargo that name the programs.
        """
        programs = self.build("test", "--no-run", *which)
        if programs is None:
            return "unviable"
        return next(filter(None, map(self.run, programs)), None)

    def try_known(self, file: Path) -> Outcome | None:
        """Return what the compiled tests say, those that caught mutants of a file first.

        Args:
            file: the file.
        """
        for program in self.programs:
            if (known := self.catchers[file, program]) and (found := self.run(program, *known)):
                return found
        for program in self.programs:
            if found := self.run(program, catchers=self.catchers[file, program]):
                return found
        return None

    def run(self, program: Path, *names: str, catchers: list[str] | None = None) -> Outcome | None:
        """Return what a test program says; None if it passes.

        Args:
            program: the program.
            names: names of the tests that are run; default: all.
            catchers: list to which names of tests that fail are added.
        """
        environment = {
            **os.environ,
            "LD_LIBRARY_PATH": f"{self.folder / 'target' / 'debug' / 'deps'}:{_libraries()}",
            "RUSTC_BOOTSTRAP": "1",  # the option is not stable yet
            "RUST_BACKTRACE": "0",
        }
        command = [str(program), "-Zunstable-options", "--fail-fast"]
        try:
            ran = subprocess.run(
                [*command, "--exact", *names] if names else command,
                env=environment,
                cwd=self.folder / CRATE,
                capture_output=True,
                text=True,
                timeout=LIMIT,
            )
        except subprocess.TimeoutExpired:
            return "timeout"
        if ran.returncode == 127:
            raise UnlinkedError(f"{program}: {ran.stderr}")
        if catchers is not None:
            catchers += re.findall(r"(?m)^test (\S+) \.\.\. FAILED$", ran.stdout)
        return "caught" if ran.returncode else None


@cache
def _libraries() -> str:
    """The folder of the compiler's own libraries."""
    rustc = os.environ.get("RUSTC", "rustc")
    return subprocess.check_output([rustc, "--print", "target-libdir"], text=True).strip()


def mutants(folder: Path) -> Iterator[Mutant]:
    """Yield all mutants of the crate.

    Args:
        folder: root of the repository.
    """
    command = [CARGO, "mutants", "--list", "--json", "--package", PACKAGE]
    listed = subprocess.check_output(command, cwd=folder, text=True)
    yield from map(Mutant.read, json.loads(listed))


def main(arguments: list[str] | None = None) -> int:
    """Judge mutants, print a table of them by file and those that were missed.

    Args:
        arguments: command line without the program name; default: that of the process.
    """
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--only", default="", help="expression that names of mutants contain")
    parser.add_argument(
        "--sample", type=int, help="number of mutants, drawn at random; default: all"
    )
    parser.add_argument("--shard", default="0/1", help="K/N: each Nth mutant, from the Kth on")
    parser.add_argument(
        "--log",
        type=Path,
        help="file that gets a line for each mutant; those that it has are not judged again",
    )
    options = parser.parse_args(arguments)
    nth, shards = map(int, options.shard.split("/"))
    chosen = [mutant for mutant in mutants(ROOT) if re.search(options.only, mutant.name)]
    if options.sample:
        chosen = random.Random(1).sample(chosen, min(options.sample, len(chosen)))
    workshop = Workshop(FOLDER / f"{nth}-{shards}")
    known = begin_log(options.log) if options.log else {}
    found: dict[Mutant, Outcome] = {}
    for mutant in chosen[nth::shards]:
        if mutant.name in known:
            found[mutant] = known[mutant.name]
            continue
        start = time.monotonic()
        found[mutant] = workshop.judge(mutant)
        if options.log:
            with options.log.open("a") as log:
                log.write(f"{found[mutant]:8} {time.monotonic() - start:4.1f} s {mutant.name}\n")
    sys.stdout.write(f"{summary(found)}\n")
    return 0


def digest() -> str:
    """Return a digest of the crate: names of mutants are places in its files."""
    found = hashlib.sha256()
    for path in sorted((ROOT / CRATE).rglob("*.rs")):
        found.update(path.read_bytes())
    return found.hexdigest()[:16]


def begin_log(path: Path) -> dict[str, Outcome]:
    """Begin a log, or return the outcomes in it by the names of the mutants.

    Args:
        path: the log; it need not exist.

    Raises:
        ValueError: a log of other code or tests, or a line that is none of a log.
    """
    first = f"crate {digest()}"
    if not path.exists():
        path.write_text(f"{first}\n")
    head, *lines = path.read_text().splitlines() or [""]
    if head != first:
        raise ValueError(f"log: expected {first!r} at its head, got {head!r}: name another file")
    found: dict[str, Outcome] = {}
    for line in lines:
        match = re.fullmatch(r"(caught|timeout|missed|unviable) +[\d.]+ s (.+)", line)
        if match is None:
            raise ValueError(f"log: expected lines of outcome, time and name, got {line!r}")
        found[match[2]] = cast(Outcome, match[1])
    return found


def summary(found: dict[Mutant, Outcome]) -> str:
    """Return a table of outcomes by file, and the names of the mutants that were missed.

    Args:
        found: mutants and their outcomes.
    """
    rows = []
    for file in [*sorted({mutant.file for mutant in found}), None]:
        counts = Counter(out for mutant, out in found.items() if file in (mutant.file, None))
        viable = counts.total() - counts["unviable"]
        caught = counts["caught"] + counts["timeout"]
        share = f"{caught / viable:.1%}" if viable else ""
        name = str(file.relative_to(CRATE)) if file else "all"
        rows.append((name, *map(str, (viable, caught, viable - caught)), share))
    missed = [f"- `{mutant.name}`" for mutant, outcome in found.items() if outcome == "missed"]
    return "\n".join([table(("file", "viable", "caught", "missed", "share"), rows), "", *missed])


if __name__ == "__main__":
    sys.exit(main())
