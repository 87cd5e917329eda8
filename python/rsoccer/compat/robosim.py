"""The interface of rSim (rc-robosim 1.2), on this package's physics.

Environments written for rSim run with one import changed:

    import robosim                          # before
    from rsoccer.compat import robosim      # now

    sim = robosim.SSL(2, 1, 1, 25, [-0.1, 0, 0, 0], [[0, 0, 180]], [[-0.5, 0, 180]])
    sim.step([[0, 1.0, 0, 0, 0, 0, 0, 1], [0] * 8])  # drive forward, dribbler on
    ball_x = sim.get_state()[0]

Code of others finds this module under the name `robosim` after `install()`:

    python -c "from rsoccer.compat import robosim; robosim.install(); import their_training"

Arguments, actions, layout of states, sizes, wheels and motors are those of rSim. The physics
is this package's; `docs/coming-from-rsoccer-gym.md` lists the differences.
"""

import sys
from types import ModuleType
from typing import ClassVar, Final

import numpy as np

from rsoccer import checks
from rsoccer._core import BallModel, Field, RobotModel, SimConfig, Simulator
from rsoccer.arrays import Doubles
from rsoccer.compat import legacy_models
from rsoccer.compat.separation import separate
from rsoccer.compat.wheel_kinematics import WheelKinematics
from rsoccer.entities import degrees, headings
from rsoccer.frame import Frame

__all__ = ["SSL", "VSS", "install"]

MAX_TICK: Final = 5  # ms; as in the rest of the package
MAX_MAGNITUDE: Final = 1e9  # of any argument: single precision can still square it


