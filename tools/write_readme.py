"""Writes the generated parts of README.md and of pages in docs/: `make docs`.

Code and measurements are their source. A test compares the pages with what this would write, so a
table cannot differ from the code.
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
from benches import (
    offline,
    ray_training,
    scripted_ssl,
    tactics,
    transfer_responses,
    transfer_tables,
)
from benches.learning.reporting import report as learning
from benches.markdown import filled, table
from rsoccer import policies
from rsoccer.policies import trained
from rsoccer.policies.evolved import is_tactics
from rsoccer.policies.policy_file import read_file
from rsoccer.registry import make_task
from rsoccer.tasks import legacy_names
from tools import leaderboard, referee_scenes, referee_tables, senses_tables, soak_matches
from tools.library_speed import libraries
from tools.paths import DOCS, ROOT
from tools.protocols import codes, fields
from tools.site import task_docs
from tools.speed import feature, instructions, speed, summary, training_speed, whole_matches

README = ROOT / "README.md"
WRITTEN = (
    README,
    DOCS / "coming-from-rsoccer-gym.md",
    DOCS / "cooperation.md",
    DOCS / "getting-started.md",
    DOCS / "index.md",
    *learning.PAGES,
    DOCS / "leaderboard.md",
    DOCS / "libraries.md",
    DOCS / "offline.md",
    DOCS / "policies.md",
    DOCS / "protocols.md",
    DOCS / "referee.md",
    DOCS / "scaling.md",
    DOCS / "senses.md",
    DOCS / "speed.md",
    DOCS / "transfer.md",
    DOCS / "tutorials" / "new-task.md",
)
DEMO = DOCS / "demo.json"
DEMO_PARTS = {"ladder": "evaluation", "tasks": "observations and rewards"}
"""Names of parts of the training's time where they differ from those of the log."""
PICTURES = {
    "match": ("docs/match.gif", "A match after half a minute of training"),
    "curve": ("docs/curve.png", "Goal score over training"),
}
"""Pictures that `tools.keep_demo` copies or films: path and description."""


