"""What decisions were worth, against numbers worked out by hand."""

import pytest
import torch
from torch import Tensor

from rsoccer.train.trainer import advantages

GAMMA, LAMBDA = 0.5, 0.8


def column(*values: float) -> Tensor:
    return torch.tensor(values).reshape(-1, 1)


def worth(terminated: Tensor, ended: Tensor) -> list[float]:
    result = advantages(
        rewards=column(1.0, 2.0, 4.0),
        values=column(10.0, 20.0, 30.0),
        next_values=column(20.0, 50.0, 60.0),
        terminated=terminated.bool(),
        ended=ended.bool(),
        gamma=GAMMA,
        gae_lambda=LAMBDA,
    )
    return [float(value) for value in result[:, 0]]


def test_without_an_end_later_surprises_count_less_and_less() -> None:
    # Surprises: 1 + 10 - 10 = 1, 2 + 25 - 20 = 7, 4 + 30 - 30 = 4; each passes on 0.4.
    assert worth(column(0, 0, 0), column(0, 0, 0)) == pytest.approx([4.44, 8.6, 4.0])


def test_a_time_limit_counts_what_could_have_come() -> None:
    # The second ends by the clock: 2 + 0.5 * 50 - 20 = 7, and nothing passes back over the end.
    assert worth(column(0, 0, 0), column(0, 1, 0)) == pytest.approx([3.8, 7.0, 4.0])


def test_a_goal_is_the_end() -> None:
    # The second ends by a goal: 2 - 20 = -18, whatever the network expects to come.
    assert worth(column(0, 1, 0), column(0, 1, 0)) == pytest.approx([-6.2, -18.0, 4.0])


def test_robots_do_not_mix() -> None:
    same = torch.tensor([[1.0, 5.0], [2.0, 6.0]])
    both = advantages(
        rewards=same,
        values=same,
        next_values=same,
        terminated=torch.tensor([[False, True], [False, False]]),
        ended=torch.tensor([[False, True], [False, False]]),
        gamma=GAMMA,
        gae_lambda=LAMBDA,
    )
    # First robot: 1 + .5 - 1 = .5 and 2 + 1 - 2 = 1; second: 5 - 5 = 0 and 6 + 3 - 6 = 3.
    torch.testing.assert_close(both, torch.tensor([[0.9, 0.0], [1.0, 3.0]]))
