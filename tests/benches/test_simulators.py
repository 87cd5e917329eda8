from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from benches import simulators
from benches.games import CROWD, RANDOM, Game
from benches.measuring import SPEED
from benches.simulators import ENOUGH, TOUCHING, Old, Ours, Player, bout, expect_contacts
from rsoccer import Frame, WorldRng
from rsoccer.compat import robosim
from rsoccer.frame import Floats

SHORT = [replace(game, episode=40) for game in (RANDOM[0], RANDOM[2])]


@pytest.mark.parametrize("game", [*RANDOM, *CROWD], ids=lambda game: game.name)
def test_both_interfaces_start_and_see_alike(game: Game) -> None:
    start = game.start(WorldRng.seeded(5, 1))
    ours, old = Ours(game, 1), Old(game, robosim)
    for player in (ours, old):
        player.place(start)
    for one, other in zip(ours.seen(), old.seen(), strict=True):
        np.testing.assert_allclose(one, other, atol=1e-5)


@pytest.mark.parametrize("game", SHORT, ids=lambda game: game.name)
def test_both_are_told_the_same(game: Game) -> None:
    columns = len(game.config.command_columns)
    commands = np.zeros((1, game.config.n_robots, columns), np.float32)
    commands[..., 0] = 1.0
    commands[..., 1] = 1.0 if game.on_wheels else 0.0
    players: tuple[Player, ...] = (Ours(game, 1), Old(game, robosim))
    start = game.start(WorldRng.seeded(5, 1))
    moved = []
    for player in players:
        player.place(start)
        for _ in range(20):
            player.step(player.prepared(commands))
        moved.append(player.seen().robots[0] - start.robots.position[0])
    assert np.abs(moved[0]).max() > 0.01
    ahead = [(way * start.robots.heading[0]).sum(axis=-1) for way in moved]
    assert np.median(ahead[0]) > 0.01
    assert np.median(ahead[1]) == pytest.approx(np.median(ahead[0]), rel=0.3)


@pytest.mark.parametrize("game", SHORT, ids=lambda game: game.name)
def test_a_bout_is_measured(game: Game) -> None:
    for measure in (
        bout(game, partial(Ours, game, 3), 3),
        bout(game, partial(Old, game, robosim)),
    ):
        assert measure(0.0) == {}
        values = measure(1e-6)
        assert list(values) == [SPEED, TOUCHING]
        assert values[SPEED] > 0


class Noting(Ours):
    """Notes where its robots are placed."""

    def __init__(self, game: Game, worlds: int, placed: list[Floats]) -> None:
        super().__init__(game, worlds)
        self.placed = placed

    def place(self, start: Frame) -> None:
        self.placed.extend(start.robots.position)
        super().place(start)


def test_one_match_after_the_other_has_the_starts_of_many(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(simulators, "play", lambda *_: (1.0, [0.5]))  # a second each
    game, one, many = RANDOM[0], list[Floats](), list[Floats]()
    singly = bout(game, lambda: Noting(game, 1, one), starts=3)
    at_once = bout(game, lambda: Noting(game, 3, many), 3)
    for _ in range(2):
        singly(4.0)
        at_once(2.0)
    first, second = np.array(many[:6]), np.array(many[6:])
    np.testing.assert_array_equal(one, [*first[:4], *second[:4]])
    np.testing.assert_array_equal(first[:3], first[3:])
    assert len(np.unique(many, axis=0)) == 6, "every round has starts of its own"


def test_a_crowd_touches() -> None:
    game = replace(CROWD[0], episode=80)
    values = bout(game, partial(Ours, game, 2), 2)(1e-6)
    assert values[TOUCHING] > 0.3


def test_a_scene_without_contacts_is_refused() -> None:
    game = replace(CROWD[4], episode=2)
    with pytest.raises(RuntimeError, match=r"SSL 11 v 11 crowd: only 0\.0% of the robots"):
        bout(game, partial(Ours, game, 1))(1e-6)
    expect_contacts(RANDOM[0], 0.0, ENOUGH - 1)
    with pytest.raises(RuntimeError, match="VSSS 3 v 3 random"):
        expect_contacts(RANDOM[0], 0.0, ENOUGH)
