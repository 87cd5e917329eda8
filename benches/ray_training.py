"""Training on Ray against the trainer, at equal wall clock: `python -m benches.ray_training`.

Both learn a match task from nothing: the trainer alone with all cores, and the example
`14_ray_league.py` with two runners, which needs Ray. `--only trainer`, `--only ray` and
`--only evaluate` run one part each. A run that was interrupted goes on from its last checkpoint,
with the seconds that it has learned. Schedules of the learning rate end after `--pace` decisions a
second; a trainer that is faster ends before its time. Each saves its policy at fixed times. These
policies play whole matches against scripts, and the result file gets the scores.

`--speed` measures how fast one core plays and learns 11 v 11, from which `cores_needed`
extrapolates.
"""

import argparse
import json
import math
import os
import runpy
import sys
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, Final

import rsoccer
from benches.markdown import table
from benches.result_files import RESULTS, format_number, this_machine
from rsoccer.evaluate.schedule import processors
from rsoccer.files import write_atomically
from rsoccer.option_words import parse_options
from rsoccer.train import Args
from rsoccer.train.run.checkpoint import FILE_NAME as CHECKPOINT

FILE: Final = RESULTS / "ray_training.json"
"""Results by part."""
EXAMPLE: Final = Path(__file__).parents[1] / "examples" / "14_ray_league.py"
TASK: Final = "VSSMatch-v0"
OPTIONS: Final = ("half_seconds=30",)
"""Options of the task: matches of a minute, so that many end."""
SIDES: Final = ("trainer", "ray")
OPPONENTS: Final = ("ou", "chase", "scripted")
"""Policies that the trained ones play against."""
MATCHES: Final = 100
"""Matches of each evaluation, half of them for each team."""
BETWEEN: Final = 10.0
"""Minutes between two policies that are kept."""
SAVED_EVERY: Final = 60.0
"""Seconds between two checkpoints of the run on Ray."""
PACE: Final = {"trainer": 22_500, "ray": 10_000}
"""Decisions a second and core that a run is planned for: its schedules end after so many. They are
some tenth above those measured on two cores, so that no run ends before its time."""

LARGE: Final = ("SSLMatch-v0", {"division": "A", "n_blue": 11, "n_yellow": 11})
"""Task and options of 11 v 11."""
LARGE_WORLDS: Final = 32
"""Matches of the measurement of its speed."""
EXPONENTS: Final = (1.0, 2.0)
"""Powers of the number of robots in a team with which the samples of each robot may grow."""
DAYS: Final = (1.0, 7.0)
"""Days in which the cores have to be done."""


