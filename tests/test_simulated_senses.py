"""Senses that the simulator computes, in matches."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer import Matches, Sensing, Simulator
from rsoccer.arrays import Floats
from rsoccer.tasks import SslSelfPlay, VssSelfPlay

PRESETS = [name for name in Sensing.PRESETS if name != "none"]
TASKS = {"VSSSelfPlay-v0": VssSelfPlay(), "SSLSelfPlay-v0": SslSelfPlay(n_blue=2, n_yellow=2)}


def played(matches: Matches, steps: int, seed: int = 0) -> list[bytes]:
    """Rows, sensed rows and observations of each step, with random actions."""
    rng = np.random.default_rng(seed)
    matches.reset()
    shape = (len(matches.agents), matches.action_size)
    seen = []
    for _ in range(steps):
        action = rng.uniform(-1, 1, shape).astype(np.float32)
        outcome = matches.step(np.repeat(action[None], matches.worlds, axis=0))
        seen.append(matches.frame.rows[0].tobytes())
        seen.append(matches.play.sensed.rows[0].tobytes())
        seen.append(outcome.observations[0].tobytes())
    return seen


def test_a_name_a_model_and_its_file_are_the_same(tmp_path: Path) -> None:
    path = tmp_path / "late.json"
    path.write_text('{"preset": "vsss", "delay": 0.1}')
    ways: list[Sensing | str] = [Sensing("vsss", delay=0.1), str(path)]
    assert played(Matches("VSS-v0", sensing=ways[0]), 5) == played(
        Matches("VSS-v0", sensing=ways[1]), 5
    )
    assert played(Matches("VSS-v0", sensing="vsss"), 5) == played(
        Matches("VSS-v0", sensing=Sensing.preset("vsss")), 5
    )
    assert played(Matches("VSS-v0", sensing="vsss, delay=0.1"), 5) == played(
        Matches("VSS-v0", sensing=Sensing("vsss", delay=0.1)), 5
    )


@pytest.mark.parametrize("off", [None, "none", Sensing()])
def test_off_is_the_truth_without_a_copy(off: Sensing | str | None) -> None:
    matches = Matches("VSS-v0", sensing=off)
    assert matches.play.sensed is matches.play.frame
    assert played(matches, 20) == played(Matches("VSS-v0"), 20)


@pytest.mark.parametrize("preset", PRESETS)
@pytest.mark.parametrize("task", TASKS)
def test_a_world_is_the_same_whatever_batch_and_threads(preset: str, task: str) -> None:
    alone = played(Matches(TASKS[task], 1, 5, sensing=preset), 60)
    among = played(Matches(TASKS[task], 9, 5, threads=2, sensing=preset), 60)
    assert alone == among


@pytest.mark.parametrize("preset", PRESETS)
@pytest.mark.parametrize("task", TASKS)
def test_robots_know_about_where_they_are(preset: str, task: str) -> None:
    matches = Matches(TASKS[task], 20, 0, sensing=preset)
    rng = np.random.default_rng(0)
    matches.reset()
    errors = []
    for step in range(80):
        if step % 10 == 0:
            actions = rng.uniform(-1, 1, (20, len(matches.agents), matches.action_size))
        matches.step(actions.astype(np.float32))
        errors.append(matches.play.sensed.blue.position - matches.frame.blue.position)
    distance = np.linalg.norm(errors, axis=-1)
    if Sensing(preset).frame_rate == 0.0:
        assert not distance.any(), "commands alone are late"
        return
    assert 0.001 < np.median(distance) < 0.12, "45 ms of a robot at 2 m/s are 90 mm"


def test_observations_are_of_what_is_sensed_and_rewards_of_the_truth() -> None:
    exact, late = (Matches(VssSelfPlay(), 2, 0, sensing=s) for s in (None, Sensing(delay=0.2)))
    exact.reset()
    late.reset()
    actions = np.ones((2, 6, 2), np.float32)
    for _ in range(6):
        truth, sensed = exact.step(actions), late.step(actions)
        assert exact.frame.rows.tobytes() == late.frame.rows.tobytes()
        assert truth.rewards.tobytes() == sensed.rewards.tobytes()
    assert not np.allclose(truth.observations, sensed.observations)


@pytest.mark.parametrize("preset", PRESETS)
def test_saved_matches_go_on_exactly(preset: str) -> None:
    matches, other = (Matches(SslSelfPlay(), 2, 3, sensing=preset) for _ in range(2))
    actions = np.ones((2, len(matches.agents), matches.action_size), np.float32)
    matches.reset()
    for _ in range(13):
        matches.step(actions)
    other.reset(seed=50)
    other.load_state_dict(matches.state_dict())
    for _ in range(30):
        one, two = matches.step(actions), other.step(actions)
        assert one.observations.tobytes() == two.observations.tobytes()
        assert matches.play.sensed.rows.tobytes() == other.play.sensed.rows.tobytes()


def test_a_reset_of_some_worlds_leaves_the_senses_of_others() -> None:
    matches = Matches("VSS-v0", 3, 0, sensing="vsss")
    matches.reset()
    actions = np.ones((3, 1, 2), np.float32)
    for _ in range(5):
        matches.step(actions)
    before = matches.play.sensed.rows.copy()
    matches.reset(mask=np.array([False, True, False]))
    assert matches.play.sensed.rows[[0, 2]].tobytes() == before[[0, 2]].tobytes()
    assert matches.play.sensed.rows[1].tobytes() != before[1].tobytes()


def test_every_episode_has_errors_of_its_own() -> None:
    matches = Matches("VSS-v0", 1, 0, sensing=Sensing(camera_offset_error=0.05))
    offsets = []
    for _ in range(3):
        matches.reset()
        offsets.append(matches.play.sensed.blue.position - matches.frame.blue.position)
    assert not np.allclose(offsets[0], offsets[1])
    assert not np.allclose(offsets[1], offsets[2])


class Plain:
    """A simulator without senses."""

    place: Any
    restart: Any
    reposition_balls: Any
    step: Any

    def __init__(self, *arguments: Any) -> None:  # noqa: ANN401  (those of a simulator)
        self._simulator = Simulator(*arguments)
        for name in ("place", "restart", "reposition_balls", "step", "snapshot", "restore"):
            if not hasattr(self, name):
                setattr(self, name, getattr(self._simulator, name))


class Sensible(Plain):
    """A simulator with senses whose steps do not write what is sensed."""

    sense: Any
    begin_senses: Any

    def __init__(self, *arguments: Any) -> None:  # noqa: ANN401  (those of a simulator)
        super().__init__(*arguments)
        self.sense, self.begin_senses = self._simulator.sense, self._simulator.begin_senses
        self.restarts = 0

    def restart(self, *arguments: Any) -> None:  # noqa: ANN401  (those of a simulator)
        self.restarts += 1
        self._simulator.restart(*arguments)


@pytest.mark.parametrize("sensing", ["vsss", "vsss, forecast=1, forecast_others=1"])
def test_a_step_writes_what_is_sensed_afterwards(sensing: str) -> None:
    """Also where the referee restarts play between the two, and where some matches wait."""
    options: dict[str, Any] = {
        "sensing": sensing,
        "autoreset": "next_step",
        "max_steps": 300,
    }
    at_once = Matches("VSSMatch-v0", 6, 2, **options)
    assert at_once.play.senses is not None
    assert at_once.play.senses.own_rows is not None
    assert np.shares_memory(at_once.play.senses.own_rows, at_once.play.sensed.rows)
    made: list[Sensible] = []

    def simulator(*arguments: Any) -> Sensible:  # noqa: ANN401  (those of a simulator)
        made.append(Sensible(*arguments))
        return made[-1]

    afterwards = Matches("VSSMatch-v0", 6, 2, simulator=simulator, **options)
    first = [matches.reset() for matches in (at_once, afterwards)]
    assert first[0].tobytes() == first[1].tobytes()
    rng, shape = np.random.default_rng(0), (6, len(at_once.agents), at_once.action_size)
    actions = np.zeros(shape, np.float32)
    for step in range(700):
        if step % 20 == 0:
            actions = rng.uniform(-1.0, 1.0, shape).astype(np.float32)
        one, two = (matches.step(actions) for matches in (at_once, afterwards))
        assert one.observations.tobytes() == two.observations.tobytes()
        assert at_once.play.sensed.rows.tobytes() == afterwards.play.sensed.rows.tobytes()
    assert made[0].restarts > 0, "after goals and where the ball is stuck"


def test_a_simulator_steps_and_senses_at_once() -> None:
    config = TASKS["VSSSelfPlay-v0"].config.with_sensing(Sensing("vsss"))
    simulator, shape = Simulator(config, 3), (3, config.row_size)
    rows, known, expected = (np.full(shape, 7.0, np.float32) for _ in range(3))
    simulator.begin_senses(np.ones(3, np.bool_), np.arange(3, dtype=np.uint64))
    commands = np.full((3, 6, 2), 30.0, np.float32)
    active = np.array([True, False, True])
    for _ in range(20):
        simulator.step(commands, rows, active, sensed=known)
    simulator.sense(expected, active)
    assert known.tobytes() == expected.tobytes()
    assert (known[1] == 7.0).all()
    before = simulator.snapshot()
    with pytest.raises(ValueError, match=r"sensed must have shape \(3, "):
        simulator.step(commands, rows, sensed=known[:2])
    with pytest.raises(ValueError, match="sensed must be writeable: The given array is already"):
        simulator.step(commands, rows, sensed=rows)
    assert simulator.snapshot() == before


def test_a_simulator_without_senses_is_refused() -> None:
    with pytest.raises(TypeError, match=r"sensing: Plain has no senses \(sense, begin_senses\)"):
        Matches("VSS-v0", simulator=Plain, sensing="vsss")
    Matches("VSS-v0", simulator=Plain)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Sensing("vss"), "sensing must be one of none, friendly"),
        (lambda: Sensing(delay=-1.0), "sensing.delay must be finite and not negative"),
        (lambda: Sensing(missing=1.5), "sensing.missing_balls must be between 0 and 1"),
        (lambda: Sensing(noise=0.1), 'none has no "noise"; its numbers are frame_rate'),
        (lambda: Sensing("rc2021, delay=.1, delay=.2"), 'expected each number once, got "delay"'),
        (lambda: Sensing(position_noise=1e20), "ball_position_noise must be at most 100 m"),
        (lambda: Sensing(heading_noise=1e10), "heading_noise must be at most 100 rad"),
        (lambda: Sensing(camera_offset_error=101), "camera_offset_error must be at most 100 m"),
        (lambda: Sensing(odometry_noise=3e38), "odometry_noise must be at most 100 m/s"),
        (lambda: Sensing(gyroscope_noise=3e38), "gyroscope_noise must be at most 100 rad/s"),
        (lambda: Sensing(gyroscope_error=3e38), "gyroscope_error must be at most 100 rad/s"),
        (lambda: Sensing(kick_direction_noise=1e9), "kick_direction_noise must be at most 100 rad"),
        (lambda: Sensing("rc2021, delay=x"), '^sensing: expected number=value .*, got "delay=x"'),
        (lambda: Sensing("rc2021 delay=.1"), "^sensing: expected number=value after the name and"),
        (lambda: Sensing("rc2021, dely=.1"), '^sensing: rc2021 has no "dely"; its numbers are'),
    ],
)
def test_wrong_senses_are_refused(make: Callable[[], Sensing], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        make()


def test_the_largest_errors_leave_numbers_finite() -> None:
    largest = {"position_noise": 100, "heading_noise": 100, "camera_offset_error": 100}
    largest |= {"odometry_noise": 100, "gyroscope_noise": 100, "gyroscope_error": 100}
    largest |= {"kick_direction_noise": 100}
    for text in ("none", "odometry=1", "rc2021", "rc2021, forecast=1"):
        matches = Matches("SSLContestedPossession-v0", 2, sensing=Sensing(text, **largest))
        matches.reset(seed=1)
        actions = np.zeros((2, len(matches.agents), matches.action_size), np.float32)
        for _ in range(40):
            assert np.isfinite(matches.step(actions).observations).all()


def test_short_names_are_those_of_ball_and_robots_together() -> None:
    sensing = Sensing("rc2021", position_noise=0.01, missing=0.2, missing_balls=0.1)
    assert (sensing.ball_position_noise, sensing.robot_position_noise) == (0.01, 0.01)
    assert (sensing.missing_balls, sensing.missing_robots) == (0.1, 0.2)


def test_every_interface_takes_senses_and_variation() -> None:
    given: dict[str, Any] = {"sensing": "vsss", "randomization": {"robot.mass": (0.9, 1.1)}}
    parallel = rsoccer.parallel_env("VSSSelfPlay-v0", **given)
    single = rsoccer.single_env("VSS-v0", **given)
    vector = rsoccer.vector_env("VSS-v0", 2, **given)
    robots = rsoccer.robots_vector_env("VSSSelfPlay-v0", worlds=2, **given)
    same = Matches("VSS-v0", 2, 7, **given)
    first: Floats = same.reset()
    assert vector.reset(seed=7)[0].tobytes() == first[:, 0].tobytes()
    assert single.reset(seed=8)[0].tobytes() == first[1, 0].tobytes()
    for environment in (parallel, robots):
        environment.reset(seed=1)
    evaluation = rsoccer.evaluate("zero", "zero", 4, task="VSSSelfPlay-v0", **given)
    assert evaluation.matches == 4


# -- Cameras of each team ---------------------------------------------------------------------

OWN = Sensing("realistic", own_cameras=1)
NOBODY = {"all": rsoccer.LEARN}
"""Controllers that do not look, so that the matches are the same whatever is known."""


def known_to_teams(matches: Matches, steps: int = 40) -> list[Floats]:
    """(2, worlds, row) errors of what blue and yellow know, after each step of robots that rest.

    What a robot that drives knows turns its commands, so that it would drive elsewhere.
    """
    matches.reset()
    shape = (matches.worlds, len(matches.agents), matches.action_size)
    found = []
    for _ in range(steps):
        matches.step(np.zeros(shape, np.float32))
        known = [matches.play.known_to(team).rows for team in (0, 1)]
        found.append(np.stack(known) - matches.frame.rows)
    return found


@pytest.mark.parametrize("task", TASKS)
def test_each_team_knows_what_its_own_cameras_see(task: str) -> None:
    shared, own = (
        np.stack(known_to_teams(Matches(TASKS[task], 3, sensing=each, controllers=NOBODY)))
        for each in ("realistic", OWN)
    )
    assert np.array_equal(shared[:, 0], shared[:, 1])
    assert np.array_equal(own[:, 0], shared[:, 0])
    ball = own[..., :2]
    assert (ball[:, 0] != ball[:, 1]).mean() > 0.9
    sizes = np.sqrt((ball**2).mean(axis=(0, 2, 3)))
    assert 0.5 < sizes[0] / sizes[1] < 2.0


@pytest.mark.parametrize("forecast", [0, 1])
def test_cameras_of_each_team_are_the_same_in_any_batch_and_resumed(forecast: int) -> None:
    sensing = Sensing("realistic", own_cameras=1, forecast=forecast)
    alone = played(Matches(TASKS["SSLSelfPlay-v0"], 1, 5, sensing=sensing), 40)
    among = played(Matches(TASKS["SSLSelfPlay-v0"], 5, 5, threads=2, sensing=sensing), 40)
    assert alone == among
    ours, theirs = (Matches(TASKS["SSLSelfPlay-v0"], 2, n, sensing=sensing) for n in (0, 1))
    ours.reset()
    actions = np.full((2, len(ours.agents), ours.action_size), 0.3, np.float32)
    for _ in range(7):
        ours.step(actions)
    theirs.load_state_dict(ours.state_dict())
    for _ in range(7):
        ours.step(actions)
        theirs.step(actions)
    for team in (0, 1):
        assert np.array_equal(ours.play.known_to(team).rows, theirs.play.known_to(team).rows)


def test_a_team_without_opponents_that_look_has_its_own_cameras() -> None:
    matches = Matches("VSS-v0", 1, 0, sensing=OWN)
    assert matches.play.teams_differ
    errors = known_to_teams(matches, 10)
    assert not np.array_equal(errors[-1][0], errors[-1][1])
