"""Distillation: a policy with late and noisy senses learns from one that knows the true state.

The teacher is a trained policy, such as `best`. The student plays matches with senses and with
commands that arrive late. Its label for a decision is the teacher's action in the true state in
which the decision arrives. That state is known a moment later, so no forecast is needed, and the
student learns to forecast as well as to act. It plays itself, so it learns in the states that it
reaches: DAgger (Ross, Gordon and Bagnell, 2011) with a privileged teacher (Chen et al., "Learning
by Cheating", 2019). A label says more than a reward, so it takes far fewer samples than PPO.
"""

from __future__ import annotations

from pathlib import Path

from rsoccer.train.distillation.settings import DistillArgs

__all__ = ["DistillArgs", "distill"]


def distill(args: DistillArgs) -> Path:
    """Teach a policy with senses what a policy on the true state does, and save it.

    Example:
        >>> args = DistillArgs("SSLGoToBall-v0", sensing="rc2021", history=5)
        >>> path = distill(args)  # doctest: +SKIP

    Args:
        args: settings of the run.

    Returns:
        Path of the policy file, in the folder `args.out`.

    Raises:
        ValueError: an unknown task, a teacher that is no trained policy or does not fit the task,
            a command delay that is no multiple of the control step, fewer decisions in a round
            than the longest delay takes, or a folder that holds a run.
    """
    from rsoccer.train.distillation.run import run_distillation

    return run_distillation(args)
