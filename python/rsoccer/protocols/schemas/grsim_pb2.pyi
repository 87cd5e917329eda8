from google.protobuf.internal import containers as _containers
from google.protobuf import descriptor as _descriptor
from google.protobuf import message as _message
from collections.abc import Iterable as _Iterable, Mapping as _Mapping
from typing import ClassVar as _ClassVar, Optional as _Optional, Union as _Union

DESCRIPTOR: _descriptor.FileDescriptor

class Packet(_message.Message):
    __slots__ = ("commands", "replacement")
    COMMANDS_FIELD_NUMBER: _ClassVar[int]
    REPLACEMENT_FIELD_NUMBER: _ClassVar[int]
    commands: Commands
    replacement: Replacement
    def __init__(self, commands: _Optional[_Union[Commands, _Mapping]] = ..., replacement: _Optional[_Union[Replacement, _Mapping]] = ...) -> None: ...

class Commands(_message.Message):
    __slots__ = ("timestamp", "isteamyellow", "robot_commands")
    TIMESTAMP_FIELD_NUMBER: _ClassVar[int]
    ISTEAMYELLOW_FIELD_NUMBER: _ClassVar[int]
    ROBOT_COMMANDS_FIELD_NUMBER: _ClassVar[int]
    timestamp: float
    isteamyellow: bool
    robot_commands: _containers.RepeatedCompositeFieldContainer[RobotCommand]
    def __init__(self, timestamp: _Optional[float] = ..., isteamyellow: _Optional[bool] = ..., robot_commands: _Optional[_Iterable[_Union[RobotCommand, _Mapping]]] = ...) -> None: ...

class RobotCommand(_message.Message):
    __slots__ = ("id", "wheelsspeed", "veltangent", "velnormal", "velangular", "wheel1", "wheel2", "wheel3", "wheel4", "kickspeedx", "kickspeedz", "spinner")
    ID_FIELD_NUMBER: _ClassVar[int]
    WHEELSSPEED_FIELD_NUMBER: _ClassVar[int]
    VELTANGENT_FIELD_NUMBER: _ClassVar[int]
    VELNORMAL_FIELD_NUMBER: _ClassVar[int]
    VELANGULAR_FIELD_NUMBER: _ClassVar[int]
    WHEEL1_FIELD_NUMBER: _ClassVar[int]
    WHEEL2_FIELD_NUMBER: _ClassVar[int]
    WHEEL3_FIELD_NUMBER: _ClassVar[int]
    WHEEL4_FIELD_NUMBER: _ClassVar[int]
    KICKSPEEDX_FIELD_NUMBER: _ClassVar[int]
    KICKSPEEDZ_FIELD_NUMBER: _ClassVar[int]
    SPINNER_FIELD_NUMBER: _ClassVar[int]
    id: int
    wheelsspeed: bool
    veltangent: float
    velnormal: float
    velangular: float
    wheel1: float
    wheel2: float
    wheel3: float
    wheel4: float
    kickspeedx: float
    kickspeedz: float
    spinner: bool
    def __init__(self, id: _Optional[int] = ..., wheelsspeed: _Optional[bool] = ..., veltangent: _Optional[float] = ..., velnormal: _Optional[float] = ..., velangular: _Optional[float] = ..., wheel1: _Optional[float] = ..., wheel2: _Optional[float] = ..., wheel3: _Optional[float] = ..., wheel4: _Optional[float] = ..., kickspeedx: _Optional[float] = ..., kickspeedz: _Optional[float] = ..., spinner: _Optional[bool] = ...) -> None: ...

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
    __slots__ = ("yellowteam", "id", "x", "y", "dir", "turnon")
    YELLOWTEAM_FIELD_NUMBER: _ClassVar[int]
    ID_FIELD_NUMBER: _ClassVar[int]
    X_FIELD_NUMBER: _ClassVar[int]
    Y_FIELD_NUMBER: _ClassVar[int]
    DIR_FIELD_NUMBER: _ClassVar[int]
    TURNON_FIELD_NUMBER: _ClassVar[int]
    yellowteam: bool
    id: int
    x: float
    y: float
    dir: float
    turnon: bool
    def __init__(self, yellowteam: _Optional[bool] = ..., id: _Optional[int] = ..., x: _Optional[float] = ..., y: _Optional[float] = ..., dir: _Optional[float] = ..., turnon: _Optional[bool] = ...) -> None: ...

class StatusPacket(_message.Message):
    __slots__ = ("robots_status",)
    ROBOTS_STATUS_FIELD_NUMBER: _ClassVar[int]
    robots_status: _containers.RepeatedCompositeFieldContainer[RobotStatus]
    def __init__(self, robots_status: _Optional[_Iterable[_Union[RobotStatus, _Mapping]]] = ...) -> None: ...

class RobotStatus(_message.Message):
    __slots__ = ("robot_id", "infrared", "flat_kick", "chip_kick")
    ROBOT_ID_FIELD_NUMBER: _ClassVar[int]
    INFRARED_FIELD_NUMBER: _ClassVar[int]
    FLAT_KICK_FIELD_NUMBER: _ClassVar[int]
    CHIP_KICK_FIELD_NUMBER: _ClassVar[int]
    robot_id: int
    infrared: bool
    flat_kick: bool
    chip_kick: bool
    def __init__(self, robot_id: _Optional[int] = ..., infrared: _Optional[bool] = ..., flat_kick: _Optional[bool] = ..., chip_kick: _Optional[bool] = ...) -> None: ...
