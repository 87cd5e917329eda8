"""Training speed: rollouts and updates of the trainer, and of the example's own loop."""

import io
import runpy
import time
from contextlib import redirect_stdout
from pathlib import Path
from typing import Any, Final

import rsoccer
from benches.measuring import Measure, Quantity, Values

DECISIONS: Final = Quantity("speed", "decisions/s")
EXAMPLE: Final = Path(__file__).parents[1] / "examples" / "13_ppo.py"


def training(task: str, engine: str, worlds: int, threads: int) -> Measure:
    """Measure updates in which all robots of a team learn, as in most of a run; at least one."""
    import torch

    from rsoccer.train import Args, OpponentSettings, RolloutSettings
    from rsoccer.train.run.trainer import Trainer

    args = Args(
        task,
        Path("nowhere"),  # a trainer alone writes no files
        task_options={"engine": engine},
        threads=threads,
        rollout=RolloutSettings(worlds=worlds),
        opponents=OpponentSettings(solo_fraction=0.0),
    )
    trainer = Trainer(args)

    def measure(seconds: float) -> Values:
        torch.set_num_threads(args.torch_threads)
        before, start, elapsed = trainer.samples, time.perf_counter(), 0.0
        while not elapsed or elapsed < seconds:
            trainer.update(trainer.collect_rollout(lambda: None), lambda: None)
            elapsed = time.perf_counter() - start
        return {DECISIONS: (trainer.samples - before) / elapsed}

    return measure


def example(task: str, worlds: int, threads: int) -> Measure:
    """Measure updates of the PPO in `examples/13_ppo.py`; at least four."""
    import torch

    matches = rsoccer.Matches(task, worlds, 0, threads, autoreset="disabled")
    script: Any = runpy.run_path(str(EXAMPLE))
    decisions_per_run = 4 * script["HORIZON"] * worlds * len(matches.agents)

    def measure(seconds: float) -> Values:
        torch.set_num_threads(1)
        decisions, start, elapsed = 0, time.perf_counter(), 0.0
        while not elapsed or elapsed < seconds:
            with redirect_stdout(io.StringIO()):  # its progress
                script["train"](matches, decisions_per_run, central=False)
            decisions += decisions_per_run
            elapsed = time.perf_counter() - start
        return {DECISIONS: decisions / elapsed}

    return measure
