"""Tables of the presets, and checks of the presets against the cited numbers."""

from dataclasses import asdict
from math import pi

from benches.markdown import table
from rsoccer._core import BallModel, Field, RobotModel
from tools.physics.check import Checks, Criterion, percent
from tools.physics.cited import (
    BALLS,
    FIELDS,
    SSL_MIMICS,
    SSL_ROBOTS,
    SSL_SHARED,
    VSS_MIMICS,
    VSS_ROBOTS,
    Ball,
    SslRobot,
    VssRobot,
)

TOPIC = "presets"
CITED = Criterion(TOPIC, "preset number", "", percent(0.01), "cited source")
LIMITED = {"ssl_unknown", *SSL_MIMICS}  # have limits of their own


def checks() -> Checks:
    """Yield one check per cited number of a preset."""
    for name, ball in BALLS.items():
        yield from _compared("ball", name, BallModel(name), _fields(ball))
    for name, robot in (SSL_ROBOTS | SSL_MIMICS).items():
        shared = {} if name in LIMITED else {key: n.value for key, n in SSL_SHARED.items()}
        yield from _compared("robot", name, RobotModel(name), _fields(robot) | shared)
    for name, vss in (VSS_ROBOTS | VSS_MIMICS).items():
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
    """Return attributes of a model, four digits each, separated by slashes."""
    return " / ".join(f"{getattr(model, name):.4g}" for name in names)


def field_table() -> str:
    """Return the table of fields with their sources."""
    header = (
        "field",
        "length / width (m)",
        "goal width / depth / height (m)",
        "margin behind goal / touch lines (m)",
        "corner block, wall height (m)",
        "maximum robots per team",
        "source",
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
                _numbers(field, "corner_leg", "wall_height") if field.wall_height else "-",
                str(field.max_robots),
                FIELDS[name].source,
            )
        )
    return table(header, rows)


def ball_table() -> str:
    """Return the table of balls with their sources."""
    header = (
        "ball",
        "radius (mm)",
        "sliding / rolling deceleration (m/s²)",
        "rolling drag (1/s)",
        "rolling share",
        "hop ratios: first / later / vertical",
        "robot: restitution / friction",
        "wall: restitution / friction",
        "goal back: restitution / friction",
        "source",
    )
    rows = []
    for name in BallModel.PRESETS:
        ball = BallModel(name)
        surfaces = (
            _numbers(ball, f"{surface}_restitution", f"{surface}_friction")
            for surface in ("robot", "wall", "goal_back")
        )
        rows.append(
            (
                f"`{name}`",
                f"{1000 * ball.radius:.4g}",
                _numbers(ball, "sliding_deceleration", "rolling_deceleration"),
                f"{ball.rolling_drag:.3g}",
                f"{ball.slide_to_roll_ratio:.3g}",
                _numbers(ball, "first_hop_factor", "later_hop_factor", "vertical_restitution"),
                *surfaces,
                BALLS[name].source,
            )
        )
    return table(header, rows)


def ssl_table() -> str:
    """Return the table of the numbers in which SSL robots differ."""
    header = (
        "robot",
        "command",
        "radius / front / height (mm)",
        "mass (kg)",
        "mouth width (mm)",
        "maximum kick / chip (m/s)",
        "top speed, angular velocity (m/s, rad/s)",
        "wheel angles (degrees)",
    )
    rows = []
    for name in SSL_ROBOTS | SSL_MIMICS:
        robot = RobotModel(name)
        command = "wheel speeds" if robot.drive == "omni_wheels" else "body velocity"
        sizes = (1000 * size for size in (robot.radius, robot.front_distance, robot.height))
        rows.append(
            (
                f"`{name}`",
                command,
                " / ".join(f"{size:.4g}" for size in sizes),
                f"{robot.mass:.4g}",
                f"{1000 * robot.mouth_width:.4g}",
                _numbers(robot, "max_kick_speed", "max_chip_speed"),
                _numbers(robot, "top_speed", "top_angular_velocity"),
                " ".join(f"{angle:g}" for angle in robot.wheel_angles),
            )
        )
    return table(header, rows)


def shared_table() -> str:
    """Return the table of the parameters that SSL robots share, with their sources."""
    robot = RobotModel("ssl_generic")
    rows = []
    for name, cited in SSL_SHARED.items():
        value = f"{getattr(robot, name):.4g} {cited.unit}".strip()
        rows.append((f"`{name}`", value, cited.source))
    return table(("parameter", "value", "source"), rows)


def vss_table() -> str:
    """Return the table of VSSS robots with their sources."""
    header = (
        "robot",
        "side / height (mm)",
        "mass (g)",
        "wheel radius / track (mm)",
        "top speed, angular velocity (m/s, rad/s)",
        "torque per wheel (N m)",
        "grip forward / sideways (m/s²)",
        "tipping friction / skid slip (m/s)",
        "restitution / friction",
        "source",
    )
    rows = []
    for name, cited in (VSS_ROBOTS | VSS_MIMICS).items():
        robot = RobotModel(name)
        rows.append(
            (
                f"`{name}`",
                f"{1000 * robot.side_length:.4g} / {1000 * robot.height:.4g}",
                f"{1000 * robot.mass:.4g}",
                f"{1000 * robot.wheel_radius:.4g} / {1000 * robot.track_width:.4g}",
                _numbers(robot, "top_speed", "top_angular_velocity"),
                _numbers(robot, "motor_torque"),
                _numbers(robot, "longitudinal_grip", "lateral_grip"),
                _numbers(robot, "tipping_friction", "skid_slip"),
                _numbers(robot, "restitution", "friction"),
                cited.source,
            )
        )
    return table(header, rows)
