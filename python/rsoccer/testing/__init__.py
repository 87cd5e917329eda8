"""Checks for tasks that users write: `check_task(MyTask())`."""

from rsoccer.testing.errors import TaskError
from rsoccer.testing.task_check import check_task

__all__ = ["TaskError", "check_task"]
