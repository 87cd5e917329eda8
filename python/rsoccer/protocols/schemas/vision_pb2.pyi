from google.protobuf.internal import containers as _containers
from google.protobuf.internal import enum_type_wrapper as _enum_type_wrapper
from google.protobuf import descriptor as _descriptor
from google.protobuf import message as _message
from collections.abc import Iterable as _Iterable, Mapping as _Mapping
from typing import ClassVar as _ClassVar, Optional as _Optional, Union as _Union

DESCRIPTOR: _descriptor.FileDescriptor

class Source(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = ()
    SOURCE_UNKNOWN: _ClassVar[Source]
    SOURCE_OTHER: _ClassVar[Source]
    SOURCE_SSL_VISION: _ClassVar[Source]
    SOURCE_VISION_PROCESSOR: _ClassVar[Source]
    SOURCE_GRSIM: _ClassVar[Source]
    SOURCE_ERFORCE_SIM: _ClassVar[Source]

class FieldShape(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = ()
    Undefined: _ClassVar[FieldShape]
    CenterCircle: _ClassVar[FieldShape]
    TopTouchLine: _ClassVar[FieldShape]
    BottomTouchLine: _ClassVar[FieldShape]
    LeftGoalLine: _ClassVar[FieldShape]
    RightGoalLine: _ClassVar[FieldShape]
    HalfwayLine: _ClassVar[FieldShape]
    CenterLine: _ClassVar[FieldShape]
    LeftPenaltyStretch: _ClassVar[FieldShape]
    RightPenaltyStretch: _ClassVar[FieldShape]
    LeftFieldLeftPenaltyStretch: _ClassVar[FieldShape]
    LeftFieldRightPenaltyStretch: _ClassVar[FieldShape]
    RightFieldLeftPenaltyStretch: _ClassVar[FieldShape]
    RightFieldRightPenaltyStretch: _ClassVar[FieldShape]
SOURCE_UNKNOWN: Source
SOURCE_OTHER: Source
SOURCE_SSL_VISION: Source
SOURCE_VISION_PROCESSOR: Source
SOURCE_GRSIM: Source
SOURCE_ERFORCE_SIM: Source
Undefined: FieldShape
CenterCircle: FieldShape
TopTouchLine: FieldShape
BottomTouchLine: FieldShape
LeftGoalLine: FieldShape
RightGoalLine: FieldShape
HalfwayLine: FieldShape
CenterLine: FieldShape
LeftPenaltyStretch: FieldShape
RightPenaltyStretch: FieldShape
LeftFieldLeftPenaltyStretch: FieldShape
LeftFieldRightPenaltyStretch: FieldShape
RightFieldLeftPenaltyStretch: FieldShape
RightFieldRightPenaltyStretch: FieldShape

class Packet(_message.Message):
    __slots__ = ("detection", "geometry", "source")
    DETECTION_FIELD_NUMBER: _ClassVar[int]
    GEOMETRY_FIELD_NUMBER: _ClassVar[int]
    SOURCE_FIELD_NUMBER: _ClassVar[int]
    detection: DetectionFrame
    geometry: Geometry
    source: Source
    def __init__(self, detection: _Optional[_Union[DetectionFrame, _Mapping]] = ..., geometry: _Optional[_Union[Geometry, _Mapping]] = ..., source: _Optional[_Union[Source, str]] = ...) -> None: ...

class Packet2010(_message.Message):
    __slots__ = ("detection",)
    DETECTION_FIELD_NUMBER: _ClassVar[int]
    detection: DetectionFrame
    def __init__(self, detection: _Optional[_Union[DetectionFrame, _Mapping]] = ...) -> None: ...

class DetectionFrame(_message.Message):
    __slots__ = ("frame_number", "camera_id", "t_capture", "t_capture_camera", "t_sent", "balls", "robots_blue", "robots_yellow")
    FRAME_NUMBER_FIELD_NUMBER: _ClassVar[int]
    CAMERA_ID_FIELD_NUMBER: _ClassVar[int]
    T_CAPTURE_FIELD_NUMBER: _ClassVar[int]
    T_CAPTURE_CAMERA_FIELD_NUMBER: _ClassVar[int]
    T_SENT_FIELD_NUMBER: _ClassVar[int]
    BALLS_FIELD_NUMBER: _ClassVar[int]
    ROBOTS_BLUE_FIELD_NUMBER: _ClassVar[int]
    ROBOTS_YELLOW_FIELD_NUMBER: _ClassVar[int]
    frame_number: int
    camera_id: int
    t_capture: float
    t_capture_camera: float
    t_sent: float
    balls: _containers.RepeatedCompositeFieldContainer[DetectionBall]
    robots_blue: _containers.RepeatedCompositeFieldContainer[DetectionRobot]
    robots_yellow: _containers.RepeatedCompositeFieldContainer[DetectionRobot]
    def __init__(self, frame_number: _Optional[int] = ..., camera_id: _Optional[int] = ..., t_capture: _Optional[float] = ..., t_capture_camera: _Optional[float] = ..., t_sent: _Optional[float] = ..., balls: _Optional[_Iterable[_Union[DetectionBall, _Mapping]]] = ..., robots_blue: _Optional[_Iterable[_Union[DetectionRobot, _Mapping]]] = ..., robots_yellow: _Optional[_Iterable[_Union[DetectionRobot, _Mapping]]] = ...) -> None: ...

class DetectionBall(_message.Message):
    __slots__ = ("x", "y", "z", "confidence", "area", "pixel_x", "pixel_y")
    X_FIELD_NUMBER: _ClassVar[int]
    Y_FIELD_NUMBER: _ClassVar[int]
    Z_FIELD_NUMBER: _ClassVar[int]
    CONFIDENCE_FIELD_NUMBER: _ClassVar[int]
    AREA_FIELD_NUMBER: _ClassVar[int]
    PIXEL_X_FIELD_NUMBER: _ClassVar[int]
    PIXEL_Y_FIELD_NUMBER: _ClassVar[int]
    x: float
    y: float
    z: float
    confidence: float
    area: int
    pixel_x: float
    pixel_y: float
    def __init__(self, x: _Optional[float] = ..., y: _Optional[float] = ..., z: _Optional[float] = ..., confidence: _Optional[float] = ..., area: _Optional[int] = ..., pixel_x: _Optional[float] = ..., pixel_y: _Optional[float] = ...) -> None: ...

class DetectionRobot(_message.Message):
    __slots__ = ("robot_id", "x", "y", "orientation", "height", "confidence", "pixel_x", "pixel_y")
    ROBOT_ID_FIELD_NUMBER: _ClassVar[int]
    X_FIELD_NUMBER: _ClassVar[int]
    Y_FIELD_NUMBER: _ClassVar[int]
    ORIENTATION_FIELD_NUMBER: _ClassVar[int]
    HEIGHT_FIELD_NUMBER: _ClassVar[int]
    CONFIDENCE_FIELD_NUMBER: _ClassVar[int]
    PIXEL_X_FIELD_NUMBER: _ClassVar[int]
    PIXEL_Y_FIELD_NUMBER: _ClassVar[int]
    robot_id: int
    x: float
    y: float
    orientation: float
    height: float
    confidence: float
    pixel_x: float
    pixel_y: float
    def __init__(self, robot_id: _Optional[int] = ..., x: _Optional[float] = ..., y: _Optional[float] = ..., orientation: _Optional[float] = ..., height: _Optional[float] = ..., confidence: _Optional[float] = ..., pixel_x: _Optional[float] = ..., pixel_y: _Optional[float] = ...) -> None: ...

class Geometry(_message.Message):
    __slots__ = ("field", "calib", "models")
    FIELD_FIELD_NUMBER: _ClassVar[int]
    CALIB_FIELD_NUMBER: _ClassVar[int]
    MODELS_FIELD_NUMBER: _ClassVar[int]
    field: FieldSize
    calib: _containers.RepeatedCompositeFieldContainer[CameraCalibration]
    models: BallModels
    def __init__(self, field: _Optional[_Union[FieldSize, _Mapping]] = ..., calib: _Optional[_Iterable[_Union[CameraCalibration, _Mapping]]] = ..., models: _Optional[_Union[BallModels, _Mapping]] = ...) -> None: ...

class FieldSize(_message.Message):
    __slots__ = ("field_length", "field_width", "boundary_width", "boundary_width_goal_line", "goal_width", "goal_depth", "goal_height", "penalty_area_depth", "penalty_area_width", "center_circle_radius", "line_thickness", "goal_center_to_penalty_mark", "goal_substitution_area_width", "ball_radius", "max_robot_radius", "field_lines", "field_arcs")
    FIELD_LENGTH_FIELD_NUMBER: _ClassVar[int]
    FIELD_WIDTH_FIELD_NUMBER: _ClassVar[int]
    BOUNDARY_WIDTH_FIELD_NUMBER: _ClassVar[int]
    BOUNDARY_WIDTH_GOAL_LINE_FIELD_NUMBER: _ClassVar[int]
    GOAL_WIDTH_FIELD_NUMBER: _ClassVar[int]
    GOAL_DEPTH_FIELD_NUMBER: _ClassVar[int]
    GOAL_HEIGHT_FIELD_NUMBER: _ClassVar[int]
    PENALTY_AREA_DEPTH_FIELD_NUMBER: _ClassVar[int]
    PENALTY_AREA_WIDTH_FIELD_NUMBER: _ClassVar[int]
    CENTER_CIRCLE_RADIUS_FIELD_NUMBER: _ClassVar[int]
    LINE_THICKNESS_FIELD_NUMBER: _ClassVar[int]
    GOAL_CENTER_TO_PENALTY_MARK_FIELD_NUMBER: _ClassVar[int]
    GOAL_SUBSTITUTION_AREA_WIDTH_FIELD_NUMBER: _ClassVar[int]
    BALL_RADIUS_FIELD_NUMBER: _ClassVar[int]
    MAX_ROBOT_RADIUS_FIELD_NUMBER: _ClassVar[int]
    FIELD_LINES_FIELD_NUMBER: _ClassVar[int]
    FIELD_ARCS_FIELD_NUMBER: _ClassVar[int]
    field_length: int
    field_width: int
    boundary_width: int
    boundary_width_goal_line: int
    goal_width: int
    goal_depth: int
    goal_height: int
    penalty_area_depth: int
    penalty_area_width: int
    center_circle_radius: int
    line_thickness: int
    goal_center_to_penalty_mark: int
    goal_substitution_area_width: int
    ball_radius: float
    max_robot_radius: float
    field_lines: _containers.RepeatedCompositeFieldContainer[FieldLine]
    field_arcs: _containers.RepeatedCompositeFieldContainer[FieldArc]
    def __init__(self, field_length: _Optional[int] = ..., field_width: _Optional[int] = ..., boundary_width: _Optional[int] = ..., boundary_width_goal_line: _Optional[int] = ..., goal_width: _Optional[int] = ..., goal_depth: _Optional[int] = ..., goal_height: _Optional[int] = ..., penalty_area_depth: _Optional[int] = ..., penalty_area_width: _Optional[int] = ..., center_circle_radius: _Optional[int] = ..., line_thickness: _Optional[int] = ..., goal_center_to_penalty_mark: _Optional[int] = ..., goal_substitution_area_width: _Optional[int] = ..., ball_radius: _Optional[float] = ..., max_robot_radius: _Optional[float] = ..., field_lines: _Optional[_Iterable[_Union[FieldLine, _Mapping]]] = ..., field_arcs: _Optional[_Iterable[_Union[FieldArc, _Mapping]]] = ...) -> None: ...

class Point(_message.Message):
    __slots__ = ("x", "y")
    X_FIELD_NUMBER: _ClassVar[int]
    Y_FIELD_NUMBER: _ClassVar[int]
    x: float
    y: float
    def __init__(self, x: _Optional[float] = ..., y: _Optional[float] = ...) -> None: ...

class FieldLine(_message.Message):
    __slots__ = ("name", "type", "p1", "p2", "thickness")
    NAME_FIELD_NUMBER: _ClassVar[int]
    TYPE_FIELD_NUMBER: _ClassVar[int]
    P1_FIELD_NUMBER: _ClassVar[int]
    P2_FIELD_NUMBER: _ClassVar[int]
    THICKNESS_FIELD_NUMBER: _ClassVar[int]
    name: str
    type: FieldShape
    p1: Point
    p2: Point
    thickness: float
    def __init__(self, name: _Optional[str] = ..., type: _Optional[_Union[FieldShape, str]] = ..., p1: _Optional[_Union[Point, _Mapping]] = ..., p2: _Optional[_Union[Point, _Mapping]] = ..., thickness: _Optional[float] = ...) -> None: ...

class FieldArc(_message.Message):
    __slots__ = ("name", "type", "center", "radius", "a1", "a2", "thickness")
    NAME_FIELD_NUMBER: _ClassVar[int]
    TYPE_FIELD_NUMBER: _ClassVar[int]
    CENTER_FIELD_NUMBER: _ClassVar[int]
    RADIUS_FIELD_NUMBER: _ClassVar[int]
    A1_FIELD_NUMBER: _ClassVar[int]
    A2_FIELD_NUMBER: _ClassVar[int]
    THICKNESS_FIELD_NUMBER: _ClassVar[int]
    name: str
    type: FieldShape
    center: Point
    radius: float
    a1: float
    a2: float
    thickness: float
    def __init__(self, name: _Optional[str] = ..., type: _Optional[_Union[FieldShape, str]] = ..., center: _Optional[_Union[Point, _Mapping]] = ..., radius: _Optional[float] = ..., a1: _Optional[float] = ..., a2: _Optional[float] = ..., thickness: _Optional[float] = ...) -> None: ...

class CameraCalibration(_message.Message):
    __slots__ = ("camera_id", "pixel_image_width", "pixel_image_height", "focal_length", "principal_point_x", "principal_point_y", "distortion", "q0", "q1", "q2", "q3", "tx", "ty", "tz", "derived_camera_world_tx", "derived_camera_world_ty", "derived_camera_world_tz")
    CAMERA_ID_FIELD_NUMBER: _ClassVar[int]
    PIXEL_IMAGE_WIDTH_FIELD_NUMBER: _ClassVar[int]
    PIXEL_IMAGE_HEIGHT_FIELD_NUMBER: _ClassVar[int]
    FOCAL_LENGTH_FIELD_NUMBER: _ClassVar[int]
    PRINCIPAL_POINT_X_FIELD_NUMBER: _ClassVar[int]
    PRINCIPAL_POINT_Y_FIELD_NUMBER: _ClassVar[int]
    DISTORTION_FIELD_NUMBER: _ClassVar[int]
    Q0_FIELD_NUMBER: _ClassVar[int]
    Q1_FIELD_NUMBER: _ClassVar[int]
    Q2_FIELD_NUMBER: _ClassVar[int]
    Q3_FIELD_NUMBER: _ClassVar[int]
    TX_FIELD_NUMBER: _ClassVar[int]
    TY_FIELD_NUMBER: _ClassVar[int]
    TZ_FIELD_NUMBER: _ClassVar[int]
    DERIVED_CAMERA_WORLD_TX_FIELD_NUMBER: _ClassVar[int]
    DERIVED_CAMERA_WORLD_TY_FIELD_NUMBER: _ClassVar[int]
    DERIVED_CAMERA_WORLD_TZ_FIELD_NUMBER: _ClassVar[int]
    camera_id: int
    pixel_image_width: int
    pixel_image_height: int
    focal_length: float
    principal_point_x: float
    principal_point_y: float
    distortion: float
    q0: float
    q1: float
    q2: float
    q3: float
    tx: float
    ty: float
    tz: float
    derived_camera_world_tx: float
    derived_camera_world_ty: float
    derived_camera_world_tz: float
    def __init__(self, camera_id: _Optional[int] = ..., pixel_image_width: _Optional[int] = ..., pixel_image_height: _Optional[int] = ..., focal_length: _Optional[float] = ..., principal_point_x: _Optional[float] = ..., principal_point_y: _Optional[float] = ..., distortion: _Optional[float] = ..., q0: _Optional[float] = ..., q1: _Optional[float] = ..., q2: _Optional[float] = ..., q3: _Optional[float] = ..., tx: _Optional[float] = ..., ty: _Optional[float] = ..., tz: _Optional[float] = ..., derived_camera_world_tx: _Optional[float] = ..., derived_camera_world_ty: _Optional[float] = ..., derived_camera_world_tz: _Optional[float] = ...) -> None: ...

class BallModels(_message.Message):
    __slots__ = ("straight_two_phase", "chip_fixed_loss")
    STRAIGHT_TWO_PHASE_FIELD_NUMBER: _ClassVar[int]
    CHIP_FIXED_LOSS_FIELD_NUMBER: _ClassVar[int]
    straight_two_phase: StraightTwoPhase
    chip_fixed_loss: ChipFixedLoss
    def __init__(self, straight_two_phase: _Optional[_Union[StraightTwoPhase, _Mapping]] = ..., chip_fixed_loss: _Optional[_Union[ChipFixedLoss, _Mapping]] = ...) -> None: ...

class StraightTwoPhase(_message.Message):
    __slots__ = ("acc_slide", "acc_roll", "k_switch")
    ACC_SLIDE_FIELD_NUMBER: _ClassVar[int]
    ACC_ROLL_FIELD_NUMBER: _ClassVar[int]
    K_SWITCH_FIELD_NUMBER: _ClassVar[int]
    acc_slide: float
    acc_roll: float
    k_switch: float
    def __init__(self, acc_slide: _Optional[float] = ..., acc_roll: _Optional[float] = ..., k_switch: _Optional[float] = ...) -> None: ...

class ChipFixedLoss(_message.Message):
    __slots__ = ("damping_xy_first_hop", "damping_xy_other_hops", "damping_z")
    DAMPING_XY_FIRST_HOP_FIELD_NUMBER: _ClassVar[int]
    DAMPING_XY_OTHER_HOPS_FIELD_NUMBER: _ClassVar[int]
    DAMPING_Z_FIELD_NUMBER: _ClassVar[int]
    damping_xy_first_hop: float
    damping_xy_other_hops: float
    damping_z: float
    def __init__(self, damping_xy_first_hop: _Optional[float] = ..., damping_xy_other_hops: _Optional[float] = ..., damping_z: _Optional[float] = ...) -> None: ...
