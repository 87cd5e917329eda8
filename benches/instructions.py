"""Instructions per physics tick by part of the tick: `python -m benches.instructions`.

Counts do not depend on the load of the machine. It builds the benchmark `instructions` of
`crates/rsim-bench` with line tables, runs its scenes under `valgrind --tool=callgrind`, and prints
a table. Valgrind and addr2line (binutils) have to be installed; the first build takes minutes.
"""

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from itertools import product
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final

from benches.criterion import LEAGUES
from benches.markdown import table
from benches.result_files import RESULTS, ROOT
from benches.scenarios import ENGINES

STORED: Final = RESULTS / "instructions.md"
BUILD: Final = ROOT / "target" / "counting"
SCENES: Final = (
    *("vss_3v3_free", "vss_3v3_random", "vss_3v3_crowd", "vss_5v5_random", "vss_5v5_crowd"),
    *("ssl_1v1_random", "ssl_1v1_crowd", "ssl_6v6_random", "ssl_6v6_crowd"),
    *("ssl_11v11_random", "ssl_11v11_crowd"),
)
STEPS: Final = 400
ROOT_FUNCTION: Final = "instructions4step"  # part of the mangled name of `instructions::step`

REST: Final = "rest"
CORE: Final = "rsim-core/src/"
PARTS: Final = {
    "solver": ("engine/rapier/", "engine/compact/", "engine/ball_contact"),
    "pair search": ("engine/near", "geometry/free_space"),
    "squeeze check": ("tick/squeeze",),
    "free motion": ("engine/contact_free", "bodies.rs:move_freely"),
    "wheels": ("drive/",),
    "loads": (),
    "ball": ("ball/rolling", "ball/impact", "tick/ball_contacts", "tick/bounce", "tick/flight"),
    "handling": ("ball/mouth", "ball/kicks", "tick/handling"),
    "robot contacts": ("tick/robot_contacts",),
    "events": ("state/touch", "state/crossing"),
    "rows": ("world/row",),
}
"""Parts of a tick, and the beginnings of their files in the core, or a file and a function in it.
Files in no part are helpers."""
LOADS: Final = "estimate_load"  # in the names of functions of that part, which call those of others
ENGINE_CRATES: Final = re.compile(r"/(rapier2d|parry2d)-[^/]*/")

Address = tuple[str, str]  # object file, address
Name = tuple[str, str]  # object file, function


@dataclass
class Function:
    """Costs of one function, in instructions."""

    own: dict[Address, int] = field(default_factory=lambda: defaultdict(int))
    calls: list[tuple[Address, Name, int]] = field(default_factory=list)
    """Address of the call, called function, and cost of the call with all that it calls."""

    @property
    def total(self) -> int:
        """Cost of the function with all that it calls."""
        return sum(self.own.values()) + sum(cost for _, _, cost in self.calls)


