"""A new task defined by four methods, and its training: one robot drives to the ball."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rsoccer import Frame, Play, SimConfig, Task, WorldRng, register, spawn
from rsoccer.arrays import Floats, Mask


@dataclass(frozen=True)
class Reach(Task):
    """One robot has to reach the ball within the time limit."""

    max_steps: int = 120  # 3 s
    action_size = 2

    @cached_property
    def config(self) -> SimConfig:
        """Simulator configuration: the VSSS field for three a side with one robot."""
        return SimConfig(n_blue=1, n_yellow=0)

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        """Draw random positions of ball and robot, at least 0.3 m apart."""
        frame = Frame.empty(len(rng), 1, 0)
        positions = spawn.positions(rng, self.config.field, [0.03, 0.06], min_distance=0.3)
        frame.ball.position[:], frame.robots.position[:, 0] = positions[:, 0], positions[:, 1]
        frame.robots.heading[:] = spawn.headings(rng, 1)
        return frame

    def get_commands(self, play: Play, actions: Floats) -> Floats:
        """Convert actions in [-1, 1] to wheel speeds, rad/s."""
        return actions * np.float32(self.config.robot.max_wheel_speed)

    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        """Return the ball's position in the robot's frame (m) and the scaled angular velocity."""
        view = play.sensed_view
        ego, offset = view.ego, view.ball.position - view.ego.position
        ahead = (offset * ego.heading).sum(axis=-1)
        left = offset[..., 1] * ego.heading[..., 0] - offset[..., 0] * ego.heading[..., 1]
        return {
            "ball_offset": np.stack([ahead, left], axis=-1),
            "angular_velocity": ego.angular_velocity / 10,
        }

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        """Reward the distance gained (m), and 1 for reaching the ball, which ends the episode."""
        before, now = (
            np.linalg.norm(view.ball.position - view.ego.position, axis=-1)
            for view in (play.last_view, play.view)
        )
        reached = now < 0.07
        terms = {"approach": before - now, "reached": reached.astype(np.float32)}
        return terms, reached[:, 0]


register("Reach-v0", Reach)


def share_reached(policy: str, matches: int = 200) -> float:
    """Return the share of matches in which the policy reaches the ball in time."""
    from rsoccer import Matches

    batch = Matches("Reach-v0", matches, controllers={"blue": policy}, autoreset="disabled")
    batch.reset()
    actions = np.zeros((matches, 0, 2), np.float32)  # the controller drives the only robot
    return float(sum(batch.step(actions).terminated.sum() for _ in range(120))) / matches


def main(samples: int = 150_000) -> None:
    """Train for some seconds and compare with the untrained network."""
    from pathlib import Path

    from rsoccer.train import Args, RolloutSettings, train  # needs torch; the task does not

    out = Path("out/reach")
    rollout = RolloutSettings(worlds=128)
    policy = train(Args("Reach-v0", out, samples, threads=1, overwrite=True, rollout=rollout))
    before, after = share_reached(str(out / "untrained.safetensors")), share_reached(str(policy))
    print(f"reaches the ball in {before:.0%} of matches untrained, in {after:.0%} trained")


if __name__ == "__main__":
    import sys

    main(*map(int, sys.argv[1:]))
