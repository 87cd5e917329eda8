"""Who drives each robot: learners from outside, policies from within."""

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rsoccer import checks, policies
from rsoccer.frame import Floats
from rsoccer.policies.base import Memory, Policy, Seen
from rsoccer.registry import make_task
from rsoccer.rng import WorldRng
from rsoccer.task import LEARN, Learn, Play, Task
from rsoccer.view import SIDES

Controller = str | Policy | Learn
Controllers = Mapping[str, Controller]
Seats = slice | NDArray[np.intp]
DEFAULT_TASK = "VSSSelfPlay-v0"  # what scripts play if nobody says
DRIFT = "ou"  # who drives the other team where both learn and nobody is named
CrewState = tuple[WorldRng, Memory]


@dataclass
class Crew:
    """The robots that one policy drives, and what it needs to do so."""

    name: str  # of its first robot: what its random streams are split by
    policy: Policy
    robots: NDArray[np.intp]  # (k,) which robots
    seats: Seats  # (k,) their places among the seers, if it observes
    rng: WorldRng  # (n,) streams of its own
    memory: Memory  # (n, ...)

    def act(self, play: Play, observations: Floats, actions: Floats) -> None:
        """Write what its robots do into `actions` (n, robots, action)."""
        shape = (len(actions), len(self.robots), actions.shape[2])
        view = seen = None
        if self.policy.observes != "nothing":
            view = play.view.select(self.seats)
        if self.policy.observes == "observation":
            seen = observations[:, self.seats]
        chosen = self.policy.act(Seen(shape, view, seen), self.rng, self.memory)
        if chosen.shape != shape:
            raise ValueError(
                f"{type(self.policy).__name__}: expected actions {shape}, got {chosen.shape}"
            )
        actions[:, self.robots] = np.minimum(np.maximum(chosen, -1.0), 1.0)

    def restart(self, worlds: NDArray[np.intp], rng: WorldRng, action_size: int) -> None:
        """Forget the matches in some worlds; `rng` are their streams from now on."""
        fresh = _fresh(self.policy, (len(worlds), len(self.robots), action_size), rng)
        self.rng.put(worlds, rng)
        for name, array in fresh.items():
            self.memory[name][worlds] = array

    def hold(self, worlds: NDArray[np.intp]) -> CrewState:
        """A copy of what acting may change in some worlds."""
        return self.rng[worlds], {name: array[worlds] for name, array in self.memory.items()}

    def put(self, worlds: NDArray[np.intp], held: CrewState) -> None:
        """Undo what acting has changed in some worlds since `hold`."""
        rng, memory = held
        self.rng.put(worlds, rng)
        for name, array in memory.items():
            self.memory[name][worlds] = array


@dataclass
class Drivers:
    """A driver for every robot: learners, and the crews of all others."""

    learners: NDArray[np.intp]  # (agents,) which robots learn
    learner_seats: Seats  # (agents,) their places among the seers
    seers: NDArray[np.intp]  # (seers,) which robots look, in the order of a row
    crews: list[Crew]


def appoint(task: Task, controllers: Controllers | None, worlds: int) -> Drivers:
    """Give every robot its driver; the crews' streams and memory are yet to be started."""
    chosen = resolve(task, controllers)
    groups: dict[int | str, list[int]] = {}
    found: dict[int | str, Policy] = {}
    learners = []
    for robot, controller in enumerate(chosen.values()):
        if isinstance(controller, Learn):
            learners.append(robot)
            continue
        key = controller if isinstance(controller, str) else id(controller)
        groups.setdefault(key, []).append(robot)
        if key not in found:
            found[key] = policies.make(controller, task)
    looking = [
        robot
        for key, robots in groups.items()
        if found[key].observes != "nothing"
        for robot in robots
    ]
    seers = np.array(sorted(learners + looking), np.intp)
    crews = []
    for key, robots in groups.items():
        rng = WorldRng.seeded(0, worlds)
        memory = _fresh(found[key], (worlds, len(robots), task.action_size), rng)
        seats = _seats(seers, robots)
        name = task.robots[robots[0]]
        crews.append(Crew(name, found[key], np.array(robots, np.intp), seats, rng, memory))
    learned = np.array(learners, np.intp)
    return Drivers(learned, _seats(seers, learners), seers, crews)


