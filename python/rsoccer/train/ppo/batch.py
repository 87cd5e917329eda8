"""Samples for updates of the networks."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import torch
from torch import Tensor


@dataclass
class Batch:
    """Samples of one rollout; size is horizon x worlds x agents."""

    observations: Tensor
    """(size, o) normalized observations."""
    actions: Tensor
    """(size, action) drawn actions, not clipped."""
    log_probs: Tensor
    """(size,) log densities of the actions under the policy that drew them."""
    advantages: Tensor
    """(size,) advantages from GAE, in scaled rewards."""
    returns: Tensor
    """(size,) targets of the value network: advantages + values."""
    central_inputs: Tensor | None = None
    """(size, s + o) inputs of a centralized critic; None if the critic reads the observations."""
    weights: Tensor | None = None
    """(size,) weights of the samples in the loss of the policy; None for equal ones."""

    @property
    def critic_inputs(self) -> Tensor:
        """Inputs of the value network."""
        return self.observations if self.central_inputs is None else self.central_inputs

    def __len__(self) -> int:
        """Return the number of samples."""
        return len(self.returns)

    def select(self, indices: Tensor) -> Batch:
        """Return a minibatch of some samples.

        Args:
            indices: (k,) indices of the samples.
        """
        return self._map(lambda part: part.index_select(0, indices))

    def to(self, device: torch.device) -> Batch:
        """Return the samples on a device, without copying if they are there.

        Args:
            device: device of the tensors.
        """
        return self._map(lambda part: part.to(device))

    def chunk(self, n: int) -> Iterator[Batch]:
        """Return at most n consecutive parts, without copying.

        Their size is that of an n-th of the batch, rounded up; the last one may be smaller.

        Args:
            n: greatest number of parts.
        """
        names, parts = zip(*self.parts().items(), strict=True)
        for chunk in zip(*(part.chunk(n) for part in parts), strict=True):
            yield Batch(**dict(zip(names, chunk, strict=True)))

    def parts(self) -> dict[str, Tensor]:
        """Return the tensors by name, without those that are None."""
        return {name: part for name, part in vars(self).items() if part is not None}

    def _map(self, function: Callable[[Tensor], Tensor]) -> Batch:
        """The batch with a function applied to each tensor."""
        return Batch(**{name: function(part) for name, part in self.parts().items()})
