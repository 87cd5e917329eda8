"""What only a fresh process can tell, printed as JSON: `python -m benches.probe start`.

    memory FIELD ROBOTS WORLDS            bytes that a world takes, after play in a crowd
    hosting FIELD ROBOTS WORLDS THREADS   speed, bytes and seconds to build, in random play
    start                                 seconds until the package and its first worlds are there

Nothing is imported before it is measured.
"""

import json
import sys
import time
from pathlib import Path

TASK = "VSSSelfPlay-v0"
WORLDS = 4096
PLAYED = 40  # steps: what contacts need is then there too
HOSTED = range(10, 12)  # steps that are timed, few, of very many worlds; by then some touch


def main() -> None:
    """Measure what the command line says."""
    sys.stdout.write(json.dumps(measured(*sys.argv[1:])))


def measured(kind: str, field: str = "", *numbers: str) -> dict[str, float]:
    """What is asked for, by name."""
    if kind == "memory":
        return memory(field, *map(int, numbers))
    if kind == "hosting":
        return hosting(field, *map(int, numbers))
    return start()


def memory(field: str, robots: int, worlds: int) -> dict[str, float]:
    """Bytes that a world takes."""
    from benches.games import Driver, Game
    from benches.simulators import Ours, play
    from rsoccer import WorldRng

    game = Game("", field, robots, "crowd")
    start, driver = game.start(WorldRng.seeded(0, worlds)), Driver(game, worlds)
    ones = Ours(game, 1)  # code and tables that do not depend on the number of worlds
    ones.place(game.start(WorldRng.seeded(0, 1)))
    before = resident()
    player = Ours(game, worlds)
    player.place(start)
    play(game, player, driver, range(PLAYED))
    return {"bytes": (resident() - before) / worlds}


def hosting(field: str, robots: int, worlds: int, threads: int) -> dict[str, float]:
    """World-steps per second, bytes of the whole process and seconds to build its worlds."""
    from benches.games import Driver, Game
    from benches.simulators import Ours, expect_contacts, play
    from rsoccer import WorldRng

    game = Game("", field, robots, "random")
    begun = time.perf_counter()
    player = Ours(game, worlds, threads)
    build = time.perf_counter() - begun
    player.place(game.start(WorldRng.seeded(0, worlds)))
    spent, touching = play(game, player, Driver(game, worlds), HOSTED)
    expect_contacts(game, touching[-1], worlds * game.config.n_robots)
    return {"speed": worlds * len(HOSTED) / spent, "bytes": resident(), "build": build}


def resident() -> int:
    """Bytes of memory that this process holds; where the system does not say, its peak."""
    import resource

    held = Path("/proc/self/statm")
    if held.exists():
        return int(held.read_text().split()[1]) * resource.getpagesize()
    unit = 1 if sys.platform == "darwin" else 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit


def start() -> dict[str, float]:
    """Seconds that the first things take."""
    times = [time.perf_counter()]

    def split() -> float:
        times.append(time.perf_counter())
        return times[-1] - times[-2]

    import gymnasium  # noqa: F401
    import pettingzoo  # noqa: F401

    libraries = split()
    import rsoccer

    found = {"libraries": libraries, "import": split()}
    rsoccer.parallel_env(TASK).reset(seed=0)
    found["reset"] = split()
    matches = rsoccer.Matches(TASK, worlds=WORLDS)
    found["build"] = split()
    matches.reset()
    found["begin"] = split()
    return found


if __name__ == "__main__":
    main()
