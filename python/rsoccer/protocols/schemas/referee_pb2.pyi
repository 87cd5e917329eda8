from google.protobuf.internal import containers as _containers
from google.protobuf.internal import enum_type_wrapper as _enum_type_wrapper
from google.protobuf import descriptor as _descriptor
from google.protobuf import message as _message
from collections.abc import Iterable as _Iterable, Mapping as _Mapping
from typing import ClassVar as _ClassVar, Optional as _Optional, Union as _Union

DESCRIPTOR: _descriptor.FileDescriptor

class MatchType(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = ()
    UNKNOWN_MATCH: _ClassVar[MatchType]
    GROUP_PHASE: _ClassVar[MatchType]
    ELIMINATION_PHASE: _ClassVar[MatchType]
    FRIENDLY: _ClassVar[MatchType]

class Stage(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = ()
    NORMAL_FIRST_HALF_PRE: _ClassVar[Stage]
    NORMAL_FIRST_HALF: _ClassVar[Stage]
    NORMAL_HALF_TIME: _ClassVar[Stage]
    NORMAL_SECOND_HALF_PRE: _ClassVar[Stage]
    NORMAL_SECOND_HALF: _ClassVar[Stage]
    EXTRA_TIME_BREAK: _ClassVar[Stage]
    EXTRA_FIRST_HALF_PRE: _ClassVar[Stage]
    EXTRA_FIRST_HALF: _ClassVar[Stage]
    EXTRA_HALF_TIME: _ClassVar[Stage]
    EXTRA_SECOND_HALF_PRE: _ClassVar[Stage]
    EXTRA_SECOND_HALF: _ClassVar[Stage]
    PENALTY_SHOOTOUT_BREAK: _ClassVar[Stage]
    PENALTY_SHOOTOUT: _ClassVar[Stage]
    POST_GAME: _ClassVar[Stage]

class Command(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = ()
    HALT: _ClassVar[Command]
    STOP: _ClassVar[Command]
    NORMAL_START: _ClassVar[Command]
    FORCE_START: _ClassVar[Command]
    PREPARE_KICKOFF_YELLOW: _ClassVar[Command]
    PREPARE_KICKOFF_BLUE: _ClassVar[Command]
    PREPARE_PENALTY_YELLOW: _ClassVar[Command]
    PREPARE_PENALTY_BLUE: _ClassVar[Command]
    DIRECT_FREE_YELLOW: _ClassVar[Command]
    DIRECT_FREE_BLUE: _ClassVar[Command]
    INDIRECT_FREE_YELLOW: _ClassVar[Command]
    INDIRECT_FREE_BLUE: _ClassVar[Command]
    TIMEOUT_YELLOW: _ClassVar[Command]
    TIMEOUT_BLUE: _ClassVar[Command]
    GOAL_YELLOW: _ClassVar[Command]
    GOAL_BLUE: _ClassVar[Command]
    BALL_PLACEMENT_YELLOW: _ClassVar[Command]
    BALL_PLACEMENT_BLUE: _ClassVar[Command]

class HullColor(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = ()
    HULL_COLOR_UNKNOWN: _ClassVar[HullColor]
    HULL_COLOR_DARK: _ClassVar[HullColor]
    HULL_COLOR_LIGHT: _ClassVar[HullColor]

class Team(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = ()
    UNKNOWN: _ClassVar[Team]
    YELLOW: _ClassVar[Team]
    BLUE: _ClassVar[Team]
UNKNOWN_MATCH: MatchType
GROUP_PHASE: MatchType
ELIMINATION_PHASE: MatchType
FRIENDLY: MatchType
NORMAL_FIRST_HALF_PRE: Stage
NORMAL_FIRST_HALF: Stage
NORMAL_HALF_TIME: Stage
NORMAL_SECOND_HALF_PRE: Stage
NORMAL_SECOND_HALF: Stage
EXTRA_TIME_BREAK: Stage
EXTRA_FIRST_HALF_PRE: Stage
EXTRA_FIRST_HALF: Stage
EXTRA_HALF_TIME: Stage
EXTRA_SECOND_HALF_PRE: Stage
EXTRA_SECOND_HALF: Stage
PENALTY_SHOOTOUT_BREAK: Stage
PENALTY_SHOOTOUT: Stage
POST_GAME: Stage
HALT: Command
STOP: Command
NORMAL_START: Command
FORCE_START: Command
PREPARE_KICKOFF_YELLOW: Command
PREPARE_KICKOFF_BLUE: Command
PREPARE_PENALTY_YELLOW: Command
PREPARE_PENALTY_BLUE: Command
DIRECT_FREE_YELLOW: Command
DIRECT_FREE_BLUE: Command
INDIRECT_FREE_YELLOW: Command
INDIRECT_FREE_BLUE: Command
TIMEOUT_YELLOW: Command
TIMEOUT_BLUE: Command
GOAL_YELLOW: Command
GOAL_BLUE: Command
BALL_PLACEMENT_YELLOW: Command
BALL_PLACEMENT_BLUE: Command
HULL_COLOR_UNKNOWN: HullColor
HULL_COLOR_DARK: HullColor
HULL_COLOR_LIGHT: HullColor
UNKNOWN: Team
YELLOW: Team
BLUE: Team

class Packet(_message.Message):
    __slots__ = ("source_identifier", "match_type", "packet_timestamp", "stage", "stage_time_left", "command", "command_counter", "command_timestamp", "next_command", "designated_position", "current_action_time_remaining", "blue", "yellow", "blue_team_on_positive_half", "game_events", "game_event_proposals", "status_message")
    SOURCE_IDENTIFIER_FIELD_NUMBER: _ClassVar[int]
    MATCH_TYPE_FIELD_NUMBER: _ClassVar[int]
    PACKET_TIMESTAMP_FIELD_NUMBER: _ClassVar[int]
    STAGE_FIELD_NUMBER: _ClassVar[int]
    STAGE_TIME_LEFT_FIELD_NUMBER: _ClassVar[int]
    COMMAND_FIELD_NUMBER: _ClassVar[int]
    COMMAND_COUNTER_FIELD_NUMBER: _ClassVar[int]
    COMMAND_TIMESTAMP_FIELD_NUMBER: _ClassVar[int]
    NEXT_COMMAND_FIELD_NUMBER: _ClassVar[int]
    DESIGNATED_POSITION_FIELD_NUMBER: _ClassVar[int]
    CURRENT_ACTION_TIME_REMAINING_FIELD_NUMBER: _ClassVar[int]
    BLUE_FIELD_NUMBER: _ClassVar[int]
    YELLOW_FIELD_NUMBER: _ClassVar[int]
    BLUE_TEAM_ON_POSITIVE_HALF_FIELD_NUMBER: _ClassVar[int]
    GAME_EVENTS_FIELD_NUMBER: _ClassVar[int]
    GAME_EVENT_PROPOSALS_FIELD_NUMBER: _ClassVar[int]
    STATUS_MESSAGE_FIELD_NUMBER: _ClassVar[int]
    source_identifier: str
    match_type: MatchType
    packet_timestamp: int
    stage: Stage
    stage_time_left: int
    command: Command
    command_counter: int
    command_timestamp: int
    next_command: Command
    designated_position: Point
    current_action_time_remaining: int
    blue: TeamInfo
    yellow: TeamInfo
    blue_team_on_positive_half: bool
    game_events: _containers.RepeatedCompositeFieldContainer[GameEvent]
    game_event_proposals: _containers.RepeatedCompositeFieldContainer[GameEventProposals]
    status_message: str
    def __init__(self, source_identifier: _Optional[str] = ..., match_type: _Optional[_Union[MatchType, str]] = ..., packet_timestamp: _Optional[int] = ..., stage: _Optional[_Union[Stage, str]] = ..., stage_time_left: _Optional[int] = ..., command: _Optional[_Union[Command, str]] = ..., command_counter: _Optional[int] = ..., command_timestamp: _Optional[int] = ..., next_command: _Optional[_Union[Command, str]] = ..., designated_position: _Optional[_Union[Point, _Mapping]] = ..., current_action_time_remaining: _Optional[int] = ..., blue: _Optional[_Union[TeamInfo, _Mapping]] = ..., yellow: _Optional[_Union[TeamInfo, _Mapping]] = ..., blue_team_on_positive_half: _Optional[bool] = ..., game_events: _Optional[_Iterable[_Union[GameEvent, _Mapping]]] = ..., game_event_proposals: _Optional[_Iterable[_Union[GameEventProposals, _Mapping]]] = ..., status_message: _Optional[str] = ...) -> None: ...

class Point(_message.Message):
    __slots__ = ("x", "y")
    X_FIELD_NUMBER: _ClassVar[int]
    Y_FIELD_NUMBER: _ClassVar[int]
    x: float
    y: float
    def __init__(self, x: _Optional[float] = ..., y: _Optional[float] = ...) -> None: ...

class TeamInfo(_message.Message):
    __slots__ = ("name", "score", "goalkeeper", "hull_color", "foul_counter", "yellow_cards", "yellow_card_times", "red_cards", "max_allowed_bots", "timeouts", "timeout_time", "can_place_ball", "ball_placement_failures", "ball_placement_failures_reached", "bot_substitution_intent", "bot_substitution_allowed", "bot_substitutions_left", "bot_substitution_time_left")
    NAME_FIELD_NUMBER: _ClassVar[int]
    SCORE_FIELD_NUMBER: _ClassVar[int]
    GOALKEEPER_FIELD_NUMBER: _ClassVar[int]
    HULL_COLOR_FIELD_NUMBER: _ClassVar[int]
    FOUL_COUNTER_FIELD_NUMBER: _ClassVar[int]
    YELLOW_CARDS_FIELD_NUMBER: _ClassVar[int]
    YELLOW_CARD_TIMES_FIELD_NUMBER: _ClassVar[int]
    RED_CARDS_FIELD_NUMBER: _ClassVar[int]
    MAX_ALLOWED_BOTS_FIELD_NUMBER: _ClassVar[int]
    TIMEOUTS_FIELD_NUMBER: _ClassVar[int]
    TIMEOUT_TIME_FIELD_NUMBER: _ClassVar[int]
    CAN_PLACE_BALL_FIELD_NUMBER: _ClassVar[int]
    BALL_PLACEMENT_FAILURES_FIELD_NUMBER: _ClassVar[int]
    BALL_PLACEMENT_FAILURES_REACHED_FIELD_NUMBER: _ClassVar[int]
    BOT_SUBSTITUTION_INTENT_FIELD_NUMBER: _ClassVar[int]
    BOT_SUBSTITUTION_ALLOWED_FIELD_NUMBER: _ClassVar[int]
    BOT_SUBSTITUTIONS_LEFT_FIELD_NUMBER: _ClassVar[int]
    BOT_SUBSTITUTION_TIME_LEFT_FIELD_NUMBER: _ClassVar[int]
    name: str
    score: int
    goalkeeper: int
    hull_color: HullColor
    foul_counter: int
    yellow_cards: int
    yellow_card_times: _containers.RepeatedScalarFieldContainer[int]
    red_cards: int
    max_allowed_bots: int
    timeouts: int
    timeout_time: int
    can_place_ball: bool
    ball_placement_failures: int
    ball_placement_failures_reached: bool
    bot_substitution_intent: bool
    bot_substitution_allowed: bool
    bot_substitutions_left: int
    bot_substitution_time_left: int
    def __init__(self, name: _Optional[str] = ..., score: _Optional[int] = ..., goalkeeper: _Optional[int] = ..., hull_color: _Optional[_Union[HullColor, str]] = ..., foul_counter: _Optional[int] = ..., yellow_cards: _Optional[int] = ..., yellow_card_times: _Optional[_Iterable[int]] = ..., red_cards: _Optional[int] = ..., max_allowed_bots: _Optional[int] = ..., timeouts: _Optional[int] = ..., timeout_time: _Optional[int] = ..., can_place_ball: _Optional[bool] = ..., ball_placement_failures: _Optional[int] = ..., ball_placement_failures_reached: _Optional[bool] = ..., bot_substitution_intent: _Optional[bool] = ..., bot_substitution_allowed: _Optional[bool] = ..., bot_substitutions_left: _Optional[int] = ..., bot_substitution_time_left: _Optional[int] = ...) -> None: ...

class Vector2(_message.Message):
    __slots__ = ("x", "y")
    X_FIELD_NUMBER: _ClassVar[int]
    Y_FIELD_NUMBER: _ClassVar[int]
    x: float
    y: float
    def __init__(self, x: _Optional[float] = ..., y: _Optional[float] = ...) -> None: ...

class GameEventProposals(_message.Message):
    __slots__ = ("id", "game_events", "accepted")
    ID_FIELD_NUMBER: _ClassVar[int]
    GAME_EVENTS_FIELD_NUMBER: _ClassVar[int]
    ACCEPTED_FIELD_NUMBER: _ClassVar[int]
    id: str
    game_events: _containers.RepeatedCompositeFieldContainer[GameEvent]
    accepted: bool
    def __init__(self, id: _Optional[str] = ..., game_events: _Optional[_Iterable[_Union[GameEvent, _Mapping]]] = ..., accepted: _Optional[bool] = ...) -> None: ...

class GameEvent(_message.Message):
    __slots__ = ("type", "origin", "created_timestamp", "id", "prepared", "no_progress_in_game", "placement_failed", "placement_succeeded", "ball_left_field_touch_line", "ball_left_field_goal_line", "goal", "indirect_goal", "chipped_goal", "aimless_kick", "kick_timeout", "keeper_held_ball", "attacker_double_touched_ball", "attacker_touched_ball_in_defense_area", "attacker_touched_opponent_in_defense_area", "bot_dribbled_ball_too_far", "bot_kicked_ball_too_fast", "attacker_too_close_to_defense_area", "bot_interfered_placement", "bot_crash_drawn", "bot_crash_unique", "bot_crash_unique_skipped", "bot_pushed_bot", "bot_pushed_bot_skipped", "bot_held_ball_deliberately", "bot_tipped_over", "bot_too_fast_in_stop", "defender_too_close_to_kick_point", "defender_in_defense_area_partially", "defender_in_defense_area", "multiple_cards", "multiple_placement_failures", "multiple_fouls", "unsporting_behavior_minor", "unsporting_behavior_major", "bot_substitution", "too_many_robots", "possible_goal", "attacker_touched_opponent_in_defense_area_skipped", "boundary_crossing", "invalid_goal", "penalty_kick_failed", "challenge_flag", "emergency_stop", "challenge_flag_handled", "bot_dropped_parts", "excessive_bot_substitution")
    class Type(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
        __slots__ = ()
        UNKNOWN_GAME_EVENT_TYPE: _ClassVar[GameEvent.Type]
        PREPARED: _ClassVar[GameEvent.Type]
        NO_PROGRESS_IN_GAME: _ClassVar[GameEvent.Type]
        PLACEMENT_FAILED: _ClassVar[GameEvent.Type]
        PLACEMENT_SUCCEEDED: _ClassVar[GameEvent.Type]
        BALL_LEFT_FIELD_TOUCH_LINE: _ClassVar[GameEvent.Type]
        BALL_LEFT_FIELD_GOAL_LINE: _ClassVar[GameEvent.Type]
        GOAL: _ClassVar[GameEvent.Type]
        INDIRECT_GOAL: _ClassVar[GameEvent.Type]
        CHIPPED_GOAL: _ClassVar[GameEvent.Type]
        AIMLESS_KICK: _ClassVar[GameEvent.Type]
        KICK_TIMEOUT: _ClassVar[GameEvent.Type]
        KEEPER_HELD_BALL: _ClassVar[GameEvent.Type]
        ATTACKER_DOUBLE_TOUCHED_BALL: _ClassVar[GameEvent.Type]
        ATTACKER_TOUCHED_BALL_IN_DEFENSE_AREA: _ClassVar[GameEvent.Type]
        ATTACKER_TOUCHED_OPPONENT_IN_DEFENSE_AREA: _ClassVar[GameEvent.Type]
        BOT_DRIBBLED_BALL_TOO_FAR: _ClassVar[GameEvent.Type]
        BOT_KICKED_BALL_TOO_FAST: _ClassVar[GameEvent.Type]
        ATTACKER_TOO_CLOSE_TO_DEFENSE_AREA: _ClassVar[GameEvent.Type]
        BOT_INTERFERED_PLACEMENT: _ClassVar[GameEvent.Type]
        BOT_CRASH_DRAWN: _ClassVar[GameEvent.Type]
        BOT_CRASH_UNIQUE: _ClassVar[GameEvent.Type]
        BOT_CRASH_UNIQUE_SKIPPED: _ClassVar[GameEvent.Type]
        BOT_PUSHED_BOT: _ClassVar[GameEvent.Type]
        BOT_PUSHED_BOT_SKIPPED: _ClassVar[GameEvent.Type]
        BOT_HELD_BALL_DELIBERATELY: _ClassVar[GameEvent.Type]
        BOT_TIPPED_OVER: _ClassVar[GameEvent.Type]
        BOT_TOO_FAST_IN_STOP: _ClassVar[GameEvent.Type]
        DEFENDER_TOO_CLOSE_TO_KICK_POINT: _ClassVar[GameEvent.Type]
        DEFENDER_IN_DEFENSE_AREA_PARTIALLY: _ClassVar[GameEvent.Type]
        DEFENDER_IN_DEFENSE_AREA: _ClassVar[GameEvent.Type]
        MULTIPLE_CARDS: _ClassVar[GameEvent.Type]
        MULTIPLE_PLACEMENT_FAILURES: _ClassVar[GameEvent.Type]
        MULTIPLE_FOULS: _ClassVar[GameEvent.Type]
        UNSPORTING_BEHAVIOR_MINOR: _ClassVar[GameEvent.Type]
        UNSPORTING_BEHAVIOR_MAJOR: _ClassVar[GameEvent.Type]
        BOT_SUBSTITUTION: _ClassVar[GameEvent.Type]
        TOO_MANY_ROBOTS: _ClassVar[GameEvent.Type]
        POSSIBLE_GOAL: _ClassVar[GameEvent.Type]
        ATTACKER_TOUCHED_OPPONENT_IN_DEFENSE_AREA_SKIPPED: _ClassVar[GameEvent.Type]
        BOUNDARY_CROSSING: _ClassVar[GameEvent.Type]
        INVALID_GOAL: _ClassVar[GameEvent.Type]
        PENALTY_KICK_FAILED: _ClassVar[GameEvent.Type]
        CHALLENGE_FLAG: _ClassVar[GameEvent.Type]
        EMERGENCY_STOP: _ClassVar[GameEvent.Type]
        CHALLENGE_FLAG_HANDLED: _ClassVar[GameEvent.Type]
        BOT_DROPPED_PARTS: _ClassVar[GameEvent.Type]
        EXCESSIVE_BOT_SUBSTITUTION: _ClassVar[GameEvent.Type]
    UNKNOWN_GAME_EVENT_TYPE: GameEvent.Type
    PREPARED: GameEvent.Type
    NO_PROGRESS_IN_GAME: GameEvent.Type
    PLACEMENT_FAILED: GameEvent.Type
    PLACEMENT_SUCCEEDED: GameEvent.Type
    BALL_LEFT_FIELD_TOUCH_LINE: GameEvent.Type
    BALL_LEFT_FIELD_GOAL_LINE: GameEvent.Type
    GOAL: GameEvent.Type
    INDIRECT_GOAL: GameEvent.Type
    CHIPPED_GOAL: GameEvent.Type
    AIMLESS_KICK: GameEvent.Type
    KICK_TIMEOUT: GameEvent.Type
    KEEPER_HELD_BALL: GameEvent.Type
    ATTACKER_DOUBLE_TOUCHED_BALL: GameEvent.Type
    ATTACKER_TOUCHED_BALL_IN_DEFENSE_AREA: GameEvent.Type
    ATTACKER_TOUCHED_OPPONENT_IN_DEFENSE_AREA: GameEvent.Type
    BOT_DRIBBLED_BALL_TOO_FAR: GameEvent.Type
    BOT_KICKED_BALL_TOO_FAST: GameEvent.Type
    ATTACKER_TOO_CLOSE_TO_DEFENSE_AREA: GameEvent.Type
    BOT_INTERFERED_PLACEMENT: GameEvent.Type
    BOT_CRASH_DRAWN: GameEvent.Type
    BOT_CRASH_UNIQUE: GameEvent.Type
    BOT_CRASH_UNIQUE_SKIPPED: GameEvent.Type
    BOT_PUSHED_BOT: GameEvent.Type
    BOT_PUSHED_BOT_SKIPPED: GameEvent.Type
    BOT_HELD_BALL_DELIBERATELY: GameEvent.Type
    BOT_TIPPED_OVER: GameEvent.Type
    BOT_TOO_FAST_IN_STOP: GameEvent.Type
    DEFENDER_TOO_CLOSE_TO_KICK_POINT: GameEvent.Type
    DEFENDER_IN_DEFENSE_AREA_PARTIALLY: GameEvent.Type
    DEFENDER_IN_DEFENSE_AREA: GameEvent.Type
    MULTIPLE_CARDS: GameEvent.Type
    MULTIPLE_PLACEMENT_FAILURES: GameEvent.Type
    MULTIPLE_FOULS: GameEvent.Type
    UNSPORTING_BEHAVIOR_MINOR: GameEvent.Type
    UNSPORTING_BEHAVIOR_MAJOR: GameEvent.Type
    BOT_SUBSTITUTION: GameEvent.Type
    TOO_MANY_ROBOTS: GameEvent.Type
    POSSIBLE_GOAL: GameEvent.Type
    ATTACKER_TOUCHED_OPPONENT_IN_DEFENSE_AREA_SKIPPED: GameEvent.Type
    BOUNDARY_CROSSING: GameEvent.Type
    INVALID_GOAL: GameEvent.Type
    PENALTY_KICK_FAILED: GameEvent.Type
    CHALLENGE_FLAG: GameEvent.Type
    EMERGENCY_STOP: GameEvent.Type
    CHALLENGE_FLAG_HANDLED: GameEvent.Type
    BOT_DROPPED_PARTS: GameEvent.Type
    EXCESSIVE_BOT_SUBSTITUTION: GameEvent.Type
    TYPE_FIELD_NUMBER: _ClassVar[int]
    ORIGIN_FIELD_NUMBER: _ClassVar[int]
    CREATED_TIMESTAMP_FIELD_NUMBER: _ClassVar[int]
    ID_FIELD_NUMBER: _ClassVar[int]
    PREPARED_FIELD_NUMBER: _ClassVar[int]
    NO_PROGRESS_IN_GAME_FIELD_NUMBER: _ClassVar[int]
    PLACEMENT_FAILED_FIELD_NUMBER: _ClassVar[int]
    PLACEMENT_SUCCEEDED_FIELD_NUMBER: _ClassVar[int]
    BALL_LEFT_FIELD_TOUCH_LINE_FIELD_NUMBER: _ClassVar[int]
    BALL_LEFT_FIELD_GOAL_LINE_FIELD_NUMBER: _ClassVar[int]
    GOAL_FIELD_NUMBER: _ClassVar[int]
    INDIRECT_GOAL_FIELD_NUMBER: _ClassVar[int]
    CHIPPED_GOAL_FIELD_NUMBER: _ClassVar[int]
    AIMLESS_KICK_FIELD_NUMBER: _ClassVar[int]
    KICK_TIMEOUT_FIELD_NUMBER: _ClassVar[int]
    KEEPER_HELD_BALL_FIELD_NUMBER: _ClassVar[int]
    ATTACKER_DOUBLE_TOUCHED_BALL_FIELD_NUMBER: _ClassVar[int]
    ATTACKER_TOUCHED_BALL_IN_DEFENSE_AREA_FIELD_NUMBER: _ClassVar[int]
    ATTACKER_TOUCHED_OPPONENT_IN_DEFENSE_AREA_FIELD_NUMBER: _ClassVar[int]
    BOT_DRIBBLED_BALL_TOO_FAR_FIELD_NUMBER: _ClassVar[int]
    BOT_KICKED_BALL_TOO_FAST_FIELD_NUMBER: _ClassVar[int]
    ATTACKER_TOO_CLOSE_TO_DEFENSE_AREA_FIELD_NUMBER: _ClassVar[int]
    BOT_INTERFERED_PLACEMENT_FIELD_NUMBER: _ClassVar[int]
    BOT_CRASH_DRAWN_FIELD_NUMBER: _ClassVar[int]
    BOT_CRASH_UNIQUE_FIELD_NUMBER: _ClassVar[int]
    BOT_CRASH_UNIQUE_SKIPPED_FIELD_NUMBER: _ClassVar[int]
    BOT_PUSHED_BOT_FIELD_NUMBER: _ClassVar[int]
    BOT_PUSHED_BOT_SKIPPED_FIELD_NUMBER: _ClassVar[int]
    BOT_HELD_BALL_DELIBERATELY_FIELD_NUMBER: _ClassVar[int]
    BOT_TIPPED_OVER_FIELD_NUMBER: _ClassVar[int]
    BOT_TOO_FAST_IN_STOP_FIELD_NUMBER: _ClassVar[int]
    DEFENDER_TOO_CLOSE_TO_KICK_POINT_FIELD_NUMBER: _ClassVar[int]
    DEFENDER_IN_DEFENSE_AREA_PARTIALLY_FIELD_NUMBER: _ClassVar[int]
    DEFENDER_IN_DEFENSE_AREA_FIELD_NUMBER: _ClassVar[int]
    MULTIPLE_CARDS_FIELD_NUMBER: _ClassVar[int]
    MULTIPLE_PLACEMENT_FAILURES_FIELD_NUMBER: _ClassVar[int]
    MULTIPLE_FOULS_FIELD_NUMBER: _ClassVar[int]
    UNSPORTING_BEHAVIOR_MINOR_FIELD_NUMBER: _ClassVar[int]
    UNSPORTING_BEHAVIOR_MAJOR_FIELD_NUMBER: _ClassVar[int]
    BOT_SUBSTITUTION_FIELD_NUMBER: _ClassVar[int]
    TOO_MANY_ROBOTS_FIELD_NUMBER: _ClassVar[int]
    POSSIBLE_GOAL_FIELD_NUMBER: _ClassVar[int]
    ATTACKER_TOUCHED_OPPONENT_IN_DEFENSE_AREA_SKIPPED_FIELD_NUMBER: _ClassVar[int]
    BOUNDARY_CROSSING_FIELD_NUMBER: _ClassVar[int]
    INVALID_GOAL_FIELD_NUMBER: _ClassVar[int]
    PENALTY_KICK_FAILED_FIELD_NUMBER: _ClassVar[int]
    CHALLENGE_FLAG_FIELD_NUMBER: _ClassVar[int]
    EMERGENCY_STOP_FIELD_NUMBER: _ClassVar[int]
    CHALLENGE_FLAG_HANDLED_FIELD_NUMBER: _ClassVar[int]
    BOT_DROPPED_PARTS_FIELD_NUMBER: _ClassVar[int]
    EXCESSIVE_BOT_SUBSTITUTION_FIELD_NUMBER: _ClassVar[int]
    type: GameEvent.Type
    origin: _containers.RepeatedScalarFieldContainer[str]
    created_timestamp: int
    id: str
    prepared: Prepared
    no_progress_in_game: NoProgressInGame
    placement_failed: PlacementFailed
    placement_succeeded: PlacementSucceeded
    ball_left_field_touch_line: BallLeftField
    ball_left_field_goal_line: BallLeftField
    goal: Goal
    indirect_goal: IndirectGoal
    chipped_goal: ChippedGoal
    aimless_kick: AimlessKick
    kick_timeout: KickTimeout
    keeper_held_ball: KeeperHeldBall
    attacker_double_touched_ball: AttackerDoubleTouchedBall
    attacker_touched_ball_in_defense_area: AttackerTouchedBallInDefenseArea
    attacker_touched_opponent_in_defense_area: AttackerTouchedOpponentInDefenseArea
    bot_dribbled_ball_too_far: BotDribbledBallTooFar
    bot_kicked_ball_too_fast: BotKickedBallTooFast
    attacker_too_close_to_defense_area: AttackerTooCloseToDefenseArea
    bot_interfered_placement: BotInterferedPlacement
    bot_crash_drawn: BotCrashDrawn
    bot_crash_unique: BotCrashUnique
    bot_crash_unique_skipped: BotCrashUnique
    bot_pushed_bot: BotPushedBot
    bot_pushed_bot_skipped: BotPushedBot
    bot_held_ball_deliberately: BotHeldBallDeliberately
    bot_tipped_over: BotTippedOver
    bot_too_fast_in_stop: BotTooFastInStop
    defender_too_close_to_kick_point: DefenderTooCloseToKickPoint
    defender_in_defense_area_partially: DefenderInDefenseAreaPartially
    defender_in_defense_area: DefenderInDefenseArea
    multiple_cards: MultipleCards
    multiple_placement_failures: MultiplePlacementFailures
    multiple_fouls: MultipleFouls
    unsporting_behavior_minor: UnsportingBehaviorMinor
    unsporting_behavior_major: UnsportingBehaviorMajor
    bot_substitution: BotSubstitution
    too_many_robots: TooManyRobots
    possible_goal: Goal
    attacker_touched_opponent_in_defense_area_skipped: AttackerTouchedOpponentInDefenseArea
    boundary_crossing: BoundaryCrossing
    invalid_goal: Goal
    penalty_kick_failed: PenaltyKickFailed
    challenge_flag: ChallengeFlag
    emergency_stop: EmergencyStop
    challenge_flag_handled: ChallengeFlagHandled
    bot_dropped_parts: BotDroppedParts
    excessive_bot_substitution: ExcessiveBotSubstitution
    def __init__(self, type: _Optional[_Union[GameEvent.Type, str]] = ..., origin: _Optional[_Iterable[str]] = ..., created_timestamp: _Optional[int] = ..., id: _Optional[str] = ..., prepared: _Optional[_Union[Prepared, _Mapping]] = ..., no_progress_in_game: _Optional[_Union[NoProgressInGame, _Mapping]] = ..., placement_failed: _Optional[_Union[PlacementFailed, _Mapping]] = ..., placement_succeeded: _Optional[_Union[PlacementSucceeded, _Mapping]] = ..., ball_left_field_touch_line: _Optional[_Union[BallLeftField, _Mapping]] = ..., ball_left_field_goal_line: _Optional[_Union[BallLeftField, _Mapping]] = ..., goal: _Optional[_Union[Goal, _Mapping]] = ..., indirect_goal: _Optional[_Union[IndirectGoal, _Mapping]] = ..., chipped_goal: _Optional[_Union[ChippedGoal, _Mapping]] = ..., aimless_kick: _Optional[_Union[AimlessKick, _Mapping]] = ..., kick_timeout: _Optional[_Union[KickTimeout, _Mapping]] = ..., keeper_held_ball: _Optional[_Union[KeeperHeldBall, _Mapping]] = ..., attacker_double_touched_ball: _Optional[_Union[AttackerDoubleTouchedBall, _Mapping]] = ..., attacker_touched_ball_in_defense_area: _Optional[_Union[AttackerTouchedBallInDefenseArea, _Mapping]] = ..., attacker_touched_opponent_in_defense_area: _Optional[_Union[AttackerTouchedOpponentInDefenseArea, _Mapping]] = ..., bot_dribbled_ball_too_far: _Optional[_Union[BotDribbledBallTooFar, _Mapping]] = ..., bot_kicked_ball_too_fast: _Optional[_Union[BotKickedBallTooFast, _Mapping]] = ..., attacker_too_close_to_defense_area: _Optional[_Union[AttackerTooCloseToDefenseArea, _Mapping]] = ..., bot_interfered_placement: _Optional[_Union[BotInterferedPlacement, _Mapping]] = ..., bot_crash_drawn: _Optional[_Union[BotCrashDrawn, _Mapping]] = ..., bot_crash_unique: _Optional[_Union[BotCrashUnique, _Mapping]] = ..., bot_crash_unique_skipped: _Optional[_Union[BotCrashUnique, _Mapping]] = ..., bot_pushed_bot: _Optional[_Union[BotPushedBot, _Mapping]] = ..., bot_pushed_bot_skipped: _Optional[_Union[BotPushedBot, _Mapping]] = ..., bot_held_ball_deliberately: _Optional[_Union[BotHeldBallDeliberately, _Mapping]] = ..., bot_tipped_over: _Optional[_Union[BotTippedOver, _Mapping]] = ..., bot_too_fast_in_stop: _Optional[_Union[BotTooFastInStop, _Mapping]] = ..., defender_too_close_to_kick_point: _Optional[_Union[DefenderTooCloseToKickPoint, _Mapping]] = ..., defender_in_defense_area_partially: _Optional[_Union[DefenderInDefenseAreaPartially, _Mapping]] = ..., defender_in_defense_area: _Optional[_Union[DefenderInDefenseArea, _Mapping]] = ..., multiple_cards: _Optional[_Union[MultipleCards, _Mapping]] = ..., multiple_placement_failures: _Optional[_Union[MultiplePlacementFailures, _Mapping]] = ..., multiple_fouls: _Optional[_Union[MultipleFouls, _Mapping]] = ..., unsporting_behavior_minor: _Optional[_Union[UnsportingBehaviorMinor, _Mapping]] = ..., unsporting_behavior_major: _Optional[_Union[UnsportingBehaviorMajor, _Mapping]] = ..., bot_substitution: _Optional[_Union[BotSubstitution, _Mapping]] = ..., too_many_robots: _Optional[_Union[TooManyRobots, _Mapping]] = ..., possible_goal: _Optional[_Union[Goal, _Mapping]] = ..., attacker_touched_opponent_in_defense_area_skipped: _Optional[_Union[AttackerTouchedOpponentInDefenseArea, _Mapping]] = ..., boundary_crossing: _Optional[_Union[BoundaryCrossing, _Mapping]] = ..., invalid_goal: _Optional[_Union[Goal, _Mapping]] = ..., penalty_kick_failed: _Optional[_Union[PenaltyKickFailed, _Mapping]] = ..., challenge_flag: _Optional[_Union[ChallengeFlag, _Mapping]] = ..., emergency_stop: _Optional[_Union[EmergencyStop, _Mapping]] = ..., challenge_flag_handled: _Optional[_Union[ChallengeFlagHandled, _Mapping]] = ..., bot_dropped_parts: _Optional[_Union[BotDroppedParts, _Mapping]] = ..., excessive_bot_substitution: _Optional[_Union[ExcessiveBotSubstitution, _Mapping]] = ...) -> None: ...

class AimlessKick(_message.Message):
    __slots__ = ("by_team", "by_bot", "location", "kick_location")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    BY_BOT_FIELD_NUMBER: _ClassVar[int]
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    KICK_LOCATION_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    by_bot: int
    location: Vector2
    kick_location: Vector2
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., by_bot: _Optional[int] = ..., location: _Optional[_Union[Vector2, _Mapping]] = ..., kick_location: _Optional[_Union[Vector2, _Mapping]] = ...) -> None: ...

class AttackerDoubleTouchedBall(_message.Message):
    __slots__ = ("by_team", "by_bot", "location")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    BY_BOT_FIELD_NUMBER: _ClassVar[int]
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    by_bot: int
    location: Vector2
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., by_bot: _Optional[int] = ..., location: _Optional[_Union[Vector2, _Mapping]] = ...) -> None: ...

class AttackerTooCloseToDefenseArea(_message.Message):
    __slots__ = ("by_team", "by_bot", "location", "distance", "ball_location")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    BY_BOT_FIELD_NUMBER: _ClassVar[int]
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    DISTANCE_FIELD_NUMBER: _ClassVar[int]
    BALL_LOCATION_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    by_bot: int
    location: Vector2
    distance: float
    ball_location: Vector2
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., by_bot: _Optional[int] = ..., location: _Optional[_Union[Vector2, _Mapping]] = ..., distance: _Optional[float] = ..., ball_location: _Optional[_Union[Vector2, _Mapping]] = ...) -> None: ...

class AttackerTouchedBallInDefenseArea(_message.Message):
    __slots__ = ("by_team", "by_bot", "location", "distance")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    BY_BOT_FIELD_NUMBER: _ClassVar[int]
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    DISTANCE_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    by_bot: int
    location: Vector2
    distance: float
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., by_bot: _Optional[int] = ..., location: _Optional[_Union[Vector2, _Mapping]] = ..., distance: _Optional[float] = ...) -> None: ...

class AttackerTouchedOpponentInDefenseArea(_message.Message):
    __slots__ = ("by_team", "by_bot", "location", "victim")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    BY_BOT_FIELD_NUMBER: _ClassVar[int]
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    VICTIM_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    by_bot: int
    location: Vector2
    victim: int
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., by_bot: _Optional[int] = ..., location: _Optional[_Union[Vector2, _Mapping]] = ..., victim: _Optional[int] = ...) -> None: ...

class BallLeftField(_message.Message):
    __slots__ = ("by_team", "by_bot", "location")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    BY_BOT_FIELD_NUMBER: _ClassVar[int]
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    by_bot: int
    location: Vector2
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., by_bot: _Optional[int] = ..., location: _Optional[_Union[Vector2, _Mapping]] = ...) -> None: ...

