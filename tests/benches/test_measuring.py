import pytest

from benches.measuring import (
    RATIO,
    SPEED,
    Contest,
    Entrant,
    LeftOut,
    Measure,
    Quantity,
    Values,
    calls,
    chosen,
    measure,
)

LOAD = Quantity("load", "share")


class Told:
    """Says what it was told to, a value a round, and notes its turns."""

    def __init__(self, name: str, values: list[float], turns: list[str]) -> None:
        self.name, self.values, self.turns = name, values, turns

    def __call__(self, seconds: float) -> Values:
        if seconds:
            self.turns.append(self.name)
            return {SPEED: self.values.pop(0), LOAD: 0.5}
        return {}

    def start(self) -> Measure:
        return self


def contest(turns: list[str]) -> Contest:
    fast, slow = Told("fast", [10, 40, 60], turns), Told("slow", [5, 10, 20], turns)
    entrants = (Entrant("fast", 4, 1, fast.start), Entrant("slow", 1, 1, slow.start))
    return Contest("core", "game", entrants, ((0, 1),))


def test_ratios_are_taken_within_a_round() -> None:
    figures = measure([contest([])], 3, 0.1, lambda _: None)
    found = {(f.who, f.quantity): (f.median, f.least, f.most) for f in figures}
    assert found == {
        ("fast", SPEED.name): (40, 10, 60),
        ("fast", LOAD.name): (0.5, 0.5, 0.5),
        ("slow", SPEED.name): (10, 5, 20),
        ("slow", LOAD.name): (0.5, 0.5, 0.5),
        ("fast / slow", RATIO.name): (3, 2, 4),
    }
    [ratio] = [figure for figure in figures if figure.unit == "x"]
    assert (ratio.group, ratio.game, ratio.worlds, ratio.rounds) == ("core", "game", 4, 3)


def test_every_second_round_goes_backward() -> None:
    turns: list[str] = []
    measure([contest(turns)], 3, 0.1, lambda _: None)
    assert turns == ["fast", "slow", "slow", "fast", "fast", "slow"]


def test_what_goes_on_is_told() -> None:
    heard: list[str] = []
    measure([contest([])], 2, 0.1, heard.append)
    assert heard == [
        *("getting ready, core: game", "round 1 of 2, core: game", "round 2 of 2, core: game"),
    ]


def test_what_a_machine_cannot_hold_is_left_out() -> None:
    def start() -> Measure:
        raise LeftOut("too little memory")

    heard: list[str] = []
    huge = Contest("hosting", "game", (Entrant("huge", 9, 1, start),))
    figures = measure([huge, contest([])], 1, 0.1, heard.append)
    assert {figure.group for figure in figures} == {"core"}
    assert "left out, hosting: game: too little memory" in heard


def test_contests_are_chosen_by_their_titles() -> None:
    one, other = contest([]), Contest("memory", "Game", ())
    assert chosen([one, other], "CORE") == [one]
    assert chosen([one, other], "game") == [one, other]
    with pytest.raises(ValueError, match=r"(?s)'nobody' in its title.*core: game.*memory: Game"):
        chosen([one, other], "nobody")


def test_one_call_at_least_is_measured() -> None:
    made: list[int] = []
    assert calls(lambda: made.append(1), 0.0) > 0
    assert len(made) == 1