def main() -> None:
    """Renew the pages; with `--check`, only report whether one would change."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--check", action="store_true", help="change nothing; 1 if one is stale")
    check = parser.parse_args().check
    for page in WRITTEN:
        text = page.read_text()
        if not check:
            page.write_text(written(text, page.name))
        elif written(text, page.name) != text:
            sys.exit(f"{page.name} is stale: run `make docs`")


def written(text: str, name: str = README.name) -> str:
    """Return a page with every generated part renewed.

    Args:
        text: The page.
        name: Its name for error messages.

    Returns:
        The page as it should be.

    Raises:
        ValueError: The page has an unknown part.
    """
    return filled(text, PARTS, name)


def tasks() -> str:
    """Return the table of all registered tasks."""
    rows = [_task_row(name) for name in rsoccer.list_tasks()]
    return table(("task", "summary", "robots", "learners", "success"), rows)


def _task_row(name: str) -> tuple[str, ...]:
    task = rsoccer.make_task(name)
    return (
        f"`{name}`",
        task_docs.summary(task),
        f"{task.n_blue} v {task.n_yellow}",
        str(len(task.agents)),
        f"`{task.success}`",
    )


def policy_names() -> str:
    """Return the names of the shipped policies as a sentence."""
    names = ", ".join(f"`{name}`" for name in policies.list_policies())
    skilled = " or ".join(f"`{name}:0.5`" for name in policies.list_policies_with_skill())
    return (
        f"{names}, the path of a policy file, or `module:name` of code of your own. A skill "
        f"from 0 to 1 may follow, as in {skilled}. `best` is the [trained policy]"
        "(docs/policies.md#trained-policies) of the task. It and "
        "policy files sample actions as in training; `best:mean` plays the mean action, and "
        "`best:lookahead` [tries actions](docs/policies.md#lookahead) before it acts."
    )


def policy_table() -> str:
    """Return the table of the shipped policies and the robots that they drive."""
    rows = [(f"`{trained.BEST}`", "by task", "The trained policy of the task, see below.")]
    for name in policies.list_policies():
        if name == trained.BEST:
            continue
        fits = {task[:3]: made for task in rsoccer.list_tasks() if (made := _made(name, task))}
        leagues = " and ".join({"SSL": "SSL", "VSS": "VSSS"}[league] for league in fits)
        summary = (next(iter(fits.values())).__doc__ or "").split("\n")[0]
        rows.append((f"`{name}`", leagues, summary))
    return table(("policy", "robots", "behavior"), rows)


def trained_table() -> str:
    """Return the table of the trained policies in the package and of their scores."""
    header = ("task", "samples", "opponent", "metric", "mean", "95% interval", "matches")
    rows = [cells for variant in (None, trained.OPPONENTS) for _, cells in _scores(variant)]
    return table(header, sorted(rows, key=lambda cells: cells[0]))


def robust_table() -> str:
    """Return the table of the policies `best:robust` and of their scores."""
    header = ("task", "samples", "opponent", "metric", "mean", "95% interval", "matches", "sensing")
    rows = [(*cells, sensing and f"`{sensing}`") for sensing, cells in _scores(trained.ROBUST)]
    return table(header, rows)


def _scores(variant: str | None) -> list[tuple[str, tuple[str, ...]]]:
    """Senses and cells of each score of the trained policies of a variant."""
    rows: list[tuple[str, tuple[str, ...]]] = []
    for name, path in trained.list_trained(variant).items():
        metadata = read_file(path)[1]
        samples = json.loads(metadata["training"])["samples"]
        millions = samples / 1e6
        made = f"{millions:.0f} M" if millions >= 1.0 else f"{millions:.2g} M"
        if is_tactics(metadata):
            made = f"{samples:,} matches"
        options = f", {metadata['task_options']}" if variant == trained.OPPONENTS else ""
        for score in trained.list_scores(path):
            interval = f"{score.low:.3f} to {score.high:.3f}"
            cells = (f"`{score.opponent}`", f"`{score.metric}`", f"{score.score:.3f}", interval)
            rows.append((score.sensing, (f"`{name}`{options}", made, *cells, str(score.matches))))
    return rows


def _made(name: str, task: str) -> policies.Policy | None:
    """A policy for the robots of a task, or None if it cannot drive them."""
    try:
        return policies.make_policy(name, rsoccer.make_task(task))
    except ValueError:
        return None


def demo() -> str:
    """Return the results of `make demo` that `tools.keep_demo` kept; empty without them."""
    if not DEMO.exists():
        return ""
    kept = json.loads(DEMO.read_text())
    header = ("against", "matches", "won", "drawn", "lost", "goal score", "95% interval")
    rows = [_evaluation_row(evaluation) for evaluation in kept["evaluations"]]
    training, machine = kept["training"], kept["machine"]
    parts = sorted(training["shares"].items(), key=lambda part: -part[1])
    shares = ", ".join(f"{DEMO_PARTS.get(name, name)} {share:.0%}" for name, share in parts)
    return (
        f"{kept['samples']:,} decisions in {kept['seconds']['training']:.0f} s on "
        f"{machine['machine']}, {machine['cores']} cores, {machine['date']}:\n\n"
        f"{table(header, rows)}\n\n"
        f"A second of training makes {_thousands(training['samples_per_second'])} decisions, which "
        f"are {_thousands(training['agent_steps_per_second'])} control steps of robots. Its time: "
        f"{shares}."
    )


def _evaluation_row(evaluation: dict[str, Any]) -> tuple[str, ...]:
    counts = [str(evaluation[key]) for key in ("matches", "wins", "draws", "losses")]
    interval = f"{evaluation['low']:+.2f} to {evaluation['high']:+.2f}"
    opponent = Path(evaluation["opponent"]).name.removesuffix(".safetensors")
    return (opponent, *counts, f"{evaluation['score']:+.2f}", interval)


def match_picture() -> str:
    """Return the link to the film of a match; empty without the file."""
    return _picture("match")


def curve_picture() -> str:
    """Return the link to the curve of a training run; empty without the file."""
    return _picture("curve")


def _picture(name: str) -> str:
    path, text = PICTURES[name]
    return f"![{text}]({path})" if (ROOT / path).exists() else ""


def old_names() -> str:
    """Return the table of rsoccer-gym's environments and their names here."""
    rows = [(f"`{name}`", f"`{name}`", _libraries(name)) for name in legacy_names.KEPT]
    for name, (task, given) in legacy_names.ALIASES.items():
        options = [f"`{option}={value!r}`" for option, value in given.items()]
        rows.append((f"`{name}`", ", ".join([f"`{task}`", *options]), _libraries(name)))
    rows += [(f"`{name}`", f"none: {hint}", "") for name, hint in legacy_names.REMOVED.items()]
    return table(("rsoccer-gym 1.4", "here", "through"), rows)


