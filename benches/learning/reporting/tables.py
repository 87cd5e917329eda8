"""Tables of the report as Markdown; empty groups give an empty text."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from benches.learning.ablation import CHANGES, OURS, PAPER
from benches.learning.reporting import cells
from benches.learning.reporting.collection import Collected, find, finished
from benches.markdown import table

Studied = Sequence[Collected]


def results(collected: Studied) -> str:
    """Return the results of PPO on each task against each opponent."""
    parts = finished(collected, "ppo")
    header = (
        *("task", "against", "measure", "score", "95% interval", "target", "seeds"),
        *("samples", "core time", "time to the target"),
    )
    rows = [_result_row(part, opponent) for part in parts for opponent in part.opponents]
    return _with_notes(header, rows, collected, "ppo")


def details(collected: Studied) -> str:
    """Return what else was measured of the policies of `results`."""
    header = (
        *("task", "against", "mean action", "won, drawn, lost (own goals)"),
        *("measured beside it", "time to a goal or success"),
    )
    rows = [
        (
            f"`{part.experiment.task}`{cells.mark(part)}",
            cells.against(opponent),
            cells.number(part.estimate(opponent, "mean").value) if "mean" in part.modes else "",
            cells.outcomes(part, opponent),
            cells.second_measure(part, opponent),
            cells.time_to_decision(part, opponent),
        )
        for part in finished(collected, "ppo")
        for opponent in part.opponents
    ]
    return table(header, rows) if rows else ""


def _result_row(part: Collected, opponent: str) -> tuple[str, ...]:
    estimate = part.estimate(opponent)
    return (
        f"`{part.experiment.task}`{cells.mark(part)}",
        cells.against(opponent),
        cells.measure(part),
        cells.number(estimate.value),
        cells.interval(estimate),
        cells.target(part, opponent),
        cells.seeds(part.scores(opponent)),
        cells.millions(part.samples()),
        cells.minutes(part.core_seconds()),
        cells.time_to_target(part, opponent),
    )


def baselines(collected: Studied) -> str:
    """Return the scores of DDPG and SAC beside those of PPO."""
    header = (
        *("task", "algorithm", "score", "95% interval", "seeds", "mean action"),
        *("PPO, same time", "P(PPO better)", "PPO, as many samples"),
        *("samples", "gradient steps", "core time"),
    )
    groups = ("baselines", "calibration")
    parts = [part for group in groups for part in finished(collected, group)]
    rows = [_baseline_row(part, collected) for part in parts]
    return _with_notes(header, rows, collected, *groups)


def _baseline_row(part: Collected, collected: Studied) -> tuple[str, ...]:
    experiment, estimate = part.experiment, part.estimate()
    calibrates = experiment.group == "calibration"
    label = experiment.algorithm.upper() + (", the paper's setting" if calibrates else "")
    # A run of the paper's setting has more time than PPO's, so only their samples compare.
    ppo = find(collected, experiment.task)
    rival = None if calibrates else ppo
    steps = sum(float(r["gradient_steps"]) for r in part.results) / len(part.results)
    return (
        f"`{experiment.task}`{cells.against_first(part)}{cells.mark(part)}",
        label,
        cells.number(estimate.value),
        cells.interval(estimate),
        cells.seeds(part.scores()),
        cells.number(part.estimate(mode="mean").value),
        cells.number(rival.estimate(part.opponents[0]).value) if rival else "",
        cells.better(rival, part) if rival else "",
        cells.on_curve(ppo, part.samples()) if ppo else "",
        cells.millions(part.samples()),
        cells.millions(steps),
        cells.minutes(part.core_seconds()),
    )


def ablation(collected: Studied) -> str:
    """Return the scores with one change added to the paper's setting, and with one left out."""
    parts = {part.experiment.name: part for part in finished(collected, "ablation")}
    header = (
        *("change", "paper's with it", "95% interval", "P(better than paper's)"),
        *("ours without it", "95% interval", "P(ours better)", "seeds: paper's", "ours"),
    )
    paper, ours = parts.get(PAPER), parts.get(OURS)
    rows = []
    if paper or ours:
        none = ("none", *_ablation_cells(paper, None), *_ablation_cells(ours, None))
        rows.append((*none, cells.seeds_of(paper), cells.seeds_of(ours)))
    for change in CHANGES:
        added = parts.get(f"{PAPER}+{change.name}")
        left_out = parts.get(f"{OURS}-{change.name}")
        if added or left_out:
            with_it = _ablation_cells(added, paper)
            without = _ablation_cells(left_out, ours, swap=True)
            points = (cells.seeds_of(added), cells.seeds_of(left_out))
            rows.append((change.text, *with_it, *without, *points))
    return _with_notes(header, rows, collected, "ablation")


