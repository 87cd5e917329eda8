"""A distillation in its folder."""

from __future__ import annotations

import itertools
import json
import math
import sys
import time
from collections.abc import Iterator
from contextlib import ExitStack, closing
from pathlib import Path
from typing import Any, Final

import numpy as np
import torch
from torch import Tensor, nn

from rsoccer._core import Sensing
from rsoccer.files import write_atomically
from rsoccer.history import ObservationStack
from rsoccer.matches import Matches
from rsoccer.policies.network import Network
from rsoccer.registry import make_task, task_with_options
from rsoccer.sensing_text import with_number
from rsoccer.sources import make_sensing
from rsoccer.task import Task
from rsoccer.train.args import SETTINGS_FILE
from rsoccer.train.distillation.hindsight import HindsightMatches, Samples
from rsoccer.train.distillation.settings import DistillArgs
from rsoccer.train.distillation.student import Normalizer, new_student
from rsoccer.train.network import initial_policy
from rsoccer.train.run.folder import POLICY_FILE
from rsoccer.train.run.log import FILE_NAME as LOG_FILE
from rsoccer.train.run.log import append_row

FINAL_RATE: Final = 0.05
"""Step size at the end of a run, relative to that at first."""


class Buffer:
    """The newest samples."""

    def __init__(self, size: int) -> None:
        """Begin without samples.

        Args:
            size: samples that are kept.
        """
        self._size, self._parts = size, list[Samples]()

    def add(self, samples: Samples) -> None:
        """Add samples, and forget the oldest ones.

        Args:
            samples: the samples.
        """
        self._parts.append(samples)
        while sum(len(part.actions) for part in self._parts[1:]) >= self._size:
            del self._parts[0]

    def tensors(self) -> tuple[Tensor, Tensor]:
        """Return all observations (k, o) and actions (k, action)."""
        observations, actions = (np.concatenate(p) for p in zip(*self._parts, strict=True))
        return torch.from_numpy(observations), torch.from_numpy(actions)


def run_distillation(args: DistillArgs) -> Path:
    """Run a distillation: the implementation of `rsoccer.train.distillation.distill`.

    Args:
        args: settings of the run.

    Returns:
        Path of the policy file.

    Raises:
        ValueError: see `distill`.
    """
    torch.set_num_threads(1)
    teacher = initial_policy.load(args.teacher, make_task(args.task), _plain(args.task), "teacher")
    task = task_with_options(args.task, teacher.task_options)
    stack = ObservationStack.of(task, args.history)
    first = teacher
    if args.student is not None:
        first = initial_policy.load(args.student, task, stack, "student")
    student = new_student(first, stack)
    mean, std = initial_policy.widened_normalization(first, stack)
    normalize = Normalizer(mean, std, float(first.clip))
    delays = _delays_in_steps(args, task, teacher.action_repeat)
    path = args.out / POLICY_FILE
    if path.exists() or (args.out / LOG_FILE).exists():  # the log of one that did not end, too
        raise ValueError(f"out: {args.out} holds a run; name another folder")
    args.out.mkdir(parents=True, exist_ok=True)
    settings = json.dumps(args.to_json(), indent=2)
    write_atomically(args.out / SETTINGS_FILE, settings.encode())
    with ExitStack() as opened:
        groups = []
        for matches, delay in zip(_matches(args, task), delays, strict=True):
            opened.enter_context(closing(matches))
            groups.append(HindsightMatches(matches, teacher, delay))
        _learn(args, groups, student, normalize)
    network = Network.from_layers(
        task,
        student,
        teacher.action_std,
        action_repeat=teacher.action_repeat,
        history=args.history,
        mean=mean,
        std=std,
        clip=float(first.clip),
        task_name=teacher.task_name,
        task_options=teacher.task_options,
        sensing=args.sensing,
        randomization=_randomization(args, task),
        shield=teacher.metadata.get("shield"),
    )
    network.save(path)
    return path


