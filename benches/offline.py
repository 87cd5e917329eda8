"""Offline learning from a data set of mixed skills: behavior cloning and IQL of d3rlpy.

`python -m benches.offline` records the data set, learns from it with each algorithm, and stores the
scores of learned policies and of those in the data set in `benches/results/offline.json`. It needs
the extra `data` and d3rlpy, see `docs/offline.md`. Finished rows stay, so that an interrupted run
goes on; `--rerun` plays all again.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np

import rsoccer
from benches.markdown import table
from benches.result_files import RESULTS, this_machine
from rsoccer.arrays import Floats
from rsoccer.datasets import LearnerEpisode, record_episodes, save_minari
from rsoccer.evaluate import Evaluation
from rsoccer.files import write_atomically
from rsoccer.policies.base import Memory, Policy, PolicyInput
from rsoccer.rng import WorldRng

if TYPE_CHECKING:
    from minari import MinariDataset

TASK: Final = "SSLGoToBall-v0"
DATASET: Final = "rsoccer/SSLGoToBall/mixed-v0"
SKILLS: Final = {"best": 50, "fetch": 50, "ou": 100}
"""Matches of each policy in the data set."""
SEED: Final = 0
STEPS: Final = 2_000
"""Gradient steps of each algorithm."""
BATCH: Final = 256
MATCHES: Final = 200
"""Matches of each evaluation."""
EVALUATION_SEED: Final = 31
COMPARED: Final = ("task", "skills", "steps", "matches", "physics")
"""Settings that all rows share."""
UNITS: Final = (128, 128)
"""Hidden layers of all networks."""
ALGORITHMS: Final = {
    "BC": "BCConfig",
    "IQL": "IQLConfig",
}
"""Names in the table, and classes in `d3rlpy.algos`."""
RESULT: Final = RESULTS / "offline.json"


class Learned(Policy):
    """Plays a policy of d3rlpy, which maps observations to actions."""

    observes = "observation"

    def __init__(self, algorithm: Any) -> None:  # noqa: ANN401  (a class of d3rlpy)
        """Take a trained algorithm."""
        super().__init__()
        self._algorithm = algorithm

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Return the greedy actions."""
        assert inputs.observations is not None
        flat = inputs.observations.reshape(-1, inputs.observations.shape[-1])
        actions = np.asarray(self._algorithm.predict(flat), np.float32)
        return actions.reshape(inputs.action_shape)


