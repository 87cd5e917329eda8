"""Training with PPO, by self-play where both teams learn; needs torch.

`Args` holds the settings of a run, `Args.for_task` the recommended ones, `train` runs it. Settings
of the parts of the trainer are nested in `Args`, under the name of the folder with the part:

| field | settings of | class |
| --- | --- | --- |
| `rollout` | matches from which an update learns | `RolloutSettings` |
| `network` | policy and value network | `NetworkSettings` |
| `ppo` | advantages and updates | `PpoSettings` |
| `opponents` | opponents, and the part of a run with one learner per match | `OpponentSettings` |
| `run` | checkpoints, progress, measurements | `RunSettings` |
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from rsoccer.train.args import Args
from rsoccer.train.network.settings import NetworkSettings
from rsoccer.train.opponents.settings import OpponentSettings
from rsoccer.train.ppo.settings import PpoSettings
from rsoccer.train.rollout.settings import RolloutSettings
from rsoccer.train.run.settings import RunSettings

if TYPE_CHECKING:
    from rsoccer.train.run.callback import Callback

__all__ = ["Args", "NetworkSettings", "OpponentSettings", "PpoSettings", "RolloutSettings"]
__all__ += ["RunSettings", "train"]


def train(args: Args, callback: Callback | None = None) -> Path:
    """Train a policy with PPO and save it.

    Example:
        >>> args = Args.for_task("VSS-v0", out=Path("out/mine"), ppo={"gamma": 0.99})
        >>> path = train(args)  # doctest: +SKIP

    Args:
        args: settings of the run.
        callback: called after each update with an `Update` of `rsoccer.train.run.callback`: the
            columns of the log, and the current policy. It may log them elsewhere, evaluate the
            policy or film it; False ends the run early, and an error after the run was saved. It
            does not change what the run learns. None for none.

    Returns:
        Path of the policy file, in the folder `args.out`.

    Raises:
        ValueError: an unknown task, options or masked observations that it does not have, a folder
            that cannot be written or that holds a run already, or a checkpoint that is missing,
            damaged or of a run with other settings.
        TypeError: a callback that is no function, or that returns something else than None or a
            bool.
        Interrupted: Ctrl-C or SIGTERM ended the run, after a checkpoint was saved.
    """
    if callback is not None and not callable(callback):
        raise TypeError(f"callback: expected a function, got {callback!r}")
    from rsoccer.train.run.training import run_training

    return run_training(args, callback)
