"""An evolution in its folder."""

from __future__ import annotations

import itertools
import json
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from rsoccer import checks
from rsoccer.arrays import Doubles, Floats
from rsoccer.evaluate.episodes import EpisodeRunner
from rsoccer.files import write_atomically
from rsoccer.lineup import lineup
from rsoccer.matches.sensing import simulated
from rsoccer.policies import make_policy
from rsoccer.policies.evolved import SCRIPTS, Evolved
from rsoccer.policies.trained import list_trained, load_file
from rsoccer.randomization import Randomization
from rsoccer.registry import task_with_options
from rsoccer.sources import make_sensing
from rsoccer.task import LEARN, Task
from rsoccer.train.args import SETTINGS_FILE
from rsoccer.train.evolution.settings import STATE_FILE, EvolveArgs
from rsoccer.train.evolution.strategy import Strategy, standardized
from rsoccer.train.run.folder import POLICY_FILE, check_empty, digests_of, locked
from rsoccer.train.run.log import FILE_NAME as LOG_FILE
from rsoccer.train.run.log import append_row
from rsoccer.view import SIDES

_CHANGEABLE: Final = ("generations", "out", "resume", "threads")
"""Settings that may differ when a run resumes."""

Kind = tuple[str | None, str | None]
"""Opponent and side of a match; None where there is none."""


def run_evolution(args: EvolveArgs) -> Path:
    """Run an evolution: the implementation of `rsoccer.train.evolution.evolve`.

    Args:
        args: settings of the run.

    Returns:
        Path of the policy file.

    Raises:
        ImportError: safetensors is not installed.
        ValueError: see `evolve`.
    """
    task = task_with_options(args.task, args.task_options)
    strategy = _strategy(args, None if args.resume else _first(args, task))
    kinds = _kinds(args, task)
    Randomization.of(args.randomization, task.config, simulated(make_sensing(args.sensing)))
    policy = _policy(args, task, strategy)
    policy_files = digests_of(task, args.opponents)
    if args.resume and not (args.out / STATE_FILE).exists():
        raise ValueError(f"resume: expected the state of a run in {args.out}, got none")
    path = args.out / POLICY_FILE
    with locked(args.out):
        done = 0
        if args.resume:
            done = _resume(args, strategy, policy_files)
        else:
            check_empty(args.out, "resume")
            _keep(args, strategy, 0, policy_files)  # first: a run that is killed here can resume
            policy.save(path)
            write_atomically(
                args.out / SETTINGS_FILE, json.dumps(args.to_json(), indent=2).encode()
            )
        _trim_log(args.out, done)
        for generation in range(done, args.generations):
            start = time.monotonic()
            means = _generation(args, task, kinds, strategy, generation)
            _policy(args, task, strategy).save(path)
            matches = (generation + 1) * len(kinds) * args.matches
            row = {"generation": generation + 1, "samples": matches, **means}
            _log(args.out, {**row, "seconds": time.monotonic() - start})
            _keep(args, strategy, generation + 1, policy_files)
    return path


