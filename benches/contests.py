"""All that is measured, and what is compared with what."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from importlib.util import find_spec
from itertools import product

import rsoccer
from benches import doors, fresh, sharing
from benches.empty import EmptyEnv, EmptyParallelEnv
from benches.games import GAMES, Game
from benches.measuring import Contest, Entrant, Measure
from benches.peers import named, peer, silent, vmas_football
from benches.simulators import Old, Ours, bout
from benches.training import training
from rsoccer.compat import robosim as compat

TEAMS_TASK = "VSSSelfPlay-v0"
LONE_TASK = "SSLGoToBall-v0"


@dataclass(frozen=True)
class Sizes:
    """How many worlds; tests take fewer."""

    batch: int = 64
    """In the games that are played beside the old simulator."""
    many: tuple[int, ...] = (1024, 8192)
    shared: int = 1024
    """Over one thread and two."""
    growing: tuple[int, ...] = (64, 256, 1024, 4096, 16384)
    football: tuple[int, ...] = (32, 1024, 8192)
    trained: int = 256
    weighed: int = 2048
    hosted: int = 100_000
    """On one machine at once."""


def contests(sizes: Sizes) -> Iterator[Contest]:
    """Everything, in the order of the table."""
    yield from (core(game, sizes.batch) for game in GAMES)
    yield threads(GAMES[0], sizes.shared)
    yield growth(GAMES[0], sizes.growing)
    yield many(sizes)
    yield lone_teams()
    yield lone_robot(sizes.many[0])
    if find_spec("torch"):
        train = partial(training, TEAMS_TASK, sizes.trained, 2)
        yield Contest("training", TEAMS_TASK, (Entrant("trainer", sizes.trained, 2, train),))
    for game, worlds in ((GAMES[0], sizes.weighed), (GAMES[4], sizes.weighed // 4)):
        weigh = partial(fresh.memory, game, worlds)
        yield Contest("memory", game.teams, (Entrant("Simulator", worlds, 1, weigh),))
    yield hosting(GAMES[0], sizes.hosted, 2)
    yield Contest("start", TEAMS_TASK, (Entrant("fresh process", 1, 1, lambda: fresh.start),))


def core(game: Game, batch: int) -> Contest:
    """The physics alone, beside the old simulator where that is installed.

    Who plays one match at a time plays those of the batch, one after the other.
    """
    one = partial(bout, game, starts=batch)
    entrants = [
        Entrant("Simulator", 1, 1, partial(one, partial(Ours, game, 1))),
        Entrant("Simulator", batch, 1, partial(bout, game, partial(Ours, game, batch), batch)),
        Entrant("compat.robosim", 1, 1, partial(one, partial(Old, game, compat))),
    ]
    if (old := peer("robosim")) is None:
        return Contest("core", game.name, tuple(entrants))
    ours, theirs = range(len(entrants)), len(entrants)
    start = partial(quiet, partial(one, partial(Old, game, old)))
    entrants.append(Entrant(named("robosim"), 1, 1, start))
    return Contest("core", game.name, tuple(entrants), tuple((i, theirs) for i in ours))


def quiet(start: Callable[[], Measure]) -> Measure:
    """An entrant that would otherwise print."""
    return silent(start())


def threads(game: Game, worlds: int) -> Contest:
    """A second thread: inside a simulator, with a simulator of its own, and merely computing."""
    entrants = []
    for number in (1, 2):
        step = partial(sharing.stepping, game, worlds, number)
        beside = partial(sharing.side_by_side, game, worlds, number)
        hashes = partial(sharing.hashing, number)
        entrants += [
            Entrant("Simulator", worlds, number, step),
            Entrant("Simulators, one a thread", worlds, number, beside),
            Entrant("hashing", 1, number, hashes),
        ]
    return Contest("threads", game.name, tuple(entrants), ((3, 0), (4, 1), (5, 2)))


def growth(game: Game, worlds: tuple[int, ...]) -> Contest:
    """Few worlds and many, as fast as each other if they do not get in each other's way."""
    entrants = [Entrant("Simulator", n, 1, partial(sharing.stepping, game, n, 1)) for n in worlds]
    return Contest(
        "growth", game.name, tuple(entrants), tuple((i, 0) for i in range(1, len(worlds)))
    )


def hosting(game: Game, worlds: int, threads: int) -> Contest:
    """Very many worlds on one machine, in a process of their own."""
    host = partial(fresh.hosting, game, worlds, threads)
    return Contest("hosting", game.name, (Entrant("Simulator", worlds, threads, host),))


def many(sizes: Sizes) -> Contest:
    """Many matches as arrays, beside VMAS' football of the same teams."""
    entrants = [
        Entrant("Matches", worlds, number, partial(doors.matches, TEAMS_TASK, worlds, number))
        for worlds, number in product(sizes.many, (1, 2))
    ]
    places, pairs = {(e.worlds, e.threads): i for i, e in enumerate(entrants)}, []
    if (vmas := peer("vmas")) is not None:
        # Torch's second thread may slow it down, so ours on two are compared with either.
        for worlds, number in product(sizes.football, (1, 2)):
            if (worlds, 2) in places:
                pairs.append((places[worlds, 2], len(entrants)))
            play = partial(vmas_football, vmas, worlds, number)
            entrants.append(Entrant(named("vmas"), worlds, number, play))
    return Contest("many", TEAMS_TASK, tuple(entrants), tuple(pairs))


def lone_teams() -> Contest:
    """One match through PettingZoo, beside an env that does nothing."""
    env = partial(rsoccer.parallel_env, TEAMS_TASK)
    entrants = (
        Entrant("ParallelEnv", 1, 1, lambda: doors.parallel(env())),
        Entrant("AECEnv", 1, 1, lambda: doors.aec(rsoccer.env(TEAMS_TASK))),
        Entrant("empty ParallelEnv", 1, 1, lambda: doors.parallel(EmptyParallelEnv(env()))),
    )
    return Contest("one", TEAMS_TASK, entrants, ((0, 2),))


def lone_robot(envs: int) -> Contest:
    """One robot through Gymnasium, beside an env that does nothing; and many of them."""
    env, vector = partial(rsoccer.single_env, LONE_TASK), partial(rsoccer.vector_env, LONE_TASK)
    entrants = (
        Entrant("Env", 1, 1, lambda: doors.single(env())),
        Entrant("empty Env", 1, 1, lambda: doors.single(EmptyEnv(env()))),
        Entrant("VectorEnv", envs, 1, lambda: doors.vector(vector(envs))),
        Entrant("VectorEnv", envs, 2, lambda: doors.vector(vector(envs, threads=2))),
    )
    return Contest("one", LONE_TASK, entrants, ((0, 1),))