class BotCrashDrawn(_message.Message):
    __slots__ = ("bot_yellow", "bot_blue", "location", "crash_speed", "speed_diff", "crash_angle")
    BOT_YELLOW_FIELD_NUMBER: _ClassVar[int]
    BOT_BLUE_FIELD_NUMBER: _ClassVar[int]
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    CRASH_SPEED_FIELD_NUMBER: _ClassVar[int]
    SPEED_DIFF_FIELD_NUMBER: _ClassVar[int]
    CRASH_ANGLE_FIELD_NUMBER: _ClassVar[int]
    bot_yellow: int
    bot_blue: int
    location: Vector2
    crash_speed: float
    speed_diff: float
    crash_angle: float
    def __init__(self, bot_yellow: _Optional[int] = ..., bot_blue: _Optional[int] = ..., location: _Optional[_Union[Vector2, _Mapping]] = ..., crash_speed: _Optional[float] = ..., speed_diff: _Optional[float] = ..., crash_angle: _Optional[float] = ...) -> None: ...

class BotCrashUnique(_message.Message):
    __slots__ = ("by_team", "violator", "victim", "location", "crash_speed", "speed_diff", "crash_angle")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    VIOLATOR_FIELD_NUMBER: _ClassVar[int]
    VICTIM_FIELD_NUMBER: _ClassVar[int]
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    CRASH_SPEED_FIELD_NUMBER: _ClassVar[int]
    SPEED_DIFF_FIELD_NUMBER: _ClassVar[int]
    CRASH_ANGLE_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    violator: int
    victim: int
    location: Vector2
    crash_speed: float
    speed_diff: float
    crash_angle: float
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., violator: _Optional[int] = ..., victim: _Optional[int] = ..., location: _Optional[_Union[Vector2, _Mapping]] = ..., crash_speed: _Optional[float] = ..., speed_diff: _Optional[float] = ..., crash_angle: _Optional[float] = ...) -> None: ...