def _ablation_cells(
    part: Collected | None, reference: Collected | None, *, swap: bool = False
) -> tuple[str, str, str]:
    """Score, interval and probability of improvement over a reference, or of the reference."""
    if part is None:
        return "missing", "", ""
    estimate = part.estimate()
    better = ""
    if reference is not None:
        better = cells.better(reference, part) if swap else cells.better(part, reference)
    return f"{cells.number(estimate.value)}{cells.mark(part)}", cells.interval(estimate), better


def cooperation(collected: Studied) -> str:
    """Return the comparisons of teams, clones and critics."""
    header = (
        *("task", "policy", "against", "score", "95% interval", "target"),
        *("PPO of the first table", "P(better than it)", "seeds", "won, drawn, lost (own goals)"),
    )
    rows = [
        _cooperation_row(part, opponent, collected)
        for part in finished(collected, "cooperation")
        for opponent in part.opponents
    ]
    return _with_notes(header, rows, collected, "cooperation")


def _cooperation_row(part: Collected, opponent: str, collected: Studied) -> tuple[str, ...]:
    estimate = part.estimate(opponent)
    ppo = find(collected, part.experiment.task)
    # Clones play the task of a team: their comparison with it is the same.
    comparable = ppo is not None and opponent in ppo.opponents
    return (
        f"`{part.experiment.task}`{cells.mark(part)}",
        part.experiment.text,
        cells.against(opponent),
        cells.number(estimate.value),
        cells.interval(estimate),
        # Targets against scripts are those of the first table's policies.
        cells.target(part, opponent) if opponent.startswith("@") else "",
        cells.number(ppo.estimate(opponent).value) if ppo and comparable else "",
        cells.better(part, ppo, opponent) if ppo and comparable else "",
        cells.seeds(part.scores(opponent)),
        cells.outcomes(part, opponent),
    )


def compute(collected: Studied) -> str:
    """Return the time that the runs of each group took."""
    rows = []
    for group in dict.fromkeys(part.experiment.group for part in collected):
        found = [result for part in finished(collected, group) for result in part.results]
        if found:
            learning = sum(float(result["seconds"]["cpu"]) for result in found) / 3600.0
            wall = sum(float(result["seconds"]["wall"]) for result in found) / 3600.0
            evaluation = sum(float(result["evaluation_seconds"]) for result in found) / 3600.0
            samples = cells.millions(sum(float(result["samples"]) for result in found))
            machines = sorted({_machine(result["machine"]) for result in found})
            hours = (f"{hours:.1f} h" for hours in (learning, wall, evaluation))
            rows.append((group, str(len(found)), samples, *hours, ", ".join(machines)))
    header = (
        *("group", "runs", "samples", "core time of learning", "its wall clock"),
        *("wall clock of evaluation", "machine, one core of it for each run"),
    )
    return table(header, rows) if rows else ""


def _machine(found: Mapping[str, Any]) -> str:
    return f"{found['machine']}, {found['cores']} cores"


def _with_notes(
    header: tuple[str, ...], rows: Sequence[tuple[str, ...]], collected: Studied, *groups: str
) -> str:
    """A table with a line about missing and stale runs; empty without rows."""
    if not rows:
        return ""
    parts = [part for part in collected if part.experiment.group in groups and part.missing]
    missing = {part.experiment.key.removeprefix(f"{groups[0]}/"): part.missing for part in parts}
    notes = []
    if missing:
        names = ", ".join(f"{name} ({count})" for name, count in missing.items())
        notes.append(f"Missing runs: {names}.")
    text = "\n\n".join([table(header, rows), *notes])
    return f"{text}{_stale_note(text)}"


def _stale_note(text: str) -> str:
    """Explanation of the mark of stale results, as a paragraph; empty where the text has none."""
    found = cells.STALE_MARK in text
    return f"\n\n{cells.STALE_MARK} Settings have changed since this run." if found else ""
