"""Put a run's policy into the package: `python -m tools.ship_policy out/mine`.

Its weights are rounded to half precision. Policies of the SSL lose their value network, as a
lookahead makes them worse (docs/learning-tried.md). The policy plays a fixed list of starts, from
both sides where the task has two, against each opponent. Its scores and how it was made go into the
metadata of the file, which is copied to `python/rsoccer/policies/trained/<task>.safetensors`. There
it is the policy `best` of its task. The policy of a run with `sensing`, such as a distillation,
becomes `<task>.robust.safetensors`, the policy `best:robust`, and plays all starts with these
senses, too.

`python -m tools.ship_policy --behind-forecast VSSSelfPlay-v0` makes `best` of a task its
`best:robust`, too: the same weights, behind a forecast.

`python -m tools.ship_policy --value out/critic` adds the value network of a run to the policies of
its task that have the weights that the run began with, `best` and perhaps `best:robust`: a run with
`network.initial_policy` "best" whose value network alone has learned (`ppo.critic_warmup`). With it
they play as `best:lookahead`, too.

`python -m tools.ship_policy --again` measures policies that are in the package once more, after a
change of the physics: their weights stay.
"""

import argparse
import json
import shlex
import tempfile
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

import numpy as np

import rsoccer
from rsoccer import checks
from rsoccer.arrays import Floats
from rsoccer.benchmark.protocol import opponents_of
from rsoccer.evaluate import Evaluation, evaluate, table
from rsoccer.evaluate.results import MIN_PER_SIDE
from rsoccer.files import write_atomically
from rsoccer.policies import trained, training_conditions
from rsoccer.policies.evolved import Evolved
from rsoccer.policies.network import Network
from rsoccer.policies.policy_file import SUFFIX, Score, scores_text
from rsoccer.sensing_text import describe
from rsoccer.task import Task
from rsoccer.train.args import CHANGEABLE_ON_RESUME, SETTINGS_FILE
from rsoccer.train.run.log import read_progress

BEHIND_FORECAST: Final = "rc2021, forecast=1"
"""Senses of a policy that is made robust by a forecast alone."""
STARTS: Final = 500
"""Starts of an evaluation; a two-sided task plays each number of them for each team."""
SEED: Final = 0
"""Seed of the starts, the same for every policy."""
Shipped = Network | Evolved
"""A policy of the package."""
MAX_SIZE: Final = 144 * 1024
"""Greatest size of a file, bytes, so that the package stays small."""


