"""Whether matches are whole, or torn by something that failed half way."""


class Whole:
    """What failed half way, if anything; costs nothing while nothing does."""

    def __init__(self) -> None:
        """Nothing has failed."""
        self._fault = ""

    def check(self) -> None:
        """RuntimeError if the matches are torn."""
        if self._fault:
            raise RuntimeError(
                f"the matches are torn: {self._fault}; reset() of all worlds or "
                "load_state_dict() mends them"
            )

    def tear(self, what: str, error: BaseException) -> None:
        """Remember what failed, by its text: the error itself would keep all that it has seen."""
        self._fault = f"{what} failed with {type(error).__name__}: {error}"

    def mend(self) -> None:
        """All parts of the matches are of one moment again."""
        self._fault = ""
