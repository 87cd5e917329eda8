"""Training with PPO, by self-play where both teams learn; needs torch.

`Args` holds the settings of a run, `Args.for_task` the recommended ones, `train` runs it.
"""

from __future__ import annotations

from pathlib import Path

from rsoccer.train.args import Args

__all__ = ["Args", "train"]


def train(args: Args) -> Path:
    """Train a policy with PPO and save it.

    Example:
        >>> path = train(Args.for_task("VSS-v0", out=Path("out/mine")))  # doctest: +SKIP

    Args:
        args: settings of the run.

    Returns:
        Path of the policy file, in the folder `args.out`.

    Raises:
        ValueError: an unknown task, options or masked observations that it does not have, a folder
            that cannot be written or that holds a run already, or a checkpoint that is missing,
            damaged or of a run with other settings.
        Interrupted: Ctrl-C or SIGTERM ended the run, after a checkpoint was saved.
    """
    from rsoccer.train.run import run

    return run(args)
