"""Evolution: better tactics of a script, by playing matches.

The scripted SSL side is a fixed program with some sixty numbers: thresholds, values, gains
(`crates/rsim-teams/src/tactics.rs`); `keep` has some twenty. An evolution strategy with mirrored
samples (Salimans et al., "Evolution Strategies as a Scalable Alternative to Reinforcement
Learning", 2017) plays each match with its own numbers, drawn around the present ones, and moves
these to where more is scored. One match says little, a thousand say for all numbers at once which
way is better: no gradient through the program and no network are needed.
"""

from __future__ import annotations

from pathlib import Path

from rsoccer.train.evolution.settings import EvolveArgs

__all__ = ["EvolveArgs", "evolve"]


def evolve(args: EvolveArgs) -> Path:
    """Find better tactics of a script, and save them as a policy.

    Example:
        >>> args = EvolveArgs.for_task("SSLMatch-v0", generations=10)
        >>> path = evolve(args)  # doctest: +SKIP

    Args:
        args: settings of the run.

    Returns:
        Path of the policy file, in the folder `args.out`.

    Raises:
        ImportError: safetensors is not installed.
        ValueError: an unknown task or one that the script cannot play, opponents in a task without
            another team that learns, a folder that holds a run or cannot be written, nothing to
            resume, or a run with other settings or opponents.
    """
    from rsoccer.train.evolution.run import run_evolution

    return run_evolution(args)
