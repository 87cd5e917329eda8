//! Decisions of a referee in a step.

use crate::team::Team;
use crate::vector::Vector;

/// Declares the kinds of events with their numbers.
macro_rules! kinds {
    ($($(#[$doc:meta])* $name:ident = $code:literal, $text:literal;)*) => {
        /// Kind of an event. Numbers below 1000 are those of `GameEvent.Type` of the game controller
        /// (78a9b3b, 2026-08-03).
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        #[repr(u16)]
        pub enum EventKind { $($(#[$doc])* $name = $code,)* }

        impl EventKind {
            /// All kinds, their numbers and their names.
            pub const ALL: &'static [(Self, u16, &'static str)] =
                &[$((Self::$name, $code, $text),)*];

            /// Number of the kind.
            pub const fn code(self) -> u16 {
                self as u16
            }
        }
    };
}

kinds! {
    /// Neither team makes progress with the ball.
    NoProgressInGame = 2, "NO_PROGRESS_IN_GAME";
    /// A ball placement did not succeed in its time.
    PlacementFailed = 3, "PLACEMENT_FAILED";
    /// The ball was placed.
    PlacementSucceeded = 5, "PLACEMENT_SUCCEEDED";
    /// The ball left the field over a touch line.
    BallLeftFieldTouchLine = 6, "BALL_LEFT_FIELD_TOUCH_LINE";
    /// The ball left the field over a goal line.
    BallLeftFieldGoalLine = 7, "BALL_LEFT_FIELD_GOAL_LINE";
    /// A goal that counts.
    Goal = 8, "GOAL";
    /// The ball left the field over the far goal line, kicked from the own half.
    AimlessKick = 11, "AIMLESS_KICK";
    /// A keeper's team held the ball in its area.
    KeeperHeldBall = 13, "KEEPER_HELD_BALL";
    /// The robot that took a kick touched the ball again.
    AttackerDoubleTouchedBall = 14, "ATTACKER_DOUBLE_TOUCHED_BALL";
    /// A robot touched the ball in the area that it attacks.
    AttackerTouchedBallInDefenseArea = 15, "ATTACKER_TOUCHED_BALL_IN_DEFENSE_AREA";
    /// A robot dribbled the ball too far.
    BotDribbledBallTooFar = 17, "BOT_DRIBBLED_BALL_TOO_FAR";
    /// A robot kicked the ball too fast.
    BotKickedBallTooFast = 18, "BOT_KICKED_BALL_TOO_FAST";
    /// A robot was too near to the area that it attacks, in STOP or at a free kick.
    AttackerTooCloseToDefenseArea = 19, "ATTACKER_TOO_CLOSE_TO_DEFENSE_AREA";
    /// A robot stood in the way of a ball placement.
    BotInterferedPlacement = 20, "BOT_INTERFERED_PLACEMENT";
    /// Two robots crashed at about the same speed.
    BotCrashDrawn = 21, "BOT_CRASH_DRAWN";
    /// A robot crashed into a slower one.
    BotCrashUnique = 22, "BOT_CRASH_UNIQUE";
    /// A robot pushed another one.
    BotPushedBot = 24, "BOT_PUSHED_BOT";
    /// A robot was too fast in STOP.
    BotTooFastInStop = 28, "BOT_TOO_FAST_IN_STOP";
    /// A robot was too near to the ball at the opponents' free kick or kick-off.
    DefenderTooCloseToKickPoint = 29, "DEFENDER_TOO_CLOSE_TO_KICK_POINT";
    /// A robot beside the keeper touched the ball in its own area.
    DefenderInDefenseArea = 31, "DEFENDER_IN_DEFENSE_AREA";
    /// A team got enough cards for a red one.
    MultipleCards = 32, "MULTIPLE_CARDS";
    /// A team got enough fouls for a card.
    MultipleFouls = 34, "MULTIPLE_FOULS";
    /// A robot did not keep to the positions of a penalty kick.
    UnsportingBehaviorMinor = 35, "UNSPORTING_BEHAVIOR_MINOR";
    /// A team had too many robots on the field.
    TooManyRobots = 38, "TOO_MANY_ROBOTS";
    /// A robot kicked the ball over the outer walls.
    BoundaryCrossing = 41, "BOUNDARY_CROSSING";
    /// A goal that does not count.
    InvalidGoal = 42, "INVALID_GOAL";
    /// A penalty kick did not lead to a goal.
    PenaltyKickFailed = 43, "PENALTY_KICK_FAILED";
}

/// Something that the referee decided.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    /// Its kind.
    pub kind: EventKind,
    /// Team that it is about: the one that scored, or that is at fault.
    pub team: Option<Team>,
    /// Index of the robot that it is about.
    pub robot: Option<usize>,
    /// Place where it happened, m.
    pub position: Vector,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_names_are_unique_and_in_order() {
        let all = EventKind::ALL;
        assert!(all.windows(2).all(|pair| pair[0].1 < pair[1].1));
        assert!(all.iter().all(|(kind, code, _)| kind.code() == *code));
        for (nth, (_, _, name)) in all.iter().enumerate() {
            assert!(all[nth + 1..].iter().all(|(_, _, other)| other != name), "{name}");
        }
    }
}