class BotDribbledBallTooFar(_message.Message):
    __slots__ = ("by_team", "by_bot", "start", "end")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    BY_BOT_FIELD_NUMBER: _ClassVar[int]
    START_FIELD_NUMBER: _ClassVar[int]
    END_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    by_bot: int
    start: Vector2
    end: Vector2
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., by_bot: _Optional[int] = ..., start: _Optional[_Union[Vector2, _Mapping]] = ..., end: _Optional[_Union[Vector2, _Mapping]] = ...) -> None: ...

class BotDroppedParts(_message.Message):
    __slots__ = ("by_team", "by_bot", "location", "ball_location")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    BY_BOT_FIELD_NUMBER: _ClassVar[int]
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    BALL_LOCATION_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    by_bot: int
    location: Vector2
    ball_location: Vector2
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., by_bot: _Optional[int] = ..., location: _Optional[_Union[Vector2, _Mapping]] = ..., ball_location: _Optional[_Union[Vector2, _Mapping]] = ...) -> None: ...

class BotHeldBallDeliberately(_message.Message):
    __slots__ = ("by_team", "by_bot", "location", "duration")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    BY_BOT_FIELD_NUMBER: _ClassVar[int]
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    DURATION_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    by_bot: int
    location: Vector2
    duration: float
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., by_bot: _Optional[int] = ..., location: _Optional[_Union[Vector2, _Mapping]] = ..., duration: _Optional[float] = ...) -> None: ...

