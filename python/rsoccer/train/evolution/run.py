"""An evolution in its folder."""

from __future__ import annotations

import csv
import itertools
import json
import sys
import time
from pathlib import Path
from typing import Any, Final

import numpy as np

from rsoccer import build_info
from rsoccer.arrays import Doubles, Floats
from rsoccer.evaluate.episodes import EpisodeRunner
from rsoccer.files import write_atomically
from rsoccer.lineup import lineup
from rsoccer.policies import make_policy
from rsoccer.policies.evolved import SCRIPTS, Evolved
from rsoccer.registry import make_task
from rsoccer.task import LEARN, Task
from rsoccer.train.args import SETTINGS_FILE
from rsoccer.train.evolution.settings import EvolveArgs
from rsoccer.train.evolution.strategy import Strategy, standardized
from rsoccer.train.run.folder import POLICY_FILE
from rsoccer.train.run.log import FILE_NAME as LOG_FILE
from rsoccer.view import SIDES

STATE_FILE: Final = "evolution.json"
"""Name of the file from which a run resumes."""
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
    task = make_task(args.task, **args.task_options)
    defaults = np.array([tactic.default for tactic in SCRIPTS[args.script].TACTICS], np.float32)
    SCRIPTS[args.script].with_tactics(task, defaults)  # refuses tasks before anything changes
    kinds = _kinds(args, task)
    strategy, done = _resumed(args) if args.resume else (_begun(args, task), 0)
    path = args.out / POLICY_FILE
    for generation in range(done, args.generations):
        start = time.monotonic()
        rng = np.random.default_rng([args.seed, generation])
        draws, scores, means = [], [], {}
        for kind in kinds:
            drawn = strategy.draw(args.matches // 2, rng)
            found = _play(args, task, kind, strategy.tactics(drawn), int(rng.integers(2**31)))
            draws.append(drawn)
            scores.append(standardized(found))
            means[_words(kind)] = float(found.mean())
        strategy.learn(np.concatenate(draws), np.concatenate(scores))
        _keep(args, strategy, generation + 1)
        _save(args, task, strategy, generation + 1, len(kinds))
        _log(args.out, {"generation": generation + 1, **means, "seconds": time.monotonic() - start})
    return path


def _kinds(args: EvolveArgs, task: Task) -> list[Kind]:
    """Opponents and sides, each with an equal share of the matches."""
    if args.opponents and not task.two_sided:
        raise ValueError(
            f"opponents: expected none in {task.name}, which has no other team that learns, "
            f"got {list(args.opponents)}"
        )
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
    policy = make_policy(args.first, task)
    if not isinstance(policy, Evolved) or policy.metadata["script"] != args.script:
        raise ValueError(f"first: expected tactics of {args.script}, got {args.first}")
    return policy.tactics


def _begun(args: EvolveArgs, task: Task) -> Strategy:
    """The strategy of a new run, whose folder is made."""
    strategy = _strategy(args, _first(args, task))
    if (args.out / STATE_FILE).exists() or (args.out / POLICY_FILE).exists():
        raise ValueError(f"out: {args.out} holds a run; set resume, or name another folder")
    args.out.mkdir(parents=True, exist_ok=True)
    settings = json.dumps(args.to_json(), indent=2)
    write_atomically(args.out / SETTINGS_FILE, settings.encode())
    return strategy


def _resumed(args: EvolveArgs) -> tuple[Strategy, int]:
    """The strategy of the run in the folder, and the generations that it has played."""
    path = args.out / STATE_FILE
    if not path.exists():
        raise ValueError(f"resume: expected the state of a run in {path}, got none")
    saved = json.loads(path.read_text())
    now = args.to_json()
    changed = [
        f"{name} was {saved['settings'].get(name)!r}, is {now[name]!r}"
        for name in now
        if name not in _CHANGEABLE and saved["settings"].get(name) != now[name]
    ]
    if changed:
        raise ValueError(f"resume: {path} is of a run with other settings: {'; '.join(changed)}")
    strategy = _strategy(args)
    strategy.mean, strategy.step = np.array(saved["mean"]), np.array(saved["step"])
    return strategy, int(saved["generation"])


def _keep(args: EvolveArgs, strategy: Strategy, generation: int) -> None:
    """Write the state from which the run resumes."""
    numbers = {"mean": strategy.mean.tolist(), "step": strategy.step.tolist()}
    state = {"generation": generation, **numbers, "settings": args.to_json()}
    write_atomically(args.out / STATE_FILE, json.dumps(state).encode())


def _save(args: EvolveArgs, task: Task, strategy: Strategy, generation: int, kinds: int) -> None:
    policy = Evolved.of_training(
        args.script, task, strategy.tactics(), args.task_options, args.sensing
    )
    info = build_info()
    policy.metadata["training"] = json.dumps(
        {
            "command": _command(args),
            "samples": generation * kinds * args.matches,
            "seed": args.seed,
            "package": info["version"],
            "physics": info["physics"],
        }
    )
    policy.save(args.out / POLICY_FILE)


def _command(args: EvolveArgs) -> str:
    """The command of the run, without its folder."""
    words = ["rsoccer evolve"]
    for name, value in args.to_json().items():
        option = f"--{name.replace('_', '-')}"
        if name in ("out", "resume", "threads") or value in (None, [], {}):
            continue
        if isinstance(value, dict):
            value = [f"{key}={each}" for key, each in value.items()]
        texts = value if isinstance(value, list) else [value]
        words.append(" ".join([option, *(_quoted(str(text)) for text in texts)]))
    return " ".join(words)


def _quoted(text: str) -> str:
    return f"'{text}'" if " " in text else text


def _words(kind: Kind) -> str:
    """Name of a kind of match, for the log."""
    opponent, side = kind
    return " as ".join(word for word in (opponent or "score", side) if word)


def _log(folder: Path, row: dict[str, Any]) -> None:
    """Write a row of the log, and show it."""
    path = folder / LOG_FILE
    with path.open("a", newline="") as file:
        writer = csv.DictWriter(file, list(row))
        if file.tell() == 0:
            writer.writeheader()
        writer.writerow(row)
    texts = (f"{name} {value:.2f}" for name, value in row.items() if name != "generation")
    sys.stderr.write(f"generation {row['generation']}: {', '.join(texts)}\n")
