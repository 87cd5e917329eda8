"""Compare the two contact engines over whole matches: `python -m benches.engine_agreement`.

Crowds and random play have statistics of their play; scripted policies and a trained policy have
their success. Worlds start from the same states under both engines, so differences are paired where
worlds are. The result file is the source of the section on both engines in docs/physics.md.
"""

import argparse
import json
import math
import sys
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from typing import Any, Final

import rsoccer
from benches.play_statistics import Statistics, in_batches, play_ou, play_scenario
from benches.result_files import RESULTS, ROOT, this_machine
from benches.scenarios import SCENARIOS, Scenario
from benches.solvers import EPISODIC
from rsoccer.arrays import Doubles
from rsoccer.evaluate import Evaluation
from rsoccer.evaluate.results import MIN_PER_SIDE

FILE: Final = RESULTS / "engine_agreement.json"
REFERENCE: Final = "rapier"
COMPARED: Final = "compact"
TICK: Final = 0.005  # s
LIMIT_TICK: Final = 0.001  # s, of the reference that both engines approach
BOUND: Final = 0.05
"""Difference, as a share of the reference, up to which the engines agree whatever the interval."""
SCORE_BOUND: Final = 0.05
"""Difference of a success metric, as a share of its range, with the same meaning."""
NORMAL_95: Final = 1.96
BATCH: Final = 256
CROWDS: Final = (
    "VSSS 3 v 3 random",
    "VSSS 3 v 3 crowd",
    "VSSS 5 v 5 crowd",
    "SSL 1 v 1 crowd",
    "SSL 6 v 6 crowd",
)
OU: Final = "VSSS 3 v 3, policy `ou`"
OU_SECONDS: Final = 60.0
TRAINED_TASK: Final = "VSS-v0"
TRAINED: Final = ROOT / "out" / "engine_agreement"


@dataclass(frozen=True)
class Comparison:
    """A quantity under both engines."""

    scene: str
    """Scenario, or task with policy and opponent."""
    quantity: str
    unit: str
    count: int
    """Number of worlds or matches."""
    reference: float
    """Mean under the reference, rapier."""
    compared: float
    """Mean under the compact engine."""
    low: float
    """Lower bound of the 95% interval of the difference, reference minus compared."""
    high: float
    """Upper bound of that interval."""
    limit: float | None = None
    """Mean under the reference with ticks of 1 ms, if that was measured."""

    @property
    def difference(self) -> float:
        """Reference minus compared."""
        return self.reference - self.compared


def agrees(comparison: Comparison, scale: float) -> bool:
    """Return whether two engines agree.

    Args:
        comparison: A quantity under both engines.
        scale: Difference up to which they agree whatever the interval, in the quantity's unit.

    Returns:
        True if the interval of the difference contains 0 or the difference is at most `scale`.
    """
    return comparison.low <= 0.0 <= comparison.high or abs(comparison.difference) <= scale


def play_agrees(comparison: Comparison) -> bool:
    """Return whether the engines agree on a statistic of play, within `BOUND` of its value.

    The compact engine may also be within `BOUND` of the limit that both engines approach.
    """
    limit = comparison.limit
    near_limit = limit is not None and abs(comparison.compared - limit) <= BOUND * abs(limit)
    return near_limit or agrees(comparison, BOUND * abs(comparison.reference))


def score_agrees(comparison: Comparison) -> bool:
    """Return whether the engines agree on a success metric, within `SCORE_BOUND`."""
    scale = max(1.0, abs(comparison.reference))
    return agrees(comparison, SCORE_BOUND * scale)


def main(arguments: Sequence[str] | None = None) -> Path:
    """Measure, write the result file and return its path.

    Args:
        arguments: Command line without the program name; default: that of the process.

    Returns:
        Path of the result file.
    """
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--policy", type=Path, help="policy file for VSS-v0; default: train one")
    parser.add_argument("--samples", type=int, default=1_500_000, help="samples of the training")
    parser.add_argument("--worlds", type=int, default=1024, help="worlds of each scene")
    parser.add_argument("--matches", type=int, default=400, help="matches of each policy")
    parser.add_argument("--out", type=Path, default=FILE, help="result file")
    options = parser.parse_args(arguments)
    policy = options.policy or train(options.samples)
    results = {
        **asdict(this_machine()),
        "samples": options.samples,
        "policies": [_rounded(row) for row in policies(policy, options.matches)],
        "play": [_rounded(row) for row in play(options.worlds)],
    }
    options.out.parent.mkdir(parents=True, exist_ok=True)
    options.out.write_text(json.dumps(results, indent=1) + "\n")
    return Path(options.out)


