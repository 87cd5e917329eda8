"""The error of `check_task`."""


class TaskError(AssertionError):
    """Fault of a task that `check_task` found."""


def expect(holds: bool, fault: str) -> None:
    """Raise `TaskError` unless a condition holds.

    Args:
        holds: the condition.
        fault: what is wrong if it does not hold.

    Raises:
        TaskError: the condition does not hold.
    """
    if not holds:
        raise TaskError(fault)