def _generation(
    args: EvolveArgs, task: Task, kinds: list[Kind], strategy: Strategy, generation: int
) -> dict[str, float]:
    """Play the matches of a generation and learn from them. Return mean scores by kind."""
    rng = np.random.default_rng([args.seed, generation])
    draws, scores, means = [], [], {}
    for kind in kinds:
        drawn = strategy.draw(args.matches // 2, rng)
        found = _play(args, task, kind, strategy.tactics(drawn), int(rng.integers(2**31)))
        draws.append(drawn)
        scores.append(standardized(found))
        means[_words(kind)] = float(found.mean())
    strategy.learn(np.concatenate(draws), np.concatenate(scores))
    return means


def _kinds(args: EvolveArgs, task: Task) -> list[Kind]:
    """Opponents and sides, each with an equal share of the matches."""
    if args.opponents and not task.two_sided:
        raise ValueError(
            f"opponents: expected none in {task.name}, which has no other team that learns, "
            f"got {list(args.opponents)}"
        )
    if task.two_sided and task.success is None:
        raise ValueError(f"task: expected one with a success metric, got {task.name}")
    for opponent in args.opponents:
        make_policy(opponent, task)
    sides = SIDES if task.two_sided else (None,)
    return list(itertools.product(args.opponents or (None,), sides))


def _play(args: EvolveArgs, task: Task, kind: Kind, tactics: Doubles, seed: int) -> Doubles:
    """Scores (n,) of matches with the tactics (n, tactics), from the view of their team."""
    name, side = kind
    opponent = None if name is None else make_policy(name, task)
    runner = EpisodeRunner(
        task,
        lineup(task, LEARN, opponent, side),
        SCRIPTS[args.script].with_tactics(task, tactics.astype(np.float32)),
        worlds=len(tactics),
        threads=args.threads,
        sensing=args.sensing,
        randomization=args.randomization or None,
    )
    scores = runner.run(len(tactics), seed).scores
    return -scores if side == SIDES[1] else scores


def _strategy(args: EvolveArgs, first: Floats | None = None) -> Strategy:
    """The strategy before the first generation."""
    known = SCRIPTS[args.script].TACTICS
    return Strategy.begin(known, args.spread, args.step_size, args.momentum, first)


def _first(args: EvolveArgs, task: Task) -> Floats | None:
    """Tactics to begin with; None for those that were set by hand."""
    if args.first is None:
        return None
    path = list_trained().get(args.first)
    policy = make_policy(args.first, task) if path is None else load_file(path)
    if not isinstance(policy, Evolved) or policy.metadata["script"] != args.script:
        raise ValueError(f"first: expected tactics of {args.script}, got {args.first}")
    return policy.tactics


def _resume(args: EvolveArgs, strategy: Strategy, policy_files: dict[str, str]) -> int:
    """Bring the strategy to where the run in the folder is. Return the generations so far."""
    path = args.out / STATE_FILE
    saved = _read_state(path)
    now = args.to_json()
    before = {**EvolveArgs(args.task).to_json(), **saved.settings}  # some may be newer than it
    changed = [
        f"{name} was {before[name]!r}, is {now[name]!r}"
        for name in now
        if name not in _CHANGEABLE and before[name] != now[name]
    ]
    if changed:
        raise ValueError(f"resume: {path} is of a run with other settings: {'; '.join(changed)}")
    if saved.policy_files != policy_files:
        raise ValueError(f"resume: {path} is of a run with other policies of the same names")
    for name, numbers in (("mean", saved.mean), ("step", saved.step)):
        if numbers.shape != strategy.mean.shape or not np.isfinite(numbers).all():
            raise ValueError(
                f"resume: {path}: {name}: expected {len(strategy.mean)} finite numbers, those of "
                f"{args.script}, got {numbers.tolist()}"
            )
    strategy.mean, strategy.step = saved.mean, saved.step
    return saved.generation


@dataclass(frozen=True)
class _State:
    """State of a run in its folder."""

    generation: int
    mean: Doubles
    step: Doubles
    settings: dict[str, Any]
    policy_files: Any


def _read_state(path: Path) -> _State:
    """Read the state of a run; an error names the file."""
    try:
        saved = json.loads(path.read_bytes())
        return _State(
            checks.integer("generation", saved["generation"], 0),
            np.array(saved["mean"], np.float64),
            np.array(saved["step"], np.float64),
            {**saved["settings"]},
            saved["policy_files"],
        )
    except (KeyError, TypeError, ValueError) as error:
        raise ValueError(
            f"resume: {path} is damaged or not the state of an evolution: {error}"
        ) from error


def _keep(
    args: EvolveArgs, strategy: Strategy, generation: int, policy_files: dict[str, str]
) -> None:
    """Write the state from which the run resumes."""
    numbers = {"mean": strategy.mean.tolist(), "step": strategy.step.tolist()}
    settings = {"settings": args.to_json(), "policy_files": policy_files}
    state = {"generation": generation, **numbers, **settings}
    write_atomically(args.out / STATE_FILE, json.dumps(state).encode())


def _policy(args: EvolveArgs, task: Task, strategy: Strategy) -> Evolved:
    """The script with the present tactics."""
    tactics = strategy.tactics().astype(np.float32)
    matches = args.sensing, args.randomization
    return Evolved.of_training(args.script, task, tactics, args.task_options, *matches)


def _words(kind: Kind) -> str:
    """Name of a kind of match, for the log."""
    opponent, side = kind
    return " as ".join(word for word in (opponent or "score", side) if word)


def _trim_log(folder: Path, generations: int) -> None:
    """Forget rows of the log that are played again, as their state was not written any more."""
    path = folder / LOG_FILE
    if path.exists():
        rows = path.read_text().splitlines(keepends=True)
        write_atomically(path, "".join(rows[: generations + 1]).encode())


def _log(folder: Path, row: dict[str, Any]) -> None:
    """Write a row of the log, and show it."""
    append_row(folder, row)
    shown = {name: value for name, value in row.items() if name not in ("generation", "samples")}
    texts = (f"{name} {value:.2f}" for name, value in shown.items())
    sys.stderr.write(f"generation {row['generation']}: {', '.join(texts)}\n")