class BotInterferedPlacement(_message.Message):
    __slots__ = ("by_team", "by_bot", "location")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    BY_BOT_FIELD_NUMBER: _ClassVar[int]
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    by_bot: int
    location: Vector2
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., by_bot: _Optional[int] = ..., location: _Optional[_Union[Vector2, _Mapping]] = ...) -> None: ...

class BotKickedBallTooFast(_message.Message):
    __slots__ = ("by_team", "by_bot", "location", "initial_ball_speed", "chipped")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    BY_BOT_FIELD_NUMBER: _ClassVar[int]
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    INITIAL_BALL_SPEED_FIELD_NUMBER: _ClassVar[int]
    CHIPPED_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    by_bot: int
    location: Vector2
    initial_ball_speed: float
    chipped: bool
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., by_bot: _Optional[int] = ..., location: _Optional[_Union[Vector2, _Mapping]] = ..., initial_ball_speed: _Optional[float] = ..., chipped: _Optional[bool] = ...) -> None: ...

class BotPushedBot(_message.Message):
    __slots__ = ("by_team", "violator", "victim", "location", "pushed_distance")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    VIOLATOR_FIELD_NUMBER: _ClassVar[int]
    VICTIM_FIELD_NUMBER: _ClassVar[int]
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    PUSHED_DISTANCE_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    violator: int
    victim: int
    location: Vector2
    pushed_distance: float
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., violator: _Optional[int] = ..., victim: _Optional[int] = ..., location: _Optional[_Union[Vector2, _Mapping]] = ..., pushed_distance: _Optional[float] = ...) -> None: ...

