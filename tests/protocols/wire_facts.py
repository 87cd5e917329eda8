"""Wire format of the leagues: fields and values of enumerations, by the messages of the schemas.

Sources: ssl-vision c06bb3f, ssl-game-controller 78a9b3b, ssl-simulation-protocol 65ad614, grSim
fe2bd29, FIRASim 8955749, VSSReferee 2862742. Read from their descriptors on 2026-11-25.
"""

# Of each field: number, name, type or name of the message, label; "oneof" is one of a choice.
MESSAGES = """
fira.Ball
  1 x double optional
  2 y double optional
  3 z double optional
  4 vx double optional
  5 vy double optional
  6 vz double optional
fira.BallReplacement
  1 x double optional
  2 y double optional
  3 vx double optional
  4 vy double optional
fira.Command
  1 id uint32 optional
  2 yellowteam bool optional
  6 wheel_left double optional
  7 wheel_right double optional
fira.Commands
  1 robot_commands Command repeated
fira.Environment
  1 step uint32 optional
  2 frame Frame optional
  3 field Field optional
  4 goals_blue uint32 optional
  5 goals_yellow uint32 optional
fira.Field
  1 width double optional
  2 length double optional
  3 goal_width double optional
  4 goal_depth double optional
  5 center_radius double optional
  6 penalty_width double optional
  7 penalty_depth double optional
  8 penalty_point double optional
fira.Frame
  1 ball Ball optional
  2 robots_yellow Robot repeated
  3 robots_blue Robot repeated
fira.Packet
  1 cmd Commands optional
  2 replace Replacement optional
fira.Replacement
  1 ball BallReplacement optional
  2 robots RobotReplacement repeated
fira.Robot
  1 robot_id uint32 optional
  2 x double optional
  3 y double optional
  4 orientation double optional
  5 vx double optional
  6 vy double optional
  7 vorientation double optional
fira.RobotReplacement
  1 position Robot optional
  5 yellowteam bool optional
  6 turnon bool optional
grsim.BallReplacement
  1 x double optional
  2 y double optional
  3 vx double optional
  4 vy double optional
grsim.Commands
  1 timestamp double required
  2 isteamyellow bool required
  3 robot_commands RobotCommand repeated
grsim.Packet
  1 commands Commands optional
  2 replacement Replacement optional
grsim.Replacement
  1 ball BallReplacement optional
  2 robots RobotReplacement repeated
grsim.RobotCommand
  1 id uint32 required
  2 kickspeedx float required
  3 kickspeedz float required
  4 veltangent float required
  5 velnormal float required
  6 velangular float required
  7 spinner bool required
  8 wheelsspeed bool required
  9 wheel1 float optional
  10 wheel2 float optional
  11 wheel3 float optional
  12 wheel4 float optional
grsim.RobotReplacement
  1 x double required
  2 y double required
  3 dir double required
  4 id uint32 required
  5 yellowteam bool required
  6 turnon bool optional
grsim.RobotStatus
  1 robot_id int32 required
  2 infrared bool required
  3 flat_kick bool required
  4 chip_kick bool required
grsim.StatusPacket
  1 robots_status RobotStatus repeated
referee.AimlessKick
  1 by_team Team required
  2 by_bot uint32 optional
  3 location Vector2 optional
  4 kick_location Vector2 optional
referee.AttackerDoubleTouchedBall
  1 by_team Team required
  2 by_bot uint32 optional
  3 location Vector2 optional
referee.AttackerTooCloseToDefenseArea
  1 by_team Team required
  2 by_bot uint32 optional
  3 location Vector2 optional
  4 distance float optional
  5 ball_location Vector2 optional
referee.AttackerTouchedBallInDefenseArea
  1 by_team Team required
  2 by_bot uint32 optional
  3 location Vector2 optional
  4 distance float optional
referee.AttackerTouchedOpponentInDefenseArea
  1 by_team Team required
  2 by_bot uint32 optional
  3 location Vector2 optional
  4 victim uint32 optional
referee.BallLeftField
  1 by_team Team required
  2 by_bot uint32 optional
  3 location Vector2 optional
referee.BotCrashDrawn
  1 bot_yellow uint32 optional
  2 bot_blue uint32 optional
  3 location Vector2 optional
  4 crash_speed float optional
  5 speed_diff float optional
  6 crash_angle float optional
referee.BotCrashUnique
  1 by_team Team required
  2 violator uint32 optional
  3 victim uint32 optional
  4 location Vector2 optional
  5 crash_speed float optional
  6 speed_diff float optional
  7 crash_angle float optional
referee.BotDribbledBallTooFar
  1 by_team Team required
  2 by_bot uint32 optional
  3 start Vector2 optional
  4 end Vector2 optional
referee.BotDroppedParts
  1 by_team Team required
  2 by_bot uint32 optional
  3 location Vector2 optional
  4 ball_location Vector2 optional
referee.BotHeldBallDeliberately
  1 by_team Team required
  2 by_bot uint32 optional
  3 location Vector2 optional
  4 duration float optional
referee.BotInterferedPlacement
  1 by_team Team required
  2 by_bot uint32 optional
  3 location Vector2 optional
referee.BotKickedBallTooFast
  1 by_team Team required
  2 by_bot uint32 optional
  3 location Vector2 optional
  4 initial_ball_speed float optional
  5 chipped bool optional
referee.BotPushedBot
  1 by_team Team required
  2 violator uint32 optional
  3 victim uint32 optional
  4 location Vector2 optional
  5 pushed_distance float optional
referee.BotSubstitution
  1 by_team Team required
referee.BotTippedOver
  1 by_team Team required
  2 by_bot uint32 optional
  3 location Vector2 optional
  4 ball_location Vector2 optional
referee.BotTooFastInStop
  1 by_team Team required
  2 by_bot uint32 optional
  3 location Vector2 optional
  4 speed float optional
referee.BoundaryCrossing
  1 by_team Team required
  2 location Vector2 optional
referee.ChallengeFlag
  1 by_team Team required
referee.ChallengeFlagHandled
  1 by_team Team required
  2 accepted bool required
referee.ChippedGoal
  1 by_team Team required
  2 by_bot uint32 optional
  3 location Vector2 optional
  4 kick_location Vector2 optional
  5 max_ball_height float optional
referee.DefenderInDefenseArea
  1 by_team Team required
  2 by_bot uint32 optional
  3 location Vector2 optional
  4 distance float optional
referee.DefenderInDefenseAreaPartially
  1 by_team Team required
  2 by_bot uint32 optional
  3 location Vector2 optional
  4 distance float optional
  5 ball_location Vector2 optional
referee.DefenderTooCloseToKickPoint
  1 by_team Team required
  2 by_bot uint32 optional
  3 location Vector2 optional
  4 distance float optional
referee.EmergencyStop
  1 by_team Team required
referee.ExcessiveBotSubstitution
  1 by_team Team required
referee.GameEvent
  1 prepared Prepared oneof
  2 no_progress_in_game NoProgressInGame oneof
  3 placement_failed PlacementFailed oneof
  5 placement_succeeded PlacementSucceeded oneof
  6 ball_left_field_touch_line BallLeftField oneof
  7 ball_left_field_goal_line BallLeftField oneof
  8 goal Goal oneof
  9 indirect_goal IndirectGoal oneof
  10 chipped_goal ChippedGoal oneof
  11 aimless_kick AimlessKick oneof
  12 kick_timeout KickTimeout oneof
  13 keeper_held_ball KeeperHeldBall oneof
  14 attacker_double_touched_ball AttackerDoubleTouchedBall oneof
  15 attacker_touched_ball_in_defense_area AttackerTouchedBallInDefenseArea oneof
  16 attacker_touched_opponent_in_defense_area AttackerTouchedOpponentInDefenseArea oneof
  17 bot_dribbled_ball_too_far BotDribbledBallTooFar oneof
  18 bot_kicked_ball_too_fast BotKickedBallTooFast oneof
  19 attacker_too_close_to_defense_area AttackerTooCloseToDefenseArea oneof
  20 bot_interfered_placement BotInterferedPlacement oneof
  21 bot_crash_drawn BotCrashDrawn oneof
  22 bot_crash_unique BotCrashUnique oneof
  23 bot_crash_unique_skipped BotCrashUnique oneof
  24 bot_pushed_bot BotPushedBot oneof
  25 bot_pushed_bot_skipped BotPushedBot oneof
  26 bot_held_ball_deliberately BotHeldBallDeliberately oneof
  27 bot_tipped_over BotTippedOver oneof
  28 bot_too_fast_in_stop BotTooFastInStop oneof
  29 defender_too_close_to_kick_point DefenderTooCloseToKickPoint oneof
  30 defender_in_defense_area_partially DefenderInDefenseAreaPartially oneof
  31 defender_in_defense_area DefenderInDefenseArea oneof
  32 multiple_cards MultipleCards oneof
  33 multiple_placement_failures MultiplePlacementFailures oneof
  34 multiple_fouls MultipleFouls oneof
  35 unsporting_behavior_minor UnsportingBehaviorMinor oneof
  36 unsporting_behavior_major UnsportingBehaviorMajor oneof
  37 bot_substitution BotSubstitution oneof
  38 too_many_robots TooManyRobots oneof
  39 possible_goal Goal oneof
  40 type Type optional
  41 origin string repeated
  42 attacker_touched_opponent_in_defense_area_skipped AttackerTouchedOpponentInDefenseArea oneof
  43 boundary_crossing BoundaryCrossing oneof
  44 invalid_goal Goal oneof
  45 penalty_kick_failed PenaltyKickFailed oneof
  46 challenge_flag ChallengeFlag oneof
  47 emergency_stop EmergencyStop oneof
  48 challenge_flag_handled ChallengeFlagHandled oneof
  49 created_timestamp uint64 optional
  50 id string optional
  51 bot_dropped_parts BotDroppedParts oneof
  52 excessive_bot_substitution ExcessiveBotSubstitution oneof
referee.GameEventProposals
  1 game_events GameEvent repeated
  2 accepted bool optional
  3 id string optional
referee.Goal
  1 by_team Team required
  2 kicking_bot uint32 optional
  3 location Vector2 optional
  4 kick_location Vector2 optional
  5 max_ball_height float optional
  6 kicking_team Team optional
  7 num_robots_by_team uint32 optional
  8 last_touch_by_team uint64 optional
  9 message string optional
referee.IndirectGoal
  1 by_team Team required
  2 by_bot uint32 optional
  3 location Vector2 optional
  4 kick_location Vector2 optional
referee.KeeperHeldBall
  1 by_team Team required
  2 location Vector2 optional
  3 duration float optional
referee.KickTimeout
  1 by_team Team required
  2 location Vector2 optional
  3 time float optional
referee.MultipleCards
  1 by_team Team required
referee.MultipleFouls
  1 by_team Team required
  2 caused_game_events GameEvent repeated
referee.MultiplePlacementFailures
  1 by_team Team required
referee.NoProgressInGame
  1 location Vector2 optional
  2 time float optional
referee.Packet
  1 packet_timestamp uint64 required
  2 stage Stage required
  3 stage_time_left sint64 optional
  4 command Command required
  5 command_counter uint32 required
  6 command_timestamp uint64 required
  7 yellow TeamInfo required
  8 blue TeamInfo required
  9 designated_position Point optional
  10 blue_team_on_positive_half bool optional
  12 next_command Command optional
  15 current_action_time_remaining int64 optional
  16 game_events GameEvent repeated
  17 game_event_proposals GameEventProposals repeated
  18 source_identifier string optional
  19 match_type MatchType optional
  20 status_message string optional
referee.PenaltyKickFailed
  1 by_team Team required
  2 location Vector2 optional
  3 reason string optional
referee.PlacementFailed
  1 by_team Team required
  2 remaining_distance float optional
  3 nearest_own_bot_distance float optional
referee.PlacementSucceeded
  1 by_team Team required
  2 time_taken float optional
  3 precision float optional
  4 distance float optional
referee.Point
  1 x float required
  2 y float required
referee.Prepared
  1 time_taken float optional
referee.TeamInfo
  1 name string required
  2 score uint32 required
  3 red_cards uint32 required
  4 yellow_card_times uint32 repeated
  5 yellow_cards uint32 required
  6 timeouts uint32 required
  7 timeout_time uint32 required
  8 goalkeeper uint32 required
  9 foul_counter uint32 optional
  10 ball_placement_failures uint32 optional
  12 can_place_ball bool optional
  13 max_allowed_bots uint32 optional
  14 bot_substitution_intent bool optional
  15 ball_placement_failures_reached bool optional
  16 bot_substitution_allowed bool optional
  17 bot_substitutions_left uint32 optional
  18 bot_substitution_time_left uint32 optional
  19 hull_color HullColor optional
referee.TooManyRobots
  1 by_team Team required
  2 num_robots_allowed int32 optional
  3 num_robots_on_field int32 optional
  4 ball_location Vector2 optional
referee.UnsportingBehaviorMajor
  1 by_team Team required
  2 reason string required
referee.UnsportingBehaviorMinor
  1 by_team Team required
  2 reason string required
referee.Vector2
  1 x float required
  2 y float required
simulation.Command
  1 control Control optional
  2 config Config optional
simulation.Config
  1 geometry Geometry optional
  2 robot_specs RobotSpecs repeated
  3 realism_config RealismConfig optional
  4 vision_port uint32 optional
simulation.Control
  1 teleport_ball TeleportBall optional
  2 teleport_robot TeleportRobot repeated
  3 simulation_speed float optional
simulation.Error
  1 code string optional
  2 message string optional
simulation.GlobalVelocity
  1 x float required
  2 y float required
  3 angular float required
simulation.LocalVelocity
  1 forward float required
  2 left float required
  3 angular float required
simulation.MoveCommand
  1 wheel_velocity WheelVelocity oneof
  2 local_velocity LocalVelocity oneof
  3 global_velocity GlobalVelocity oneof
simulation.RealismConfig
  1 custom Any repeated
simulation.Response
  1 errors Error repeated
simulation.RobotCommand
  1 id uint32 required
  2 move_command MoveCommand optional
  3 kick_speed float optional
  4 kick_angle float optional
  5 dribbler_speed float optional
simulation.RobotControl
  1 robot_commands RobotCommand repeated
simulation.RobotControlResponse
  1 errors Error repeated
  2 feedback RobotFeedback repeated
simulation.RobotFeedback
  1 id uint32 required
  2 dribbler_ball_contact bool optional
  3 custom Any optional
simulation.RobotId
  1 id uint32 optional
  2 team Team optional
simulation.RobotLimits
  1 acc_speedup_absolute_max float optional
  2 acc_speedup_angular_max float optional
  3 acc_brake_absolute_max float optional
  4 acc_brake_angular_max float optional
  5 vel_absolute_max float optional
  6 vel_angular_max float optional
simulation.RobotSpecs
  1 id RobotId required
  2 radius float optional
  3 height float optional
  4 mass float optional
  7 max_linear_kick_speed float optional
  8 max_chip_kick_speed float optional
  9 center_to_dribbler float optional
  10 limits RobotLimits optional
  13 wheel_angles WheelAngles optional
  14 custom Any repeated
simulation.SyncRequest
  1 sim_step float optional
  2 simulator_command Command optional
  3 robot_control RobotControl optional
simulation.SyncResponse
  1 detection DetectionFrame repeated
  2 robot_control_response RobotControlResponse optional
simulation.TeleportBall
  1 x float optional
  2 y float optional
  3 z float optional
  4 vx float optional
  5 vy float optional
  6 vz float optional
  7 teleport_safely bool optional
  8 roll bool optional
  9 by_force bool optional
simulation.TeleportRobot
  1 id RobotId required
  2 x float optional
  3 y float optional
  4 orientation float optional
  5 v_x float optional
  6 v_y float optional
  7 v_angular float optional
  8 present bool optional
  9 by_force bool optional
simulation.WheelAngles
  1 front_right float required
  2 back_right float required
  3 back_left float required
  4 front_left float required
simulation.WheelVelocity
  1 front_right float required
  2 back_right float required
  3 back_left float required
  4 front_left float required
tracker.KickedBall
  1 pos Vector2 required
  2 vel Vector3 required
  3 start_timestamp double required
  4 stop_timestamp double optional
  5 stop_pos Vector2 optional
  6 robot_id RobotId optional
tracker.Packet
  1 uuid string required
  2 source_name string optional
  3 tracked_frame TrackedFrame optional
tracker.RobotId
  1 id uint32 required
  2 team_color TeamColor required
tracker.TrackedBall
  1 pos Vector3 required
  2 vel Vector3 optional
  3 visibility float optional
tracker.TrackedFrame
  1 frame_number uint32 required
  2 timestamp double required
  3 balls TrackedBall repeated
  4 robots TrackedRobot repeated
  5 kicked_ball KickedBall optional
  6 capabilities Capability repeated
tracker.TrackedRobot
  1 robot_id RobotId required
  2 pos Vector2 required
  3 orientation float required
  4 vel Vector2 optional
  5 vel_angular float optional
  6 visibility float optional
tracker.Vector2
  1 x float required
  2 y float required
tracker.Vector3
  1 x float required
  2 y float required
  3 z float required
vision.BallModels
  1 straight_two_phase StraightTwoPhase optional
  2 chip_fixed_loss ChipFixedLoss optional
vision.CameraCalibration
  1 camera_id uint32 required
  2 focal_length float required
  3 principal_point_x float required
  4 principal_point_y float required
  5 distortion float required
  6 q0 float required
  7 q1 float required
  8 q2 float required
  9 q3 float required
  10 tx float required
  11 ty float required
  12 tz float required
  13 derived_camera_world_tx float optional
  14 derived_camera_world_ty float optional
  15 derived_camera_world_tz float optional
  16 pixel_image_width uint32 optional
  17 pixel_image_height uint32 optional
vision.ChipFixedLoss
  1 damping_xy_first_hop double required
  2 damping_xy_other_hops double required
  3 damping_z double required
vision.DetectionBall
  1 confidence float required
  2 area uint32 optional
  3 x float required
  4 y float required
  5 z float optional
  6 pixel_x float required
  7 pixel_y float required
vision.DetectionFrame
  1 frame_number uint32 required
  2 t_capture double required
  3 t_sent double required
  4 camera_id uint32 required
  5 balls DetectionBall repeated
  6 robots_yellow DetectionRobot repeated
  7 robots_blue DetectionRobot repeated
  8 t_capture_camera double optional
vision.DetectionRobot
  1 confidence float required
  2 robot_id uint32 optional
  3 x float required
  4 y float required
  5 orientation float optional
  6 pixel_x float required
  7 pixel_y float required
  8 height float optional
vision.FieldArc
  1 name string required
  2 center Point required
  3 radius float required
  4 a1 float required
  5 a2 float required
  6 thickness float required
  7 type FieldShape optional
vision.FieldLine
  1 name string required
  2 p1 Point required
  3 p2 Point required
  4 thickness float required
  5 type FieldShape optional
vision.FieldSize
  1 field_length int32 required
  2 field_width int32 required
  3 goal_width int32 required
  4 goal_depth int32 required
  5 boundary_width int32 required
  6 field_lines FieldLine repeated
  7 field_arcs FieldArc repeated
  8 penalty_area_depth int32 optional
  9 penalty_area_width int32 optional
  10 center_circle_radius int32 optional
  11 line_thickness int32 optional
  12 goal_center_to_penalty_mark int32 optional
  13 goal_height int32 optional
  14 ball_radius float optional
  15 max_robot_radius float optional
  16 boundary_width_goal_line int32 optional
  17 goal_substitution_area_width int32 optional
vision.Geometry
  1 field FieldSize required
  2 calib CameraCalibration repeated
  3 models BallModels optional
vision.Packet
  1 detection DetectionFrame optional
  2 geometry Geometry optional
  3 source Source optional
vision.Point
  1 x float required
  2 y float required
vision.StraightTwoPhase
  1 acc_slide double required
  2 acc_roll double required
  3 k_switch double required
vssref.Command
  1 foul Foul optional
  2 teamcolor Color optional
  3 foulQuadrant Quadrant optional
  4 timestamp double optional
  5 gameHalf Half optional
vssref.Frame
  1 teamColor Color optional
  2 robots Robot repeated
vssref.Placement
  1 world Frame optional
vssref.Robot
  1 robot_id uint32 optional
  2 x double optional
  3 y double optional
  4 orientation double optional
"""

