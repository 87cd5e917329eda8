"""The robots that learn: their part of what is computed for all robots that have a view."""

from collections.abc import Mapping

import numpy as np

from rsoccer._core import Threads
from rsoccer.arrays import Floats
from rsoccer.controllers import Assignment
from rsoccer.matches import result_checks
from rsoccer.task import Task


class Learners:
    """Selection of the learners from arrays (n, observers, ...)."""

    def __init__(self, task: Task, assignment: Assignment) -> None:
        """Prepare the selection.

        Args:
            task: the task that is played, for errors.
            assignment: controllers of all robots.
        """
        self._task, self._indices = task, assignment.learner_indices
        self._learners, self._observers = len(assignment.learners), len(assignment.observers)
        self._all_learn = self._learners == self._observers

    def select(self, array: Floats) -> Floats:
        """Return the learners' part (n, agents, ...), which may be the array itself.

        Args:
            array: (n, observers, ...).
        """
        return array if self._all_learn else array[:, self._indices]

    def copy(self, array: Floats, threads: Threads) -> Floats:
        """Return a copy (n, agents, ...) of the learners' part.

        Args:
            array: (n, observers, ...).
            threads: threads that share the work.
        """
        if not self._all_learn:
            return np.array(self.select(array))
        copied = np.empty_like(array)
        threads.copy(array, copied)
        return copied

    def sum_terms(self, named: Mapping[str, Floats], n: int) -> tuple[dict[str, Floats], Floats]:
        """Return the learners' reward terms and their sum, both in new arrays.

        Args:
            named: weighted terms by name, (n, observers) or (n, 1) for all observers alike.
            n: number of worlds.

        Returns:
            Terms (n, agents) by name, and rewards (n, agents).

        Raises:
            TypeError: a term that is no array.
            ValueError: a term of another shape.
        """
        shape = (n, self._observers)
        terms: dict[str, Floats] = {}
        rewards = np.zeros((n, self._learners), np.float32)
        for name, term in named.items():
            if not isinstance(term, np.ndarray) or term.shape != shape:
                result_checks.term(self._task, name, term, shape)
                term = np.broadcast_to(term, shape)
            if not self._all_learn:
                term = term[:, self._indices]
            terms[name] = copied = term.astype(np.float32)
            rewards = rewards + copied  # `+=` is three times slower on a single element
        return terms, rewards
