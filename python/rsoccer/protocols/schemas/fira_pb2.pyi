from google.protobuf.internal import containers as _containers
from google.protobuf import descriptor as _descriptor
from google.protobuf import message as _message
from collections.abc import Iterable as _Iterable, Mapping as _Mapping
from typing import ClassVar as _ClassVar, Optional as _Optional, Union as _Union

DESCRIPTOR: _descriptor.FileDescriptor

class Packet(_message.Message):
    __slots__ = ("cmd", "replace")
    CMD_FIELD_NUMBER: _ClassVar[int]
    REPLACE_FIELD_NUMBER: _ClassVar[int]
    cmd: Commands
    replace: Replacement
    def __init__(self, cmd: _Optional[_Union[Commands, _Mapping]] = ..., replace: _Optional[_Union[Replacement, _Mapping]] = ...) -> None: ...

class Commands(_message.Message):
    __slots__ = ("robot_commands",)
    ROBOT_COMMANDS_FIELD_NUMBER: _ClassVar[int]
    robot_commands: _containers.RepeatedCompositeFieldContainer[Command]
    def __init__(self, robot_commands: _Optional[_Iterable[_Union[Command, _Mapping]]] = ...) -> None: ...

class Command(_message.Message):
    __slots__ = ("id", "yellowteam", "wheel_left", "wheel_right")
    ID_FIELD_NUMBER: _ClassVar[int]
    YELLOWTEAM_FIELD_NUMBER: _ClassVar[int]
    WHEEL_LEFT_FIELD_NUMBER: _ClassVar[int]
    WHEEL_RIGHT_FIELD_NUMBER: _ClassVar[int]
    id: int
    yellowteam: bool
    wheel_left: float
    wheel_right: float
    def __init__(self, id: _Optional[int] = ..., yellowteam: _Optional[bool] = ..., wheel_left: _Optional[float] = ..., wheel_right: _Optional[float] = ...) -> None: ...

class Replacement(_message.Message):
    __slots__ = ("ball", "robots")
    BALL_FIELD_NUMBER: _ClassVar[int]
    ROBOTS_FIELD_NUMBER: _ClassVar[int]
    ball: BallReplacement
    robots: _containers.RepeatedCompositeFieldContainer[RobotReplacement]
    def __init__(self, ball: _Optional[_Union[BallReplacement, _Mapping]] = ..., robots: _Optional[_Iterable[_Union[RobotReplacement, _Mapping]]] = ...) -> None: ...

class BallReplacement(_message.Message):
    __slots__ = ("x", "y", "vx", "vy")
    X_FIELD_NUMBER: _ClassVar[int]
    Y_FIELD_NUMBER: _ClassVar[int]
    VX_FIELD_NUMBER: _ClassVar[int]
    VY_FIELD_NUMBER: _ClassVar[int]
    x: float
    y: float
    vx: float
    vy: float
    def __init__(self, x: _Optional[float] = ..., y: _Optional[float] = ..., vx: _Optional[float] = ..., vy: _Optional[float] = ...) -> None: ...

class RobotReplacement(_message.Message):
    __slots__ = ("position", "yellowteam", "turnon")
    POSITION_FIELD_NUMBER: _ClassVar[int]
    YELLOWTEAM_FIELD_NUMBER: _ClassVar[int]
    TURNON_FIELD_NUMBER: _ClassVar[int]
    position: Robot
    yellowteam: bool
    turnon: bool
    def __init__(self, position: _Optional[_Union[Robot, _Mapping]] = ..., yellowteam: _Optional[bool] = ..., turnon: _Optional[bool] = ...) -> None: ...

class Environment(_message.Message):
    __slots__ = ("step", "frame", "field", "goals_blue", "goals_yellow")
    STEP_FIELD_NUMBER: _ClassVar[int]
    FRAME_FIELD_NUMBER: _ClassVar[int]
    FIELD_FIELD_NUMBER: _ClassVar[int]
    GOALS_BLUE_FIELD_NUMBER: _ClassVar[int]
    GOALS_YELLOW_FIELD_NUMBER: _ClassVar[int]
    step: int
    frame: Frame
    field: Field
    goals_blue: int
    goals_yellow: int
    def __init__(self, step: _Optional[int] = ..., frame: _Optional[_Union[Frame, _Mapping]] = ..., field: _Optional[_Union[Field, _Mapping]] = ..., goals_blue: _Optional[int] = ..., goals_yellow: _Optional[int] = ...) -> None: ...

