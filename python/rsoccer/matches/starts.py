"""Beginnings of episodes and restarts of play, with steppers that place bodies and that do not."""

import numpy as np

from rsoccer.arrays import Doubles, Floats, Mask
from rsoccer.simulator_interface import Stepper, placer_of, reader_of


class Starts:
    """The ways in which episodes begin and play restarts with a stepper."""

    def __init__(self, stepper: Stepper) -> None:
        """Choose the ways.

        Args:
            stepper: a `Placer`, or else a `Reader`.

        Raises:
            TypeError: it is neither.
        """
        self._placer, self._reader = placer_of(stepper), reader_of(stepper)
        self._name = type(stepper).__name__
        if self._placer is None and self._reader is None:
            raise TypeError(
                "simulator: expected one that can place bodies (place, restart, "
                f"reposition_balls) or read its state (read), got {self._name} with neither"
            )

    @property
    def can_place(self) -> bool:
        """True if bodies can be put anywhere; else episodes begin with the state as it is."""
        return self._placer is not None

    def check_rows(self) -> None:
        """Refuse initial states that are given from outside.

        Raises:
            ValueError: bodies cannot be placed.
        """
        if self._placer is None:
            raise ValueError(
                f"rows: {self._name} cannot place bodies, so episodes begin with the state as it "
                "is; expected None"
            )

    def check_parameters(self) -> None:
        """Refuse factors on the models' numbers, which are given where bodies are placed.

        Raises:
            ValueError: bodies cannot be placed.
        """
        if self._placer is None:
            raise ValueError(
                f"randomization: {self._name} cannot place bodies, so robots and ball have their "
                "own numbers; expected none of them"
            )

    def begin(
        self, worlds: Mask, rows: Floats | None, out: Floats, parameters: Floats | None = None
    ) -> Doubles | None:
        """Begin episodes in some worlds.

        Args:
            worlds: (n,) bool, k of them True.
            rows: (k, row) initial states; None for the state as it is.
            out: (n, row) output; the rows of the k worlds are overwritten.
            parameters: (k, parameter) factors on the models' numbers in these worlds; None for the
                simulator's own.

        Returns:
            Time stamps, or None.

        Raises:
            ValueError: a state that is not finite. Nothing has changed.
        """
        if self._placer is not None and rows is not None:
            if parameters is None:
                return self._placer.place(worlds, rows, out)
            return self._placer.place(worlds, rows, out, parameters)
        assert self._reader is not None, "the constructor has checked it"
        present = np.empty_like(out)
        times = self._reader.read(present)
        if not np.isfinite(present[worlds]).all():
            raise ValueError(f"{self._name}.read: expected finite numbers")
        out[worlds] = present[worlds]
        return times

    def restart(
        self, worlds: Mask, rows: Floats | None, balls: Floats | None, out: Floats
    ) -> Doubles | None:
        """Restart play in some worlds.

        Args:
            worlds: (n,) bool, k of them True.
            rows: (k, row) new states of all bodies, or None.
            balls: (k, ball column) new states of the balls, or None.
            out: (n, row) output; the rows of the k worlds are overwritten.

        Returns:
            Time stamps, or None.

        Raises:
            RuntimeError: bodies cannot be placed.
        """
        if self._placer is None:
            raise RuntimeError(
                f"a rule restarts play in worlds {np.flatnonzero(worlds).tolist()}, but "
                f"{self._name} cannot place bodies; rsoccer.placed_by_hand.PlacedByHand asks "
                "people, or code of yours, to place them"
            )
        if balls is not None:
            return self._placer.reposition_balls(worlds, balls, out)
        assert rows is not None, "a restart has rows or balls"
        return self._placer.restart(worlds, rows, out)
