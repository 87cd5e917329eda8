"""Tables of the report as Markdown; empty groups give an empty text."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from benches.learning.ablation import CHANGES, OURS, PAPER
from benches.learning.collection import Collected, find, finished
from benches.learning.curves import value_at
from benches.learning.statistics import Estimate, probability_of_improvement
from benches.learning.targets import FULL_SUCCESS, TARGETS
from tools.markdown import table

Studied = Sequence[Collected]
STALE_MARK: Final = "\\*"


def results(collected: Studied) -> str:
    """Return the results of PPO on each task against each opponent."""
    parts = finished(collected, "ppo")
    header = (
        *("task", "against", "score", "95% interval", "target", "seeds", "mean action"),
        *("won, drawn, lost (own goals)", "time to success", "samples", "core time"),
    )
    rows = [_result_row(part, opponent) for part in parts for opponent in part.opponents]
    return _with_notes(header, rows, collected, "ppo")


def _result_row(part: Collected, opponent: str) -> tuple[str, ...]:
    task = part.experiment.task
    estimate = part.estimate(opponent)
    return (
        _name(part, task),
        "" if opponent == "-" else f"`{opponent}`",
        _number(estimate.value),
        _interval(estimate),
        _target(part, opponent),
        _seeds(part.scores(opponent)),
        _number(part.estimate(opponent, "mean").value) if "mean" in part.modes else "",
        _outcomes(part, opponent),
        _time_to_success(part, opponent),
        _millions(part.samples()),
        _minutes(part.core_seconds()),
    )


def baselines(collected: Studied) -> str:
    """Return the scores of DDPG and SAC beside those of PPO."""
    header = (
        *("task", "algorithm", "score", "95% interval", "seeds", "PPO, same time"),
        *("PPO better", "PPO, as many samples", "samples", "gradient steps"),
        "core time",
    )
    rows = [_baseline_row(part, collected) for part in finished(collected, "baselines")]
    return _with_notes(header, rows, collected, "baselines")


def _baseline_row(part: Collected, collected: Studied) -> tuple[str, ...]:
    experiment, estimate = part.experiment, part.estimate()
    ppo = find(collected, f"ppo/{experiment.task}")
    label = f"{experiment.algorithm.upper()}{', paper sizes' if 'paper' in experiment.name else ''}"
    opponent = "" if part.opponents[0] == "-" else f" against `{part.opponents[0]}`"
    steps = sum(float(r["gradient_steps"]) for r in part.results) / len(part.results)
    return (
        _name(part, f"{experiment.task}{opponent}"),
        label,
        _number(estimate.value),
        _interval(estimate),
        _seeds(part.scores()),
        _number(ppo.estimate(part.opponents[0]).value) if ppo else "",
        _better(ppo, part) if ppo else "",
        _on_curve(ppo, part.samples()) if ppo else "",
        _millions(part.samples()),
        _millions(steps),
        _minutes(part.core_seconds()),
    )


def ablation(collected: Studied) -> str:
    """Return the scores with one change added to the paper's setting, and with one left out."""
    parts = {part.experiment.name: part for part in finished(collected, "ablation")}
    header = (
        *("change", "paper + change", "95% interval", "P(better than paper)"),
        *("ours - change", "95% interval", "P(ours better)", "seeds: paper + change", "ours"),
    )
    paper, ours = parts.get(PAPER), parts.get(OURS)
    rows = []
    if paper or ours:
        cells = ("none", *_ablation_cells(paper, None), *_ablation_cells(ours, None))
        rows.append((*cells, _seeds_of(paper), _seeds_of(ours)))
    for change in CHANGES:
        added = parts.get(f"{PAPER}+{change.name}")
        left_out = parts.get(f"{OURS}-{change.name}")
        if added or left_out:
            with_it = _ablation_cells(added, paper)
            without = _ablation_cells(left_out, ours, swap=True)
            points = (_seeds_of(added), _seeds_of(left_out))
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
        better = _better(reference, part) if swap else _better(part, reference)
    return _number(estimate.value), _interval(estimate), better


def cooperation(collected: Studied) -> str:
    """Return the comparisons of teams, clones and critics."""
    header = (
        *("task", "policy", "against", "score", "95% interval", "PPO, decentral critic"),
        *("P(better than that)", "seeds"),
    )
    rows = [
        _cooperation_row(part, opponent, collected)
        for part in finished(collected, "cooperation")
        for opponent in part.opponents
    ]
    return _with_notes(header, rows, collected, "cooperation")