class Frame(_message.Message):
    __slots__ = ("ball", "robots_yellow", "robots_blue")
    BALL_FIELD_NUMBER: _ClassVar[int]
    ROBOTS_YELLOW_FIELD_NUMBER: _ClassVar[int]
    ROBOTS_BLUE_FIELD_NUMBER: _ClassVar[int]
    ball: Ball
    robots_yellow: _containers.RepeatedCompositeFieldContainer[Robot]
    robots_blue: _containers.RepeatedCompositeFieldContainer[Robot]
    def __init__(self, ball: _Optional[_Union[Ball, _Mapping]] = ..., robots_yellow: _Optional[_Iterable[_Union[Robot, _Mapping]]] = ..., robots_blue: _Optional[_Iterable[_Union[Robot, _Mapping]]] = ...) -> None: ...

class Ball(_message.Message):
    __slots__ = ("x", "y", "z", "vx", "vy", "vz")
    X_FIELD_NUMBER: _ClassVar[int]
    Y_FIELD_NUMBER: _ClassVar[int]
    Z_FIELD_NUMBER: _ClassVar[int]
    VX_FIELD_NUMBER: _ClassVar[int]
    VY_FIELD_NUMBER: _ClassVar[int]
    VZ_FIELD_NUMBER: _ClassVar[int]
    x: float
    y: float
    z: float
    vx: float
    vy: float
    vz: float
    def __init__(self, x: _Optional[float] = ..., y: _Optional[float] = ..., z: _Optional[float] = ..., vx: _Optional[float] = ..., vy: _Optional[float] = ..., vz: _Optional[float] = ...) -> None: ...

class Robot(_message.Message):
    __slots__ = ("robot_id", "x", "y", "orientation", "vx", "vy", "vorientation")
    ROBOT_ID_FIELD_NUMBER: _ClassVar[int]
    X_FIELD_NUMBER: _ClassVar[int]
    Y_FIELD_NUMBER: _ClassVar[int]
    ORIENTATION_FIELD_NUMBER: _ClassVar[int]
    VX_FIELD_NUMBER: _ClassVar[int]
    VY_FIELD_NUMBER: _ClassVar[int]
    VORIENTATION_FIELD_NUMBER: _ClassVar[int]
    robot_id: int
    x: float
    y: float
    orientation: float
    vx: float
    vy: float
    vorientation: float
    def __init__(self, robot_id: _Optional[int] = ..., x: _Optional[float] = ..., y: _Optional[float] = ..., orientation: _Optional[float] = ..., vx: _Optional[float] = ..., vy: _Optional[float] = ..., vorientation: _Optional[float] = ...) -> None: ...

class Field(_message.Message):
    __slots__ = ("width", "length", "goal_width", "goal_depth", "center_radius", "penalty_width", "penalty_depth", "penalty_point")
    WIDTH_FIELD_NUMBER: _ClassVar[int]
    LENGTH_FIELD_NUMBER: _ClassVar[int]
    GOAL_WIDTH_FIELD_NUMBER: _ClassVar[int]
    GOAL_DEPTH_FIELD_NUMBER: _ClassVar[int]
    CENTER_RADIUS_FIELD_NUMBER: _ClassVar[int]
    PENALTY_WIDTH_FIELD_NUMBER: _ClassVar[int]
    PENALTY_DEPTH_FIELD_NUMBER: _ClassVar[int]
    PENALTY_POINT_FIELD_NUMBER: _ClassVar[int]
    width: float
    length: float
    goal_width: float
    goal_depth: float
    center_radius: float
    penalty_width: float
    penalty_depth: float
    penalty_point: float
    def __init__(self, width: _Optional[float] = ..., length: _Optional[float] = ..., goal_width: _Optional[float] = ..., goal_depth: _Optional[float] = ..., center_radius: _Optional[float] = ..., penalty_width: _Optional[float] = ..., penalty_depth: _Optional[float] = ..., penalty_point: _Optional[float] = ...) -> None: ...