ENUMS = """
referee.Command
  0 HALT
  1 STOP
  2 NORMAL_START
  3 FORCE_START
  4 PREPARE_KICKOFF_YELLOW
  5 PREPARE_KICKOFF_BLUE
  6 PREPARE_PENALTY_YELLOW
  7 PREPARE_PENALTY_BLUE
  8 DIRECT_FREE_YELLOW
  9 DIRECT_FREE_BLUE
  10 INDIRECT_FREE_YELLOW
  11 INDIRECT_FREE_BLUE
  12 TIMEOUT_YELLOW
  13 TIMEOUT_BLUE
  14 GOAL_YELLOW
  15 GOAL_BLUE
  16 BALL_PLACEMENT_YELLOW
  17 BALL_PLACEMENT_BLUE
referee.GameEvent.Type
  0 UNKNOWN_GAME_EVENT_TYPE
  1 PREPARED
  2 NO_PROGRESS_IN_GAME
  3 PLACEMENT_FAILED
  5 PLACEMENT_SUCCEEDED
  6 BALL_LEFT_FIELD_TOUCH_LINE
  7 BALL_LEFT_FIELD_GOAL_LINE
  8 GOAL
  9 INDIRECT_GOAL
  10 CHIPPED_GOAL
  11 AIMLESS_KICK
  12 KICK_TIMEOUT
  13 KEEPER_HELD_BALL
  14 ATTACKER_DOUBLE_TOUCHED_BALL
  15 ATTACKER_TOUCHED_BALL_IN_DEFENSE_AREA
  16 ATTACKER_TOUCHED_OPPONENT_IN_DEFENSE_AREA
  17 BOT_DRIBBLED_BALL_TOO_FAR
  18 BOT_KICKED_BALL_TOO_FAST
  19 ATTACKER_TOO_CLOSE_TO_DEFENSE_AREA
  20 BOT_INTERFERED_PLACEMENT
  21 BOT_CRASH_DRAWN
  22 BOT_CRASH_UNIQUE
  23 BOT_CRASH_UNIQUE_SKIPPED
  24 BOT_PUSHED_BOT
  25 BOT_PUSHED_BOT_SKIPPED
  26 BOT_HELD_BALL_DELIBERATELY
  27 BOT_TIPPED_OVER
  28 BOT_TOO_FAST_IN_STOP
  29 DEFENDER_TOO_CLOSE_TO_KICK_POINT
  30 DEFENDER_IN_DEFENSE_AREA_PARTIALLY
  31 DEFENDER_IN_DEFENSE_AREA
  32 MULTIPLE_CARDS
  33 MULTIPLE_PLACEMENT_FAILURES
  34 MULTIPLE_FOULS
  35 UNSPORTING_BEHAVIOR_MINOR
  36 UNSPORTING_BEHAVIOR_MAJOR
  37 BOT_SUBSTITUTION
  38 TOO_MANY_ROBOTS
  39 POSSIBLE_GOAL
  40 ATTACKER_TOUCHED_OPPONENT_IN_DEFENSE_AREA_SKIPPED
  41 BOUNDARY_CROSSING
  42 INVALID_GOAL
  43 PENALTY_KICK_FAILED
  44 CHALLENGE_FLAG
  45 EMERGENCY_STOP
  46 CHALLENGE_FLAG_HANDLED
  47 BOT_DROPPED_PARTS
  48 EXCESSIVE_BOT_SUBSTITUTION
referee.HullColor
  0 HULL_COLOR_UNKNOWN
  1 HULL_COLOR_DARK
  2 HULL_COLOR_LIGHT
referee.MatchType
  0 UNKNOWN_MATCH
  1 GROUP_PHASE
  2 ELIMINATION_PHASE
  3 FRIENDLY
referee.Stage
  0 NORMAL_FIRST_HALF_PRE
  1 NORMAL_FIRST_HALF
  2 NORMAL_HALF_TIME
  3 NORMAL_SECOND_HALF_PRE
  4 NORMAL_SECOND_HALF
  5 EXTRA_TIME_BREAK
  6 EXTRA_FIRST_HALF_PRE
  7 EXTRA_FIRST_HALF
  8 EXTRA_HALF_TIME
  9 EXTRA_SECOND_HALF_PRE
  10 EXTRA_SECOND_HALF
  11 PENALTY_SHOOTOUT_BREAK
  12 PENALTY_SHOOTOUT
  13 POST_GAME
referee.Team
  0 UNKNOWN
  1 YELLOW
  2 BLUE
simulation.Team
  0 UNKNOWN
  1 YELLOW
  2 BLUE
tracker.Capability
  0 CAPABILITY_UNKNOWN
  1 CAPABILITY_DETECT_FLYING_BALLS
  2 CAPABILITY_DETECT_MULTIPLE_BALLS
  3 CAPABILITY_DETECT_KICKED_BALLS
tracker.TeamColor
  0 TEAM_COLOR_UNKNOWN
  1 TEAM_COLOR_YELLOW
  2 TEAM_COLOR_BLUE
vision.FieldShape
  0 Undefined
  1 CenterCircle
  2 TopTouchLine
  3 BottomTouchLine
  4 LeftGoalLine
  5 RightGoalLine
  6 HalfwayLine
  7 CenterLine
  8 LeftPenaltyStretch
  9 RightPenaltyStretch
  10 LeftFieldLeftPenaltyStretch
  11 LeftFieldRightPenaltyStretch
  12 RightFieldLeftPenaltyStretch
  13 RightFieldRightPenaltyStretch
vision.Source
  0 SSL_SOURCE_UNKNOWN
  1 SSL_SOURCE_OTHER
  2 SSL_SOURCE_SSL_VISION
  3 SSL_SOURCE_VISION_PROCESSOR
  4 SSL_SOURCE_GRSIM
  5 SSL_SOURCE_ERFORCE_SIM
vssref.Color
  0 BLUE
  1 YELLOW
  2 NONE
vssref.Foul
  0 FREE_KICK
  1 PENALTY_KICK
  2 GOAL_KICK
  3 FREE_BALL
  4 KICKOFF
  5 STOP
  6 GAME_ON
  7 HALT
vssref.Half
  0 NO_HALF
  1 FIRST_HALF
  2 SECOND_HALF
  3 OVERTIME_FIRST_HALF
  4 OVERTIME_SECOND_HALF
  5 PENALTY_SHOOTOUTS
vssref.Quadrant
  0 NO_QUADRANT
  1 QUADRANT_1
  2 QUADRANT_2
  3 QUADRANT_3
  4 QUADRANT_4
"""
