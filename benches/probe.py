"""What only a fresh process can tell, printed as JSON: `python -m benches.probe start`.

    memory FIELD ROBOTS WORLDS   bytes that a world takes, after play in a crowd
    start                        seconds until the package is there and its first worlds are

Nothing is imported before it is measured.
"""

import json
import sys
import time
from pathlib import Path

TASK = "VSSSelfPlay-v0"
WORLDS = 4096
PLAYED = 40  # steps: what contacts need is then there too


def main() -> None:
    """Measure what the command line says."""
    kind, *rest = sys.argv[1:]
    found = memory(rest[0], int(rest[1]), int(rest[2])) if kind == "memory" else start()
    sys.stdout.write(json.dumps(found))


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
