import numpy as np
import pytest

from rsoccer.derived import TrackRecord
from rsoccer.frame import Frame

SECONDS = 0.025
BOTH = np.arange(2)


def moving(x: float, turned: float = 0.0) -> Frame:
    """blue_0 of two worlds at x, with velocities that are wrong."""
    frame = Frame.empty(2, 1, 0)
    frame.robots.position[:, 0] = x, 0.0
    frame.robots.heading[:, 0] = np.cos(turned), np.sin(turned)
    frame.robots.velocity[:, 0] = 9.0, 9.0
    return frame


def test_velocities_are_means_over_two_frames() -> None:
    record = TrackRecord(moving(0.0))
    record.begin(BOTH, moving(0.0))
    seconds = np.full(2, SECONDS, np.float32)
    for x, turned in ((0.0, 0.0), (0.02, 0.1), (0.03, 0.1)):
        record.add(BOTH, moving(x, turned), seconds)
    found = record.mean_motion(BOTH, moving(0.06, 0.3)).robots
    assert found.velocity[:, 0, 0] == pytest.approx([0.04 / (2 * SECONDS)] * 2, rel=1e-4)
    assert found.angular_velocity[:, 0] == pytest.approx([0.2 / (2 * SECONDS)] * 2, rel=1e-3)
    assert found.position[:, 0, 0] == pytest.approx([0.06, 0.06])


def test_one_frame_is_a_shorter_past_and_none_leaves_velocities_as_they_are() -> None:
    record = TrackRecord(moving(0.0))
    assert (record.mean_motion(BOTH, moving(0.5)).robots.velocity == 9.0).all()
    record.begin(BOTH, moving(0.0))
    record.add(BOTH, moving(0.0), np.array([SECONDS, 0.0], np.float32))
    velocity = record.mean_motion(BOTH, moving(0.02)).robots.velocity[:, 0, 0]
    assert velocity == pytest.approx([0.02 / SECONDS, 9.0], rel=1e-4)


def test_a_world_that_begins_anew_forgets_its_past_alone() -> None:
    record = TrackRecord(moving(0.0))
    record.add(BOTH, moving(0.0), np.full(2, SECONDS, np.float32))
    record.begin(BOTH[:1], moving(0.3).take(BOTH[:1]))
    velocity = record.mean_motion(BOTH, moving(0.02)).robots.velocity[:, 0, 0]
    assert velocity == pytest.approx([9.0, 0.02 / SECONDS], rel=1e-4)
