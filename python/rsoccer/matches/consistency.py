"""Consistency of matches: a failure in the middle of a step leaves parts one step apart."""


class Consistency:
    """Remembers the failure that left the matches inconsistent, if any."""

    def __init__(self) -> None:
        """Begin consistent."""
        self._fault = ""

    def check(self) -> None:
        """Refuse to continue after a failure.

        Raises:
            RuntimeError: the matches are inconsistent.
        """
        if self._fault:
            raise RuntimeError(
                f"the matches are inconsistent: {self._fault}; call reset() for all worlds or "
                "load_state_dict() to repair them"
            )

    def fail(self, call: str, error: BaseException) -> None:
        """Mark the matches as inconsistent.

        Only the text of the error is kept: the error itself holds references to all frames of
        the stack.

        Args:
            call: the call that failed, such as "step 3".
            error: its exception.
        """
        self._fault = f"{call} failed with {type(error).__name__}: {error}"

    def repair(self) -> None:
        """Mark the matches as consistent."""
        self._fault = ""