class BotSubstitution(_message.Message):
    __slots__ = ("by_team",)
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ...) -> None: ...

class BotTippedOver(_message.Message):
    __slots__ = ("by_team", "by_bot", "location", "ball_location")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    BY_BOT_FIELD_NUMBER: _ClassVar[int]
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    BALL_LOCATION_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    by_bot: int
    location: Vector2
    ball_location: Vector2
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., by_bot: _Optional[int] = ..., location: _Optional[_Union[Vector2, _Mapping]] = ..., ball_location: _Optional[_Union[Vector2, _Mapping]] = ...) -> None: ...

class BotTooFastInStop(_message.Message):
    __slots__ = ("by_team", "by_bot", "location", "speed")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    BY_BOT_FIELD_NUMBER: _ClassVar[int]
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    SPEED_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    by_bot: int
    location: Vector2
    speed: float
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., by_bot: _Optional[int] = ..., location: _Optional[_Union[Vector2, _Mapping]] = ..., speed: _Optional[float] = ...) -> None: ...

class BoundaryCrossing(_message.Message):
    __slots__ = ("by_team", "location")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    location: Vector2
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., location: _Optional[_Union[Vector2, _Mapping]] = ...) -> None: ...

class ChallengeFlag(_message.Message):
    __slots__ = ("by_team",)
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ...) -> None: ...

