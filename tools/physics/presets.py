"""The presets as tables, and whether they carry the numbers that are cited."""

from dataclasses import asdict
from math import pi

from rsoccer._core import BallModel, Field, RobotModel
from tools.parts import table
from tools.physics.check import Checks, Line, percent
from tools.physics.cited import (
    BALLS,
    FIELDS,
    SSL_ROBOTS,
    SSL_SHARED,
    VSS_ROBOTS,
    Ball,
    SslRobot,
    VssRobot,
)

TOPIC = "presets"
CITED = Line(TOPIC, "number of a preset", "", percent(0.01), "cited")
LIMITED = {"ssl_unknown"}  # has limits of its own


def checks() -> Checks:
    """Every number that is cited of a preset."""
    for name, ball in BALLS.items():
        yield from _compared("ball", name, BallModel(name), _fields(ball))
    for name, robot in SSL_ROBOTS.items():
        shared = {} if name in LIMITED else {key: n.value for key, n in SSL_SHARED.items()}
        yield from _compared("robot", name, RobotModel(name), _fields(robot) | shared)
    for name, vss in VSS_ROBOTS.items():
        cited = _fields(vss) | {"max_wheel_speed": vss.rpm / 60 * 2 * pi}
        del cited["rpm"]
        yield from _compared("robot", name, RobotModel(name), cited)
    for name, pitch in FIELDS.items():
        yield from _compared("field", name, Field(name), pitch.numbers)


def _fields(cited: Ball | SslRobot | VssRobot) -> dict[str, float]:
    numbers = asdict(cited)
    numbers.pop("source", None)
    return numbers


def _compared(kind: str, name: str, preset: object, cited: dict[str, float]) -> Checks:
    for number, value in cited.items():
        yield CITED(f"{kind} `{name}`, {number}", value, getattr(preset, number))


def _numbers(model: object, *names: str) -> str:
    """Numbers of a model, three digits, with slashes between them."""
    return " / ".join(f"{getattr(model, name):.4g}" for name in names)


def field_table() -> str:
    """Fields and where their numbers are from."""
    header = (
        "field",
        "length / width (m)",
        "goal width / depth / height (m)",
        "beyond goal / touch lines (m)",
        "corner, walls' height (m)",
        "robots a side, at most",
        "from",
    )
    rows = []
    for name in Field.PRESETS:
        field = Field(name)
        rows.append(
            (
                f"`{name}`",
                _numbers(field, "length", "width"),
                _numbers(field, "goal_width", "goal_depth", "goal_height"),
                _numbers(field, "goal_line_margin", "touch_line_margin"),
                _numbers(field, "corner", "wall_height") if field.wall_height else "-",
                str(field.max_robots),
                FIELDS[name].source,
            )
        )
    return table(header, rows)


def ball_table() -> str:
    """Balls and where their numbers are from."""
    header = (
        "ball",
        "radius (mm)",
        "slide / roll (m/s²)",
        "rolls at",
        "hop: first / later / up",
        "robot: restitution / friction",
        "wall",
        "goal's back",
        "from",
    )
    rows = []
    for name in BallModel.PRESETS:
        ball = BallModel(name)
        surfaces = (
            _numbers(ball, f"{what}_restitution", f"{what}_friction")
            for what in ("robot", "wall", "goal_back")
        )
        rows.append(
            (
                f"`{name}`",
                f"{1000 * ball.radius:.4g}",
                _numbers(ball, "sliding_deceleration", "rolling_deceleration"),
                f"{ball.rolling_share:.3g}",
                _numbers(ball, "hop_first", "hop_later", "hop_up"),
                *surfaces,
                BALLS[name].source,
            )
        )
    return table(header, rows)


def ssl_table() -> str:
    """SSL robots: what sets them apart."""
    header = (
        "robot",
        "told",
        "radius / front / height (mm)",
        "mass (kg)",
        "mouth (mm)",
        "kick / chip (m/s)",
        "top speed, turn rate (m/s, rad/s)",
        "wheels (degrees)",
    )
    rows = []
    for name in SSL_ROBOTS:
        robot = RobotModel(name)
        told = "wheel speeds" if robot.drive == "omni_wheels" else "body velocity"
        sizes = (1000 * size for size in (robot.radius, robot.front, robot.height))
        rows.append(
            (
                f"`{name}`",
                told,
                " / ".join(f"{size:.4g}" for size in sizes),
                f"{robot.mass:.4g}",
                f"{1000 * robot.mouth_width:.4g}",
                _numbers(robot, "max_kick", "max_chip"),
                _numbers(robot, "top_speed", "top_turn_rate"),
                " ".join(f"{angle:g}" for angle in robot.wheel_angles),
            )
        )
    return table(header, rows)


def shared_table() -> str:
    """Numbers that SSL robots share, with their sources."""
    robot = RobotModel("ssl_generic")
    rows = []
    for name, cited in SSL_SHARED.items():
        value = f"{getattr(robot, name):.4g} {cited.unit}".strip()
        rows.append((f"`{name}`", value, cited.source))
    return table(("number", "value", "from"), rows)


def vss_table() -> str:
    """VSSS robots and where their numbers are from."""
    header = (
        "robot",
        "side / height (mm)",
        "mass (g)",
        "wheel radius / track (mm)",
        "top speed, turn rate (m/s, rad/s)",
        "torque a wheel (N m)",
        "grip forward / aside (m/s²)",
        "from",
    )
    rows = []
    for name, cited in VSS_ROBOTS.items():
        robot = RobotModel(name)
        rows.append(
            (
                f"`{name}`",
                f"{1000 * robot.side:.4g} / {1000 * robot.height:.4g}",
                f"{1000 * robot.mass:.4g}",
                f"{1000 * robot.wheel_radius:.4g} / {1000 * robot.track:.4g}",
                _numbers(robot, "top_speed", "top_turn_rate"),
                _numbers(robot, "motor_torque"),
                _numbers(robot, "forward_grip", "side_grip"),
                cited.source,
            )
        )
    return table(header, rows)
