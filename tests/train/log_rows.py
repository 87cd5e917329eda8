"""Rows of a log with a gap, as a run writes them."""

from rsoccer.train.log import Logger


def write_rows(logger: Logger, first: int, last: int) -> int:
    """Write the rows of updates `first` to `last` - 1, close the log, and return its size."""
    for update in range(first, last):
        score = float("nan") if update == 1 else update / 10
        row = {"samples": 100 * update, "reward": 1.0, "episode_ou/goal_score": score}
        logger.write(100 * update, row)
    logger.close()
    return logger.size
