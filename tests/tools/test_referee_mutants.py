"""Mutants of the referee: changes, outcomes, table. No program is built here."""

import re
import subprocess
from collections import defaultdict
from pathlib import Path
from types import SimpleNamespace

import pytest

from tools import referee_mutants
from tools.paths import ROOT
from tools.referee_mutants import (
    CRATE,
    GENERIC,
    Mutant,
    Outcome,
    UnlinkedError,
    Workshop,
    begin_log,
    digest,
    main,
    summary,
)

SOURCE = "fn f() -> bool {\n    1 <\n        2\n}\n"


def mutant(name: str = "x", file: str = "src/cards.rs") -> Mutant:
    """Return a mutant whose operator is another one."""
    return Mutant(name, CRATE / file, (2, 7), (2, 8), "<=")


def test_a_mutant_is_read_and_applied_between_its_places() -> None:
    span = {"start": {"line": 2, "column": 5}, "end": {"line": 3, "column": 10}}
    entry = {"name": "f.rs:2:5: replace f", "file": "f.rs", "span": span, "replacement": "true"}
    read = Mutant.read(entry)
    assert (read.name, read.file) == ("f.rs:2:5: replace f", Path("f.rs"))
    assert read.apply(SOURCE) == "fn f() -> bool {\n    true\n}\n"
    assert mutant().apply(SOURCE) == SOURCE.replace("<", "<=")


def test_the_table_counts_viable_mutants_by_file() -> None:
    outcomes: list[tuple[str, Outcome]] = [
        ("src/cards.rs", "caught"),
        ("src/cards.rs", "missed"),
        ("src/cards.rs", "unviable"),
        ("src/flow.rs", "timeout"),
    ]
    found = {mutant(str(n), file): outcome for n, (file, outcome) in enumerate(outcomes)}
    lines = summary(found).splitlines()
    assert lines[2:5] == [
        "| src/cards.rs | 2 | 1 | 1 | 50.0% |",
        "| src/flow.rs | 1 | 1 | 0 | 100.0% |",
        "| all | 3 | 2 | 1 | 66.7% |",
    ]
    assert lines[5:] == ["", "- `1`"]


class Bench(Workshop):
    """A workshop without programs: what cargo and the tests say is given."""

    def __init__(self, folder: Path, fails: str, compiles: bool = True) -> None:
        super(Workshop, self).__init__()
        self.folder, self.fails, self.compiles = folder, fails, compiles
        self.programs = [folder / "ssl", folder / "vsss"]
        self.catchers = defaultdict(list)
        self.calls: list[tuple[str, ...]] = []

    def build(self, *command: str) -> list[Path] | None:
        assert "<=" in (self.folder / CRATE / "src" / self.file).read_text(), "it is not changed"
        self.calls.append(command)
        return [self.folder / command[-1]] if self.compiles else None

    def run(self, program: Path, *names: str, catchers: list[str] | None = None) -> Outcome | None:
        self.calls.append((program.name, *names))
        if program.name != self.fails:
            return None
        if catchers is not None:
            catchers.append("areas::a_test")
        return "caught"

    def of(self, file: str) -> Outcome:
        """Judge a mutant of a file, and check that the file is as before."""
        self.file = file
        path = self.folder / CRATE / "src" / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(SOURCE)
        outcome = self.judge(mutant(file=f"src/{file}"))
        assert path.read_text() == SOURCE
        return outcome


def test_tests_that_caught_a_mutant_are_the_first_for_the_next_one(tmp_path: Path) -> None:
    bench = Bench(tmp_path, fails="vsss")
    assert bench.of("cards.rs") == "caught"
    assert bench.calls[1:] == [("ssl",), ("vsss",)]
    bench.calls.clear()
    assert bench.of("cards.rs") == "caught"
    assert bench.calls[1:] == [("vsss", "areas::a_test")]
    bench.calls.clear()
    assert bench.of("flow.rs") == "caught"
    assert bench.calls[1:] == [("ssl",), ("vsss",)], "those of another file say nothing"


def test_a_mutant_is_missed_where_all_tests_pass_and_unviable_where_it_does_not_compile(
    tmp_path: Path,
) -> None:
    bench = Bench(tmp_path, fails="")
    assert bench.of("cards.rs") == "missed"
    assert bench.calls[-1] == ("--lib",), "the crate's own tests were run, too"
    assert Bench(tmp_path, fails="", compiles=False).of("cards.rs") == "unviable"