def resolve(task: Task, controllers: Controllers | None) -> dict[str, Controller]:
    """A driver for each robot by name: `all`, then a team, then a robot's own name wins."""
    given = given_by_name(controllers)
    valid = ["all", *SIDES, *task.robots]
    unknown = sorted(set(given) - set(valid), key=str)
    if unknown:
        raise ValueError(f"controllers: unknown {unknown}; valid are {valid}")
    chosen: dict[str, Controller] = dict(task.default_controllers())
    for name in chosen:
        team = name.rsplit("_", 1)[0]
        for key in ("all", team, name):
            chosen[name] = given.get(key, chosen[name])
    return {name: _checked(name, controller) for name, controller in chosen.items()}


def given_by_name(controllers: Controllers | None) -> dict[str, Controller]:
    """A copy of the drivers as they were given: nobody by default."""
    if controllers is None:
        return {}
    if not isinstance(controllers, Mapping):
        raise TypeError(
            "controllers: expected a mapping from robots to policies, as in {'blue': 'ou'}, "
            f"got {controllers!r}"
        )
    return dict(controllers)


def task_for(*players: Controller | os.PathLike[str]) -> Task:
    """The task that the first trained one of these was trained on; VSSSelfPlay-v0 if none was."""
    names = (policies.trained_on(who) for who in players if not isinstance(who, Learn))
    return make_task(next(filter(None, names), DEFAULT_TASK))


def lineup(
    task: Task, policy: Controller, opponent: Controller | None = None, side: str | None = None
) -> dict[str, Controller]:
    """A driver for each robot when `policy` takes the part of those that learn.

    Mates that do not learn follow who the task has for them. So does the other team, unless it
    learns too, which `ou` then does for it, or `opponent` is given. With `side` "blue" or "yellow"
    that is the team that has the part, robot for robot.
    """
    home, away = _teams(task)
    own = [policy if driver is LEARN else driver for driver in home.values()]
    foes: list[Controller] = [DRIFT if driver is LEARN else driver for driver in away.values()]
    if opponent is not None:
        if not foes:
            raise ValueError(f"opponent: {task.name} has one team only, so nobody can be it")
        foes = [opponent] * len(foes)
    if side is None or next(iter(home)).startswith(side):
        return {**dict(zip(home, own, strict=True)), **dict(zip(away, foes, strict=True))}
    return {**_in_place_of(home, foes), **_in_place_of(away, own)}


def opponents_of(task: Task) -> list[str]:
    """Names of the policies that the task has for the team that a learner plays against."""
    foes = (DRIFT if isinstance(driver, Learn) else driver for driver in _teams(task)[1].values())
    return list(dict.fromkeys(foes))


def _teams(task: Task) -> tuple[dict[str, str | Learn], dict[str, str | Learn]]:
    """Robots and who the task has for them: the first learner's team, and the other."""
    if not task.agents:
        raise ValueError(f"task: expected one with a robot that learns, {task.name} has none")
    side = task.agents[0].rsplit("_", 1)[0]
    drivers = task.default_controllers()
    home = {robot: drivers[robot] for robot in task.robots if robot.startswith(side)}
    return home, {robot: drivers[robot] for robot in task.robots if robot not in home}


def _in_place_of(
    robots: Mapping[str, object], drivers: Sequence[Controller]
) -> dict[str, Controller]:
    """Another team's drivers, robot for robot; where it is smaller, its last one drives more."""
    return {robot: drivers[min(i, len(drivers) - 1)] for i, robot in enumerate(robots)}


def _checked(name: str, controller: object) -> Controller:
    if not isinstance(controller, str | Policy | Learn):
        raise TypeError(
            f"controllers[{name!r}]: expected {LEARN}, a policy or its name, got {controller!r}"
        )
    return controller


def _seats(seers: NDArray[np.intp], robots: list[int]) -> Seats:
    """Places among the seers; a slice where they are neighbours, which copies nothing."""
    seats = np.searchsorted(seers, robots)
    if (np.diff(seats) == 1).all() and len(seats):
        return slice(int(seats[0]), int(seats[0]) + len(seats))
    return seats


def _fresh(policy: Policy, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
    """What a policy remembers at a start, in arrays of our own."""
    return checks.memory(type(policy).__name__, policy.new_memory(shape, rng), shape[0])
