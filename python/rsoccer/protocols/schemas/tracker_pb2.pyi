from google.protobuf.internal import containers as _containers
from google.protobuf.internal import enum_type_wrapper as _enum_type_wrapper
from google.protobuf import descriptor as _descriptor
from google.protobuf import message as _message
from collections.abc import Iterable as _Iterable, Mapping as _Mapping
from typing import ClassVar as _ClassVar, Optional as _Optional, Union as _Union

DESCRIPTOR: _descriptor.FileDescriptor

class Capability(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = ()
    CAPABILITY_UNKNOWN: _ClassVar[Capability]
    CAPABILITY_DETECT_FLYING_BALLS: _ClassVar[Capability]
    CAPABILITY_DETECT_MULTIPLE_BALLS: _ClassVar[Capability]
    CAPABILITY_DETECT_KICKED_BALLS: _ClassVar[Capability]

class TeamColor(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = ()
    TEAM_COLOR_UNKNOWN: _ClassVar[TeamColor]
    TEAM_COLOR_YELLOW: _ClassVar[TeamColor]
    TEAM_COLOR_BLUE: _ClassVar[TeamColor]
CAPABILITY_UNKNOWN: Capability
CAPABILITY_DETECT_FLYING_BALLS: Capability
CAPABILITY_DETECT_MULTIPLE_BALLS: Capability
CAPABILITY_DETECT_KICKED_BALLS: Capability
TEAM_COLOR_UNKNOWN: TeamColor
TEAM_COLOR_YELLOW: TeamColor
TEAM_COLOR_BLUE: TeamColor

class Packet(_message.Message):
    __slots__ = ("uuid", "source_name", "tracked_frame")
    UUID_FIELD_NUMBER: _ClassVar[int]
    SOURCE_NAME_FIELD_NUMBER: _ClassVar[int]
    TRACKED_FRAME_FIELD_NUMBER: _ClassVar[int]
    uuid: str
    source_name: str
    tracked_frame: TrackedFrame
    def __init__(self, uuid: _Optional[str] = ..., source_name: _Optional[str] = ..., tracked_frame: _Optional[_Union[TrackedFrame, _Mapping]] = ...) -> None: ...

class TrackedFrame(_message.Message):
    __slots__ = ("frame_number", "timestamp", "balls", "robots", "kicked_ball", "capabilities")
    FRAME_NUMBER_FIELD_NUMBER: _ClassVar[int]
    TIMESTAMP_FIELD_NUMBER: _ClassVar[int]
    BALLS_FIELD_NUMBER: _ClassVar[int]
    ROBOTS_FIELD_NUMBER: _ClassVar[int]
    KICKED_BALL_FIELD_NUMBER: _ClassVar[int]
    CAPABILITIES_FIELD_NUMBER: _ClassVar[int]
    frame_number: int
    timestamp: float
    balls: _containers.RepeatedCompositeFieldContainer[TrackedBall]
    robots: _containers.RepeatedCompositeFieldContainer[TrackedRobot]
    kicked_ball: KickedBall
    capabilities: _containers.RepeatedScalarFieldContainer[Capability]
    def __init__(self, frame_number: _Optional[int] = ..., timestamp: _Optional[float] = ..., balls: _Optional[_Iterable[_Union[TrackedBall, _Mapping]]] = ..., robots: _Optional[_Iterable[_Union[TrackedRobot, _Mapping]]] = ..., kicked_ball: _Optional[_Union[KickedBall, _Mapping]] = ..., capabilities: _Optional[_Iterable[_Union[Capability, str]]] = ...) -> None: ...

class Vector2(_message.Message):
    __slots__ = ("x", "y")
    X_FIELD_NUMBER: _ClassVar[int]
    Y_FIELD_NUMBER: _ClassVar[int]
    x: float
    y: float
    def __init__(self, x: _Optional[float] = ..., y: _Optional[float] = ...) -> None: ...

class Vector3(_message.Message):
    __slots__ = ("x", "y", "z")
    X_FIELD_NUMBER: _ClassVar[int]
    Y_FIELD_NUMBER: _ClassVar[int]
    Z_FIELD_NUMBER: _ClassVar[int]
    x: float
    y: float
    z: float
    def __init__(self, x: _Optional[float] = ..., y: _Optional[float] = ..., z: _Optional[float] = ...) -> None: ...

class RobotId(_message.Message):
    __slots__ = ("id", "team_color")
    ID_FIELD_NUMBER: _ClassVar[int]
    TEAM_COLOR_FIELD_NUMBER: _ClassVar[int]
    id: int
    team_color: TeamColor
    def __init__(self, id: _Optional[int] = ..., team_color: _Optional[_Union[TeamColor, str]] = ...) -> None: ...

class TrackedBall(_message.Message):
    __slots__ = ("pos", "vel", "visibility")
    POS_FIELD_NUMBER: _ClassVar[int]
    VEL_FIELD_NUMBER: _ClassVar[int]
    VISIBILITY_FIELD_NUMBER: _ClassVar[int]
    pos: Vector3
    vel: Vector3
    visibility: float
    def __init__(self, pos: _Optional[_Union[Vector3, _Mapping]] = ..., vel: _Optional[_Union[Vector3, _Mapping]] = ..., visibility: _Optional[float] = ...) -> None: ...

class TrackedRobot(_message.Message):
    __slots__ = ("robot_id", "pos", "orientation", "vel", "vel_angular", "visibility")
    ROBOT_ID_FIELD_NUMBER: _ClassVar[int]
    POS_FIELD_NUMBER: _ClassVar[int]
    ORIENTATION_FIELD_NUMBER: _ClassVar[int]
    VEL_FIELD_NUMBER: _ClassVar[int]
    VEL_ANGULAR_FIELD_NUMBER: _ClassVar[int]
    VISIBILITY_FIELD_NUMBER: _ClassVar[int]
    robot_id: RobotId
    pos: Vector2
    orientation: float
    vel: Vector2
    vel_angular: float
    visibility: float
    def __init__(self, robot_id: _Optional[_Union[RobotId, _Mapping]] = ..., pos: _Optional[_Union[Vector2, _Mapping]] = ..., orientation: _Optional[float] = ..., vel: _Optional[_Union[Vector2, _Mapping]] = ..., vel_angular: _Optional[float] = ..., visibility: _Optional[float] = ...) -> None: ...

class KickedBall(_message.Message):
    __slots__ = ("pos", "vel", "start_timestamp", "stop_timestamp", "stop_pos", "robot_id")
    POS_FIELD_NUMBER: _ClassVar[int]
    VEL_FIELD_NUMBER: _ClassVar[int]
    START_TIMESTAMP_FIELD_NUMBER: _ClassVar[int]
    STOP_TIMESTAMP_FIELD_NUMBER: _ClassVar[int]
    STOP_POS_FIELD_NUMBER: _ClassVar[int]
    ROBOT_ID_FIELD_NUMBER: _ClassVar[int]
    pos: Vector2
    vel: Vector3
    start_timestamp: float
    stop_timestamp: float
    stop_pos: Vector2
    robot_id: RobotId
    def __init__(self, pos: _Optional[_Union[Vector2, _Mapping]] = ..., vel: _Optional[_Union[Vector3, _Mapping]] = ..., start_timestamp: _Optional[float] = ..., stop_timestamp: _Optional[float] = ..., stop_pos: _Optional[_Union[Vector2, _Mapping]] = ..., robot_id: _Optional[_Union[RobotId, _Mapping]] = ...) -> None: ...
