from google.protobuf.internal import containers as _containers
from google.protobuf.internal import enum_type_wrapper as _enum_type_wrapper
from google.protobuf import descriptor as _descriptor
from google.protobuf import message as _message
from collections.abc import Iterable as _Iterable, Mapping as _Mapping
from typing import ClassVar as _ClassVar, Optional as _Optional, Union as _Union

DESCRIPTOR: _descriptor.FileDescriptor

class Foul(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = ()
    FREE_KICK: _ClassVar[Foul]
    PENALTY_KICK: _ClassVar[Foul]
    GOAL_KICK: _ClassVar[Foul]
    FREE_BALL: _ClassVar[Foul]
    KICKOFF: _ClassVar[Foul]
    STOP: _ClassVar[Foul]
    GAME_ON: _ClassVar[Foul]
    HALT: _ClassVar[Foul]

class Color(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = ()
    BLUE: _ClassVar[Color]
    YELLOW: _ClassVar[Color]
    NONE: _ClassVar[Color]

class Quadrant(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = ()
    NO_QUADRANT: _ClassVar[Quadrant]
    QUADRANT_1: _ClassVar[Quadrant]
    QUADRANT_2: _ClassVar[Quadrant]
    QUADRANT_3: _ClassVar[Quadrant]
    QUADRANT_4: _ClassVar[Quadrant]

class Half(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = ()
    NO_HALF: _ClassVar[Half]
    FIRST_HALF: _ClassVar[Half]
    SECOND_HALF: _ClassVar[Half]
    OVERTIME_FIRST_HALF: _ClassVar[Half]
    OVERTIME_SECOND_HALF: _ClassVar[Half]
    PENALTY_SHOOTOUTS: _ClassVar[Half]
FREE_KICK: Foul
PENALTY_KICK: Foul
GOAL_KICK: Foul
FREE_BALL: Foul
KICKOFF: Foul
STOP: Foul
GAME_ON: Foul
HALT: Foul
BLUE: Color
YELLOW: Color
NONE: Color
NO_QUADRANT: Quadrant
QUADRANT_1: Quadrant
QUADRANT_2: Quadrant
QUADRANT_3: Quadrant
QUADRANT_4: Quadrant
NO_HALF: Half
FIRST_HALF: Half
SECOND_HALF: Half
OVERTIME_FIRST_HALF: Half
OVERTIME_SECOND_HALF: Half
PENALTY_SHOOTOUTS: Half

class Command(_message.Message):
    __slots__ = ("foul", "teamcolor", "foulQuadrant", "timestamp", "gameHalf")
    FOUL_FIELD_NUMBER: _ClassVar[int]
    TEAMCOLOR_FIELD_NUMBER: _ClassVar[int]
    FOULQUADRANT_FIELD_NUMBER: _ClassVar[int]
    TIMESTAMP_FIELD_NUMBER: _ClassVar[int]
    GAMEHALF_FIELD_NUMBER: _ClassVar[int]
    foul: Foul
    teamcolor: Color
    foulQuadrant: Quadrant
    timestamp: float
    gameHalf: Half
    def __init__(self, foul: _Optional[_Union[Foul, str]] = ..., teamcolor: _Optional[_Union[Color, str]] = ..., foulQuadrant: _Optional[_Union[Quadrant, str]] = ..., timestamp: _Optional[float] = ..., gameHalf: _Optional[_Union[Half, str]] = ...) -> None: ...

class Placement(_message.Message):
    __slots__ = ("world",)
    WORLD_FIELD_NUMBER: _ClassVar[int]
    world: Frame
    def __init__(self, world: _Optional[_Union[Frame, _Mapping]] = ...) -> None: ...

class Frame(_message.Message):
    __slots__ = ("teamColor", "robots")
    TEAMCOLOR_FIELD_NUMBER: _ClassVar[int]
    ROBOTS_FIELD_NUMBER: _ClassVar[int]
    teamColor: Color
    robots: _containers.RepeatedCompositeFieldContainer[Robot]
    def __init__(self, teamColor: _Optional[_Union[Color, str]] = ..., robots: _Optional[_Iterable[_Union[Robot, _Mapping]]] = ...) -> None: ...

class Robot(_message.Message):
    __slots__ = ("robot_id", "x", "y", "orientation")
    ROBOT_ID_FIELD_NUMBER: _ClassVar[int]
    X_FIELD_NUMBER: _ClassVar[int]
    Y_FIELD_NUMBER: _ClassVar[int]
    ORIENTATION_FIELD_NUMBER: _ClassVar[int]
    robot_id: int
    x: float
    y: float
    orientation: float
    def __init__(self, robot_id: _Optional[int] = ..., x: _Optional[float] = ..., y: _Optional[float] = ..., orientation: _Optional[float] = ...) -> None: ...
