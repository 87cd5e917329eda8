//! Numbers and switches of the rules of a match. [`RefereeConfig::preset`] has those of the leagues.

use serde::{Deserialize, Serialize};

use crate::error::RefereeError;
use crate::rules;

/// League whose rules are played.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum League {
    /// Small Size League.
    Ssl,
    /// IEEE Very Small Size Soccer.
    Vsss,
}

/// Time that the match clock counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Clock {
    /// All time of a half counts.
    Running,
    /// Time counts only while a team may play the ball.
    Stopped,
}

/// Way in which the ball comes to the place of the next kick.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Placement {
    /// Ball and robots that stand too near are put in valid places at once.
    Teleport,
    /// A robot of a team carries it.
    Robots,
}

/// Moment at which a half whose time is up ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum HalfEnd {
    /// At once, but for a penalty kick of SSL, which is still taken.
    AtOnce,
    /// At the next stop, as the game controller does.
    NextStop,
}

/// Error of the places of VSSS robots in match tasks, m: assumed for robots that people put there by eye. The
/// presets have none.
pub const HAND_ERROR: f32 = 0.01;

/// Declares the configuration: its choices, and its numbers with unit and source.
macro_rules! config {
    (
        choices { $($(#[doc = $choice_doc:literal])* $choice:ident: $kind:ty,)* }
        numbers { $($(#[doc = $doc:literal])* $name:ident, $unit:literal;)* }
    ) => {
        /// Numbers and switches of the rules of a match.
        #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub struct RefereeConfig {
            $($(#[doc = $choice_doc])* pub $choice: $kind,)*
            $($(#[doc = $doc])* pub $name: f32,)*
        }

        impl RefereeConfig {
            /// Rules whose numbers are all 0.
            pub(crate) const fn zero(league: League) -> Self {
                Self {
                    league,
                    clock: Clock::Stopped,
                    placement: Placement::Teleport,
                    half_end: HalfEnd::AtOnce,
                    aimless_kick: false,
                    failed_placement_passes: false,
                    off: Vec::new(),
                    $($name: 0.0,)*
                }
            }

            /// Names and meanings of all choices.
            pub const CHOICES: &'static [(&'static str, &'static str)] =
                &[$((stringify!($choice), concat!($($choice_doc),*)),)*];

            /// Names, units and meanings of all numbers.
            pub const NUMBERS: &'static [(&'static str, &'static str, &'static str)] =
                &[$((stringify!($name), $unit, concat!($($doc),*)),)*];

            /// All numbers, in the order of [`Self::NUMBERS`].
            pub fn numbers(&self) -> impl Iterator<Item = f32> {
                [$(self.$name,)*].into_iter()
            }

            /// Checks that all numbers are finite and not negative, and that the rules in `off` exist.
            ///
            /// # Errors
            /// The first number or name that is not.
            pub fn validate(&self) -> Result<(), RefereeError> {
                $(if !(self.$name.is_finite() && self.$name >= 0.0) {
                    return Err(RefereeError::Number {
                        name: stringify!($name),
                        got: self.$name,
                    });
                })*
                self.off.iter().try_for_each(|name| rules::find(name).map(drop))
            }
        }
    };
}

config! {
    choices {
        /// League.
        league: League,
        /// Time that the clock counts.
        clock: Clock,
        /// Way in which the ball comes to the place of the next kick.
        placement: Placement,
        /// Moment at which a half whose time is up ends.
        half_end: HalfEnd,
        /// Whether a ball over the far goal line from the own half is a free kick where it was kicked.
        aimless_kick: bool,
        /// Whether a free kick passes to the opponents where the team in favor failed to place the ball.
        failed_placement_passes: bool,
        /// Rules that are not judged, by the names of their events.
        off: Vec<String>,
    }
    numbers {
        /// Duration of a half.
        half_seconds, "s";
        /// Number of halves, 1 or 2.
        halves, "1";
        /// Duration of a half of extra time after a draw; 0 for none.
        extra_half_seconds, "s";
        /// Penalty kicks of each team in the shoot-out after a draw, before sudden death; 0 for none.
        shootout_kicks, "1";
        /// Penalty kicks of each team after which the shoot-out ends, with a draw where it decided nothing.
        max_shootout_kicks, "1";
        /// Goals of a team from which a lead of `early_end_lead` ends the match; 0 for never.
        early_end_goals, "1";
        /// Lead that ends the match early.
        early_end_lead, "1";
        /// Duration of a stop before play is prepared or goes on.
        stop_seconds, "s";
        /// The same after a goal.
        goal_stop_seconds, "s";
        /// Duration of a halt.
        halt_seconds, "s";
        /// Time to take the positions of a kick, at least.
        prepare_seconds, "s";
        /// The same, at most: then robots in forbidden places are put in valid ones.
        max_prepare_seconds, "s";
        /// Time from the permission of a kick-off until the ball is free for all.
        kickoff_seconds, "s";
        /// Time from the permission of a free kick until the ball is free for all.
        free_kick_seconds, "s";
        /// Duration of a penalty kick.
        penalty_seconds, "s";
        /// Time of a ball that makes no progress.
        no_progress_seconds, "s";
        /// Time for which the ball may be in a goal area.
        held_ball_seconds, "s";
        /// Time of a ball placement.
        placement_seconds, "s";
        /// Time of a ball placement, at least.
        min_placement_seconds, "s";
        /// Time that an interference adds to a ball placement.
        interference_seconds, "s";
        /// Time in which robots have to obey a new command.
        grace_seconds, "s";
        /// Time in which the same foul of a team is not raised again.
        repeat_seconds, "s";
        /// Time after a foul of its own in which no goal of a team counts.
        goal_foul_seconds, "s";
        /// Time after a card until robots over the limit are taken out.
        removal_seconds, "s";
        /// Playing time for which a yellow card reduces a team.
        yellow_card_seconds, "s";
        /// Way of the ball that brings it into play.
        in_play_distance, "m";
        /// Way that a robot may dribble.
        dribble_distance, "m";
        /// Way of the ball that is no progress.
        no_progress_distance, "m";
        /// Distance of robots from the ball before a kick of the opponents, and in a stop.
        ball_distance, "m";
        /// Distance of robots from the opponents' goal area before a kick.
        area_distance, "m";
        /// Way over which a robot may push an opponent.
        push_distance, "m";
        /// Height of the ball above which a team scores no goal, since its last touch.
        goal_height, "m";
        /// Height of the outer walls, over which the ball must not be kicked.
        boundary_height, "m";
        /// Greatest error, in x and in y, of the places in which VSSS robots are put by hand.
        placement_error, "m";
        /// Distance from its place within which a ball is placed.
        placement_tolerance, "m";
        /// Distance of robots from a placed ball before a free kick of their own.
        placement_clearance, "m";
        /// Distance of the ball from its place from which it has to be placed.
        placement_distance, "m";
        /// Distance of the ball from goal areas below which it has to be placed.
        placement_area_distance, "m";
        /// Distance of the ball from the lines for a free kick, a throw-in and a corner kick.
        kick_line_distance, "m";
        /// Distance of the ball from the goal areas for a free kick.
        kick_area_distance, "m";
        /// Distance of the ball from the goal line for a goal kick.
        goal_kick_distance, "m";
        /// Distance behind the ball of robots that take no part in a penalty kick.
        penalty_distance, "m";
        /// Distance from the ball within which a team plays for it.
        contest_distance, "m";
        /// Maximum speed of the ball.
        ball_speed, "m/s";
        /// Maximum speed of robots in a stop.
        stop_speed, "m/s";
        /// Closing speed from which a contact of opponents is a crash.
        crash_speed, "m/s";
        /// Difference of speeds below which both robots are at fault.
        crash_difference, "m/s";
        /// Speed below which the ball is stuck or stationary.
        stuck_speed, "m/s";
        /// Fouls of a team that make a yellow card; 0 for none.
        fouls_per_card, "1";
        /// Ball placements that may fail before a team places no more.
        placement_failures, "1";
        /// Robots of a team in the smaller area that are too many.
        area_robots, "1";
        /// Defenders in the larger area that are too many; 0 for any number.
        large_area_defenders, "1";
        /// Attackers in the larger area that are too many; 0 for any number.
        large_area_attackers, "1";
    }
}
