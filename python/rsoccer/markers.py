"""What a task would draw on the floor, as plain data: pictures show where the play is to go."""

from dataclasses import dataclass

Point = tuple[float, float]


@dataclass(frozen=True)
class Target:
    """A place to be reached. Metres."""

    center: Point
    radius: float


@dataclass(frozen=True)
class Gate:
    """A gap to go through, named as who goes through it sees its ends."""

    left: Point
    right: Point
    done: bool = False


@dataclass(frozen=True)
class Area:
    """A rectangle by its least and its greatest corner."""

    low: Point
    high: Point


@dataclass(frozen=True)
class Way:
    """A straight way from one place to another."""

    start: Point
    end: Point


Marker = Target | Gate | Area | Way
