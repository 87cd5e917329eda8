"""Figures such as a machine's table holds, made up."""

from benches.table import Figure, Machine

MACHINE = Machine("Some CPU @ 2.5GHz", 2, "2026-01-31", "abc1234-dirty", "0.1.0", "release")
OLD = "robosim 1.2"
TASK = "VSSSelfPlay-v0"
RANDOM = "VSSS 3 v 3 random"


def made_up(
    group: str,
    game: str,
    who: str,
    median: float,
    worlds: int = 1,
    threads: int = 1,
    quantity: str = "speed",
    unit: str = "world-steps/s",
) -> Figure:
    """A figure of three rounds, the others a tenth off."""
    extremes = (round(0.9 * median, 4), round(1.1 * median, 4))
    return Figure(group, game, who, worlds, threads, quantity, unit, median, *extremes, 3)


def ratio(group: str, game: str, who: str, median: float, worlds: int, threads: int = 1) -> Figure:
    """A ratio of three rounds."""
    return made_up(group, game, who, median, worlds, threads, "ratio", "x")


OURS = [
    made_up("core", RANDOM, "Simulator", 25_000.0),
    made_up("core", RANDOM, "Simulator", 50_000.0, 64),
    made_up("core", RANDOM, "Simulator", 0.02, 64, 1, "robots touching", "share"),
    made_up("many", TASK, "Matches", 40_000.0, 1024, 2),
    made_up("many", TASK, "Matches", 3.96, 1024, 2, "outside physics", "us a world-step"),
    made_up("one", TASK, "empty ParallelEnv", 150_000.0),
    made_up("memory", "SSL 11 v 11", "Simulator", 58.83, 512, 1, "memory", "KiB a world"),
    made_up("hosting", RANDOM, "Simulator", 45_678.0, 100_000, 2),
    made_up("hosting", RANDOM, "Simulator", 2.61, 100_000, 2, "memory of the process", "GiB"),
    made_up("hosting", RANDOM, "Simulator", 1.234, 100_000, 2, "worlds built", "s"),
    made_up("start", TASK, "fresh process", 0.131, 1, 1, "first env and reset", "s"),
]
PEERS = [
    made_up("core", RANDOM, OLD, 500.0),
    ratio("core", RANDOM, f"Simulator / {OLD}", 50.0, 1),
    ratio("core", RANDOM, f"Simulator / {OLD}", 100.0, 64),
    ratio("core", RANDOM, f"compat.robosim / {OLD}", 20.0, 1),
    made_up("many", TASK, "vmas 1.5.2", 20_000.0, 1024, 2),
    ratio("many", TASK, "Matches / vmas 1.5.2", 2.0, 1024, 2),
    ratio("many", TASK, "Matches / vmas 1.5.2", 8.0, 1024, 2),  # to its second number of threads
]
SHARED = [
    ratio("threads", RANDOM, "Simulator / Simulator", 1.9, 1024, 2),
    ratio("threads", RANDOM, "Simulators, one a thread / Simulators, one a thread", 1.95, 1024, 2),
    ratio("threads", RANDOM, "hashing / hashing", 1.98, 1, 2),
    made_up("growth", RANDOM, "Simulator", 50_000.0, 64),
    ratio("growth", RANDOM, "Simulator / Simulator", 0.97, 16384),
]
