"""Labels of a distillation: the teacher's actions when decisions arrive."""

from typing import Any

import numpy as np
import pytest
import torch

import rsoccer
from rsoccer import Matches
from rsoccer.arrays import Floats
from rsoccer.history import ObservationStack
from rsoccer.policies import make_policy
from rsoccer.policies.network import Network
from rsoccer.policies.shield import Shield
from rsoccer.train.distillation import hindsight
from rsoccer.train.distillation.hindsight import HindsightMatches
from rsoccer.train.distillation.student import Normalizer, new_student
from rsoccer.train.network import initial_policy

TASK = "SSLGoToBall-v0"
WORLDS, DECISIONS = 4, 6


def best() -> Network:
    policy = make_policy("best", TASK)
    assert isinstance(policy, Network)
    return policy


def collected(delay: int, **options: Any) -> tuple[np.ndarray, np.ndarray]:  # noqa: ANN401  (any field)
    matches = rsoccer.Matches(TASK, WORLDS, 3, autoreset="disabled", **options)
    stack = ObservationStack.of(matches.task, 1)
    student = new_student(best(), stack)
    normalize = Normalizer(*initial_policy.widened_normalization(best(), stack), 10.0)
    group = HindsightMatches(matches, best(), delay)
    generator = torch.Generator().manual_seed(0)
    return group.collect(student, normalize, 0.1, DECISIONS, generator)


def test_without_delay_labels_are_actions_for_what_is_seen() -> None:
    observations, actions = collected(0)
    assert len(actions) == WORLDS * DECISIONS
    np.testing.assert_allclose(actions, best().mean_actions(observations), atol=1e-6)


def test_labels_are_of_the_state_in_which_commands_arrive() -> None:
    """A delay of one decision: labels are those of the next decisions without it."""
    now = collected(0, sensing=rsoccer.Sensing(command_delay=0.075))
    later = collected(3, sensing=rsoccer.Sensing(command_delay=0.075))
    rows = (DECISIONS - 1) * WORLDS
    assert len(later[1]) == rows
    np.testing.assert_array_equal(now[0][:rows], later[0])
    block = rsoccer.make_task(TASK).layout.blocks["action"].columns
    expected = now[0][WORLDS:].copy()
    expected[:, block] = now[0][:rows, block]
    np.testing.assert_allclose(later[1], best().mean_actions(expected), atol=1e-6)
    assert np.abs(later[1] - now[1][:rows]).max() > 0.05


def test_students_act_behind_the_shield_of_the_teacher(monkeypatch: pytest.MonkeyPatch) -> None:
    teacher, shields = make_policy("best", "SSLStaticDefenders-v0"), list[Shield | None]()
    assert isinstance(teacher, Network)
    assert teacher.shield is not None
    matches = rsoccer.Matches("SSLStaticDefenders-v0", WORLDS, autoreset="disabled")
    stack = ObservationStack.of(matches.task, 1)
    normalize = Normalizer(*initial_policy.widened_normalization(teacher, stack), 10.0)

    def noting(matches: Matches, actions: Floats, shield: Shield | None) -> Floats:
        shields.append(shield)
        return np.full_like(actions, 0.25)

    monkeypatch.setattr(hindsight, "shielded", noting)
    group, generator = HindsightMatches(matches, teacher, 0), torch.Generator().manual_seed(0)
    group.collect(new_student(teacher, stack), normalize, 0.1, 2, generator)
    assert shields == [teacher.shield] * 2 * teacher.action_repeat
    assert (matches.play.actions[:, 0] == 0.25).all()


def test_decisions_that_arrive_after_the_end_have_no_label() -> None:
    observations, _ = collected(3, max_steps=6)
    assert len(observations) == WORLDS * DECISIONS / 2