class ChallengeFlagHandled(_message.Message):
    __slots__ = ("by_team", "accepted")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    ACCEPTED_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    accepted: bool
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., accepted: _Optional[bool] = ...) -> None: ...

class ChippedGoal(_message.Message):
    __slots__ = ("by_team", "by_bot", "location", "kick_location", "max_ball_height")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    BY_BOT_FIELD_NUMBER: _ClassVar[int]
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    KICK_LOCATION_FIELD_NUMBER: _ClassVar[int]
    MAX_BALL_HEIGHT_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    by_bot: int
    location: Vector2
    kick_location: Vector2
    max_ball_height: float
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., by_bot: _Optional[int] = ..., location: _Optional[_Union[Vector2, _Mapping]] = ..., kick_location: _Optional[_Union[Vector2, _Mapping]] = ..., max_ball_height: _Optional[float] = ...) -> None: ...

class DefenderInDefenseArea(_message.Message):
    __slots__ = ("by_team", "by_bot", "location", "distance")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    BY_BOT_FIELD_NUMBER: _ClassVar[int]
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    DISTANCE_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    by_bot: int
    location: Vector2
    distance: float
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., by_bot: _Optional[int] = ..., location: _Optional[_Union[Vector2, _Mapping]] = ..., distance: _Optional[float] = ...) -> None: ...

