"""Advantages against values computed by hand."""

import pytest
import torch
from torch import Tensor

from rsoccer.train.ppo.gae import compute_gae

GAMMA, LAMBDA = 0.5, 0.8


def column(*values: float) -> Tensor:
    return torch.tensor(values).reshape(-1, 1)


def advantages_of(terminated: Tensor, ended: Tensor) -> list[float]:
    advantages = compute_gae(
        rewards=column(1.0, 2.0, 4.0),
        values=column(10.0, 20.0, 30.0),
        next_values=column(20.0, 50.0, 60.0),
        terminated=terminated.bool(),
        ended=ended.bool(),
        gamma=GAMMA,
        gae_lambda=LAMBDA,
    )
    return [float(value) for value in advantages[:, 0]]


def test_later_deltas_are_discounted_where_no_episode_ends() -> None:
    # Deltas: 1 + 10 - 10 = 1, 2 + 25 - 20 = 7, 4 + 30 - 30 = 4; gamma x lambda is 0.4.
    assert advantages_of(column(0, 0, 0), column(0, 0, 0)) == pytest.approx([4.44, 8.6, 4.0])


def test_a_truncated_episode_bootstraps_its_value() -> None:
    # The second is truncated: 2 + 0.5 * 50 - 20 = 7, and no later delta counts before the end.
    assert advantages_of(column(0, 0, 0), column(0, 1, 0)) == pytest.approx([3.8, 7.0, 4.0])


def test_a_terminated_episode_has_no_future_value() -> None:
    # The second ends by a goal: 2 - 20 = -18, whatever the next value is.
    assert advantages_of(column(0, 1, 0), column(0, 1, 0)) == pytest.approx([-6.2, -18.0, 4.0])


def test_robots_do_not_mix() -> None:
    same = torch.tensor([[1.0, 5.0], [2.0, 6.0]])
    both = compute_gae(
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
