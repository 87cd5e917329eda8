"""The old simulator's interface (rc-robosim): environments written for it run on this physics.

    import robosim                          # before
    from rsoccer.compat import robosim      # now

    sim = robosim.SSL(2, 1, 1, 25, [-0.1, 0, 0, 0], [[0, 0, 180]], [[-0.5, 0, 180]])
    sim.step([[0, 1.0, 0, 0, 0, 0, 0, 1], [0] * 8])  # drive on, dribbler running
    ball_x = sim.get_state()[0]

Code that is not yours finds it under the old name after `install()`:

    python -c "from rsoccer.compat import robosim; robosim.install(); import their_training"

Interface and robots are the old ones: the same arguments, actions and layout of states, the same
sizes, wheels and motors. The physics is this package's; `docs/robosim.md` lists what differs.
"""

import sys
from types import ModuleType
from typing import ClassVar, Final

import numpy as np

from rsoccer import checks
from rsoccer._core import BallModel, Field, RobotModel, SimConfig, Simulator
from rsoccer.compat import legacy_models
from rsoccer.compat.separation import make_room
from rsoccer.compat.wheel_kinematics import Wheels
from rsoccer.entities import Doubles, degrees, headings
from rsoccer.frame import Frame

__all__ = ["SSL", "VSS", "install"]

LONGEST_TICK: Final = 5  # ms; as in the rest of the package
LARGEST: Final = 1e9  # of any number given: what single precision can still square


class _World:
    """What both leagues share. Blue robots come first, everywhere."""

    _fields: ClassVar[tuple[Field, ...]]  # by `field_type`
    _ball: ClassVar[BallModel]
    _robot: ClassVar[RobotModel]
    _action: ClassVar[str]  # what a robot's row of actions is
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
        """Build a match and start it: see `reset` for the positions.

        Any whole number of milliseconds will do. A step is computed in ticks of 5 ms, or, where
        that does not divide it, in the fewest equal ones that are shorter.

        Raises:
            ValueError: no such field, too many robots for it, or positions as in `reset`.
            TypeError: what should be a whole number is none.
        """
        kind, step = (
            checks.integer("field_type", field_type, 0),
            checks.integer("time_step_ms", time_step_ms, 1),
        )
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
            tick=step / 1000.0 / -(-step // LONGEST_TICK),
        )
        self._simulator = Simulator(self._config)
        self._frame = Frame.empty(1, self._config.n_blue, self._config.n_yellow)
        self.reset(ball_pos, blue_robots_pos, yellow_robots_pos)

    def reset(self, ball_pos: object, blue_robots_pos: object, yellow_robots_pos: object) -> None:
        """Start a new match: ball `[x, y, v_x, v_y]`, robots `[x, y, degrees]`; lists or arrays.

        Robots start at rest. Bodies that overlap a little are moved apart: robots by up to 1 cm, a
        ball whose centre is outside out of the robot, straight ahead if it is at its front.

        Raises:
            ValueError: wrong numbers of robots or columns, what is not finite, or bodies outside
                or deeper in each other, by name. The old match goes on.
        """
        ball = _numbers("ball_pos", ball_pos, (4,), "x, y, v_x, v_y")
        poses = [
            _numbers(name, given, (n, 3), "x, y and degrees of each robot")
            for name, given, n in (
                ("blue_robots_pos", blue_robots_pos, self._config.n_blue),
                ("yellow_robots_pos", yellow_robots_pos, self._config.n_yellow),
            )
        ]
        robots = np.concatenate(poses)
        ahead = headings(robots[:, 2])
        place, places = make_room(
            ball[:2], robots[:, :2], ahead, self._robot, self._config.ball.radius
        )
        start = Frame.empty(1, self._config.n_blue, self._config.n_yellow)
        start.ball.position[0], start.ball.velocity[0] = place, ball[2:]
        start.robots.position[0], start.robots.heading[0] = places, ahead
        self._simulator.place(np.ones(1, np.bool_), start.rows, self._frame.rows)

    def step(self, actions: object) -> None:
        """Move one time step, a row of actions a robot.

        Raises:
            ValueError: wrong numbers of rows or columns, or what is not finite. Nothing has moved.
        """
        shape = (self._config.n_robots, self._action_size)
        commands = self._commands(_numbers("actions", actions, shape, self._action))
        columns = len(self._config.command_columns)  # none, where there is no robot
        told = np.array(commands[None, :, :columns], np.float32, order="C")
        self._simulator.step(told, self._frame.rows)

    def get_state(self) -> list[float]:
        """Ball `x, y, z, v_x, v_y`, then a robot's numbers each; reading changes nothing.

        `z` is the height of the ball's centre, a heading is within [0, 360).
        """
        ball = self._frame.ball
        height = ball.height + np.float32(self._config.ball.radius)
        parts = [ball.position[0], height, ball.velocity[0], self._robot_states().ravel()]
        state: list[float] = np.concatenate(parts, dtype=np.float64).tolist()
        return state

    def get_field_params(self) -> dict[str, float]:
        """Sizes of the field, the ball and the robots: metres, degrees, turns per minute."""
        return self._parameters(self._config.field)

    def _robot_states(self) -> Doubles:
        """(robots, numbers) where they are and how they move, degrees."""
        robots = self._frame.robots
        turned = np.mod(np.round(degrees(robots.heading[0]), 9), 360.0)  # -1e-20 is 0, not 360
        turning = np.degrees(robots.spin[0], dtype=np.float64)
        parts = [robots.position[0], turned[:, None], robots.velocity[0], turning[:, None]]
        return np.concatenate(parts, axis=1, dtype=np.float64)

    def _commands(self, actions: Doubles) -> Doubles:
        """(robots, command) what the simulator is told."""
        raise NotImplementedError

    def _parameters(self, field: Field) -> dict[str, float]:
        raise NotImplementedError