def main() -> None:
    """Evaluate the policy of a run, and copy it into the package."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("run", type=Path, nargs="?", help="folder of a training run")
    parser.add_argument(
        "--again", nargs="*", metavar="TASK", help="measure shipped policies again; all by default"
    )
    parser.add_argument("--behind-forecast", metavar="TASK", help="ship `best` as `best:robust`")
    parser.add_argument("--value", type=Path, metavar="RUN", help="add the value network of a run")
    parser.add_argument("--opponents", nargs="*", help="policies of the other team")
    parser.add_argument("--starts", type=int, default=STARTS, help="starts for each side")
    parser.add_argument("--threads", type=int, help="threads of the simulator")
    arguments = parser.parse_args()
    given = (arguments.run, arguments.again, arguments.behind_forecast, arguments.value)
    if sum(value is not None for value in given) != 1:
        parser.error("expected one of a run, --again, --behind-forecast and --value")
    if arguments.value is not None:
        for path in add_value(arguments.value):
            print(f"{path}: {path.stat().st_size / 1024:.1f} KiB")
        return
    if arguments.again is not None:
        for name in arguments.again or shipped():
            measure_again(name, arguments.starts, arguments.threads)
        return
    numbers = (arguments.opponents, arguments.starts, arguments.threads)
    if arguments.behind_forecast is not None:
        path = ship_behind_forecast(arguments.behind_forecast, *numbers)
    else:
        path = ship(arguments.run, *numbers)
    print(f"{path}: {path.stat().st_size / 1024:.1f} KiB")


def ship(
    run: Path,
    opponents: list[str] | None = None,
    starts: int = STARTS,
    threads: int | None = None,
) -> Path:
    """Evaluate the policy of a run, and copy it into the package.

    Args:
        run: folder of a training run.
        opponents: policies of the other team; None for those of the protocol.
        starts: starts for each side, at least 10, without which scores have no interval.
        threads: threads of the simulator; None for all.

    Returns:
        The file in the package; an existing one has been replaced.

    Raises:
        FileNotFoundError: no policy or no settings in the folder.
        ValueError: a file that is too large, too few starts, or a policy of a task that is not
            registered.
    """
    checks.integer("starts", starts, MIN_PER_SIDE)
    policy = trained.load_file(run / f"policy{SUFFIX}")
    task = rsoccer.make_task(policy.task_name)
    if task.name != policy.task_name:
        raise ValueError(f"run: expected a policy of {task.name}, got one of {policy.task_name}")
    if isinstance(policy, Network) and "layout" not in policy.metadata:
        raise ValueError(f"run: expected a policy with its layout in {run}, got none")
    policy.metadata["training"] = json.dumps(_training(run))
    if isinstance(policy, Network) and task.config.robot.drive == "omni":
        policy.set_value(None)
    task = rsoccer.make_task(task.name, **options_of(policy))
    path = trained.FOLDER / trained.file_name(task.name, variant_of(policy))
    candidate = run / path.name
    _save(policy, candidate)  # scores are those of the rounded weights
    scores = _scores(candidate, task, opponents, starts, threads, senses_of(policy))
    policy.metadata["scores"] = scores_text(scores)
    _save(policy, candidate)
    _put(candidate, path)
    return path


def ship_behind_forecast(
    name: str,
    opponents: list[str] | None = None,
    starts: int = STARTS,
    threads: int | None = None,
) -> Path:
    """Make the policy `best` of a task its policy `best:robust`, too, which needs a forecast.

    Args:
        name: the task.
        opponents: policies of the other team; None for those of the protocol.
        starts: starts for each side, at least 10.
        threads: threads of the simulator; None for all.

    Returns:
        The file in the package; an existing one has been replaced.

    Raises:
        ValueError: a task without a policy, a file that is too large, or too few starts.
    """
    checks.integer("starts", starts, MIN_PER_SIDE)
    source = trained.list_trained().get(name)
    if source is None:
        raise ValueError(f"name: expected one of {list(trained.list_trained())}, got {name!r}")
    network = Network.load(source)
    network.metadata |= training_conditions.written(BEHIND_FORECAST, None)
    path = trained.FOLDER / trained.file_name(name, trained.ROBUST)
    with tempfile.TemporaryDirectory() as folder:
        candidate = Path(folder) / path.name
        network.save(candidate, half_precision=True)
        senses = senses_of(network)
        scores = _scores(candidate, rsoccer.make_task(name), opponents, starts, threads, senses)
        network.metadata |= {"scores": scores_text(scores)}
        network.save(candidate, half_precision=True)
        _put(candidate, path)
    return path


def add_value(run: Path) -> list[Path]:
    """Add the value network of a run to the policies of the package with the run's weights.

    Args:
        run: folder of a run that began with `best` of its task and changed its value network alone.

    Returns:
        The files that have it now.

    Raises:
        ValueError: a run without a value network, or one that no policy of the package has been
            the beginning of.
    """
    network = Network.load(run / f"policy{SUFFIX}")
    if network.value is None:
        raise ValueError(f"value: expected a run with a value network, got {run}")
    changed = []
    for variant in (None, trained.ROBUST):
        path = trained.list_trained(variant).get(network.task_name)
        policy = None if path is None else Network.load(path)
        if path is None or policy is None or not _same_play(policy, network):
            continue
        layers = _for_normalization(network.value.layers, network, policy)
        policy.set_value(replace(network.value, layers=layers))
        with tempfile.TemporaryDirectory() as folder:
            candidate = Path(folder) / path.name
            policy.save(candidate, half_precision=True)
            _put(candidate, path)
        changed.append(path)
    if not changed:
        raise ValueError(
            f"value: expected a run that began with a policy of the package, got {run}"
        )
    return changed


def _same_play(policy: Network, other: Network) -> bool:
    """Whether both act alike but for their normalization: they have the same later layers."""
    if len(policy.layers) != len(other.layers):
        return False
    pairs = zip(policy.layers[1:], other.layers[1:], strict=True)
    return all(np.array_equal(a, b) for one, two in pairs for a, b in zip(one, two, strict=True))


def _for_normalization(
    layers: list[tuple[Floats, Floats]], old: Network, new: Network
) -> list[tuple[Floats, Floats]]:
    """The same network for observations as another policy normalizes them."""
    (weight, bias), *others = layers
    scale, shift = new.std / old.std, (new.mean - old.mean) / old.std
    return [(weight * scale, bias + weight @ shift), *others]


def _save(policy: Shipped, path: Path) -> None:
    """Write a policy, a network in half precision."""
    if isinstance(policy, Network):
        policy.save(path, half_precision=True)
    else:
        policy.save(path)


def _put(candidate: Path, path: Path) -> None:
    """Put a file into the package, and print the scores of the one that it replaces."""
    if candidate.stat().st_size > MAX_SIZE:
        raise ValueError(f"run: expected a policy of at most {MAX_SIZE} bytes, got {candidate}")
    if path.exists():
        print("before:", *trained.list_scores(path), sep="\n    ")
    write_atomically(path, candidate.read_bytes())


def shipped() -> dict[str, Path]:
    """Return the files of the package by the names that `--again` takes."""
    variants = (trained.ROBUST, trained.OPPONENTS)
    return trained.list_trained() | {
        f"{name}:{variant}": path
        for variant in variants
        for name, path in trained.list_trained(variant).items()
    }


def variant_of(policy: Shipped) -> str | None:
    """Return the variant of the package's policy that one becomes; None for `best` itself.

    Args:
        policy: the policy of a run.
    """
    if policy.sensing is not None:
        return trained.ROBUST
    return trained.OPPONENTS if options_of(policy) else None


def options_of(policy: Shipped) -> dict[str, int]:
    """Return the options of the task with which a policy is measured: those that give opponents.

    Args:
        policy: the policy.
    """
    default = getattr(rsoccer.make_task(policy.task_name), "n_opponents", 0)
    count = policy.task_options.get("n_opponents", default)
    return {} if count == default else {"n_opponents": count}


def senses_of(policy: Shipped) -> list[str]:
    """Return the senses with which a policy is measured: none, and those of its training.

    Args:
        policy: the policy.
    """
    return [""] if policy.sensing is None else ["", describe(policy.sensing)]


def measure_again(name: str, starts: int = STARTS, threads: int | None = None) -> None:
    """Measure a policy of the package again, against the opponents that its file has scores of.

    Args:
        name: task of the policy, with ":robust" for the one that has learned with senses.
        starts: starts for each side, at least 10.
        threads: threads of the simulator; None for all.

    Raises:
        ValueError: no policy of that task, or too few starts.
    """
    checks.integer("starts", starts, MIN_PER_SIDE)
    path = shipped().get(name)
    if path is None:
        raise ValueError(f"name: expected one of {list(shipped())}, got {name!r}")
    before = trained.list_scores(path)
    policy = trained.load_file(path)
    # A policy that was measured on its own names "-" as its opponent.
    opponents = list(dict.fromkeys(s.opponent for s in before if s.opponent != "-"))
    task = rsoccer.make_task(policy.task_name, **options_of(policy))
    scores = _scores(path, task, opponents, starts, threads, senses_of(policy))
    print("before:", *before, "now:", *scores, sep="\n    ")
    policy.metadata["scores"] = scores_text(scores)
    _save(policy, path)


def _scores(
    policy: Path,
    task: Task,
    opponents: list[str] | None,
    starts: int,
    threads: int | None,
    senses: list[str],
) -> list[Score]:
    """Scores with each senses against each opponent, printed as tables."""
    chosen: Sequence[str | None] = opponents_of(task.name)
    if task.two_sided and opponents:
        chosen = opponents
    matches = starts * (2 if task.two_sided else 1)
    scores = []
    for sensing in senses:
        results = [
            evaluate(
                *(policy, opponent, matches, SEED),
                task=task,
                threads=threads,
                sensing=sensing or None,
            )
            for opponent in chosen
        ]
        print(*([f"sensing {sensing}:"] if sensing else []), table(results), sep="\n")
        scores += [_score(found, sensing) for found in results]
    return scores


def _score(found: Evaluation, sensing: str) -> Score:
    """The score of an evaluation."""
    assert found.low is not None and found.high is not None, "enough starts for an interval"
    numbers = (found.matches, found.score, found.low, found.high)
    return Score(found.opponent, found.metric, *numbers, sensing)


def _training(run: Path) -> dict[str, Any]:
    """Command, samples and versions of the training of a run, for the metadata."""
    settings = json.loads((run / SETTINGS_FILE).read_text())
    info = rsoccer.build_info()
    return {
        "command": command_of(settings),
        "samples": int(read_progress(run)["samples"][-1]),
        "seed": settings["seed"],
        "package": info["version"],
        "physics": info["physics"],
    }


def command_of(settings: dict[str, Any]) -> str:
    """Return the command of a run with all its settings, as defaults and recommended ones change.

    Args:
        settings: settings of the run, from `to_json` of `Args`, `DistillArgs` or `EvolveArgs`.
    """
    kinds = {"teacher": "distill", "script": "evolve"}
    kind = next((kinds[name] for name in kinds if name in settings), "train")
    words = ["rsoccer", kind]
    for name, value in settings.items():
        if name in CHANGEABLE_ON_RESUME and name != "samples":
            continue
        # The command line has one word for opponents.
        option = "opponents" if name == "opponents.fixed" else name.replace("_", "-")
        part, dot, setting = option.rpartition(".")
        if isinstance(value, bool):
            words.append(f"--{option}" if value else f"--{part}{dot}no-{setting}")
        elif name in ("task_options", "randomization"):
            words += [f"--{option}", *(f"{key}={each}" for key, each in value.items())]
        elif isinstance(value, dict):  # policies with their shares
            words += [f"--{option}", *(str(part) for pair in value.items() for part in pair)]
        else:
            values = value if isinstance(value, list) else [value]
            words += [f"--{option}", *map(str, values)]
    return shlex.join(words)


if __name__ == "__main__":
    main()