def _learn(
    args: DistillArgs, groups: list[HindsightMatches], student: nn.Sequential, normalize: Normalizer
) -> None:
    """Collect samples and learn from them in turn."""
    generator = torch.Generator().manual_seed(args.seed)
    optimizer = torch.optim.Adam(student.parameters(), args.learning_rate)
    buffer, samples, start = Buffer(args.buffer), 0, time.monotonic()
    for update in itertools.count(1):
        progress = min(samples / args.samples, 1.0)
        for group in groups:
            found = group.collect(student, normalize, args.noise, args.decisions, generator)
            buffer.add(found)
            samples += len(found.actions)
        for parameters in optimizer.param_groups:
            parameters["lr"] = args.learning_rate * FINAL_RATE**progress
        loss = _fit(args, buffer, student, normalize, optimizer, generator)
        seconds = time.monotonic() - start
        _log(args.out, {"update": update, "samples": samples, "seconds": seconds, "loss": loss})
        if samples >= args.samples:
            return


def _fit(
    args: DistillArgs,
    buffer: Buffer,
    student: nn.Sequential,
    normalize: Normalizer,
    optimizer: torch.optim.Optimizer,
    generator: torch.Generator,
) -> float:
    """Learn from minibatches of the buffer; the mean of their losses."""
    observations, actions = buffer.tensors()
    losses = []
    for _ in range(args.minibatches):
        rows = torch.randint(len(actions), (args.minibatch,), generator=generator)
        error = student(normalize(observations[rows])) - actions[rows]
        loss = error.square().mean()
        optimizer.zero_grad()
        loss.backward()
        optimizer.step()
        losses.append(float(loss.detach()))
    return float(np.mean(losses))


def _delays_in_steps(args: DistillArgs, task: Task, action_repeat: int) -> list[int]:
    """The command delays in control steps, none of which is longer than a round."""
    step = task.config.time_step
    steps = [round(delay / step) for delay in args.command_delays]
    for delay, count in zip(args.command_delays, steps, strict=True):
        if not math.isclose(delay, count * step, rel_tol=1e-6):
            words = f"command_delays: expected multiples of the control step of {step:g} s"
            raise ValueError(f"{words}, got {delay:g} s")
    # The labels of a round's first decisions have to become known within it.
    needed = max(steps) // action_repeat + 1
    if args.decisions < needed:
        words = f"at least {needed} for command_delays of {max(args.command_delays):g} s"
        raise ValueError(f"decisions: expected {words}, got {args.decisions}")
    return steps


def _drawn_delays(delay: float, task: Task) -> tuple[float, float]:
    """Bounds between which commands arrive in the control step of a delay, s."""
    half = 0.5 * task.config.time_step
    return (delay - half, delay + half) if delay else (0.0, 0.0)


def _matches(args: DistillArgs, task: Task) -> Iterator[Matches]:
    """Matches for each command delay."""
    seeds = np.random.SeedSequence(args.seed).generate_state(len(args.command_delays), np.uint64)
    for delay, seed in zip(args.command_delays, seeds >> np.uint64(1), strict=True):
        yield Matches(
            task,
            args.worlds // len(args.command_delays),
            int(seed),
            args.threads,
            autoreset="disabled",
            sensing=_with_delay(args.sensing, delay),
            randomization={
                **args.randomization,
                "sensing.command_delay": _drawn_delays(delay, task),
            },
            history=args.history,
        )


def _with_delay(source: str | None, delay: float) -> Sensing | None:
    """The senses of matches with a command delay, s: forecasts know its middle, as teams do."""
    sensing = make_sensing(source)
    if sensing is None:
        return None
    assert isinstance(sensing, Sensing), "the settings have checked it"
    if sensing.forecast < 0.5:
        return sensing
    return with_number(sensing, "command_delay", delay)


def _randomization(args: DistillArgs, task: Task) -> dict[str, Any]:
    """Distributions of all matches together, with the bounds of the delays that were drawn."""
    bounds = [_drawn_delays(delay, task) for delay in args.command_delays]
    # Digits beyond a nanosecond are those of the sum of two numbers.
    drawn = [round(min(low for low, _ in bounds), 9), round(max(high for _, high in bounds), 9)]
    return {**args.randomization, "sensing.command_delay": drawn}


def _plain(task: str) -> ObservationStack:
    """The stack of plain observations, which a teacher reads."""
    return ObservationStack.of(make_task(task), 1)


def _log(folder: Path, row: dict[str, float]) -> None:
    """Write a row of the log, and show it."""
    append_row(folder, row)
    sys.stderr.write(f"{row['samples']:,.0f} samples, loss {row['loss']:.4f}\n")
