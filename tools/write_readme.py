"""Writes the parts of the pages that code or measurements know better: `make docs`.

A test compares the pages with what this would write, so a table cannot drift from the code.
"""

import argparse
import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import gymnasium
import pettingzoo

import rsoccer
from benches.table import RESULTS, ROOT
from rsoccer import policies
from rsoccer.registry import list_options
from rsoccer.tasks import legacy_names
from tools.parts import filled, table
from tools.speed import speed
from tools.task_pictures import path_of

README = ROOT / "README.md"
PAGES = (README, ROOT / "docs" / "robosim.md")
DEMO = RESULTS / "demo.json"
PICTURES = {
    "docs/match.gif": "A match after a few minutes of training",
    "docs/curve.png": "Goal score over training",
}
ABREAST = 3
"""Pictures of tasks in a row."""


def main() -> None:
    """Write the pages again; with `--check`, only say whether that would change any."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--check", action="store_true", help="change nothing; 1 if one is stale")
    check = parser.parse_args().check
    for page in PAGES:
        text = page.read_text()
        if not check:
            page.write_text(written(text, page.name))
        elif written(text, page.name) != text:
            sys.exit(f"{page.name} is stale: run `make docs`")


def written(text: str, name: str = README.name) -> str:
    """A page with every part as it should be now; ValueError for a part nobody writes."""
    return filled(text, PARTS, name)


def tasks() -> str:
    """Every registered task with its sizes, and a picture of each."""
    names = rsoccer.list_tasks()
    rows = [_task_row(name) for name in names]
    sizes = ("robots", "learners", "observation", "action", "time limit")
    header = ("task", "what it is", "success", *sizes)
    return f"{table(header, rows)}\n\n{_gallery(names)}"


def _gallery(names: list[str]) -> str:
    """Pictures side by side, as many as a page is wide, each under its name."""
    cells = [f"`{name}`<br>![]({path_of(name).relative_to(ROOT)})" for name in names]
    rows = [tuple(cells[i : i + ABREAST]) for i in range(0, len(cells), ABREAST)]
    last = (*rows[-1], *("",) * (ABREAST - len(rows[-1])))
    return table(("",) * ABREAST, [*rows[:-1], last])


def _task_row(name: str) -> tuple[str, ...]:
    task = rsoccer.make_task(name)
    summary = (type(task).__doc__ or "").split("\n")[0]
    return (
        f"`{name}`",
        summary,
        f"`{task.success}`",
        f"{task.n_blue} v {task.n_yellow}",
        str(len(task.agents)),
        str(task.observation_size),
        str(task.action_size),
        f"{task.max_steps * task.config.time_step:g} s",
    )


def policy_names() -> str:
    """The policies that come with the package, as a sentence."""
    names = ", ".join(f"`{name}`" for name in policies.names())
    skilled = " or ".join(f"`{name}:0.5`" for name in policies.names_with_skill())
    return (
        f"{names}, or the path of a policy file. A skill from 0 to 1 may follow, as in {skilled}. "
        "A file plays as it was trained, by chance too, or as in `policy.safetensors:mean`."
    )


def demo() -> str:
    """What `make demo` reached when its result was kept."""
    if not DEMO.exists():
        return ""
    kept = json.loads(DEMO.read_text())
    header = ("against", "matches", "won", "drawn", "lost", "goal score", "95% interval")
    rows = [_evaluation_row(evaluation) for evaluation in kept["evaluations"]]
    training, machine = kept["training"], kept["machine"]
    shares = ", ".join(f"{name} {share:.0%}" for name, share in training["shares"].items())
    return (
        f"{kept['samples']:,} decisions in {kept['seconds']['training']:.0f} s on "
        f"{machine['machine']}, {machine['cores']} cores, {machine['date']}:\n\n"
        f"{table(header, rows)}\n\n"
        f"Learning took {_thousands(training['samples_per_second'])} decisions, "
        f"{_thousands(training['agent_steps_per_second'])} agent-steps, a second; "
        f"the time went to {shares}."
    )


def _evaluation_row(evaluation: dict[str, Any]) -> tuple[str, ...]:
    counts = [str(evaluation[key]) for key in ("matches", "wins", "draws", "losses")]
    interval = f"{evaluation['low']:+.2f} to {evaluation['high']:+.2f}"
    opponent = Path(evaluation["opponent"]).name.removesuffix(".safetensors")
    return (opponent, *counts, f"{evaluation['score']:+.2f}", interval)


def pictures() -> str:
    """The pictures that are there."""
    found = [f"![{text}]({path})" for path, text in PICTURES.items() if (ROOT / path).exists()]
    return "\n\n".join(found)


def options() -> str:
    """The options of each task: the fields of its dataclass."""
    rows = []
    for name in rsoccer.list_tasks():
        names = list_options(type(rsoccer.make_task(name)))
        rows.append((f"`{name}`", ", ".join(f"`{option}`" for option in names)))
    return table(("task", "options"), rows)


def old_names() -> str:
    """rsoccer-gym's names of environments, and what they are here."""
    rows = [(f"`{name}`", f"`{name}`", _doors(name)) for name in legacy_names.KEPT]
    for name, (task, given) in legacy_names.ALIASES.items():
        told = [f"`{option}={value!r}`" for option, value in given.items()]
        rows.append((f"`{name}`", ", ".join([f"`{task}`", *told]), _doors(name)))
    rows += [(f"`{name}`", f"none: {hint}", "") for name, hint in legacy_names.RETIRED.items()]
    return table(("rsoccer-gym 1.4", "here", "through"), rows)


def _doors(name: str) -> str:
    """The libraries that know a name."""
    known = {"Gymnasium": [*gymnasium.registry], "PettingZoo": [*pettingzoo.parallel_registry]}
    return ", ".join(library for library in known if f"rsoccer/{name}" in known[library])


def hello() -> str:
    """The first example."""
    return python_block((ROOT / "examples" / "01_hello.py").read_text())


def new_task() -> str:
    """The second example as far as its training: the task by itself."""
    text = (ROOT / "examples" / "02_new_task.py").read_text()
    return python_block(text[: text.index("def share_reached")])


def python_block(code: str) -> str:
    """Code as a block of Markdown."""
    return f"```python\n{code.strip()}\n```"


def _thousands(value: float) -> str:
    """Three digits, which is about what repeats."""
    return f"{float(f'{value:.3g}'):,.0f}"


PARTS: dict[str, Callable[[], str]] = {
    "demo": demo,
    "hello": hello,
    "new_task": new_task,
    "old_names": old_names,
    "options": options,
    "pictures": pictures,
    "policies": policy_names,
    "speed": speed,
    "tasks": tasks,
}


if __name__ == "__main__":
    main()
