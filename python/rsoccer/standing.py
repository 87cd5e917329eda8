"""Worlds that stand still while the others of their matches are stepped."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rsoccer.controllers import Crew
from rsoccer.frame import Floats
from rsoccer.outcome import Outcome
from rsoccer.play import Play


class Standing:
    """Some worlds of matches as they are now, to be as they were after the others' step."""

    def __init__(
        self, worlds: NDArray[np.intp], play: Play, crews: Sequence[Crew], observations: Floats
    ) -> None:
        """Copy all that a step may change in `worlds`; the rest is where it will be put back."""
        self._worlds, self._play, self._crews = worlds, play, crews
        self._held = play.take(worlds)
        self._crews_held = [crew.hold(worlds) for crew in crews]
        self._seen = observations[worlds]

    def release(self, observations: Floats, outcome: Outcome) -> None:
        """The worlds are as they were, and nothing happened in them."""
        observations[self._worlds] = self._seen
        self._play.put(self._worlds, self._held)
        for crew, held in zip(self._crews, self._crews_held, strict=True):
            crew.put(self._worlds, held)
        for array in (outcome.rewards, outcome.terminated, outcome.truncated):
            array[self._worlds] = 0
        for term in outcome.terms.values():
            term[self._worlds] = 0.0
