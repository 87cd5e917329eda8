"""Settings of the shortest run."""

from pathlib import Path

from rsoccer.train import (
    Args,
    NetworkSettings,
    OpponentSettings,
    PpoSettings,
    RolloutSettings,
    RunSettings,
)


def one_update(task: str, folder: Path) -> Args:
    """Return settings for one update: four decisions in three matches, a tiny network."""
    return Args(
        task,
        folder,
        samples=1,  # rounded up to one update
        threads=1,
        rollout=RolloutSettings(worlds=3, horizon=4),
        network=NetworkSettings(hidden_sizes=(8,)),
        ppo=PpoSettings(n_epochs=1, n_minibatches=1),
        opponents=OpponentSettings(solo_fraction=0.0),
        run=RunSettings(progress=False, ladder_interval=0),
    )
