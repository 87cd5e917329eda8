from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from benches.games import CROWD, RANDOM, Game
from benches.measuring import SPEED
from benches.simulators import ENOUGH, TOUCHING, Old, Ours, Player, bout, expect_contacts
from rsoccer import WorldRng
from rsoccer.compat import robosim

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
