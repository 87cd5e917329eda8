"""Adam: steps equal those of torch, also after a restore."""

import torch

from rsoccer.train.ppo.adam import BETA_1, BETA_2, EPSILON, Adam


def test_steps_equal_those_of_torch_also_after_a_restore() -> None:
    generator = torch.Generator().manual_seed(0)
    vector = torch.randn(50, generator=generator)
    expected = torch.nn.Parameter(vector.clone())
    theirs = torch.optim.Adam([expected], betas=(BETA_1, BETA_2), eps=EPSILON)
    ours = Adam(vector)
    for step in range(8):
        if step == 4:
            saved, ours = ours.state_dict(), Adam(vector)
            assert saved["steps"] == 4
            ours.load_state_dict(saved)
        gradient = torch.randn(50, generator=generator) * 10.0 ** (step % 3)
        theirs.param_groups[0]["lr"] = learning_rate = 0.1 / (step + 1)
        expected.grad = gradient
        theirs.step()
        ours.step(gradient, learning_rate)
        torch.testing.assert_close(vector, expected.detach())
