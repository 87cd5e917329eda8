import numpy as np
import pytest

import rsoccer
from rsoccer import Frame, Matches, derived, make_task
from rsoccer.arrays import Doubles, Floats, Mask
from rsoccer.completed import CompletedSimulator, CompletedStepper
from rsoccer.controllers import Controllers
from tests.helpers import pushing, same, zeros
from tests.poses_only import PosesOnly, frames


def played(
    name: str, controllers: Controllers | None = None, worlds: int = 6, stamps: bool = False
) -> tuple[Matches, PosesOnly]:
    task = make_task(name)
    poses = PosesOnly(task.config, worlds, stamps)
    completed = CompletedSimulator(poses, task.config, worlds)
    return Matches(task, worlds, controllers=controllers, simulator=completed), poses


@pytest.mark.parametrize("name", rsoccer.list_tasks())
def test_every_task_plays_on_poses_alone(name: str) -> None:
    matches, _ = played(name)
    assert np.isfinite(matches.reset()).all()
    rng = np.random.default_rng(0)
    for _ in range(60):
        outcome = matches.step(pushing(rng, matches))
        assert np.isfinite(outcome.observations).all()
        assert np.isfinite(outcome.rewards).all()
        assert np.isfinite(matches.frame.rows).all()


@pytest.mark.parametrize("name", ["VSSSelfPlay-v0", "SSLSelfPlay-v0"])
def test_poses_beams_and_crossings_are_exact_and_touches_nearly(name: str) -> None:
    script = "chase" if name.startswith("VSS") else "strike"
    matches, poses = played(name, {"all": script}, worlds=12)
    matches.reset()
    config = matches.task.config
    seen_touches, true_touches = 0, 0
    for _ in range(160):
        matches.step(zeros(matches))
        seen, true = frames(config, matches.frame.rows, poses.truth)
        for column in ("position", "heading", "infrared"):
            assert same(getattr(seen.robots, column), getattr(true.robots, column))
        assert same(seen.ball.position, true.ball.position)
        assert (seen.ball.crossed == true.ball.crossed).all()
        seen_touches += int(seen.robots.touched_ball.sum())
        true_touches += int(true.robots.touched_ball.sum())
    assert true_touches > 50
    assert 0.8 * true_touches < seen_touches < 1.25 * true_touches


def test_matches_between_scripts_score_as_on_complete_rows() -> None:
    scores = []
    for completed in (False, True):
        controllers: Controllers = {"blue": "chase", "yellow": "zero"}
        matches, _ = played("VSSSelfPlay-v0", controllers, worlds=12)
        if not completed:
            matches = Matches("VSSSelfPlay-v0", 12, controllers=controllers)
        matches.reset(seed=3)
        goals = np.zeros(2)
        for _ in range(400):
            outcome = matches.step(zeros(matches))
            if outcome.episodes is not None:
                score = outcome.episodes.metrics["goal_score"]
                goals += (score > 0).sum(), (score < 0).sum()
        scores.append(goals)
    plain, on_poses = scores
    assert plain[0] >= 10
    assert abs(plain[0] - on_poses[0]) <= 0.4 * plain[0]
    assert plain[1] + on_poses[1] <= 6


def test_resets_begin_without_a_past_and_with_the_velocities_that_were_placed() -> None:
    matches, _ = played("SSLGoToBall-v0", worlds=2)
    frame = Frame.empty(2, 1, 0)
    frame.ball.position[:] = 1.0, 0.5
    frame.ball.velocity[:] = 1.0, 0.0
    frame.robots.velocity[:, 0] = 0.0, 0.5
    matches.reset(rows=frame.rows)
    assert same(matches.frame.ball.velocity, frame.ball.velocity)
    assert same(matches.frame.robots.velocity, frame.robots.velocity)
    assert (matches.frame.ball.last_touch == -1).all()
    matches.step(zeros(matches))
    assert matches.frame.ball.velocity[0, 0] == pytest.approx(1.0, abs=0.1)


def test_only_active_worlds_advance() -> None:
    task = make_task("VSSSelfPlay-v0", max_steps=3)
    completed = CompletedSimulator(PosesOnly(task.config, 2), task.config, 2)
    matches = Matches(task, 2, simulator=completed, autoreset="disabled")
    matches.reset()
    matches.step(zeros(matches) + 1.0)
    matches.reset(mask=np.array([False, True]))
    for _ in range(2):
        matches.step(zeros(matches) + 1.0)
    before = matches.frame.rows.copy()
    assert matches.done.tolist() == [True, False]
    matches.step(zeros(matches) + 1.0)
    assert same(before[0], matches.frame.rows[0])
    assert not same(before[1], matches.frame.rows[1])


