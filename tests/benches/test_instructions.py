from pathlib import Path

import pytest

from benches import instructions
from benches.instructions import Function, costs_by_part, part_of, read_counts, rounded

PROGRAM = Path("/target/instructions")
CORE = "/work/crates/rsim-core/src"
REGISTRY = "/registry/src"
STEP, HELPER, SOLVE = (("/target/instructions", name) for name in ("step", "sine", "solve"))
COUNTS = """# callgrind format
positions: instr line
events: Ir

ob=/target/instructions
fl=/work/a.rs
fn=step
0x10 1 5
fi=/work/b.rs
0x14 9 20
fe=/work/a.rs
cfi=/work/c.rs
cfn=sine
calls=2 0x40 7
0x18 3 100
0x1c 4 1

cob=/lib/libc.so
cfn=memcpy
calls=1 0x90 0
0x20 5 30

ob=/lib/libc.so
fn=memcpy
0x90 0 30
"""


def test_own_costs_and_calls_are_read(tmp_path: Path) -> None:
    path = tmp_path / "counts"
    path.write_text(COUNTS)
    functions = read_counts(path)
    step, copy = functions[STEP], functions["/lib/libc.so", "memcpy"]
    program = "/target/instructions"
    assert step.own == {(program, "0x10"): 5, (program, "0x14"): 20, (program, "0x1c"): 1}
    assert step.calls == [
        ((program, "0x18"), HELPER, 100),
        ((program, "0x20"), ("/lib/libc.so", "memcpy"), 30),
    ]
    assert (step.total, copy.total) == (156, 30)


@pytest.mark.parametrize(
    ("places", "part"),
    [
        ([f"{REGISTRY}/glam-1.0/vec.rs:dot", f"{CORE}/drive/omni.rs:force"], "wheels"),
        ([f"{CORE}/engine/near.rs:find", f"{CORE}/engine/mod.rs:step"], "pair search"),
        ([f"{REGISTRY}/rapier2d-0.36/src/solver.rs:solve"], "solver"),
        ([f"{CORE}/bodies.rs:move_freely<f32>"], "free motion"),
        ([f"{CORE}/bodies.rs:motion", f"{CORE}/tick/squeeze.rs:find"], "squeeze check"),
        ([f"{CORE}/drive/omni.rs:slip", f"{CORE}/drive/mod.rs:estimate_load"], "loads"),
        ([f"{CORE}/bodies.rs:motion", f"{CORE}/tick/mod.rs:roll"], None),
        ([], None),
    ],
)
def test_the_innermost_file_of_a_part_decides(places: list[str], part: str | None) -> None:
    assert part_of(places) == part


def test_helpers_belong_to_the_parts_that_call_them(monkeypatch: pytest.MonkeyPatch) -> None:
    def at(position: str) -> tuple[str, str]:
        return str(PROGRAM), position

    # Wheels and solver call the helper for 30 and 10 instructions; it is a helper throughout.
    functions = {
        STEP: Function(
            {at("wheel"): 100, at("other"): 7},
            [(at("wheel"), HELPER, 30), (at("other"), SOLVE, 60)],
        ),
        SOLVE: Function({at("solver"): 50}, [(at("solver"), HELPER, 10)]),
        HELPER: Function({at("helper"): 40}),
    }
    parts = {at("wheel"): "wheels", at("solver"): "solver"}
    monkeypatch.setattr(instructions, "parts_of_addresses", lambda *_: parts)
    costs = costs_by_part(functions, PROGRAM)
    assert costs == pytest.approx({"wheels": 130, "solver": 60, "rest": 7})


def test_counts_are_rounded() -> None:
    assert [rounded(x) for x in (143_987.0, 8_581.2, 473.0, 4.0)] == [
        "144,000",
        "8,580",
        "470",
        "0",
    ]
