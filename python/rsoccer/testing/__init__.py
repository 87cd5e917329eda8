"""Tests for tasks that users write."""

from rsoccer.testing.task_check import TaskError, check_task

__all__ = ["TaskError", "check_task"]
