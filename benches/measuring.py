"""Measuring by rounds: everything is measured once a round, and what is compared, side by side.

A busy moment of the machine then hits all alike. Absolute figures are medians over the rounds; a
ratio is taken within each round first, so that a machine that speeds up or slows down over the run
does not enter it.
"""

import statistics
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final, NamedTuple

from benches.table import Figure


class Quantity(NamedTuple):
    """What a number says."""

    name: str
    unit: str


SPEED: Final = Quantity("speed", "world-steps/s")
RATIO: Final = Quantity("ratio", "x")

Values = dict[Quantity, float]  # the first is what ratios are taken of
Measure = Callable[[float], Values]  # measures for about so many seconds; 0 is a warm-up


@dataclass(frozen=True)
class Entrant:
    """One of those that do the same work."""

    who: str
    worlds: int
    threads: int
    start: Callable[[], Measure]


@dataclass(frozen=True)
class Contest:
    """Work, who does it, and which of them are compared: the first of a pair by the second."""

    group: str
    game: str
    entrants: tuple[Entrant, ...]
    pairs: tuple[tuple[int, int], ...] = ()

    @property
    def title(self) -> str:
        """By which it can be chosen."""
        return f"{self.group}: {self.game}"


class LeftOut(Exception):
    """Why this machine cannot measure something."""


Rounds = list[list[Values]]  # (rounds, entrants)


def measure(
    contests: Sequence[Contest], rounds: int, seconds: float, tell: Callable[[str], None]
) -> list[Figure]:
    """Figures of all contests. `tell` hears what is going on."""
    fields = list(ready(contests, tell))
    played: list[Rounds] = [[] for _ in fields]
    for n in range(rounds):
        for (contest, measures), seen in zip(fields, played, strict=True):
            tell(f"round {n + 1} of {rounds}, {contest.title}")
            seen.append(play_round(measures, seconds, backward=n % 2 == 1))
    pairs = zip(fields, played, strict=True)
    return [figure for (contest, _), seen in pairs for figure in summary(contest, seen)]


def ready(
    contests: Sequence[Contest], tell: Callable[[str], None]
) -> Iterator[tuple[Contest, list[Measure]]]:
    """Contests that this machine can hold, their entrants warmed up."""
    for contest in contests:
        tell(f"getting ready, {contest.title}")
        try:
            measures = [entrant.start() for entrant in contest.entrants]
        except LeftOut as reason:
            tell(f"left out, {contest.title}: {reason}")
            continue
        for warm_up in measures:
            warm_up(0.0)
        yield contest, measures


def play_round(measures: Sequence[Measure], seconds: float, *, backward: bool) -> list[Values]:
    """What each measures, in the order given; every second round is measured from the back."""
    order = range(len(measures))
    values = {i: measures[i](seconds) for i in (reversed(order) if backward else order)}
    return [values[i] for i in order]


def summary(contest: Contest, played: Rounds) -> Iterator[Figure]:
    """Medians of what was measured, and of the ratios."""
    for i, entrant in enumerate(contest.entrants):
        for quantity in played[0][i]:
            values = [values[i][quantity] for values in played]
            yield figure(contest, entrant, entrant.who, quantity, values)
    for one, other in contest.pairs:
        entrant, by = contest.entrants[one], contest.entrants[other]
        ratios = [_first(values[one]) / _first(values[other]) for values in played]
        yield figure(contest, entrant, f"{entrant.who} / {by.who}", RATIO, ratios)


def figure(
    contest: Contest, entrant: Entrant, who: str, quantity: Quantity, values: Sequence[float]
) -> Figure:
    """The median of some rounds, with its extremes."""
    return Figure(
        group=contest.group,
        game=contest.game,
        who=who,
        worlds=entrant.worlds,
        threads=entrant.threads,
        quantity=quantity.name,
        unit=quantity.unit,
        median=statistics.median(values),
        least=min(values),
        most=max(values),
        rounds=len(values),
    )


def calls(step: Callable[[], object], seconds: float) -> float:
    """Calls per second; one call at least."""
    made, start, spent = 0, time.perf_counter(), 0.0
    while not made or spent < seconds:
        step()
        made += 1
        spent = time.perf_counter() - start
    return made / spent


def repeated(step: Callable[[], object], worlds: int) -> Measure:
    """World-steps per second of what steps so many worlds in one call."""
    return lambda seconds: {SPEED: worlds * calls(step, seconds)}


def chosen(contests: Iterable[Contest], pattern: str) -> list[Contest]:
    """Those whose title has the pattern in it, whatever the case; ValueError if none has."""
    listed = list(contests)
    found = [contest for contest in listed if pattern.lower() in contest.title.lower()]
    if not found:
        titles = "\n  ".join(contest.title for contest in listed)
        raise ValueError(f"nothing to measure has {pattern!r} in its title:\n  {titles}")
    return found


def _first(values: Values) -> float:
    return next(iter(values.values()))