class VSS(_World):
    """Very small size: rows of `[left, right]` wheel speeds, rad/s; six numbers a robot.

    `field_type` 0 is the field for three a side, 1 the one for five. A robot's state is
    `x, y, degrees, v_x, v_y, degrees/s`.
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


class SSL(_World):
    """Small size: rows of eight numbers, by wheels or by the body's velocity; eleven a robot.

    `field_type` 0 is division A, 1 division B, 2 the hardware challenges. A row of actions is
    `[by_wheels, w_0, w_1, w_2, w_3, kick_v_x, kick_v_z, dribbler]`, rad/s and m/s, or, where
    `by_wheels` is not above 0, `[0, v_x, v_y, v_angle, unused, ...]`: forward, left (m/s) and
    turning (rad/s). The dribbler runs where it is above 0. A robot's state is as in VSS, and then
    `infrared` and the four wheel speeds that were asked for.
    """

    _fields = legacy_models.SSL_FIELDS
    _ball = legacy_models.SSL_BALL
    _robot = legacy_models.SSL_ROBOT
    _action = "by_wheels, four speeds, kick_v_x, kick_v_z and dribbler of each robot, blue first"
    _action_size = 8
    _wheels: ClassVar = Wheels(legacy_models.SSL_ROBOT)

    def reset(self, ball_pos: object, blue_robots_pos: object, yellow_robots_pos: object) -> None:
        """As in VSS; nothing has been asked of the wheels yet."""
        super().reset(ball_pos, blue_robots_pos, yellow_robots_pos)
        self._asked = np.zeros((self._config.n_robots, 4))

    def _commands(self, actions: Doubles) -> Doubles:
        by_wheels, bodies, wheels = actions[:, :1] > 0.0, actions[:, 1:4], actions[:, 1:5]
        self._asked = np.where(by_wheels, wheels, self._wheels.speeds(bodies))
        velocities = np.where(by_wheels, self._wheels.velocities(wheels), bodies)
        return np.concatenate([velocities, actions[:, 5:7], actions[:, 7:] > 0.0], axis=1)

    def _robot_states(self) -> Doubles:
        infrared = self._frame.robots.infrared[0, :, None]
        return np.concatenate([super()._robot_states(), infrared, self._asked], axis=1)

    def _parameters(self, field: Field) -> dict[str, float]:
        return legacy_models.ssl_parameters(field)


def install(*, force: bool = False) -> ModuleType:
    """Let `import robosim` find this module, from now on and in this process.

    Raises:
        RuntimeError: another robosim has been imported; `force` replaces it for later imports.
    """
    here = sys.modules[__name__]
    other = sys.modules.get("robosim") or here
    if other is not here and not force:
        place = getattr(other, "__file__", None) or "a place unknown"
        raise RuntimeError(
            f"robosim has been imported from {place}; call install() before that, or "
            "install(force=True) to replace it for later imports"
        )
    sys.modules["robosim"] = here
    return here


def _numbers(name: str, given: object, shape: tuple[int, ...], meaning: str) -> Doubles:
    """Given numbers as an array of this shape, of its own."""
    expected = f"{name}: expected {' x '.join(map(str, shape))} numbers, {meaning}"
    try:
        array = np.array(given, np.float64)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{expected}; got {given!r}") from error
    if array.size == 0 and 0 in shape:
        array = array.reshape(shape)  # of no robots, however it is written
    if array.shape != shape:
        raise ValueError(f"{expected}; got shape {array.shape}")
    odd = np.argwhere(~(np.abs(array) <= LARGEST))
    if len(odd):
        place = tuple(odd[0].tolist())
        raise ValueError(f"{name}: expected finite numbers, got {array[place]} at {place}")
    return array