@dataclass(frozen=True)
class Plan:
    """Task and length of both runs."""

    task: str = TASK
    """name of the task"""
    options: tuple[str, ...] = OPTIONS
    """options of the task, NAME=VALUE"""
    minutes: float = 60.0
    """length of each run"""
    runners: int = 2
    """processes that play on Ray"""
    folder: Path = Path("out/ray-training")
    """folder of the runs"""
    worlds: int | None = None
    """matches at once; None for the recommended number"""
    pace: int | None = None
    """decisions a second that a run is planned for; None for `PACE` on all cores"""

    @property
    def task_options(self) -> dict[str, Any]:
        """Options of the task by name."""
        return parse_options("task_options", self.options)

    def decisions(self, side: str) -> int:
        """Return the decisions after which the schedules of a run end.

        Args:
            side: one of `SIDES`.
        """
        pace = self.pace or PACE[side] * processors()
        return int(pace * 60.0 * self.minutes)

    @property
    def marks(self) -> list[float]:
        """Minutes after which policies are kept."""
        count = int(self.minutes // BETWEEN)
        return [BETWEEN * (index + 1) for index in range(count)] or [self.minutes]


@dataclass
class Points:
    """Policies of a run that are kept, and its decisions at their times."""

    plan: Plan
    """the run's plan"""
    folder: Path
    """its folder"""
    kept: list[dict[str, float]] = field(default_factory=list)
    """minutes, seconds and decisions of each policy"""

    def __post_init__(self) -> None:
        """Read what an interrupted run has kept."""
        if self.path.exists():
            self.kept = json.loads(self.path.read_text())

    @property
    def path(self) -> Path:
        """File with the times."""
        return self.folder / "points.json"

    def policy(self, minutes: float) -> Path:
        """Return the file of a policy.

        Args:
            minutes: its time.
        """
        return self.folder / f"policy_{minutes:06.2f}.safetensors"

    def add(self, network: Any, seconds: float, decisions: float) -> bool:  # noqa: ANN401
        """Keep the policy if it is time, and return whether the run is over.

        Args:
            network: function that returns the current policy.
            seconds: seconds of the run so far.
            decisions: decisions that it has learned from.
        """
        known = {point["minutes"] for point in self.kept}
        due = [m for m in self.plan.marks if m not in known and seconds >= 60.0 * m]
        if due:
            network().save(self.policy(due[-1]))
            self.kept.append({"minutes": due[-1], "seconds": seconds, "decisions": decisions})
            write_atomically(self.path, json.dumps(self.kept).encode())
        return seconds >= 60.0 * self.plan.minutes


def train_alone(plan: Plan) -> None:
    """Train with the package's trainer on all cores, until the time is over.

    Args:
        plan: the plan of the runs.
    """
    out = plan.folder / "trainer"
    points = Points(plan, out)
    if points.kept and points.kept[-1]["seconds"] >= 60.0 * plan.minutes:
        return
    rollout = {} if plan.worlds is None else {"rollout": {"worlds": plan.worlds}}
    args = Args.for_task(
        plan.task,
        out=out,
        samples=plan.decisions("trainer"),
        task_options=plan.task_options,
        threads=processors(),
        resume=(out / CHECKPOINT).exists(),
        network={"initial_policy": None},
        run={"progress": False, "match_page": False, "ladder_interval": 0},
        **rollout,
    )

    def after(update: Any) -> bool:  # noqa: ANN401
        seconds = float(update.row["seconds"])
        if update.samples >= args.samples and seconds < 60.0 * plan.minutes:
            sys.stderr.write("the run ends before its time: choose a higher --pace\n")
        return not points.add(update.network, seconds, update.samples)

    rsoccer.train.train(args, after)


def train_on_ray(plan: Plan) -> None:
    """Train with the example on this machine's cores, until the time is over.

    Args:
        plan: the plan of the runs.
    """
    out = plan.folder / "ray"
    out.mkdir(parents=True, exist_ok=True)
    points = Points(plan, out)
    if points.kept and points.kept[-1]["seconds"] >= 60.0 * plan.minutes:
        return
    os.environ.setdefault("RAY_AUTH_MODE", "disabled")
    example = runpy.run_path(str(EXAMPLE))
    words = ["--task", plan.task, "--runners", str(plan.runners), "--folder", str(out)]
    if plan.worlds is not None:
        words += ["--matches", str(plan.worlds // plan.runners)]
    words += ["--task-options", *plan.options]
    args = example["parsed"](words)
    args.iterations = max(int(plan.decisions("ray") / decisions_per_iteration(args, example)), 1)
    progress = out / "progress.json"
    saved = json.loads(progress.read_text()) if progress.exists() else {}
    algorithm = example["begin"](args)
    now = {"seconds": 0.0, "decisions": 0.0, **saved.get(str(algorithm.iteration), {})}
    since_save, over = 0.0, False
    while not over:
        began = time.perf_counter()
        result = algorithm.train()
        passed = time.perf_counter() - began
        now["seconds"] += passed
        now["decisions"] += learned(result)
        over = points.add(
            lambda: example["policy_of"](algorithm, args), now["seconds"], now["decisions"]
        )
        since_save += passed
        if over or since_save >= SAVED_EVERY:
            # Before the checkpoint: one without its seconds would count from 0.
            saved[str(algorithm.iteration)] = dict(now)
            write_atomically(progress, json.dumps(saved).encode())
            began = time.perf_counter()
            example["save"](algorithm, out)
            now["seconds"] += time.perf_counter() - began
            since_save = 0.0
    algorithm.stop()


def decisions_per_iteration(args: argparse.Namespace, example: dict[str, Any]) -> float:
    """Return the decisions from which the run on Ray learns in an iteration, on average.

    Args:
        args: arguments of the example.
        example: names of its module.
    """
    settings, league = example["settings_of"](args), example["league_of"](args)
    matches = args.matches * args.runners if args.matches else settings.rollout.worlds
    robots = len(settings.make_task().agents) / 2.0 * (1.0 + league.latest_fraction)
    return float(matches * (args.horizon or settings.rollout.horizon) * robots)


def learned(result: dict[str, Any]) -> float:
    """Return the decisions of robots from which an iteration on Ray has learned.

    Args:
        result: result of `Algorithm.train`.
    """
    runners = result["env_runners"]
    decisions = float(runners.get("num_module_steps_sampled", {}).get("main", 0.0))
    return decisions if math.isfinite(decisions) else 0.0  # RLlib's NaN: no runner has sampled


def evaluate(plan: Plan) -> dict[str, Any]:
    """Return the scores of all kept policies against the opponents, with what the file has.

    Args:
        plan: the plan of the runs.
    """
    found = load()
    options = plan.task_options
    kept: dict[str, Any] = {
        "task": plan.task,
        "options": list(plan.options),
        "minutes": plan.minutes,
        "runners": plan.runners,
        "machine": asdict(this_machine()),
    }
    if any(found.get(name) != kept[name] for name in ("task", "options", "minutes")):
        found.pop("runs", None)
    found |= kept
    runs = found.setdefault("runs", {})
    task = rsoccer.make_task(plan.task, **options)
    for side in SIDES:
        points = Points(plan, plan.folder / side)
        if not points.kept:
            continue
        rows = []
        for point in points.kept:
            scores = {}
            for opponent in OPPONENTS:
                sys.stderr.write(f"{side}, {point['minutes']:g} minutes, {opponent}\n")
                policy = str(points.policy(point["minutes"]))
                found_scores = asdict(rsoccer.evaluate(policy, opponent, MATCHES, task=task))
                names = ("score", "low", "high", "wins", "draws", "losses", "matches")
                scores[opponent] = {name: found_scores[name] for name in names}
            rows.append({**point, "scores": scores})
        runs[side] = rows
    return found


def measure_speed(seconds: float) -> dict[str, float]:
    """Return how fast one core plays and learns 11 v 11.

    Decisions of the learning robots a second, in updates of the trainer on one thread; and control
    steps of matches a second while they are played, with observations and inference.

    Args:
        seconds: least time of the measurement; one update is made at least.
    """
    import torch

    from rsoccer.train.run.trainer import Trainer

    task, options = LARGE
    args = Args.for_task(
        task,
        out=Path("nowhere"),  # a trainer alone writes no files
        task_options=options,
        threads=1,
        rollout={"worlds": LARGE_WORLDS},
        opponents={"solo_fraction": 0.0},
    )
    torch.set_num_threads(1)
    trainer = Trainer(args)
    playing = elapsed = 0.0
    while not elapsed or elapsed < seconds:
        began = time.perf_counter()
        batch = trainer.collect_rollout(lambda: None)
        playing += time.perf_counter() - began
        trainer.update(batch, lambda: None)
        elapsed += time.perf_counter() - began
    robots = len(trainer.curriculum.learners)
    steps = trainer.samples / robots * args.rollout.action_repeat
    return {
        "decisions_per_second": trainer.samples / elapsed,
        "steps_per_second": steps / playing,
        "robots": robots,
        "seconds": elapsed,
    }


def cores_needed(
    samples: float, robots: tuple[int, int], exponent: float, per_second: float, days: float
) -> float:
    """Return how many cores learn a larger team's play from nothing in some days.

    The decisions are those of the smaller team, times the ratio of the numbers of robots for equal
    matches, and times its power with the exponent: a reward that a team shares says less about one
    of many robots.

    Args:
        samples: decisions of robots that the smaller team needed.
        robots: robots of the smaller and of the larger team.
        exponent: power with which the samples of each robot grow.
        per_second: decisions of the larger team that one core plays and learns from in a second.
        days: time for the training.

    Example:
        >>> round(cores_needed(20e6, (3, 11), 1.0, 1000.0, 1.0), 1)
        3.1
    """
    ratio = (robots[1] / robots[0]) ** (1.0 + exponent)
    return float(samples * ratio / per_second / (days * 86_400.0))


def needed_by_small(found: dict[str, Any], opponent: str) -> float | None:
    """Return the decisions after which a run first beats an opponent; None if none does.

    Args:
        found: results of the file.
        opponent: one of the opponents; a policy beats it if the interval of its score is above 0.
    """
    decisions = [
        point["decisions"]
        for points in found.get("runs", {}).values()
        for point in points
        if point["scores"][opponent]["low"] > 0.0
    ]
    return min(decisions, default=None)


def load() -> dict[str, Any]:
    """Return the results of the file; {} without one."""
    found: dict[str, Any] = json.loads(FILE.read_text()) if FILE.exists() else {}
    return found


def report() -> str:
    """Return the table of the comparison."""
    found, rows = load(), []
    for side, points in found.get("runs", {}).items():
        for point in points:
            cells = (_score(point["scores"][opponent]) for opponent in OPPONENTS)
            decisions = point["decisions"]
            rate = format_number(decisions / point["seconds"])
            millions = f"{decisions / 1e6:.1f} M"
            rows.append((NAMES[side], f"{point['minutes']:g}", millions, rate, *cells))
    if not rows:
        return "No run of this length is stored yet."
    machine = found["machine"]
    options = " ".join(found["options"])
    against = [f"`{opponent}`" for opponent in OPPONENTS]
    header = ("training", "minutes", "decisions", "a second", *against)
    return (
        f"`{found['task']}` with `{options}`, {found['minutes']:g} minutes each, "
        f"{found['runners']} runners on Ray, {machine['machine']}, {machine['cores']} cores, "
        f"{machine['date']}:\n\n{table(header, rows)}"
    )


NAMES: Final = {"trainer": "`rsoccer train`", "ray": "Ray"}
"""Names of the sides in the table."""


def _score(row: dict[str, float]) -> str:
    """A mean goal difference with its interval."""
    return f"{row['score']:+.2f} ({row['low']:+.2f} to {row['high']:+.2f})"


def extrapolation() -> str:
    """Return the table of the cores that 11 v 11 from nothing would need."""
    found = load()
    speed, rows = found.get("speed"), []
    if speed is None or "runs" not in found:
        return "It needs both runs and the speed of 11 v 11, which are not stored yet."
    small = len(rsoccer.make_task(found["task"]).agents) // 2
    robots = (small, int(speed["robots"]))
    for opponent in OPPONENTS:
        samples = needed_by_small(found, opponent)
        if samples is None:
            rows.append((f"`{opponent}`", "not in these runs", "-", *["-"] * len(DAYS)))
            continue
        for exponent in EXPONENTS:
            cores = (
                format_number(
                    cores_needed(samples, robots, exponent, speed["decisions_per_second"], days), 2
                )
                for days in DAYS
            )
            rows.append((f"`{opponent}`", f"{samples / 1e6:.1f} M", f"{exponent:g}", *cores))
    names = [f"cores for {days:g} day{'s' if days > 1 else ''}" for days in DAYS]
    header = ("beats", f"decisions of {small} v {small}", "exponent", *names)
    return (
        f"One core plays {format_number(speed['steps_per_second'])} control steps of 11 v 11 a "
        f"second, with inference, and plays and learns from "
        f"{format_number(speed['decisions_per_second'])} decisions of robots a second.\n\n"
        f"{table(header, rows)}"
    )


def main(arguments: Sequence[str] | None = None) -> None:
    """Train, evaluate and store; print the tables.

    Args:
        arguments: words of the command line; None for those of the process.
    """
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", choices=(*SIDES, "evaluate"), help="one part; all by default")
    parser.add_argument("--minutes", type=float, default=60.0, help="length of each run")
    parser.add_argument("--out", type=Path, default=Plan.folder, help="folder of the runs")
    parser.add_argument("--task", default=TASK, help="task of both runs")
    parser.add_argument("--task-options", nargs="*", default=list(OPTIONS), metavar="NAME=VALUE")
    parser.add_argument("--runners", type=int, default=2, help="processes that play on Ray")
    parser.add_argument("--worlds", type=int, help="matches at once; recommended by default")
    parser.add_argument("--pace", type=int, help="decisions a second that a run is planned for")
    parser.add_argument("--speed", action="store_true", help="measure the speed of 11 v 11, too")
    given = parser.parse_args(arguments)
    plan = Plan(
        given.task,
        tuple(given.task_options),
        given.minutes,
        given.runners,
        given.out,
        given.worlds,
        given.pace,
    )
    if given.only in (None, "trainer"):
        train_alone(plan)
    if given.only in (None, "ray"):
        train_on_ray(plan)
    if given.only in (None, "evaluate"):
        _store(evaluate(plan))
    if given.speed:
        _store({**load(), "speed": measure_speed(30.0)})
    sys.stdout.write(f"{report()}\n\n{extrapolation()}\n")


def _store(found: dict[str, Any]) -> None:
    """Write the results."""
    write_atomically(FILE, (json.dumps(found, indent=1) + "\n").encode())


if __name__ == "__main__":
    main()
