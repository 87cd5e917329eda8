"""Reasons why fields are not read, by name or by the beginning of their names.

Names are those of schema, message and field, with points between them.
"""

from typing import Final

_PLACES: Final = "places are given in mm, too"
_LINES: Final = "follow from the sizes of the field"
_OPTICS: Final = "places are given in mm, too; sent for software that shows cameras"
_BALL: Final = "sent for software that predicts the ball; here that is the ball's model"
_DETAIL: Final = "rSoccer's events have a team, a robot and a place"
_OLD: Final = "the league has abolished the event; reading one is answered by an error"
_NO_SUCH: Final = "rSoccer's referee has no such event; reading one is answered by an error"
_HUMAN: Final = "matches without people have no such procedure"
_SHOWN: Final = "for spectators and for records"
_KICKED: Final = "rSoccer does not estimate kicks"
_DRAFT: Final = "a draft of the league, without a port; no simulator speaks it"

REASONS: Final = {
    "vision.Packet.source": "positions mean the same, whatever the sender",
    "vision.DetectionFrame.t_capture_camera": "`t_capture` is by the same clock as `t_sent`",
    "vision.DetectionBall.area": "places are enough to follow a ball",
    "vision.DetectionBall.pixel_": _PLACES,
    "vision.DetectionRobot.pixel_": _PLACES,
    "vision.DetectionRobot.height": "robots have the height of their model",
    "vision.Geometry.calib": _OPTICS,
    "vision.CameraCalibration.": _OPTICS,
    "vision.Geometry.models": _BALL,
    "vision.BallModels.": _BALL,
    "vision.StraightTwoPhase.": _BALL,
    "vision.ChipFixedLoss.": _BALL,
    "vision.FieldSize.field_lines": _LINES,
    "vision.FieldSize.field_arcs": _LINES,
    "vision.FieldLine.": _LINES,
    "vision.FieldArc.": _LINES,
    "vision.Point.": _LINES,
    "vision.FieldSize.ball_radius": "the ball has the radius of its model",
    "vision.FieldSize.max_robot_radius": "robots have the radius of their model",
    "vision.FieldSize.goal_substitution_area_width": "substitution is not played",
    "tracker.Packet.source_name": "`uuid` tells trackers apart",
    "tracker.TrackedFrame.frame_number": "`timestamp` orders frames",
    "tracker.TrackedFrame.capabilities": "what a frame has is seen from its fields",
    "tracker.TrackedBall.visibility": "the first ball is the likeliest one",
    "tracker.TrackedRobot.visibility": "robots in a frame are taken as they are",
    "tracker.TrackedFrame.kicked_ball": _KICKED,
    "tracker.KickedBall.": _KICKED,
    "referee.Packet.source_identifier": "receivers choose a sender by its address",
    "referee.Packet.match_type": _SHOWN,
    "referee.Packet.status_message": _SHOWN,
    "referee.Packet.game_event_proposals": "what other referees propose is no decision",
    "referee.GameEventProposals.": "what other referees propose is no decision",
    "referee.TeamInfo.timeout": _HUMAN,
    "referee.TeamInfo.bot_substitution": _HUMAN,
    "referee.TeamInfo.ball_placement_failures_reached": "`can_place_ball` says the same",
    "referee.TeamInfo.hull_color": "robots are seen without cameras",
    "referee.GameEvent.origin": "events of all referees count alike",
    "referee.GameEvent.prepared": _OLD,
    "referee.Prepared.": _OLD,
    "referee.GameEvent.indirect_goal": _OLD,
    "referee.IndirectGoal.": _OLD,
    "referee.GameEvent.chipped_goal": _OLD,
    "referee.ChippedGoal.": _OLD,
    "referee.GameEvent.kick_timeout": _OLD,
    "referee.KickTimeout.": _OLD,
    "referee.GameEvent.attacker_touched_opponent_in_defense_area": _OLD,
    "referee.AttackerTouchedOpponentInDefenseArea.": _OLD,
    "referee.GameEvent.bot_crash_unique_skipped": _OLD,
    "referee.GameEvent.bot_pushed_bot_skipped": _OLD,
    "referee.GameEvent.defender_in_defense_area_partially": _OLD,
    "referee.DefenderInDefenseAreaPartially.": _OLD,
    "referee.GameEvent.multiple_placement_failures": _OLD,
    "referee.MultiplePlacementFailures.": _OLD,
    "referee.GameEvent.bot_held_ball_deliberately": _NO_SUCH,
    "referee.BotHeldBallDeliberately.": _NO_SUCH,
    "referee.GameEvent.bot_tipped_over": _NO_SUCH,
    "referee.BotTippedOver.": _NO_SUCH,
    "referee.GameEvent.bot_dropped_parts": _NO_SUCH,
    "referee.BotDroppedParts.": _NO_SUCH,
    "referee.GameEvent.unsporting_behavior_major": _NO_SUCH,
    "referee.UnsportingBehaviorMajor.": _NO_SUCH,
    "referee.GameEvent.bot_substitution": _NO_SUCH,
    "referee.BotSubstitution.": _NO_SUCH,
    "referee.GameEvent.excessive_bot_substitution": _NO_SUCH,
    "referee.ExcessiveBotSubstitution.": _NO_SUCH,
    "referee.GameEvent.challenge_flag": _NO_SUCH,
    "referee.ChallengeFlag": _NO_SUCH,
    "referee.GameEvent.emergency_stop": _NO_SUCH,
    "referee.EmergencyStop.": _NO_SUCH,
    "referee.GameEvent.possible_goal": "a goal of another referee that is not decided yet",
    "referee.NoProgressInGame.time": _DETAIL,
    "referee.PlacementFailed.": _DETAIL,
    "referee.PlacementSucceeded.": _DETAIL,
    "referee.Goal.": _DETAIL,
    "referee.AimlessKick.kick_location": _DETAIL,
    "referee.KeeperHeldBall.duration": _DETAIL,
    "referee.AttackerTouchedBallInDefenseArea.distance": _DETAIL,
    "referee.AttackerTooCloseToDefenseArea.": _DETAIL,
    "referee.BotDribbledBallTooFar.start": _DETAIL,
    "referee.BotKickedBallTooFast.": _DETAIL,
    "referee.BotCrashDrawn.": _DETAIL,
    "referee.BotCrashUnique.": _DETAIL,
    "referee.BotPushedBot.": _DETAIL,
    "referee.BotTooFastInStop.speed": _DETAIL,
    "referee.DefenderTooCloseToKickPoint.distance": _DETAIL,
    "referee.DefenderInDefenseArea.distance": _DETAIL,
    "referee.MultipleFouls.caused_game_events": _DETAIL,
    "referee.UnsportingBehaviorMinor.reason": _DETAIL,
    "referee.TooManyRobots.": _DETAIL,
    "referee.PenaltyKickFailed.reason": _DETAIL,
    "simulation.RealismConfig.custom": "`Config.realism_config` is answered by an error",
    "simulation.RobotFeedback.custom": "custom messages of other simulators are not known",
    "simulation.SyncRequest.": _DRAFT,
    "simulation.SyncResponse.": _DRAFT,
    "grsim.Commands.timestamp": "commands count when they arrive, as in grSim",
    "grsim.RobotStatus.flat_kick": "policies see the ball, not the kicker",
    "grsim.RobotStatus.chip_kick": "policies see the ball, not the kicker",
    "fira.Environment.field": "the field is that of the match",
    "fira.Field.": "the field is that of the match",
}


def reason(name: str) -> str:
    """Return the reason of a field: that of the longest beginning of its name; empty for none.

    Args:
        name: name of schema, message and field, with points.
    """
    found = [start for start in REASONS if name.startswith(start)]
    return REASONS[max(found, key=len)] if found else ""
