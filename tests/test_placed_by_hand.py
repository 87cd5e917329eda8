import numpy as np
import pytest

from rsoccer import Frame, Matches, Simulator, make_task
from rsoccer.arrays import Floats, Mask
from rsoccer.completed import CompletedStepper
from rsoccer.placed_by_hand import PlacedByHand, Placement, ReadableStepper
from tests.helpers import same, zeros


class Robots:
    """Robots that cannot place anything; a hand moves them in `simulator`."""

    def __init__(self, simulator: Simulator) -> None:
        self.simulator = simulator
        self.closed = False

    def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> None:
        self.simulator.step(commands, out, active)

    def read(self, out: Floats) -> None:
        self.simulator.read(out)

    def close(self) -> None:
        self.closed = True


def with_hand(
    robots: Robots, asked: list[Placement], stepper: ReadableStepper | None = None
) -> PlacedByHand:
    """A hand that places what it is asked to, one centimeter beside."""

    def ask(placement: Placement) -> None:
        asked.append(placement)
        rows = placement.rows.copy()
        rows[:, 0] += 0.01
        robots.simulator.place(placement.worlds, rows, np.empty((1, rows.shape[1]), np.float32))

    return PlacedByHand(stepper or robots, ask)


@pytest.mark.parametrize("completed", [False, True])
def test_a_rule_restarts_play_by_hand(completed: bool) -> None:
    task = make_task("SSLSelfPlay-v0", n_blue=1, n_yellow=1)
    robots, asked = Robots(Simulator(task.config)), list[Placement]()
    layer = CompletedStepper(robots, task.config) if completed else None
    hand = with_hand(robots, asked, layer)
    matches = Matches(task, controllers={"all": "zero"}, simulator=hand)
    frame = Frame.empty(1, 1, 1)
    frame.robots.position[0] = [(-1.0, 0.0), (1.0, 0.0)]
    frame.ball.position[0] = 0.0, task.config.field.half_width - 0.01
    frame.ball.velocity[0] = 0.0, 2.0
    matches.reset(rows=frame.rows)
    assert not asked[0].ball_only
    assert matches.frame.ball.position[0, 0] == pytest.approx(0.01), "where the hand put it"
    for _ in range(3):
        matches.step(zeros(matches))
    assert len(asked) == 2
    assert asked[1].ball_only
    assert asked[1].worlds.tolist() == [True]
    x, y = asked[1].rows[0, :2].tolist()
    assert matches.frame.ball.position[0] == pytest.approx([x + 0.01, y], abs=1e-3)
    matches.close()
    assert robots.closed


def test_play_may_go_on_as_it_is() -> None:
    task = make_task("VSSSelfPlay-v0")
    simulator = Simulator(task.config)
    start = task.get_initial_positions_frame(Matches(task).play.rng).rows
    simulator.place(np.ones(1, np.bool_), start, np.empty_like(start))
    matches = Matches(task, simulator=PlacedByHand(Robots(simulator), lambda placement: None))
    matches.reset()
    assert same(matches.frame.rows, start)


def test_parameters_are_refused() -> None:
    task = make_task("VSSSelfPlay-v0")
    hand = PlacedByHand(Robots(Simulator(task.config)), lambda placement: None)
    rows = np.zeros((1, task.config.row_size), np.float32)
    parameters = np.ones((1, task.config.parameters_size), np.float32)
    with pytest.raises(ValueError, match="parameters: expected None"):
        hand.place(np.ones(1, np.bool_), rows, rows, parameters)