def _libraries(name: str) -> str:
    """Libraries that have an id of this name."""
    known = {"Gymnasium": [*gymnasium.registry], "PettingZoo": [*pettingzoo.parallel_registry]}
    found = [library for library in known if f"rsoccer/{name}" in known[library]]
    if "Gymnasium" in found and len(make_task(name).agents) > 1:
        found[found.index("Gymnasium")] = "Gymnasium with `learner`"
    return ", ".join(found)


def new_task() -> str:
    """Return the task of the second example, without its training."""
    text = (ROOT / "examples" / "02_new_task.py").read_text()
    return python_block(text[: text.index("def share_reached")])


def python_block(code: str) -> str:
    """Return code as a block of Markdown."""
    return f"```python\n{code.strip()}\n```"


def _thousands(value: float) -> str:
    """A number with three digits: more do not repeat."""
    return f"{float(f'{value:.3g}'):,.0f}"


PARTS: dict[str, Callable[[], str]] = {
    **learning.PARTS,
    "curve": curve_picture,
    "demo": demo,
    "instructions": instructions,
    "leaderboard_paper": leaderboard.papers_algorithms,
    "leaderboard_plain": leaderboard.plain,
    "leaderboard_provenance": leaderboard.provenance,
    "leaderboard_quoted": leaderboard.quoted,
    "leaderboard_robust": leaderboard.robust,
    "libraries": libraries,
    "match": match_picture,
    "new_task": new_task,
    "offline": offline.results,
    "old_names": old_names,
    "policies": policy_names,
    "ray_extrapolation": ray_training.extrapolation,
    "ray_training": ray_training.report,
    "referee_choices": referee_tables.choices,
    "referee_numbers": referee_tables.numbers,
    "passing": tactics.passing_report,
    "policy_table": policy_table,
    "protocol_codes": codes.table_of_codes,
    "protocol_counts": fields.counts,
    "protocol_fields": fields.field_tables,
    "robust_table": robust_table,
    "trained_table": trained_table,
    "senses_forecasts": senses_tables.forecasts,
    "scripted_ssl": scripted_ssl.results,
    "senses_numbers": senses_tables.numbers,
    "senses_randomization": senses_tables.randomization,
    "soak_matches": soak_matches.results,
    "ssl_rules": referee_tables.ssl_rules,
    "ssl_scenes": referee_scenes.ssl_scenes,
    "speed": speed,
    "speed_feature": feature,
    "speed_summary": summary,
    "tactics": tactics.report,
    "tasks": tasks,
    "training_speed": training_speed,
    "transfer": transfer_tables.transfer,
    "transfer_responses": transfer_responses.report,
    "vsss_rules": referee_tables.vsss_rules,
    "vsss_scenes": referee_scenes.vsss_scenes,
    "whole_matches": whole_matches,
}


if __name__ == "__main__":
    main()
