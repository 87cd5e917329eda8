"""Made-up figures in the form of a machine's result table."""

from benches.measuring import MATCH_TIME
from benches.result_files import Figure, Machine
from benches.scenarios import DEFAULT_ENGINE, ENGINES

MACHINE = Machine("Some CPU @ 2.5GHz", 2, "2026-01-31", "abc1234-dirty", "0.1.0", "release")
ROBOSIM = "robosim 1.2"
TASK = "VSSSelfPlay-v0"
RANDOM = "VSSS 3 v 3 random"
OTHER_ENGINE = ENGINES[1]
THIRD_PARTY_VARIANTS = ("robosim", "vmas", "pSim", "no-op", "hashing")


def made_up(
    group: str,
    scenario: str,
    variant: str,
    median: float,
    worlds: int = 1,
    threads: int = 1,
    quantity: str = "speed",
    unit: str = "world-steps/s",
    engine: str = DEFAULT_ENGINE,
) -> Figure:
    """Return a figure of three rounds, with minimum and maximum 10% off the median."""
    extremes = (round(0.9 * median, 4), round(1.1 * median, 4))
    engine = "" if variant.startswith(THIRD_PARTY_VARIANTS) else engine
    case = (group, scenario, variant, engine, worlds, threads)
    return Figure(*case, quantity, unit, median, *extremes, 3)


def ratio(
    group: str,
    scenario: str,
    variant: str,
    median: float,
    worlds: int,
    threads: int = 1,
    engine: str = DEFAULT_ENGINE,
) -> Figure:
    """Return a ratio of three rounds."""
    return made_up(group, scenario, variant, median, worlds, threads, "ratio", "x", engine)


RSOCCER = [
    made_up("core", RANDOM, "Simulator", 25_000.0),
    made_up("core", RANDOM, "Simulator", 50_000.0, 64),
    made_up("core", RANDOM, "Simulator", 0.02, 64, 1, "robots in contact", "share"),
    made_up("batched", TASK, "Matches", 40_000.0, 1024, 2),
    made_up("batched", TASK, "Matches", 3.96, 1024, 2, "time outside physics", "us per world-step"),
    made_up("single", TASK, "no-op ParallelEnv", 150_000.0),
    made_up("memory", "SSL 11 v 11", "Simulator", 58.83, 512, 1, "memory", "KiB per world"),
    made_up("capacity", RANDOM, "Simulator", 45_678.0, 100_000, 2),
    made_up("capacity", RANDOM, "Simulator", 2.61, 100_000, 2, "process memory", "GiB"),
    made_up("capacity", RANDOM, "Simulator", 1.234, 100_000, 2, "build time", "s"),
    made_up("startup", TASK, "fresh process", 0.131, 1, 1, "first environment and reset", "s"),
]
THIRD_PARTY = [
    made_up("core", RANDOM, ROBOSIM, 500.0),
    ratio("core", RANDOM, f"Simulator / {ROBOSIM}", 50.0, 1),
    ratio("core", RANDOM, f"Simulator / {ROBOSIM}", 100.0, 64),
    ratio("core", RANDOM, f"compat.robosim / {ROBOSIM}", 20.0, 1),
    made_up("batched", TASK, "vmas 1.5.2", 20_000.0, 1024, 2),
    ratio("batched", TASK, "Matches / vmas 1.5.2", 2.0, 1024, 2),
    ratio("batched", TASK, "Matches / vmas 1.5.2", 8.0, 1024, 2),  # with two threads of VMAS
]
SCALING = [
    ratio("threads", RANDOM, "Simulator / Simulator", 1.9, 1024, 2),
    ratio(
        "threads", RANDOM, "Simulators, one per thread / Simulators, one per thread", 1.95, 1024, 2
    ),
    ratio("threads", RANDOM, "hashing / hashing", 1.98, 1, 2),
    made_up("scaling", RANDOM, "Simulator", 50_000.0, 64),
    ratio("scaling", RANDOM, "Simulator / Simulator", 0.97, 16384),
]
OTHER = [
    made_up("core", RANDOM, "Simulator", 10_000.0, engine=OTHER_ENGINE),
    made_up("core", RANDOM, "Simulator", 20_000.0, 64, engine=OTHER_ENGINE),
    ratio("core", RANDOM, "Simulator / Simulator", 2.5, 1, engine="compact / rapier"),
    ratio("core", RANDOM, f"Simulator / {ROBOSIM}", 30.0, 1, engine=OTHER_ENGINE),
    made_up("batched", TASK, "Matches", 30_000.0, 1024, 2, engine=OTHER_ENGINE),
    ratio("batched", TASK, "Matches / Matches", 1.3, 1024, 2, engine="compact / rapier"),
    ratio("batched", TASK, "Matches / vmas 1.5.2", 1.5, 1024, 2, engine=OTHER_ENGINE),
    ratio("scaling", RANDOM, "Simulator / Simulator", 0.7, 16384, engine=OTHER_ENGINE),
    made_up(
        "memory", "SSL 11 v 11", "Simulator", 20.0, 512, 1, "memory", "KiB per world", OTHER_ENGINE
    ),
]
PSIM = [
    made_up("single", "VSSMulti-v0", "ParallelEnv", 8_000.0),
    made_up("single", "VSSMulti-v0", "ParallelEnv", 200.0, 1, 1, *MATCH_TIME),
    made_up("single", "VSSMulti-v0", "Matches", 220.0, 1, 1, *MATCH_TIME),
    made_up("single", "VSSMulti-v0", "pSim 0.2.4", 3_000.0),
    made_up("single", "VSSMulti-v0", "pSim 0.2.4", 50.0, 1, 1, *MATCH_TIME),
    ratio("single", "VSSMulti-v0", "ParallelEnv / pSim 0.2.4", 2.5, 1),
    ratio("single", "VSSMulti-v0", "Matches / pSim 0.2.4", 3.0, 1),
]
