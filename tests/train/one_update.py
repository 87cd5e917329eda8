"""Settings of the shortest run."""

from pathlib import Path

from rsoccer.train import Args


def one_update(task: str, folder: Path) -> Args:
    """Return settings for one update: four decisions in three matches, a tiny network."""
    return Args(
        task,
        folder,
        samples=1,  # rounded up to one update
        threads=1,
        progress=False,
        solo_fraction=0.0,
        worlds=3,
        horizon=4,
        hidden_sizes=(8,),
        n_epochs=1,
        n_minibatches=1,
        ladder_interval=0,
    )