def test_time_stamps_set_the_time_between_rows() -> None:
    class Late(PosesOnly):
        """Reports every second step as the last one, with its time stamp."""

        def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> Doubles | None:
            self.calls = getattr(self, "calls", 0) + 1
            if self.calls % 2 == 0:
                return 100.0 + self._steps * self._config.time_step
            super().step(commands, out, active)
            return super().step(commands, out, active)

    task = make_task("VSSSelfPlay-v0", n_blue=1, n_yellow=1)
    late = Late(task.config, 1, stamps=True)
    matches = Matches(
        task, controllers={"all": "zero"}, simulator=CompletedSimulator(late, task.config)
    )
    frame = Frame.empty(1, 1, 1)
    frame.robots.position[0] = [(-0.5, 0.4), (0.5, 0.4)]
    frame.ball.velocity[0] = 0.5, 0.0
    derived.roll(frame, task.config.ball.radius)
    matches.reset(rows=frame.rows)
    assert matches.play.times is not None
    assert matches.play.times.tolist() == [100.0]
    speeds, times = [], []
    for _ in range(4):
        matches.step(zeros(matches))
        speeds.append(float(matches.frame.ball.velocity[0, 0]))
        times.append(float(matches.play.times[0]))
    assert times == pytest.approx([100.05, 100.05, 100.1, 100.1])
    assert speeds[0] == pytest.approx(0.5, abs=0.05)
    assert speeds[1] == speeds[0]
    assert speeds[2] == pytest.approx(speeds[0], abs=0.05)


def test_a_tracker_keeps_its_velocities() -> None:
    class Tracking(PosesOnly):
        def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> Doubles | None:
            times = super().step(commands, out, active)
            out[:] = self.truth
            return times

        def place(
            self, worlds: Mask, rows: Floats, out: Floats, parameters: Floats | None = None
        ) -> Doubles | None:
            times = super().place(worlds, rows, out, parameters)
            out[worlds] = self.truth[worlds]
            return times

    task = make_task("VSSSelfPlay-v0")
    tracking = Tracking(task.config, 3)
    completed = CompletedSimulator(tracking, task.config, 3, velocities=False)
    matches = Matches(task, 3, simulator=completed, autoreset="disabled")
    matches.reset()
    for _ in range(20):
        matches.step(pushing(np.random.default_rng(0), matches))
        seen, true = frames(task.config, matches.frame.rows, tracking.truth)
        assert same(seen.robots.velocity, true.robots.velocity)
        assert same(seen.ball.velocity, true.ball.velocity)


def test_a_stepper_that_cannot_place_is_read() -> None:
    class Bare:
        """Robots at rest in a row, that cannot be placed."""

        closed = False

        def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> None:
            self.read(out)

        def read(self, out: Floats) -> None:
            frame = Frame(out, 1, 0)
            frame.robots.position[:] = 0.5, 0.0
            frame.robots.heading[:] = 1.0, 0.0
            frame.ball.position[:] = 0.0, 0.0
            frame.ball.height[:] = 0.0

        def close(self) -> None:
            self.closed = True

    task, bare = make_task("SSLGoToBall-v0"), Bare()
    matches = Matches(task, simulator=CompletedStepper(bare, task.config))
    matches.reset()
    assert matches.frame.robots.position[0, 0].tolist() == [0.5, 0.0]
    matches.step(zeros(matches))
    assert not matches.frame.robots.velocity.any()
    matches.close()
    assert bare.closed


def test_robots_that_rest_against_each_other_do_not_collide_by_wrong_velocities() -> None:
    """Formerly each velocity of a tracker that took a robot to be pushed was a collision."""
    config = make_task("SSLContestedPossession-v0").config

    class Leaning:
        """Two robots that touch; the first one's velocity is noise."""

        rng = np.random.default_rng(0)

        def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> None:
            self.read(out)

        def read(self, out: Floats) -> None:
            frame = Frame(out, 1, 1)
            frame.robots.position[0] = (0.0, 0.0), (2.0 * config.robot.radius, 0.0)
            frame.robots.heading[:] = 1.0, 0.0
            frame.robots.velocity[0] = (self.rng.normal(0.0, 0.5), 0.0), (0.0, 0.0)
            frame.ball.position[:] = 1.0, 0.0

    completed = CompletedStepper(Leaning(), config, velocities=False)
    out = Frame.empty(1, 1, 1)
    completed.read(out.rows)
    speeds = []
    for _ in range(40):
        completed.step(np.zeros((1, 2, 6), np.float32), out.rows)
        assert out.robots.touched_opponent.all()
        speeds.append(float(out.robots.collision_speed.max()))
    assert max(speeds[1:]) < 1e-3


def test_poses_that_are_not_finite_are_refused() -> None:
    class Losing(PosesOnly):
        """Loses the ball of one world."""

        def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> Doubles | None:
            times = super().step(commands, out, active)
            out[1, 0] = np.nan
            return times

    config = make_task("VSS-v0").config
    matches = Matches("VSS-v0", 3, simulator=CompletedSimulator(Losing(config, 3), config, 3))
    matches.reset()
    with pytest.raises(RuntimeError, match=r"Losing: expected finite poses.* worlds \[1\]"):
        matches.step(zeros(matches))


def test_wrong_arguments_are_named() -> None:
    config = make_task("VSS-v0").config
    poses = PosesOnly(config, 1)
    with pytest.raises(ValueError, match="worlds: expected at least 1"):
        CompletedStepper(poses, config, 0)
    with pytest.raises(TypeError, match="velocities: expected True or False"):
        CompletedStepper(poses, config, velocities=1)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="gap: expected 0 to 1"):
        CompletedStepper(poses, config, gap=-1.0)

    class NoReader:
        def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> None:
            pass

    with pytest.raises(
        TypeError, match="stepper: expected one that can place bodies, got NoReader"
    ):
        CompletedSimulator(NoReader(), config)
    matches = Matches("VSS-v0", simulator=CompletedStepper(NoReader(), config))
    with pytest.raises(TypeError, match="NoReader has no read"):
        matches.reset()
