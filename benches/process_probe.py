"""Child process of `benches.process_cost`; prints its measurements as JSON.

    memory ENGINE FIELD ROBOTS WORLDS             bytes per world, after play in a crowd
    capacity ENGINE FIELD ROBOTS WORLDS THREADS   speed, memory and build time, in random play
    startup                                       seconds of imports, first environment and resets

Example: `python -m benches.process_probe startup`. Nothing is imported before it is measured.
"""

import json
import sys
import time
from pathlib import Path

TASK = "VSSSelfPlay-v0"
WORLDS = 4096
WARM_UP_STEPS = 40  # after these the buffers for contacts are allocated
TIMED_STEPS = range(10, 12)  # few, because the batch is large; some robots touch by then


def main() -> None:
    """Run the measurement named on the command line."""
    sys.stdout.write(json.dumps(run(*sys.argv[1:])))


def run(kind: str, engine: str = "", field: str = "", *numbers: str) -> dict[str, float]:
    """Return the results of a measurement by name."""
    if kind == "memory":
        return memory(engine, field, *map(int, numbers))
    if kind == "capacity":
        return capacity(engine, field, *map(int, numbers))
    return startup()


def memory(engine: str, field: str, robots: int, worlds: int) -> dict[str, float]:
    """Measure the memory of a world, bytes."""
    from benches.scenarios import Driver, Scenario
    from benches.simulators import SimulatorAdapter, run_episode
    from rsoccer import WorldRng

    scenario = Scenario("", field, robots, "crowd", engine=engine)
    start, driver = scenario.start(WorldRng.seeded(0, worlds)), Driver(scenario, worlds)
    warm_up = SimulatorAdapter(scenario, 1)  # loads what does not depend on the number of worlds
    warm_up.place(scenario.start(WorldRng.seeded(0, 1)))
    before = resident_memory()
    simulator = SimulatorAdapter(scenario, worlds)
    simulator.place(start)
    run_episode(scenario, simulator, driver, range(WARM_UP_STEPS))
    return {"bytes": (resident_memory() - before) / worlds}


def capacity(engine: str, field: str, robots: int, worlds: int, threads: int) -> dict[str, float]:
    """Measure speed (world-steps/s), memory of the process (bytes) and build time (s)."""
    from benches.scenarios import Driver, Scenario
    from benches.simulators import SimulatorAdapter, check_contacts, run_episode
    from rsoccer import WorldRng

    scenario = Scenario("", field, robots, "random", engine=engine)
    began = time.perf_counter()
    simulator = SimulatorAdapter(scenario, worlds, threads)
    build = time.perf_counter() - began
    simulator.place(scenario.start(WorldRng.seeded(0, worlds)))
    driver = Driver(scenario, worlds)
    spent, touching = run_episode(scenario, simulator, driver, TIMED_STEPS)
    check_contacts(scenario, touching[-1], worlds * scenario.config.n_robots)
    speed = worlds * len(TIMED_STEPS) / spent
    return {"speed": speed, "bytes": resident_memory(), "build": build}


def resident_memory() -> int:
    """Return the resident memory of this process, bytes; its peak if the system has no /proc."""
    import resource

    statm = Path("/proc/self/statm")
    if statm.exists():
        return int(statm.read_text().split()[1]) * resource.getpagesize()
    unit = 1 if sys.platform == "darwin" else 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit


def startup() -> dict[str, float]:
    """Measure the time of imports, first environment and first resets, s."""
    times = [time.perf_counter()]

    def split() -> float:
        times.append(time.perf_counter())
        return times[-1] - times[-2]

    import gymnasium  # noqa: F401
    import pettingzoo  # noqa: F401

    libraries = split()
    import rsoccer

    results = {"libraries": libraries, "import": split()}
    rsoccer.parallel_env(TASK).reset(seed=0)
    results["reset"] = split()
    matches = rsoccer.Matches(TASK, worlds=WORLDS)
    results["build"] = split()
    matches.reset()
    results["begin"] = split()
    return results


if __name__ == "__main__":
    main()