def load(path: Path = FILE) -> tuple[dict[str, Any], list[Comparison], list[Comparison]]:
    """Read a result file.

    Args:
        path: File that `main` wrote.

    Returns:
        Machine and sizes, comparisons of play, comparisons of policies.
    """
    results = json.loads(path.read_text())
    play, policies = (
        [Comparison(**row) for row in results.pop(key)] for key in ("play", "policies")
    )
    return results, play, policies


def train(samples: int) -> Path:
    """Train a policy on VSS-v0 under the default engine and return its file."""
    from rsoccer.train import Args, RunSettings
    from rsoccer.train import train as run

    settings = RunSettings(progress=False)
    return run(Args(TRAINED_TASK, TRAINED, samples=samples, overwrite=True, run=settings))


def play(worlds: int) -> Iterator[Comparison]:
    """Yield the statistics of crowds, of random play and of play by `ou` under both engines."""
    scenarios = {scenario.name: scenario for scenario in SCENARIOS}
    for name in CROWDS:
        _log(f"{name}, {worlds} worlds")
        yield from _compare_scenario(scenarios[name], worlds)
    _log(f"{OU}, {worlds} worlds")
    found = [
        in_batches(partial(_ou, engine), worlds, BATCH, seed=0) for engine in (REFERENCE, COMPARED)
    ]
    yield from _paired(OU, *found)


def _log(text: str) -> None:
    sys.stderr.write(f"{text}\n")


def _ou(engine: str, worlds: int, seed: int) -> Statistics:
    return play_ou(engine, OU_SECONDS, worlds, seed)


def _compare_scenario(scenario: Scenario, worlds: int) -> Iterator[Comparison]:
    def played(engine: str, tick: float) -> Statistics:
        return in_batches(partial(play_scenario, scenario, engine, tick), worlds, BATCH, seed=0)

    reference, compared = (played(engine, TICK) for engine in (REFERENCE, COMPARED))
    yield from _paired(scenario.name, reference, compared, played(REFERENCE, LIMIT_TICK))


def _paired(
    scene: str, reference: Statistics, compared: Statistics, limit: Statistics | None = None
) -> Iterator[Comparison]:
    """Yield each quantity with the interval of its differences in the same worlds."""
    for quantity, values in reference.items():
        difference = values - compared[quantity]
        half = NORMAL_95 * _standard_error(difference)
        yield Comparison(
            scene=scene,
            quantity=quantity.name,
            unit=quantity.unit,
            count=len(values),
            reference=float(values.mean()),
            compared=float(compared[quantity].mean()),
            low=float(difference.mean() - half),
            high=float(difference.mean() + half),
            limit=None if limit is None else float(limit[quantity].mean()),
        )


def _standard_error(values: Doubles) -> float:
    return float(values.std(ddof=1) / math.sqrt(len(values)))


def policies(policy: Path, matches: int) -> Iterator[Comparison]:
    """Yield the success of a trained policy and of the best script of each task."""
    for opponent in ("ou", "zero"):
        yield _compare_policy(TRAINED_TASK, str(policy), opponent, matches, "trained")
    for task, script in sorted(EPISODIC.items()):
        yield _compare_policy(task, script, None, matches, f"`{script}`")


def _half_width(evaluation: Evaluation) -> float:
    """Half of the width of a score's interval."""
    if evaluation.low is None or evaluation.high is None:
        raise ValueError(
            f"matches: expected at least {MIN_PER_SIDE} a side, got {evaluation.matches} in all"
        )
    return (evaluation.high - evaluation.low) / 2


def _compare_policy(
    task: str, policy: str, opponent: str | None, matches: int, name: str
) -> Comparison:
    _log(f"{task}, {name}, {matches} matches")
    found: list[Evaluation] = []
    for engine in (REFERENCE, COMPARED):
        made = rsoccer.make_task(task, engine=engine)
        found.append(rsoccer.evaluate(policy, opponent, matches, seed=0, task=made))
    reference, compared = found
    difference = reference.score - compared.score
    half = math.hypot(*map(_half_width, found))
    against = "" if reference.opponent == "-" else f" against `{reference.opponent}`"
    return Comparison(
        scene=f"{task}, {name}{against}",
        quantity=reference.metric,
        unit="",
        count=matches,
        reference=reference.score,
        compared=compared.score,
        low=difference - half,
        high=difference + half,
    )


def _rounded(comparison: Comparison) -> dict[str, Any]:
    values = asdict(comparison).items()
    return {name: float(f"{x:.4g}") if isinstance(x, float) else x for name, x in values}


if __name__ == "__main__":
    main()
