"""Scores of the shipped policies in other simulators: `python -m benches.transfer grsim`.

The simulator runs already, at its usual ports on this machine; nothing here starts one. Episodes
are played in the time of its vision, one after the other, and kept in a file of the place, so that
a run that was stopped goes on where it was with `--resume`. `home` and `likeness` are this
package's own simulator: exact, and with delays and numbers like those of each place.
"""

import argparse
import json
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

import numpy as np

from benches.transfer_places import (
    HOME,
    PLACES,
    TRIALS,
    Trial,
    as_played,
    is_forecast,
    likeness,
    port_numbers,
)
from rsoccer import files
from rsoccer.drive import Network
from rsoccer.evaluate.episodes import EpisodeRunner
from rsoccer.evaluate.schedule import first_seed
from rsoccer.lineup import lineup
from rsoccer.policies import make_policy
from rsoccer.registry import make_task
from rsoccer.sources import SensingSource
from rsoccer.task import LEARN, Task
from rsoccer.view import SIDES

STORED: Final = Path(__file__).parent / "results" / "transfer"
"""Folder of the results that the documentation shows, with a file for each place."""
CHUNK: Final = 10
"""Episodes after which results are kept."""
LIKENESS: Final = " likeness"
"""Ending of the name of a place for its likeness in this package's own simulator."""

Results = dict[str, dict[str, Any]]
"""By name of the trial: scores by side, seconds by side."""


def play(
    task: Task,
    trial: Trial,
    episodes: range,
    side: str | None,
    *,
    network: Network | None = None,
    sensing: SensingSource | None = None,
) -> tuple[list[float], list[float]]:
    """Return scores and durations of some episodes, from the view of the policy's team.

    Args:
        task: the task.
        trial: policy and opponent.
        episodes: their numbers: equal numbers begin alike in every place.
        side: "blue" or "yellow" in two-sided tasks, else None.
        network: the other simulator; None for this package's own.
        sensing: what robots know.
    """
    opponent = None if trial.opponent is None else make_policy(trial.opponent, task)
    policy = make_policy(trial.policy, task)
    policy.forecasts = is_forecast(trial)  # the place's senses have a forecast, or none plays
    runner = EpisodeRunner(
        task,
        lineup(task, LEARN, opponent, side),
        policy,
        worlds=1 if network is not None else len(episodes),
        threads=1,
        simulator=network,
        sensing=sensing,
    )
    index = 0 if side is None else SIDES.index(side)
    found = runner.run(len(episodes), first_seed(0, index) + episodes.start)
    sign = -1.0 if side == SIDES[1] else 1.0
    return (sign * found.scores + 0.0).tolist(), found.seconds.tolist()


def measure(
    name: str, trials: Sequence[Trial], matches: int, path: Path, ports: Mapping[str, int]
) -> None:
    """Play the episodes of a place that its file lacks.

    Args:
        name: name of the place, `HOME`, or a place with `LIKENESS`.
        trials: what is played.
        matches: episodes of each trial.
        path: the file.
        ports: names and numbers of ports that differ from those of the place.
    """
    results: Results = json.loads(path.read_text()) if path.exists() else {}
    network = Network(PLACES[name].settings(ports)) if name in PLACES else None
    try:
        for trial in trials:
            task, sensing = _played(name, trial)
            sides = SIDES if task.two_sided else (None,)
            row = results.setdefault(trial.name, {"scores": {}, "seconds": {}})
            for side in sides:
                scores = row["scores"].setdefault(side or "all", [])
                seconds = row["seconds"].setdefault(side or "all", [])
                while len(scores) < matches // len(sides):
                    some = range(len(scores), min(len(scores) + CHUNK, matches // len(sides)))
                    played = play(task, trial, some, side, network=network, sensing=sensing)
                    scores += played[0]
                    seconds += np.round(played[1], 3).tolist()
                    text = f"{name}, {trial.name}: {np.mean(scores):.3f} of {len(scores)}\n"
                    sys.stderr.write(text)
                    _keep(path, trial.name, row)
    finally:
        if network is not None:
            network.close()


def _keep(path: Path, trial: str, row: dict[str, Any]) -> None:
    """Write a row beside what other runs, of other trials, have written since."""
    results: Results = json.loads(path.read_text()) if path.exists() else {}
    content = json.dumps(results | {trial: row})
    files.write_atomically(path, (content + "\n").encode())


def _played(name: str, trial: Trial) -> tuple[Task, SensingSource | None]:
    """Task and senses of a trial in a place."""
    if name in PLACES:
        return as_played(PLACES[name], trial)
    if name.endswith(LIKENESS):
        return likeness(PLACES[name.removesuffix(LIKENESS)], trial)
    return make_task(trial.task), None


def main(arguments: Sequence[str] | None = None) -> None:
    """Play, and keep the results.

    Args:
        arguments: words of the command line; None for those of the process.
    """
    places = [HOME, *PLACES, *(place + LIKENESS for place in PLACES)]
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("place", choices=places, help="the simulator")
    parser.add_argument("--matches", type=int, default=100, help="episodes of each trial")
    parser.add_argument("--trials", nargs="+", help="names of trials, all of the place by default")
    parser.add_argument("--ports", nargs="*", default=[], metavar="NAME=PORT", help="other ports")
    parser.add_argument("--results", type=Path, default=STORED, help="folder of the results")
    parser.add_argument("--resume", action="store_true", help="go on with the results of the file")
    given = parser.parse_args(arguments)
    league = PLACES[given.place.removesuffix(LIKENESS)].league if given.place != HOME else None
    # At home the newest state is the true one: forecasts change nothing.
    known = {
        trial.name: trial
        for trial in TRIALS
        if league in (None, trial.league) and not (given.place == HOME and trial.forecasts)
    }
    unknown = sorted(set(given.trials or ()) - set(known))
    if unknown:
        parser.error(f"--trials: unknown {unknown}; expected some of {list(known)}")
    path = given.results / f"{given.place.replace(' ', '_')}.json"
    if path.exists() and not given.resume:
        parser.error(f"{path} exists; --resume goes on with it")
    given.results.mkdir(parents=True, exist_ok=True)
    chosen = [known[name] for name in given.trials or known]
    measure(given.place, chosen, given.matches, path, port_numbers(given.ports))


if __name__ == "__main__":
    main()
