"""Robots, balls and delays whose numbers are known are identified from their logs."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rsoccer import BallModel, Field, RobotModel, Sensing
from rsoccer.identify import Identified, Log, identify, program, record
from rsoccer.option_values import encoded, read_model
from tests.identify.logs import ROBOT, rows_of, true_gains

LATENCY = 0.073
SSL = RobotModel("ssl_generic")
VSS = RobotModel("vss_440rpm")
LIMITS = (
    *("max_acceleration", "max_deceleration"),
    *("max_angular_acceleration", "max_angular_deceleration"),
)
SLOW = RobotModel(
    "ssl_generic", max_speed=2.8, **{each: 0.7 * getattr(SSL, each) for each in LIMITS}
)
SENSES = Sensing("rc2021", delay=0.053, command_delay=0.02, wheel_error=0.01)
GAINS = (0.9, 0.94, 1.04)
SEED = 4  # of a robot whose wheels err by more than a few parts in a thousand
SLOW_VSS = RobotModel("vss_440rpm", longitudinal_grip=0.7 * VSS.longitudinal_grip)
VSS_GAINS = (0.9, 0.93)


@pytest.fixture(scope="module")
def ssl_log() -> Log:
    ball = BallModel("ssl_tigers", rolling_deceleration=0.3)
    return record(SLOW, ball, SENSES, excitation=program(SSL), gains=GAINS, seed=SEED)


@pytest.fixture(scope="module")
def ssl(ssl_log: Log) -> Identified:
    return identify(ssl_log)


@pytest.fixture(scope="module")
def vss_log() -> Log:
    ball = BallModel("vss_rsim", rolling_deceleration=0.3)
    senses = Sensing("rc2021", delay=0.053, command_delay=0.02)
    return record(SLOW_VSS, ball, senses, excitation=program(VSS), gains=VSS_GAINS, seed=SEED)


@pytest.fixture(scope="module")
def vss(vss_log: Log) -> Identified:
    return identify(vss_log)


def test_delay_and_drive_of_an_ssl_robot(ssl: Identified) -> None:
    assert ssl.estimate("latency").value == pytest.approx(LATENCY, abs=0.002)
    exact = true_gains(SLOW, SENSES, SEED, 1.0)
    assert max(abs(gain - 1.0) for gain in exact) > 0.002, "wheels have errors"
    for name, gain, own in zip(("forward", "sideways", "turning"), GAINS, exact, strict=True):
        assert ssl.estimate(f"gain_{name}").value == pytest.approx(gain * own, rel=0.02)
    for name in LIMITS:
        assert ssl.estimate(name).value == pytest.approx(getattr(SLOW, name), rel=0.1)
        assert getattr(ssl.robot, name) == pytest.approx(ssl.estimate(name).value, rel=1e-5)
    for axis in ("forward", "sideways"):
        found = ssl.estimate(f"acceleration_{axis}").value
        assert found == pytest.approx(SLOW.max_acceleration, rel=0.1)
        found = ssl.estimate(f"deceleration_{axis}").value
        assert found == pytest.approx(SLOW.max_deceleration, rel=0.1)
    # Wheels that turn too fast or slow scale the top speed, too.
    assert ssl.estimate("max_speed").value == pytest.approx(2.8, rel=0.03)
    assert not ssl.estimate("max_angular_velocity").is_identified
    assert ssl.misfit == pytest.approx(1.0, abs=0.2)


def test_rolling_kicks_and_cameras(ssl: Identified) -> None:
    assert ssl.ball.rolling_deceleration == pytest.approx(0.3, rel=0.05)
    assert ssl.estimate("sliding_deceleration").value == pytest.approx(3.0, rel=0.05)
    assert ssl.estimate("slide_to_roll_ratio").value == pytest.approx(2 / 3, rel=0.02)
    assert ssl.estimate("kick_gain").value == pytest.approx(1.0, rel=0.02)
    assert ssl.estimate("kick_latency").value == pytest.approx(LATENCY, abs=0.01)
    assert ssl.estimate("ball_position_noise").value == pytest.approx(0.001, rel=0.2)
    assert ssl.estimate("robot_position_noise").value == pytest.approx(0.0013, rel=0.2)
    assert ssl.estimate("heading_noise").value == pytest.approx(0.01, rel=0.2)
    assert ssl.sensing.frame_rate == pytest.approx(66.67, rel=0.01)
    assert ssl.sensing.delay == pytest.approx(LATENCY, abs=0.002)
    assert not ssl.estimate("command_delay").is_identified


def test_intervals_are_narrow_and_near_the_truth(ssl: Identified, vss: Identified) -> None:
    for found, name, truth in (
        (ssl, "latency", LATENCY),
        (ssl, "max_acceleration", SLOW.max_acceleration),
        (ssl, "rolling_deceleration", 0.3),
        (vss, "latency", LATENCY),
        (vss, "longitudinal_grip", SLOW_VSS.longitudinal_grip),
    ):
        each = found.estimate(name)
        width = each.high - each.low
        assert 0.0 < width < 0.2 * truth
        assert each.low - width < truth < each.high + width


def test_wheels_of_a_vsss_robot(vss: Identified) -> None:
    assert vss.estimate("latency").value == pytest.approx(LATENCY, abs=0.002)
    mean = sum(VSS_GAINS) / 2
    assert vss.robot.wheel_radius == pytest.approx(mean * VSS.wheel_radius, rel=0.02)
    assert vss.robot.track_width == pytest.approx(VSS.track_width, rel=0.02)
    difference = (VSS_GAINS[1] - VSS_GAINS[0]) / mean
    assert vss.estimate("wheel_difference").value == pytest.approx(difference, abs=0.005)
    grip = vss.robot.longitudinal_grip
    assert grip == pytest.approx(SLOW_VSS.longitudinal_grip, rel=0.1)
    assert vss.ball.rolling_deceleration == pytest.approx(0.3, rel=0.05)
    assert not vss.estimate("kick_gain").is_identified
    assert not vss.estimate("sliding_deceleration").is_identified
    assert vss.ball.sliding_deceleration == BallModel("vss_rsim").sliding_deceleration


def test_one_wheel_that_reaches_its_top_speed_by_a_little() -> None:
    mean, difference = 0.87, 0.0376
    gains = (mean * (1.0 - difference / 2.0), mean * (1.0 + difference / 2.0))
    excitation = program(VSS)
    fastest = np.abs(excitation.wheels * gains).max(axis=0) / VSS.max_wheel_speed
    assert fastest[0] < 1.0 < fastest[1] < 1.05
    exact = Sensing("rc2021", delay=0.053, command_delay=0.02)
    found = identify(record(VSS, None, exact, excitation=excitation, gains=gains, seed=18), VSS)
    assert found.estimate("wheel_difference").value == pytest.approx(difference, abs=0.002)
    assert found.misfit == pytest.approx(1.0, abs=0.1)


@pytest.mark.parametrize(("robot", "seed"), [(SSL, 0), (VSS, 1)])
def test_lost_commands_do_not_change_the_latency(robot: RobotModel, seed: int) -> None:
    """A lost command delays a step by a frame, which shifts a fit of all windows."""
    senses = Sensing("rc2021", delay=0.05, command_delay=0.02, command_loss=0.08)
    log = record(robot, sensing=senses, excitation=program(robot), seed=seed)
    latency = identify(log, robot).estimate("latency")
    assert latency.value == pytest.approx(0.07, abs=0.0003)
    assert latency.low < 0.07 < latency.high
    assert latency.high - latency.low < 0.001


def test_the_file_names_each_model(ssl: Identified, tmp_path: Path) -> None:
    path = str(ssl.save(tmp_path / "model.json"))
    assert RobotModel(path).max_acceleration == pytest.approx(ssl.robot.max_acceleration, rel=1e-5)
    assert BallModel(path).rolling_deceleration == pytest.approx(
        ssl.ball.rolling_deceleration, rel=1e-5
    )
    assert Sensing(path).delay == pytest.approx(ssl.sensing.delay, rel=1e-5)
    assert read_model("robot", path, RobotModel) == RobotModel(path)
    assert list(encoded("robot", path)) == ["RobotModel"]
    assert list(encoded("ball", path)) == ["BallModel"]
    content = json.loads(Path(path).read_text())
    assert set(content["not_identified"]) >= {"max_angular_velocity", "command_delay"}
    assert content["estimates"]["latency"]["unit"] == "s"
    with pytest.raises(ValueError, match="field"):
        read_model("field", path, Field)


def test_the_same_log_and_seed_give_the_same_numbers(vss_log: Log, vss: Identified) -> None:
    assert identify(vss_log).as_dict() == vss.as_dict()
    other = identify(vss_log, seed=1)
    assert other.robot == vss.robot
    # An interval that the scatter alone makes wide enough does not depend on the seed.
    assert other.as_dict()["estimates"] != vss.as_dict()["estimates"]


def test_stamps_of_captures_tell_the_delays_apart(vss_log: Log) -> None:
    track = vss_log.poses[ROBOT]
    stamped = {
        ROBOT: type(track)(track.times, track.positions, track.headings, track.times - 0.053)
    }
    found = identify(Log(vss_log.drive, vss_log.commands, stamped, vss_log.ball))
    assert found.sensing.delay == pytest.approx(0.053, abs=1e-6)
    assert found.sensing.command_delay == pytest.approx(0.02, abs=0.002)


def test_two_clocks(vss_log: Log, vss: Identified) -> None:
    track = vss_log.poses[ROBOT]
    late = 1.7e9 + 0.004
    moved = {
        ROBOT: type(track)(track.times + late, track.positions, track.headings, track.captured)
    }
    log = Log(vss_log.drive, vss_log.commands, moved, vss_log.ball)
    with pytest.raises(ValueError, match="clocks=2"):
        identify(log)
    found = identify(log, clocks=2)
    assert not found.estimate("latency").is_identified
    assert found.sensing.delay == 0.0
    assert found.robot.longitudinal_grip == pytest.approx(vss.robot.longitudinal_grip, rel=0.02)


def test_kicks_by_two_clocks(ssl_log: Log) -> None:
    # By the clock of the poses, each kick seems to be that of the command before it.
    late = -2.4
    moved = [
        type(track)(track.times + late, track.positions, track.headings, track.captured)
        for track in (ssl_log.poses[ROBOT], ssl_log.ball)
    ]
    found = identify(Log(ssl_log.drive, ssl_log.commands, {ROBOT: moved[0]}, moved[1]), clocks=2)
    assert found.estimate("kick_gain").value == pytest.approx(1.0, rel=0.02)
    assert not found.estimate("kick_latency").is_identified


def test_what_commands_do_not_show_is_not_identified() -> None:
    forward = program(SSL, max_speed=1.0, max_angular_velocity=1.0)
    only = forward.wheels * np.array([1.0, 0.0, 0.0])
    straight = type(forward)("omni", forward.times, only, 0.0 * forward.kicks, forward.seconds, ())
    found = identify(record(SSL, sensing=Sensing("rc2021", delay=0.05), excitation=straight))
    assert found.estimate("gain_forward").value == pytest.approx(1.0, rel=0.02)
    missing = {each.name for each in found.estimates if not each.is_identified}
    assert missing >= {"gain_sideways", "gain_turning", "max_speed", "max_angular_velocity"}
    assert missing >= {"max_angular_acceleration", "rolling_deceleration", "kick_gain"}
    assert found.robot.max_angular_acceleration == SSL.max_angular_acceleration
    assert found.estimate("acceleration_sideways").hint.startswith("needs")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"x": 1000.0, "y": 1000.0}, "millimeters"),
        ({"theta": 180.0 / np.pi}, "degrees"),
        ({"v_x": 1000.0, "v_y": 1000.0}, "millimeters per second"),
        ({"v_theta": 180.0 / np.pi}, "degrees per second"),
        ({"time": 1000.0}, "milliseconds"),
        ({"v_theta": -1.0}, "sign"),
        ({"v_x": -1.0}, "sign"),
    ],
)
def test_mixed_up_units_are_refused_with_a_hint(
    ssl_log: Log, change: dict[str, float], message: str
) -> None:
    rows = rows_of(ssl_log)
    for row in rows:
        for name, factor in change.items():
            if name in row:
                row[name] = float(str(row[name])) * factor
    with pytest.raises(ValueError, match=message):
        identify(Log.of_rows(rows))


def test_small_commands_in_degrees_are_noticed_too() -> None:
    slow = program(SSL, max_speed=1.0, max_angular_velocity=1.5)
    log = record(SSL, excitation=slow)
    rows = rows_of(log)
    for row in rows:
        if "v_theta" in row:
            row["v_theta"] = float(str(row["v_theta"])) * 180.0 / np.pi
    assert max(float(str(row.get("v_theta", 0.0))) for row in rows) < 100.0
    with pytest.raises(ValueError, match="degrees per second"):
        identify(Log.of_rows(rows))


def test_bad_arguments_are_refused(vss_log: Log) -> None:
    with pytest.raises(ValueError, match="robot: expected one of drive differential"):
        identify(vss_log, "ssl_generic")
    with pytest.raises(ValueError, match="robot: "):
        identify(vss_log, "nobody")
    with pytest.raises(ValueError, match="expected a drive of omni, differential"):
        identify(vss_log, "ssl_generic_wheels")
    with pytest.raises(TypeError, match="ball: "):
        identify(vss_log, ball=3)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="clocks: "):
        identify(vss_log, clocks=3)


@pytest.mark.parametrize("clocks", [1, 2])
def test_a_log_without_driving_still_shows_the_ball(ssl_log: Log, clocks: int) -> None:
    """Robots that stand and kick have commands."""
    still = {
        robot: replace(commands, wheels=0.0 * commands.wheels)
        for robot, commands in ssl_log.commands.items()
    }
    found = identify(replace(ssl_log, commands=still), clocks=clocks)
    assert found.estimate("latency").hint == "needs commands to drive"
    assert found.estimate("rolling_deceleration").is_identified
    assert found.estimate("kick_gain").is_identified == (clocks == 1)


def test_logs_that_show_nothing_are_refused(vss_log: Log) -> None:
    poses = [{"time": 0.02 * n, "robot": "a", "x": 0.0, "y": 0.0, "theta": 0.0} for n in range(99)]
    with pytest.raises(ValueError, match="nothing can be identified"):
        identify(Log.of_rows(poses))
    renamed = {"someone": vss_log.commands[ROBOT]}
    with pytest.raises(ValueError, match="of the same robot"):
        identify(Log(vss_log.drive, renamed, vss_log.poses, vss_log.ball))