def test_tests_are_compiled_anew_for_generic_code(tmp_path: Path) -> None:
    (generic,) = GENERIC
    assert (ROOT / CRATE / "src" / generic).is_file()
    bench = Bench(tmp_path, fails="")
    assert bench.of(generic) == "missed"
    built = [call for call in bench.calls if "--no-run" in call]
    assert [call[2:] for call in built] == [("--lib",), ("--test", "*")]


def test_tests_are_compiled_anew_where_they_need_a_function_that_is_gone(tmp_path: Path) -> None:
    class Unlinked(Bench):
        def run(
            self, program: Path, *names: str, catchers: list[str] | None = None
        ) -> Outcome | None:
            if program.name == "vsss":
                raise UnlinkedError("undefined symbol")
            return super().run(program, *names, catchers=catchers)

    bench = Unlinked(tmp_path, fails="*")
    assert bench.of("cards.rs") == "caught", "by the tests that were compiled anew"
    built = [call for call in bench.calls if "--no-run" in call]
    assert [call[2:] for call in built] == [("--lib",), ("--test", "*")]


def test_failing_tests_are_read_from_the_output_of_a_program(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    output = "test areas::a ... ok\ntest areas::b ... FAILED\n"
    answers = [(101, output), (0, ""), (127, "no library")]

    def answer(command: list[str], **options: object) -> SimpleNamespace:
        assert command[0] == str(tmp_path) and options["timeout"]
        code, text = answers.pop(0)
        return SimpleNamespace(returncode=code, stdout=text, stderr=text)

    monkeypatch.setattr(referee_mutants, "_libraries", lambda: "lib")
    monkeypatch.setattr(subprocess, "run", answer)
    (tmp_path / CRATE).mkdir(parents=True)
    workshop = Workshop.__new__(Workshop)
    workshop.folder = tmp_path
    catchers: list[str] = []
    assert workshop.run(tmp_path, catchers=catchers) == "caught"
    assert catchers == ["areas::b"]
    assert workshop.run(tmp_path, "areas::b") is None
    with pytest.raises(RuntimeError, match="no library"):
        workshop.run(tmp_path)


def test_a_shard_of_the_chosen_mutants_is_judged_and_logged(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    every = [mutant(f"{CRATE}/src/cards.rs:{n}: replace") for n in range(6)]
    judged: list[Mutant] = []

    class Fake:
        def __init__(self, folder: Path) -> None:
            assert folder.name == "1-2"

        def judge(self, one: Mutant) -> Outcome:
            judged.append(one)
            return "missed"

    monkeypatch.setattr(referee_mutants, "Workshop", Fake)
    monkeypatch.setattr(referee_mutants, "mutants", lambda _: every)
    log = tmp_path / "log"
    assert main(["--shard", "1/2", "--only", "cards.rs:[0-4]", "--log", str(log)]) == 0
    assert judged == every[1:5:2]
    assert "| all | 2 | 0 | 2 | 0.0% |" in capsys.readouterr().out
    head, *lines = log.read_text().splitlines()
    assert (
        head == f"crate {digest()}"
        and len(lines) == 2
        and all(re.match(r"missed +\d+\.\d s crates/", line) for line in lines)
    )
    judged.clear()
    assert main(["--shard", "1/2", "--log", str(log)]) == 0
    assert judged == every[5:], "those of the log are known"
    assert "| all | 3 | 0 | 3 | 0.0% |" in capsys.readouterr().out
    judged.clear()
    assert main(["--shard", "1/2", "--sample", "4"]) == 0
    assert len(judged) == 2 and set(judged) < set(every)


def test_a_line_that_is_none_of_a_log_is_refused(tmp_path: Path) -> None:
    log = tmp_path / "log"
    assert begin_log(log) == {} == begin_log(log)
    with log.open("a") as file:
        file.write("caught    1.5 s a.rs:1:1: replace a with b\n")
    assert begin_log(log) == {"a.rs:1:1: replace a with b": "caught"}
    with log.open("a") as file:
        file.write("lost 3 s c\n")
    with pytest.raises(ValueError, match="got 'lost 3 s c'"):
        begin_log(log)
    log.write_text("crate of others\n")
    with pytest.raises(ValueError, match="at its head, got 'crate of others'"):
        begin_log(log)