class _Simulation:
    """Base of both leagues. Arrays of robots have blue robots first."""

    _fields: ClassVar[tuple[Field, ...]]  # by `field_type`
    _ball: ClassVar[BallModel]
    _robot: ClassVar[RobotModel]
    _action: ClassVar[str]  # description of a robot's row of actions, for errors
    _action_size: ClassVar[int]

    def __init__(
        self,
        field_type: int,
        n_robots_blue: int,
        n_robots_yellow: int,
        time_step_ms: int,
        ball_pos: object,
        blue_robots_pos: object,
        yellow_robots_pos: object,
    ) -> None:
        """Build a match and start it.

        Args:
            field_type: number of the field, see the class.
            n_robots_blue: number of blue robots.
            n_robots_yellow: number of yellow robots.
            time_step_ms: duration of a step, any whole number of milliseconds from 1. A step is
                computed in ticks of 5 ms or, where 5 ms does not divide it, in the fewest equal
                ticks that are shorter.
            ball_pos: as in `reset`.
            blue_robots_pos: as in `reset`.
            yellow_robots_pos: as in `reset`.

        Raises:
            ValueError: no such field, too many robots for it, or positions as in `reset`.
            TypeError: a whole number was expected.
        """
        kind = checks.integer("field_type", field_type, 0)
        step = checks.integer("time_step_ms", time_step_ms, 1)
        if kind >= len(self._fields):
            known = {number: field.name for number, field in enumerate(self._fields)}
            raise ValueError(f"field_type: expected one of {known}, got {kind}")
        self._config = SimConfig(
            self._fields[kind],
            checks.integer("n_robots_blue", n_robots_blue, 0),
            checks.integer("n_robots_yellow", n_robots_yellow, 0),
            robot=self._robot,
            ball=self._ball,
            time_step=step / 1000.0,
            tick=step / 1000.0 / -(-step // MAX_TICK),
        )
        self._simulator = Simulator(self._config)
        self._frame = Frame.empty(1, self._config.n_blue, self._config.n_yellow)
        self.reset(ball_pos, blue_robots_pos, yellow_robots_pos)

    def reset(self, ball_pos: object, blue_robots_pos: object, yellow_robots_pos: object) -> None:
        """Start a new match; robots start at rest.

        Bodies that overlap slightly are moved apart: robots that overlap by up to 1 cm; a ball
        whose center is outside the robot, straight ahead if it is at the robot's front.

        Args:
            ball_pos: ball `[x, y, v_x, v_y]`, meters and m/s; a list or array.
            blue_robots_pos: `[x, y, degrees]` of each blue robot.
            yellow_robots_pos: `[x, y, degrees]` of each yellow robot.

        Raises:
            ValueError: wrong numbers of robots or columns, numbers that are not finite, or bodies
                outside the field or deeper in each other, by name. The current match goes on.
        """
        ball = _numbers("ball_pos", ball_pos, (4,), "x, y, v_x, v_y")
        poses = [
            _numbers(name, positions, (n, 3), "x, y and degrees of each robot")
            for name, positions, n in (
                ("blue_robots_pos", blue_robots_pos, self._config.n_blue),
                ("yellow_robots_pos", yellow_robots_pos, self._config.n_yellow),
            )
        ]
        robots = np.concatenate(poses)
        directions = headings(robots[:, 2])
        ball_position, positions = separate(
            ball[:2], robots[:, :2], directions, self._robot, self._config.ball.radius
        )
        start = Frame.empty(1, self._config.n_blue, self._config.n_yellow)
        start.ball.position[0], start.ball.velocity[0] = ball_position, ball[2:]
        start.robots.position[0], start.robots.heading[0] = positions, directions
        self._simulator.place(np.ones(1, np.bool_), start.rows, self._frame.rows)

    def step(self, actions: object) -> None:
        """Simulate one time step.

        Args:
            actions: a row of actions for each robot, blue first; see the class.

        Raises:
            ValueError: wrong numbers of rows or columns, or numbers that are not finite. The
                state is unchanged.
        """
        shape = (self._config.n_robots, self._action_size)
        commands = self._commands(_numbers("actions", actions, shape, self._action))
        columns = len(self._config.command_columns)  # 0 without robots
        rows = np.array(commands[None, :, :columns], np.float32, order="C")
        self._simulator.step(rows, self._frame.rows)

    def get_state(self) -> list[float]:
        """Return the state; reading it changes nothing.

        Returns:
            Ball `x, y, z, v_x, v_y`, then the numbers of each robot, blue first; see the class.
            Meters and m/s; `z` is the height of the ball's center, a heading is in [0, 360)
            degrees.
        """
        ball = self._frame.ball
        height = ball.height + np.float32(self._config.ball.radius)
        parts = [ball.position[0], height, ball.velocity[0], self._robot_states().ravel()]
        state: list[float] = np.concatenate(parts, dtype=np.float64).tolist()
        return state

    def get_field_params(self) -> dict[str, float]:
        """Return sizes of the field, the ball and the robots.

        Returns:
            Parameters by rSim's names: meters, degrees, turns per minute.
        """
        return self._parameters(self._config.field)

    def _robot_states(self) -> Doubles:
        """Poses and velocities (robots, numbers), degrees."""
        robots = self._frame.robots
        turned = np.mod(np.round(degrees(robots.heading[0]), 9), 360.0)  # -1e-20 is 0, not 360
        angular_velocity = np.degrees(robots.angular_velocity[0], dtype=np.float64)
        parts = [robots.position[0], turned[:, None], robots.velocity[0], angular_velocity[:, None]]
        return np.concatenate(parts, axis=1, dtype=np.float64)

    def _commands(self, actions: Doubles) -> Doubles:
        """Commands (robots, command) of the simulator for actions (robots, action)."""
        raise NotImplementedError

    def _parameters(self, field: Field) -> dict[str, float]:
        """Result of `get_field_params`."""
        raise NotImplementedError


class VSS(_Simulation):
    """A VSS match (very small size): robots with two wheels.

    `field_type` 0 is the field for three a side, 1 the one for five. A row of actions is
    `[left, right]`, wheel speeds in rad/s. A robot's state has six numbers: `x, y` (m), heading
    (degrees), `v_x, v_y` (m/s), angular velocity (degrees/s).
    """

    _fields = legacy_models.VSS_FIELDS
    _ball = legacy_models.VSS_BALL
    _robot = legacy_models.VSS_ROBOT
    _action = "left and right wheel speed of each robot, blue first"
    _action_size = 2

    def _commands(self, actions: Doubles) -> Doubles:
        return actions

    def _parameters(self, field: Field) -> dict[str, float]:
        return legacy_models.vss_parameters(field)


class SSL(_Simulation):
    """An SSL match (small size): omnidirectional robots with kicker and dribbler.

    `field_type` 0 is division A, 1 division B, 2 the hardware challenges. A row of actions has
    eight numbers:

    | index | with index 0 above 0 | otherwise |
    | --- | --- | --- |
    | 0 | control by wheels | control by the body's velocity |
    | 1 | speed of wheel 0, rad/s | velocity forward, m/s |
    | 2 | speed of wheel 1, rad/s | velocity to the left, m/s |
    | 3 | speed of wheel 2, rad/s | angular velocity, rad/s |
    | 4 | speed of wheel 3, rad/s | unused |
    | 5, 6 | kick forward and upward, m/s | the same |
    | 7 | dribbler, on above 0 | the same |

    A robot's state has eleven numbers: the six of VSS, `infrared` (1 if the ball cuts the beam)
    and the four commanded wheel speeds (rad/s).
    """

    _fields = legacy_models.SSL_FIELDS
    _ball = legacy_models.SSL_BALL
    _robot = legacy_models.SSL_ROBOT
    _action = "by_wheels, four speeds, kick_v_x, kick_v_z and dribbler of each robot, blue first"
    _action_size = 8
    _kinematics: ClassVar = WheelKinematics(legacy_models.SSL_ROBOT)

    def reset(self, ball_pos: object, blue_robots_pos: object, yellow_robots_pos: object) -> None:
        """Start a new match; the commanded wheel speeds become 0."""
        super().reset(ball_pos, blue_robots_pos, yellow_robots_pos)
        self._wheel_commands = np.zeros((self._config.n_robots, 4))

    def _commands(self, actions: Doubles) -> Doubles:
        by_wheels, bodies, wheels = actions[:, :1] > 0.0, actions[:, 1:4], actions[:, 1:5]
        self._wheel_commands = np.where(by_wheels, wheels, self._kinematics.wheel_speeds(bodies))
        velocities = np.where(by_wheels, self._kinematics.body_velocities(wheels), bodies)
        return np.concatenate([velocities, actions[:, 5:7], actions[:, 7:] > 0.0], axis=1)

    def _robot_states(self) -> Doubles:
        infrared = self._frame.robots.infrared[0, :, None]
        return np.concatenate([super()._robot_states(), infrared, self._wheel_commands], axis=1)

    def _parameters(self, field: Field) -> dict[str, float]:
        return legacy_models.ssl_parameters(field)


def install(*, force: bool = False) -> ModuleType:
    """Make `import robosim` find this module, in this process.

    Args:
        force: replace another robosim that has been imported, for later imports.

    Returns:
        This module.

    Raises:
        RuntimeError: another robosim has been imported, and `force` is False.
    """
    here = sys.modules[__name__]
    other = sys.modules.get("robosim") or here
    if other is not here and not force:
        origin = getattr(other, "__file__", None) or "an unknown place"
        raise RuntimeError(
            f"robosim has been imported from {origin}; call install() before that, or "
            "install(force=True) to replace it for later imports"
        )
    sys.modules["robosim"] = here
    return here


def _numbers(name: str, values: object, shape: tuple[int, ...], meaning: str) -> Doubles:
    """A copy of values as an array of this shape, or ValueError."""
    expected = f"{name}: expected {' x '.join(map(str, shape))} numbers, {meaning}"
    try:
        array = np.array(values, np.float64)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{expected}; got {values!r}") from error
    if array.size == 0 and 0 in shape:
        array = array.reshape(shape)  # no robots, in any notation
    if array.shape != shape:
        raise ValueError(f"{expected}; got shape {array.shape}")
    invalid = np.argwhere(~(np.abs(array) <= MAX_MAGNITUDE))
    if len(invalid):
        index = tuple(invalid[0].tolist())
        raise ValueError(f"{name}: expected finite numbers, got {array[index]} at {index}")
    return array