def main() -> None:
    """Count, print and, on request, store the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("scenes", nargs="*", default=SCENES, help="default: all")
    parser.add_argument("--steps", type=int, default=STEPS, help="control steps of a scene")
    parser.add_argument("--store", action="store_true", help="renew the table of docs/speed.md")
    options = parser.parse_args()
    if missing := [tool for tool in ("valgrind", "addr2line") if shutil.which(tool) is None]:
        sys.exit(f"expected valgrind and addr2line, missing: {', '.join(missing)}")
    program = build()
    cases = list(product(options.scenes, ENGINES))
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        rows = list(pool.map(lambda case: row(case[0], case[1], program, options.steps), cases))
    header = ("scene", "engine", "per tick", *PARTS, REST, "ticks without solver")
    text = table(header, rows) + "\n"
    sys.stdout.write(text)
    if options.store:
        STORED.write_text(text)


def build() -> Path:
    """Build the benchmark as in a release, with line tables, and return its path."""
    command = ["cargo", "build", "--locked", "--profile", "bench", "--package", "rsim-bench"]
    command += ["--bench", "instructions", "--target-dir", str(BUILD), "--message-format", "json"]
    environment = {**os.environ, "CARGO_PROFILE_BENCH_DEBUG": "line-tables-only"}
    ran = subprocess.run(command, cwd=ROOT, env=environment, stdout=subprocess.PIPE, check=True)
    messages = [json.loads(line) for line in ran.stdout.splitlines()]
    built = [message["executable"] for message in messages if message.get("executable")]
    return Path(built[-1])


def row(scene: str, engine: str, program: Path, steps: int) -> tuple[str, ...]:
    """Return the cells of a scene with an engine: instructions per tick."""
    with TemporaryDirectory() as folder:
        counts = Path(folder) / "counts"
        command = ["valgrind", "--tool=callgrind", "--demangle=no", "--dump-instr=yes"]
        command += ["--compress-strings=no", "--compress-pos=no", "--collect-atstart=no"]
        command += [f"--toggle-collect=*{ROOT_FUNCTION}*", f"--callgrind-out-file={counts}"]
        command += [str(program), scene, engine, str(steps)]
        ran = subprocess.run(command, capture_output=True, text=True, check=False)
        if ran.returncode:
            raise RuntimeError(f"{' '.join(command)} failed ({ran.returncode}):\n{ran.stderr}")
        ticks, free = map(int, ran.stdout.split())
        functions = read_counts(counts)
    parts = costs_by_part(functions, program)
    per_tick = {part: cost / ticks for part, cost in parts.items()}
    league, sizes, play = scene.split("_")
    name = f"{LEAGUES[league]} {sizes.replace('v', ' v ')} {play}"
    cells = [rounded(per_tick.get(part, 0.0)) for part in (*PARTS, REST)]
    return (name, f"`{engine}`", rounded(sum(per_tick.values())), *cells, f"{free / ticks:.0%}")


def rounded(count: float) -> str:
    """Return a count rounded to tens, of large ones to three digits."""
    return f"{float(f'{round(count, -1):.3g}'):,.0f}"


def read_counts(path: Path) -> dict[Name, Function]:
    """Read a file of callgrind with uncompressed names and positions."""
    functions: dict[Name, Function] = defaultdict(Function)
    names = {"ob": "", "fn": "", "cob": "", "cfn": ""}
    called = False
    for line in path.read_text().splitlines():
        key, separator, value = line.partition("=")
        if separator and key in names:
            names[key] = value
            if key in ("fn", "ob"):
                names["cob"] = ""
        elif key == "calls":
            called = True
        elif line.startswith("0x"):
            position, _, cost = line.split()
            address = names["ob"], position
            function = functions[names["ob"], names["fn"]]
            if called:
                callee = names["cob"] or names["ob"], names["cfn"]
                function.calls.append((address, callee, int(cost)))
                called, names["cob"] = False, ""
            else:
                function.own[address] += int(cost)
    return functions


def costs_by_part(functions: dict[Name, Function], program: Path) -> dict[str, float]:
    """Return the instructions of each part.

    An instruction belongs to the innermost inlined function that a file of a part holds. Helpers of
    several parts, such as the mathematical library, belong to the parts that call them.
    """
    parts = parts_of_addresses(functions, program)
    # Share of a function's cost that belongs to its callers.
    shares = dict.fromkeys(functions, 0.0)
    for _ in range(100):
        before, shares = shares, {name: _share(f, parts, shares) for name, f in functions.items()}
        if max(abs(shares[name] - before[name]) for name in functions) < 1e-9:
            break
    costs: dict[str, float] = defaultdict(float)
    for function in functions.values():
        for address, cost in function.own.items():
            costs[parts.get(address, "")] += cost
        for address, callee, cost in function.calls:
            if address in parts:
                costs[parts[address]] += cost * shares[callee]
    total = sum(sum(function.own.values()) for function in functions.values())
    del costs[""]
    costs[REST] = total - sum(costs.values())
    return costs


def _share(function: Function, parts: dict[Address, str], shares: dict[Name, float]) -> float:
    """Return the share of a function's cost that belongs to its callers."""
    helping = sum(cost for address, cost in function.own.items() if address not in parts)
    called = sum(cost * shares[to] for at, to, cost in function.calls if at not in parts)
    return (helping + called) / max(function.total, 1)


def parts_of_addresses(functions: dict[Name, Function], program: Path) -> dict[Address, str]:
    """Return the part of each address of the program that belongs to one."""
    addresses = {address for function in functions.values() for address in function.own}
    addresses |= {at for function in functions.values() for at, _, _ in function.calls}
    mine = sorted(address for address in addresses if address[0] == str(program))
    found = (part_of(places) for places in source_places(program, [at for _, at in mine]))
    return {address: part for address, part in zip(mine, found, strict=True) if part}


def source_places(program: Path, positions: Sequence[str]) -> Iterator[list[str]]:
    """Yield file and function of each position, as "file:function", inlined functions first."""
    command = ["addr2line", "--addresses", "--functions", "--inlines", "--exe", str(program)]
    asked = "\n".join(positions)
    ran = subprocess.run(command, input=asked, capture_output=True, text=True, check=True)
    for block in re.split(r"^0x", ran.stdout, flags=re.MULTILINE)[1:]:
        _, *lines = block.splitlines()
        files = (line.partition(":")[0] for line in lines[1::2])
        yield [f"{file}:{name}" for file, name in zip(files, lines[::2], strict=True)]


def part_of(places: Sequence[str]) -> str | None:
    """Return the part of an instruction by its places, as `source_places` yields them."""
    if any(LOADS in place for place in places):
        return "loads"
    for place in places:
        if ENGINE_CRATES.search(place):
            return "solver"
        _, _, name = place.partition(CORE)
        for part, beginnings in PARTS.items():
            if name.startswith(beginnings):
                return part
    return None


if __name__ == "__main__":
    main()