def _cooperation_row(part: Collected, opponent: str, collected: Studied) -> tuple[str, ...]:
    estimate = part.estimate(opponent)
    ppo = find(collected, f"ppo/{part.experiment.task}")
    # Clones play the task of a team: their comparison with it is the same.
    comparable = ppo is not None and opponent in ppo.opponents
    against = "" if opponent == "-" else f"`{opponent}`"
    if opponent.startswith("@"):
        against = f"policy of {opponent.removeprefix('@ppo/')}"
    return (
        _name(part, part.experiment.task),
        part.experiment.text,
        against,
        _number(estimate.value),
        _interval(estimate),
        _number(ppo.estimate(opponent).value) if ppo and comparable else "",
        _better(part, ppo, opponent) if ppo and comparable else "",
        _seeds(part.scores(opponent)),
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
            samples = _millions(sum(float(result["samples"]) for result in found))
            machines = sorted({str(result["machine"]["machine"]) for result in found})
            hours = (f"{hours:.1f} h" for hours in (learning, wall, evaluation))
            rows.append((group, str(len(found)), samples, *hours, ", ".join(machines)))
    header = ("group", "runs", "samples", "core time", "wall clock", "evaluation", "machine")
    return table(header, rows) if rows else ""


def headline(collected: Studied) -> str:
    """Return the table of the README: all tasks, with PPO, DDPG and SAC."""
    rows = []
    for part in finished(collected, "ppo"):
        task = part.experiment.task
        others = (find(collected, f"baselines/{task}-{name}") for name in ("ddpg", "sac"))
        against = "" if part.opponents[0] == "-" else f" against `{part.opponents[0]}`"
        metric = part.rows()[0]["metric"].replace("_", " ")
        rows.append(
            (
                f"`{task}`",
                f"{metric}{against}",
                _with_interval(part),
                *(_with_interval(other) for other in others),
                f"{_millions(part.samples())}, {_minutes(part.core_seconds())}",
            )
        )
    header = ("task", "score", "PPO", "DDPG", "SAC", "PPO's samples, time of one core")
    return table(header, rows) if rows else ""


def _with_notes(
    header: tuple[str, ...], rows: Sequence[tuple[str, ...]], collected: Studied, group: str
) -> str:
    """A table with a line about missing and stale runs; empty without rows."""
    if not rows:
        return ""
    parts = [part for part in collected if part.experiment.group == group]
    missing = {part.experiment.name: part.missing for part in parts if part.missing}
    notes = []
    if missing:
        names = ", ".join(f"{name} ({count})" for name, count in missing.items())
        notes.append(f"Missing runs: {names}.")
    if any(part.stale for part in parts):
        notes.append(f"{STALE_MARK} Settings in the table have changed since this run.")
    return "\n\n".join([table(header, rows), *notes])


def _name(part: Collected, text: str) -> str:
    """A name of a task in a cell, with a mark for stale results."""
    task = part.experiment.task
    return text.replace(task, f"`{task}`", 1) + (STALE_MARK if part.stale else "")


def _with_interval(part: Collected | None) -> str:
    if part is None:
        return "-"
    estimate = part.estimate()
    return f"{_number(estimate.value)} ({_interval(estimate)})"


def _better(part: Collected, reference: Collected, opponent: str | None = None) -> str:
    """Probability that a run of the first is better, with its interval."""
    opponent = opponent or part.opponents[0]
    estimate = probability_of_improvement(part.scores(opponent), reference.scores(opponent))
    return f"{estimate.value:.2f} ({estimate.low:.2f} to {estimate.high:.2f})"


def _on_curve(part: Collected, samples: float) -> str:
    """Mean of the learning curves after some samples."""
    values = [value_at(result["curve"], samples) for result in part.results]
    known = [value for value in values if value is not None]
    return _number(sum(known) / len(known)) if known else ""


def _target(part: Collected, opponent: str) -> str:
    """Target, and whether the lower end of the interval reaches it."""
    task = part.experiment.task
    if task in FULL_SUCCESS:
        estimate, target = part.full_success(), FULL_SUCCESS[task]
        return f"full success {_number(target)} {_met(estimate, target)}"
    if (task, opponent) not in TARGETS:
        return ""
    target = TARGETS[task, opponent]
    return f"{_number(target)} {_met(part.estimate(opponent), target)}"


def _met(estimate: Estimate, target: float) -> str:
    return "met" if estimate.low >= target else "missed"


def _outcomes(part: Collected, opponent: str) -> str:
    """Shares of matches of all seeds, own goals among them; or the share of full success."""
    if part.experiment.task in FULL_SUCCESS:
        estimate = part.full_success()
        return f"full success {_number(estimate.value)}, {_interval(estimate)}"
    rows = part.rows(opponent)
    if not rows[0]["sides"]:
        return ""
    total = sum(row["matches"] for row in rows)
    names = ("wins", "draws", "losses", "own_goals")
    *counts, own = (sum(row[name] for row in rows) / total for name in names)
    return f"{', '.join(f'{share:.1%}' for share in counts)} ({own:.1%})"


def _time_to_success(part: Collected, opponent: str) -> str:
    times = [row["seconds_to_decision"] for row in part.rows(opponent)]
    known = [float(seconds) for seconds in times if seconds is not None]
    return f"{sum(known) / len(known):.1f} s" if known else ""


def _seeds_of(part: Collected | None) -> str:
    return "" if part is None else _seeds(part.scores())


def _seeds(scores: Sequence[float]) -> str:
    return " ".join(_number(score) for score in scores)


def _interval(estimate: Estimate) -> str:
    if estimate.runs == 1:
        return "one seed"
    return f"{_number(estimate.low)} to {_number(estimate.high)}"


def _number(value: float) -> str:
    """A score with three digits, without the zero before the point."""
    if abs(value) >= 1.5:
        return f"{value:.2f}"
    text = f"{value:.3f}"
    return text.replace("0.", ".", 1) if abs(value) < 1.0 and float(text) != 1.0 else text


def _millions(value: float) -> str:
    return f"{value / 1e6:.3g} M"


def _minutes(seconds: float) -> str:
    return f"{seconds / 60.0:.0f} min" if seconds >= 60.0 else f"{seconds:.0f} s"
