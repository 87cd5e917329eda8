"""Demonstration in about a minute: train a policy, evaluate it, film a match (`make demo`)."""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

from rsoccer.evaluate import Evaluation, evaluate, table
from rsoccer.render.video import write_video
from rsoccer.replay.film import film_replay
from rsoccer.replay.recorder import record_replay
from rsoccer.train import Args, train
from rsoccer.train.run.learning_curve import plot_learning_curve

TASK = "VSSSelfPlay-v0"
SAMPLES = 1_000_000
"""Number of decisions to learn from: half a minute of training on two cores.

Policies of five seeds scored .97 to 1.00 against `zero` and .98 to 1.00 against `ou`, with MKL in
place of oneDNN, which rounds otherwise, .94 to .99 and .915 to .975.
"""
SHORT_RUN: Final[Mapping[str, Any]] = {
    "rollout": {"worlds": 128},
    "network": {"action_std": 0.8, "final_action_std": 0.4},
    "ppo": {"n_epochs": 3, "n_minibatches": 8},
    "opponents": {"solo_fraction": 0.8},
}
"""Settings of a run that ends before teams play well.

- Most of the run has one learner per match, whose reward follows from its own actions.
- The actions have a wide spread to the end, so exploring does not stop. A narrow spread leaves more
  draws: after 600,000 decisions a run with a spread from .6 to .1 scored .76 against `zero`, one
  with a spread from .8 to .4 scored .955 (one seed each).
- Small batches give more updates, and small minibatches give more steps in a pass. Three passes
  over them then learn about as much as six over large ones, for less time.
"""
LADDER_INTERVAL = 44
"""Updates between two points of the learning curve, which has four: a point takes about 2 s."""


def demo(out: Path, samples: int = SAMPLES, matches: int = 200) -> dict[str, Any]:
    """Train a policy, evaluate it and film a match.

    Args:
        out: folder for all files; a run that it holds is replaced.
        samples: decisions to learn from, at least 1.
        matches: matches against each of four opponents, an even number.

    Returns:
        The content of `metrics.json`: the task, the samples, the seconds of each stage and the
        evaluations.
    """
    seconds: dict[str, float] = {}
    started = time.monotonic()

    def stage(name: str, text: str) -> None:
        now = time.monotonic()
        seconds[name] = now - started - sum(seconds.values())
        sys.stdout.write(f"{text} ({seconds[name]:.0f} s)\n")

    args = Args.for_task(
        TASK,
        out=out,
        samples=samples,
        overwrite=True,
        run={"match_page": False, "ladder_interval": LADDER_INTERVAL},
        **SHORT_RUN,
    )
    policy = train(args)
    stage("training", f"trained on {samples:,} decisions -> {policy}")
    untrained = out / "untrained.safetensors"
    opponents = ("zero", "uniform", "ou", str(untrained))
    evaluations = [
        evaluate(policy, opponent, matches=matches, seed=1, task=TASK) for opponent in opponents
    ]
    stage("evaluation", table(evaluations))
    curve = plot_learning_curve(out, out / "curve.png")
    replay = record_replay(
        TASK, {"blue": str(policy), "yellow": "ou"}, seed=1, seconds=30.0, names=("TRAINED", "OU")
    )
    video = write_video(out / "match.mp4", *film_replay(replay))
    page = replay.save_html(out / "match.html")
    replay.save(out / "match.rsr")
    stage("pictures", f"watch {video}, or {page} in a browser; learning curve in {curve}")
    metrics = _metrics(samples, evaluations, seconds)
    (out / "metrics.json").write_text(json.dumps(metrics, indent=2) + "\n")
    return metrics


def _metrics(
    samples: int, evaluations: list[Evaluation], seconds: dict[str, float]
) -> dict[str, Any]:
    """Content of `metrics.json`."""
    return {
        "task": TASK,
        "samples": samples,
        "seconds": seconds,
        "evaluations": [evaluation.as_dict() for evaluation in evaluations],
    }


def main(words: Sequence[str] | None = None) -> None:
    """Run the demonstration.

    Args:
        words: words of the command line; None for those of the process.
    """
    description = __doc__.split("\n")[0]
    parser = argparse.ArgumentParser("python -m rsoccer.demo", description=description)
    parser.add_argument(
        "--out", type=Path, default=Path("out/demo"), help="folder for all files (%(default)s)"
    )
    demo(parser.parse_args(words).out)


if __name__ == "__main__":
    main()