class DefenderInDefenseAreaPartially(_message.Message):
    __slots__ = ("by_team", "by_bot", "location", "distance", "ball_location")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    BY_BOT_FIELD_NUMBER: _ClassVar[int]
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    DISTANCE_FIELD_NUMBER: _ClassVar[int]
    BALL_LOCATION_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    by_bot: int
    location: Vector2
    distance: float
    ball_location: Vector2
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., by_bot: _Optional[int] = ..., location: _Optional[_Union[Vector2, _Mapping]] = ..., distance: _Optional[float] = ..., ball_location: _Optional[_Union[Vector2, _Mapping]] = ...) -> None: ...

class DefenderTooCloseToKickPoint(_message.Message):
    __slots__ = ("by_team", "by_bot", "location", "distance")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    BY_BOT_FIELD_NUMBER: _ClassVar[int]
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    DISTANCE_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    by_bot: int
    location: Vector2
    distance: float
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., by_bot: _Optional[int] = ..., location: _Optional[_Union[Vector2, _Mapping]] = ..., distance: _Optional[float] = ...) -> None: ...

class EmergencyStop(_message.Message):
    __slots__ = ("by_team",)
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ...) -> None: ...

class ExcessiveBotSubstitution(_message.Message):
    __slots__ = ("by_team",)
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ...) -> None: ...

