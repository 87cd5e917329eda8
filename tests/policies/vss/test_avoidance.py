import numpy as np

from rsoccer.policies.vss.avoidance import avoid_obstacle
from rsoccer.vectors import norm, reciprocal


def test_the_path_past_an_obstacle_keeps_its_distance() -> None:
    """Small steps to each next waypoint, from all around, stay outside the radius."""
    n = 16
    angle = np.linspace(0.0, 2.0 * np.pi, n, endpoint=False)
    position, target = (
        np.stack([size * np.cos(turn), size * np.sin(turn)], axis=-1, dtype=np.float32)[:, None]
        for size, turn in ((0.5, angle), (-0.4, angle + 0.1))
    )
    target_xy = target[..., 0], target[..., 1]
    zero, radius = np.zeros((n, 1), np.float32), np.float32(0.1)
    center, active = (zero, zero), zero == 0.0
    nearest, detour = np.inf, np.zeros((n, 1), np.bool_)
    for _ in range(150):
        x, y = avoid_obstacle(position, target_xy, center, radius, active)
        detour |= x != target[..., 0]
        step = np.stack([x, y], axis=-1) - position
        scale = reciprocal(norm(step[..., 0], step[..., 1]), np.float32(0.01))
        position = position + step * scale[..., None] * np.float32(0.01)
        nearest = min(nearest, float(norm(position[..., 0], position[..., 1]).min()))
    assert detour.all(), "the obstacle is in every path"
    assert nearest > 0.095
    assert np.abs(position - target).max() < 0.02
    straight, _ = avoid_obstacle(position, center, center, radius, ~active)
    assert not straight.any(), "an inactive robot drives straight to its target"
