"""Results of a tournament as data."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Standing:
    """Results of one policy in a tournament."""

    policy: str
    """name or file of the policy, or its class"""
    label: str
    """short name, different from all others; never a name of the package for a file"""
    rating: float
    """Bradley-Terry rating on the Elo scale"""
    low: float | None
    """lower bound of the rating's 95% bootstrap interval; None with fewer than 20 matches between
    each two policies, which are too few for one"""
    high: float | None
    """upper bound of the rating's interval, or None; both bounds are the rating if all matches of
    each pair end alike"""
    wins: int
    """matches won"""
    draws: int
    """matches drawn"""
    losses: int
    """matches lost"""
    score: float
    """(wins - losses) / matches, from -1 to 1"""


@dataclass(frozen=True)
class Standings:
    """All numbers of a tournament."""

    task: str
    """name of the task"""
    seed: int
    """seed of the tournament"""
    matches: int
    """matches between each two policies"""
    anchor: str | None
    """label of the policy whose rating is 1000; None if the mean of all ratings is"""
    standings: tuple[Standing, ...]
    """results of each policy, best rating first"""
    scores: tuple[tuple[float, ...], ...]
    """goal score of the row against the column, in the order of the standings"""
    low: tuple[tuple[float, ...], ...] | None
    """lower bounds of the scores' 95% bootstrap intervals; None with fewer than 20 matches"""
    high: tuple[tuple[float, ...], ...] | None
    """upper bounds of the scores' intervals, or None"""
    cycles: tuple[tuple[str, ...], ...]
    """labels of policies of which each beats the next, and the last the first: the lower bounds of
    these scores are above 0. None are named without intervals"""