class Goal(_message.Message):
    __slots__ = ("by_team", "kicking_bot", "location", "kick_location", "max_ball_height", "kicking_team", "num_robots_by_team", "last_touch_by_team", "message")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    KICKING_BOT_FIELD_NUMBER: _ClassVar[int]
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    KICK_LOCATION_FIELD_NUMBER: _ClassVar[int]
    MAX_BALL_HEIGHT_FIELD_NUMBER: _ClassVar[int]
    KICKING_TEAM_FIELD_NUMBER: _ClassVar[int]
    NUM_ROBOTS_BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    LAST_TOUCH_BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    MESSAGE_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    kicking_bot: int
    location: Vector2
    kick_location: Vector2
    max_ball_height: float
    kicking_team: Team
    num_robots_by_team: int
    last_touch_by_team: int
    message: str
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., kicking_bot: _Optional[int] = ..., location: _Optional[_Union[Vector2, _Mapping]] = ..., kick_location: _Optional[_Union[Vector2, _Mapping]] = ..., max_ball_height: _Optional[float] = ..., kicking_team: _Optional[_Union[Team, str]] = ..., num_robots_by_team: _Optional[int] = ..., last_touch_by_team: _Optional[int] = ..., message: _Optional[str] = ...) -> None: ...

class IndirectGoal(_message.Message):
    __slots__ = ("by_team", "by_bot", "location", "kick_location")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    BY_BOT_FIELD_NUMBER: _ClassVar[int]
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    KICK_LOCATION_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    by_bot: int
    location: Vector2
    kick_location: Vector2
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., by_bot: _Optional[int] = ..., location: _Optional[_Union[Vector2, _Mapping]] = ..., kick_location: _Optional[_Union[Vector2, _Mapping]] = ...) -> None: ...

class KeeperHeldBall(_message.Message):
    __slots__ = ("by_team", "location", "duration")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    DURATION_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    location: Vector2
    duration: float
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., location: _Optional[_Union[Vector2, _Mapping]] = ..., duration: _Optional[float] = ...) -> None: ...

class KickTimeout(_message.Message):
    __slots__ = ("by_team", "location", "time")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    TIME_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    location: Vector2
    time: float
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., location: _Optional[_Union[Vector2, _Mapping]] = ..., time: _Optional[float] = ...) -> None: ...

class MultipleCards(_message.Message):
    __slots__ = ("by_team",)
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ...) -> None: ...

class MultipleFouls(_message.Message):
    __slots__ = ("by_team", "caused_game_events")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    CAUSED_GAME_EVENTS_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    caused_game_events: _containers.RepeatedCompositeFieldContainer[GameEvent]
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., caused_game_events: _Optional[_Iterable[_Union[GameEvent, _Mapping]]] = ...) -> None: ...

class MultiplePlacementFailures(_message.Message):
    __slots__ = ("by_team",)
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ...) -> None: ...

class NoProgressInGame(_message.Message):
    __slots__ = ("location", "time")
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    TIME_FIELD_NUMBER: _ClassVar[int]
    location: Vector2
    time: float
    def __init__(self, location: _Optional[_Union[Vector2, _Mapping]] = ..., time: _Optional[float] = ...) -> None: ...

class PenaltyKickFailed(_message.Message):
    __slots__ = ("by_team", "location", "reason")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    LOCATION_FIELD_NUMBER: _ClassVar[int]
    REASON_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    location: Vector2
    reason: str
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., location: _Optional[_Union[Vector2, _Mapping]] = ..., reason: _Optional[str] = ...) -> None: ...

class PlacementFailed(_message.Message):
    __slots__ = ("by_team", "remaining_distance", "nearest_own_bot_distance")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    REMAINING_DISTANCE_FIELD_NUMBER: _ClassVar[int]
    NEAREST_OWN_BOT_DISTANCE_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    remaining_distance: float
    nearest_own_bot_distance: float
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., remaining_distance: _Optional[float] = ..., nearest_own_bot_distance: _Optional[float] = ...) -> None: ...

class PlacementSucceeded(_message.Message):
    __slots__ = ("by_team", "time_taken", "precision", "distance")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    TIME_TAKEN_FIELD_NUMBER: _ClassVar[int]
    PRECISION_FIELD_NUMBER: _ClassVar[int]
    DISTANCE_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    time_taken: float
    precision: float
    distance: float
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., time_taken: _Optional[float] = ..., precision: _Optional[float] = ..., distance: _Optional[float] = ...) -> None: ...

class Prepared(_message.Message):
    __slots__ = ("time_taken",)
    TIME_TAKEN_FIELD_NUMBER: _ClassVar[int]
    time_taken: float
    def __init__(self, time_taken: _Optional[float] = ...) -> None: ...

class TooManyRobots(_message.Message):
    __slots__ = ("by_team", "num_robots_allowed", "num_robots_on_field", "ball_location")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    NUM_ROBOTS_ALLOWED_FIELD_NUMBER: _ClassVar[int]
    NUM_ROBOTS_ON_FIELD_FIELD_NUMBER: _ClassVar[int]
    BALL_LOCATION_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    num_robots_allowed: int
    num_robots_on_field: int
    ball_location: Vector2
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., num_robots_allowed: _Optional[int] = ..., num_robots_on_field: _Optional[int] = ..., ball_location: _Optional[_Union[Vector2, _Mapping]] = ...) -> None: ...

class UnsportingBehaviorMajor(_message.Message):
    __slots__ = ("by_team", "reason")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    REASON_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    reason: str
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., reason: _Optional[str] = ...) -> None: ...

class UnsportingBehaviorMinor(_message.Message):
    __slots__ = ("by_team", "reason")
    BY_TEAM_FIELD_NUMBER: _ClassVar[int]
    REASON_FIELD_NUMBER: _ClassVar[int]
    by_team: Team
    reason: str
    def __init__(self, by_team: _Optional[_Union[Team, str]] = ..., reason: _Optional[str] = ...) -> None: ...
