"""Keep the results of the last `make demo` for the README: `python -m tools.keep_demo`.

The figures go to docs/demo.json, the film and the learning curve to docs/match.gif and
docs/curve.png.
"""

import json
import shutil
from dataclasses import asdict
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np

from benches.result_files import this_machine
from rsoccer.recording import film_match
from rsoccer.render.video import write_video
from rsoccer.train.run.log import read_progress
from tools.paths import DOCS, ROOT

DEMO = ROOT / "out" / "demo"


def main() -> None:
    """Keep the figures, the learning curve and a short match."""
    metrics = json.loads((DEMO / "metrics.json").read_text())
    kept = {**metrics, "training": training(DEMO), "machine": asdict(this_machine())}
    DOCS.mkdir(exist_ok=True)
    (DOCS / "demo.json").write_text(json.dumps(kept, indent=2) + "\n")
    shutil.copyfile(DEMO / "curve.png", DOCS / "curve.png")
    film(metrics["task"], str(DEMO / "policy.safetensors"))


def film(task: str, policy: str, seconds: float = 10.0) -> None:
    """Record a match against the `ou` policy as a GIF of every second image."""
    teams = {"blue": policy, "yellow": "ou"}
    images, fps = film_match(task, teams, 1, seconds, names=("LEARNED", "OU"), width=480)
    write_video(DOCS / "match.gif", islice(images, 0, None, 2), fps / 2)


def training(folder: Path) -> dict[str, Any]:
    """Return the speed of a training run, a median over updates, and the shares of its time."""
    progress = read_progress(folder)
    settings = json.loads((folder / "args.json").read_text())
    samples = float(np.median(progress["samples_per_second"]))
    parts = [name for name in progress if name.startswith("time_")]
    seconds = 1.0 / progress["samples_per_second"]  # all updates have the same number of samples
    shares = {part: float(np.average(progress[part], weights=seconds)) for part in parts}
    return {
        "samples_per_second": samples,
        "agent_steps_per_second": samples * settings["rollout.action_repeat"],
        "shares": {part.removeprefix("time_"): share for part, share in shares.items()},
    }


if __name__ == "__main__":
    main()
