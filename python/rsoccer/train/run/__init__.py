"""A run in its folder: updates in turn, checkpoints, logs, signals."""
