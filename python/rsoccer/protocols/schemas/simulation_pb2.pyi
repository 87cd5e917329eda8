from google.protobuf import any_pb2 as _any_pb2
from rsoccer.protocols.schemas import vision_pb2 as _vision_pb2
from google.protobuf.internal import containers as _containers
from google.protobuf.internal import enum_type_wrapper as _enum_type_wrapper
from google.protobuf import descriptor as _descriptor
from google.protobuf import message as _message
from collections.abc import Iterable as _Iterable, Mapping as _Mapping
from typing import ClassVar as _ClassVar, Optional as _Optional, Union as _Union

DESCRIPTOR: _descriptor.FileDescriptor

class Team(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = ()
    UNKNOWN: _ClassVar[Team]
    YELLOW: _ClassVar[Team]
    BLUE: _ClassVar[Team]
UNKNOWN: Team
YELLOW: Team
BLUE: Team

class Command(_message.Message):
    __slots__ = ("control", "config")
    CONTROL_FIELD_NUMBER: _ClassVar[int]
    CONFIG_FIELD_NUMBER: _ClassVar[int]
    control: Control
    config: Config
    def __init__(self, control: _Optional[_Union[Control, _Mapping]] = ..., config: _Optional[_Union[Config, _Mapping]] = ...) -> None: ...

class Response(_message.Message):
    __slots__ = ("errors",)
    ERRORS_FIELD_NUMBER: _ClassVar[int]
    errors: _containers.RepeatedCompositeFieldContainer[Error]
    def __init__(self, errors: _Optional[_Iterable[_Union[Error, _Mapping]]] = ...) -> None: ...

class Error(_message.Message):
    __slots__ = ("code", "message")
    CODE_FIELD_NUMBER: _ClassVar[int]
    MESSAGE_FIELD_NUMBER: _ClassVar[int]
    code: str
    message: str
    def __init__(self, code: _Optional[str] = ..., message: _Optional[str] = ...) -> None: ...

class Control(_message.Message):
    __slots__ = ("teleport_ball", "teleport_robot", "simulation_speed")
    TELEPORT_BALL_FIELD_NUMBER: _ClassVar[int]
    TELEPORT_ROBOT_FIELD_NUMBER: _ClassVar[int]
    SIMULATION_SPEED_FIELD_NUMBER: _ClassVar[int]
    teleport_ball: TeleportBall
    teleport_robot: _containers.RepeatedCompositeFieldContainer[TeleportRobot]
    simulation_speed: float
    def __init__(self, teleport_ball: _Optional[_Union[TeleportBall, _Mapping]] = ..., teleport_robot: _Optional[_Iterable[_Union[TeleportRobot, _Mapping]]] = ..., simulation_speed: _Optional[float] = ...) -> None: ...

class TeleportBall(_message.Message):
    __slots__ = ("x", "y", "z", "vx", "vy", "vz", "roll", "teleport_safely", "by_force")
    X_FIELD_NUMBER: _ClassVar[int]
    Y_FIELD_NUMBER: _ClassVar[int]
    Z_FIELD_NUMBER: _ClassVar[int]
    VX_FIELD_NUMBER: _ClassVar[int]
    VY_FIELD_NUMBER: _ClassVar[int]
    VZ_FIELD_NUMBER: _ClassVar[int]
    ROLL_FIELD_NUMBER: _ClassVar[int]
    TELEPORT_SAFELY_FIELD_NUMBER: _ClassVar[int]
    BY_FORCE_FIELD_NUMBER: _ClassVar[int]
    x: float
    y: float
    z: float
    vx: float
    vy: float
    vz: float
    roll: bool
    teleport_safely: bool
    by_force: bool
    def __init__(self, x: _Optional[float] = ..., y: _Optional[float] = ..., z: _Optional[float] = ..., vx: _Optional[float] = ..., vy: _Optional[float] = ..., vz: _Optional[float] = ..., roll: _Optional[bool] = ..., teleport_safely: _Optional[bool] = ..., by_force: _Optional[bool] = ...) -> None: ...

class TeleportRobot(_message.Message):
    __slots__ = ("id", "x", "y", "orientation", "v_x", "v_y", "v_angular", "present", "by_force")
    ID_FIELD_NUMBER: _ClassVar[int]
    X_FIELD_NUMBER: _ClassVar[int]
    Y_FIELD_NUMBER: _ClassVar[int]
    ORIENTATION_FIELD_NUMBER: _ClassVar[int]
    V_X_FIELD_NUMBER: _ClassVar[int]
    V_Y_FIELD_NUMBER: _ClassVar[int]
    V_ANGULAR_FIELD_NUMBER: _ClassVar[int]
    PRESENT_FIELD_NUMBER: _ClassVar[int]
    BY_FORCE_FIELD_NUMBER: _ClassVar[int]
    id: RobotId
    x: float
    y: float
    orientation: float
    v_x: float
    v_y: float
    v_angular: float
    present: bool
    by_force: bool
    def __init__(self, id: _Optional[_Union[RobotId, _Mapping]] = ..., x: _Optional[float] = ..., y: _Optional[float] = ..., orientation: _Optional[float] = ..., v_x: _Optional[float] = ..., v_y: _Optional[float] = ..., v_angular: _Optional[float] = ..., present: _Optional[bool] = ..., by_force: _Optional[bool] = ...) -> None: ...

class RobotId(_message.Message):
    __slots__ = ("id", "team")
    ID_FIELD_NUMBER: _ClassVar[int]
    TEAM_FIELD_NUMBER: _ClassVar[int]
    id: int
    team: Team
    def __init__(self, id: _Optional[int] = ..., team: _Optional[_Union[Team, str]] = ...) -> None: ...

class Config(_message.Message):
    __slots__ = ("geometry", "robot_specs", "realism_config", "vision_port")
    GEOMETRY_FIELD_NUMBER: _ClassVar[int]
    ROBOT_SPECS_FIELD_NUMBER: _ClassVar[int]
    REALISM_CONFIG_FIELD_NUMBER: _ClassVar[int]
    VISION_PORT_FIELD_NUMBER: _ClassVar[int]
    geometry: _vision_pb2.Geometry
    robot_specs: _containers.RepeatedCompositeFieldContainer[RobotSpecs]
    realism_config: RealismConfig
    vision_port: int
    def __init__(self, geometry: _Optional[_Union[_vision_pb2.Geometry, _Mapping]] = ..., robot_specs: _Optional[_Iterable[_Union[RobotSpecs, _Mapping]]] = ..., realism_config: _Optional[_Union[RealismConfig, _Mapping]] = ..., vision_port: _Optional[int] = ...) -> None: ...

class RealismConfig(_message.Message):
    __slots__ = ("custom",)
    CUSTOM_FIELD_NUMBER: _ClassVar[int]
    custom: _containers.RepeatedCompositeFieldContainer[_any_pb2.Any]
    def __init__(self, custom: _Optional[_Iterable[_Union[_any_pb2.Any, _Mapping]]] = ...) -> None: ...

class RobotSpecs(_message.Message):
    __slots__ = ("id", "radius", "height", "mass", "center_to_dribbler", "max_linear_kick_speed", "max_chip_kick_speed", "limits", "wheel_angles", "custom")
    ID_FIELD_NUMBER: _ClassVar[int]
    RADIUS_FIELD_NUMBER: _ClassVar[int]
    HEIGHT_FIELD_NUMBER: _ClassVar[int]
    MASS_FIELD_NUMBER: _ClassVar[int]
    CENTER_TO_DRIBBLER_FIELD_NUMBER: _ClassVar[int]
    MAX_LINEAR_KICK_SPEED_FIELD_NUMBER: _ClassVar[int]
    MAX_CHIP_KICK_SPEED_FIELD_NUMBER: _ClassVar[int]
    LIMITS_FIELD_NUMBER: _ClassVar[int]
    WHEEL_ANGLES_FIELD_NUMBER: _ClassVar[int]
    CUSTOM_FIELD_NUMBER: _ClassVar[int]
    id: RobotId
    radius: float
    height: float
    mass: float
    center_to_dribbler: float
    max_linear_kick_speed: float
    max_chip_kick_speed: float
    limits: RobotLimits
    wheel_angles: WheelAngles
    custom: _containers.RepeatedCompositeFieldContainer[_any_pb2.Any]
    def __init__(self, id: _Optional[_Union[RobotId, _Mapping]] = ..., radius: _Optional[float] = ..., height: _Optional[float] = ..., mass: _Optional[float] = ..., center_to_dribbler: _Optional[float] = ..., max_linear_kick_speed: _Optional[float] = ..., max_chip_kick_speed: _Optional[float] = ..., limits: _Optional[_Union[RobotLimits, _Mapping]] = ..., wheel_angles: _Optional[_Union[WheelAngles, _Mapping]] = ..., custom: _Optional[_Iterable[_Union[_any_pb2.Any, _Mapping]]] = ...) -> None: ...

class RobotLimits(_message.Message):
    __slots__ = ("vel_absolute_max", "vel_angular_max", "acc_speedup_absolute_max", "acc_speedup_angular_max", "acc_brake_absolute_max", "acc_brake_angular_max")
    VEL_ABSOLUTE_MAX_FIELD_NUMBER: _ClassVar[int]
    VEL_ANGULAR_MAX_FIELD_NUMBER: _ClassVar[int]
    ACC_SPEEDUP_ABSOLUTE_MAX_FIELD_NUMBER: _ClassVar[int]
    ACC_SPEEDUP_ANGULAR_MAX_FIELD_NUMBER: _ClassVar[int]
    ACC_BRAKE_ABSOLUTE_MAX_FIELD_NUMBER: _ClassVar[int]
    ACC_BRAKE_ANGULAR_MAX_FIELD_NUMBER: _ClassVar[int]
    vel_absolute_max: float
    vel_angular_max: float
    acc_speedup_absolute_max: float
    acc_speedup_angular_max: float
    acc_brake_absolute_max: float
    acc_brake_angular_max: float
    def __init__(self, vel_absolute_max: _Optional[float] = ..., vel_angular_max: _Optional[float] = ..., acc_speedup_absolute_max: _Optional[float] = ..., acc_speedup_angular_max: _Optional[float] = ..., acc_brake_absolute_max: _Optional[float] = ..., acc_brake_angular_max: _Optional[float] = ...) -> None: ...

class WheelAngles(_message.Message):
    __slots__ = ("front_right", "back_right", "back_left", "front_left")
    FRONT_RIGHT_FIELD_NUMBER: _ClassVar[int]
    BACK_RIGHT_FIELD_NUMBER: _ClassVar[int]
    BACK_LEFT_FIELD_NUMBER: _ClassVar[int]
    FRONT_LEFT_FIELD_NUMBER: _ClassVar[int]
    front_right: float
    back_right: float
    back_left: float
    front_left: float
    def __init__(self, front_right: _Optional[float] = ..., back_right: _Optional[float] = ..., back_left: _Optional[float] = ..., front_left: _Optional[float] = ...) -> None: ...

class RobotControl(_message.Message):
    __slots__ = ("robot_commands",)
    ROBOT_COMMANDS_FIELD_NUMBER: _ClassVar[int]
    robot_commands: _containers.RepeatedCompositeFieldContainer[RobotCommand]
    def __init__(self, robot_commands: _Optional[_Iterable[_Union[RobotCommand, _Mapping]]] = ...) -> None: ...

class RobotCommand(_message.Message):
    __slots__ = ("id", "move_command", "kick_speed", "kick_angle", "dribbler_speed")
    ID_FIELD_NUMBER: _ClassVar[int]
    MOVE_COMMAND_FIELD_NUMBER: _ClassVar[int]
    KICK_SPEED_FIELD_NUMBER: _ClassVar[int]
    KICK_ANGLE_FIELD_NUMBER: _ClassVar[int]
    DRIBBLER_SPEED_FIELD_NUMBER: _ClassVar[int]
    id: int
    move_command: MoveCommand
    kick_speed: float
    kick_angle: float
    dribbler_speed: float
    def __init__(self, id: _Optional[int] = ..., move_command: _Optional[_Union[MoveCommand, _Mapping]] = ..., kick_speed: _Optional[float] = ..., kick_angle: _Optional[float] = ..., dribbler_speed: _Optional[float] = ...) -> None: ...

class MoveCommand(_message.Message):
    __slots__ = ("wheel_velocity", "local_velocity", "global_velocity")
    WHEEL_VELOCITY_FIELD_NUMBER: _ClassVar[int]
    LOCAL_VELOCITY_FIELD_NUMBER: _ClassVar[int]
    GLOBAL_VELOCITY_FIELD_NUMBER: _ClassVar[int]
    wheel_velocity: WheelVelocity
    local_velocity: LocalVelocity
    global_velocity: GlobalVelocity
    def __init__(self, wheel_velocity: _Optional[_Union[WheelVelocity, _Mapping]] = ..., local_velocity: _Optional[_Union[LocalVelocity, _Mapping]] = ..., global_velocity: _Optional[_Union[GlobalVelocity, _Mapping]] = ...) -> None: ...

class WheelVelocity(_message.Message):
    __slots__ = ("front_right", "back_right", "back_left", "front_left")
    FRONT_RIGHT_FIELD_NUMBER: _ClassVar[int]
    BACK_RIGHT_FIELD_NUMBER: _ClassVar[int]
    BACK_LEFT_FIELD_NUMBER: _ClassVar[int]
    FRONT_LEFT_FIELD_NUMBER: _ClassVar[int]
    front_right: float
    back_right: float
    back_left: float
    front_left: float
    def __init__(self, front_right: _Optional[float] = ..., back_right: _Optional[float] = ..., back_left: _Optional[float] = ..., front_left: _Optional[float] = ...) -> None: ...

class LocalVelocity(_message.Message):
    __slots__ = ("forward", "left", "angular")
    FORWARD_FIELD_NUMBER: _ClassVar[int]
    LEFT_FIELD_NUMBER: _ClassVar[int]
    ANGULAR_FIELD_NUMBER: _ClassVar[int]
    forward: float
    left: float
    angular: float
    def __init__(self, forward: _Optional[float] = ..., left: _Optional[float] = ..., angular: _Optional[float] = ...) -> None: ...

class GlobalVelocity(_message.Message):
    __slots__ = ("x", "y", "angular")
    X_FIELD_NUMBER: _ClassVar[int]
    Y_FIELD_NUMBER: _ClassVar[int]
    ANGULAR_FIELD_NUMBER: _ClassVar[int]
    x: float
    y: float
    angular: float
    def __init__(self, x: _Optional[float] = ..., y: _Optional[float] = ..., angular: _Optional[float] = ...) -> None: ...

class RobotControlResponse(_message.Message):
    __slots__ = ("errors", "feedback")
    ERRORS_FIELD_NUMBER: _ClassVar[int]
    FEEDBACK_FIELD_NUMBER: _ClassVar[int]
    errors: _containers.RepeatedCompositeFieldContainer[Error]
    feedback: _containers.RepeatedCompositeFieldContainer[RobotFeedback]
    def __init__(self, errors: _Optional[_Iterable[_Union[Error, _Mapping]]] = ..., feedback: _Optional[_Iterable[_Union[RobotFeedback, _Mapping]]] = ...) -> None: ...

class RobotFeedback(_message.Message):
    __slots__ = ("id", "dribbler_ball_contact", "custom")
    ID_FIELD_NUMBER: _ClassVar[int]
    DRIBBLER_BALL_CONTACT_FIELD_NUMBER: _ClassVar[int]
    CUSTOM_FIELD_NUMBER: _ClassVar[int]
    id: int
    dribbler_ball_contact: bool
    custom: _any_pb2.Any
    def __init__(self, id: _Optional[int] = ..., dribbler_ball_contact: _Optional[bool] = ..., custom: _Optional[_Union[_any_pb2.Any, _Mapping]] = ...) -> None: ...

class SyncRequest(_message.Message):
    __slots__ = ("sim_step", "simulator_command", "robot_control")
    SIM_STEP_FIELD_NUMBER: _ClassVar[int]
    SIMULATOR_COMMAND_FIELD_NUMBER: _ClassVar[int]
    ROBOT_CONTROL_FIELD_NUMBER: _ClassVar[int]
    sim_step: float
    simulator_command: Command
    robot_control: RobotControl
    def __init__(self, sim_step: _Optional[float] = ..., simulator_command: _Optional[_Union[Command, _Mapping]] = ..., robot_control: _Optional[_Union[RobotControl, _Mapping]] = ...) -> None: ...

class SyncResponse(_message.Message):
    __slots__ = ("detection", "robot_control_response")
    DETECTION_FIELD_NUMBER: _ClassVar[int]
    ROBOT_CONTROL_RESPONSE_FIELD_NUMBER: _ClassVar[int]
    detection: _containers.RepeatedCompositeFieldContainer[_vision_pb2.DetectionFrame]
    robot_control_response: RobotControlResponse
    def __init__(self, detection: _Optional[_Iterable[_Union[_vision_pb2.DetectionFrame, _Mapping]]] = ..., robot_control_response: _Optional[_Union[RobotControlResponse, _Mapping]] = ...) -> None: ...