def main() -> None:
    """Run what is missing, then print the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--rerun", action="store_true", help="repeat finished rows")
    result = {"rows": {}} if parser.parse_args().rerun else comparable(load())
    episodes: list[LearnerEpisode] = []
    for policy in SKILLS:
        if policy not in result["rows"]:
            result["rows"][policy] = scored(policy, 0.0)
            store(result | settings())
    for name in ALGORITHMS:
        if name not in result["rows"]:
            episodes = episodes or mixed()
            start = time.process_time()
            algorithm = learn(name, through_minari(episodes))
            result["rows"][name] = scored(Learned(algorithm), time.process_time() - start)
            store(result | settings())
    sys.stdout.write(f"{results()}\n")


def comparable(stored: dict[str, Any]) -> dict[str, Any]:
    """Return stored results, without rows if those of today would be measured otherwise.

    Args:
        stored: The results; empty without them.
    """
    now = settings()
    same = all(stored.get(name) == now[name] for name in COMPARED)
    return stored if same and "rows" in stored else {"rows": {}}


def load() -> dict[str, Any]:
    """Return the stored results; empty without them."""
    found: dict[str, Any] = json.loads(RESULT.read_text()) if RESULT.exists() else {}
    return found


def store(result: dict[str, Any]) -> None:
    """Write the results."""
    write_atomically(RESULT, (json.dumps(result, indent=1) + "\n").encode())


def settings() -> dict[str, Any]:
    """Return what the results depend on."""
    machine = this_machine()
    return {
        "task": TASK,
        "skills": dict(SKILLS),
        "steps": STEPS,
        "matches": MATCHES,
        "physics": int(rsoccer._core.build_info()["physics"]),
        "machine": machine.machine,
        "date": machine.date,
    }


def mixed() -> list[LearnerEpisode]:
    """Return the episodes of all skills."""
    found: list[LearnerEpisode] = []
    for policy, matches in SKILLS.items():
        found += record_episodes(policy, TASK, matches, SEED + len(found), threads=1)
    return found


def through_minari(episodes: list[LearnerEpisode]) -> MinariDataset:
    """Return the episodes as a data set that Minari has written and read."""
    import minari

    folder = tempfile.mkdtemp()
    os.environ["MINARI_DATASETS_PATH"] = folder
    save_minari(DATASET, episodes, TASK)
    return minari.load_dataset(DATASET)


def learn(name: str, dataset: MinariDataset, steps: int = STEPS) -> Any:  # noqa: ANN401
    """Return an algorithm of d3rlpy that has learned from a data set.

    Args:
        name: One of `ALGORITHMS`.
        dataset: The data set.
        steps: Gradient steps.
    """
    import d3rlpy

    d3rlpy.seed(SEED)
    buffer = d3rlpy.dataset.MDPDataset(**columns(dataset))
    encoder = d3rlpy.models.VectorEncoderFactory(list(UNITS))
    config = getattr(d3rlpy.algos, ALGORITHMS[name])
    factories = {
        field: encoder for field in config.__dataclass_fields__ if field.endswith("encoder_factory")
    }
    algorithm = config(
        batch_size=BATCH,
        gamma=0.99,
        observation_scaler=d3rlpy.preprocessing.StandardObservationScaler(),
        **factories,
    ).create(device="cpu")
    with tempfile.TemporaryDirectory() as logs:
        algorithm.fit(
            buffer,
            n_steps=steps,
            n_steps_per_epoch=steps,
            show_progress=False,
            logger_adapter=d3rlpy.logging.NoopAdapterFactory(),
            experiment_name=Path(logs).name,
        )
    return algorithm


def columns(dataset: MinariDataset) -> dict[str, Any]:
    """Return a data set as d3rlpy takes it: steps of all episodes in arrays (n, ...)."""
    parts = list(dataset.iterate_episodes())
    return {
        # The last observation of an episode has no action: d3rlpy takes t steps.
        "observations": np.concatenate([part.observations[:-1] for part in parts]),
        "actions": np.concatenate([part.actions for part in parts]),
        "rewards": np.concatenate([part.rewards for part in parts]).astype(np.float32),
        "terminals": np.concatenate([part.terminations for part in parts]).astype(np.float32),
        "timeouts": np.concatenate([part.truncations for part in parts]).astype(np.float32),
    }


def scored(policy: Policy | str, seconds: float) -> dict[str, Any]:
    """Return the numbers of a row: the evaluation of a policy, and the time of its training."""
    found: Evaluation = rsoccer.evaluate(
        policy, matches=MATCHES, seed=EVALUATION_SEED, task=TASK, threads=1
    )
    return {
        "score": found.score,
        "low": found.low,
        "high": found.high,
        "seconds": found.seconds.mean,
        "training": seconds,
    }


def results() -> str:
    """Return the table of stored results; empty without them."""
    result = load()
    if not result:
        return ""
    rows = [
        (
            name if name in ALGORITHMS else f"`{name}`",
            str(result["skills"].get(name, "-")),
            f"{row['score']:.3f}",
            f"{row['low']:.3f} to {row['high']:.3f}",
            f"{row['seconds']:.1f} s",
            f"{row['training']:.0f} s" if name in ALGORITHMS else "-",
        )
        for name, row in result["rows"].items()
    ]
    header = ("policy", "matches in the data", "reached", "95% interval", "match", "training")
    return (
        f"{table(header, rows)}\n\n{result['steps']:,} gradient steps each, {result['matches']} "
        f"matches; physics {result['physics']}, {result['machine']}, {result['date']}."
    )


if __name__ == "__main__":
    main()
