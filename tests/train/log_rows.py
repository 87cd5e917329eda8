"""Rows of a log with a gap, as a run writes them."""

from pathlib import Path

from rsoccer.train.run.log import Logger


def new_logger(folder: Path, samples: int = 0, size: int = 0) -> Logger:
    """Return the logs of a run without a progress bar, new or after a checkpoint."""
    return Logger(folder, samples, 1000, size, progress=False)


def write_rows(logger: Logger, first: int, last: int) -> int:
    """Write the rows of updates `first` to `last` - 1, close the log, and return its size."""
    for update in range(first, last):
        score = float("nan") if update == 1 else update / 10
        row = {"samples": 100 * update, "reward": 1.0, "episode_ou/goal_score": score}
        logger.write(100 * update, row)
    logger.close()
    return logger.size
