//! Rules of VSSS, as the league's referee applies them. Source: VSSSLeague/VSSReferee 2862742 (2022-03-12),
//! `src/world/entities/referee/checkers`.

pub mod areas;
pub mod goal;
pub mod shootout;
pub mod stuck_ball;

use crate::moment::Moment;
use crate::rules::{Rule, table};
use crate::team::Team;
use crate::vector::Vector;

/// All rules, in the order in which they are judged.
pub const RULES: &[Rule] = table! {
    "GOAL", goal::goal, "checker_ballplay",
        "The ball is behind the line between the posts. After too many attackers in the area with it the \
         goal does not count.";
    "ATTACKER_TOUCHED_BALL_IN_DEFENSE_AREA", areas::too_many_attackers,
        "checker_twoattackers, checker_ballplay",
        "Two attackers in the goal area with the ball, or four in the large area: goal kick.";
    "DEFENDER_IN_DEFENSE_AREA", areas::too_many_defenders, "checker_twodefenders, checker_ballplay",
        "Two defenders in the goal area with the ball, or five in the large area: penalty kick.";
    "KEEPER_HELD_BALL", stuck_ball::held_in_area, "checker_stuckedball",
        "A ball that is stuck in a goal area, with no opponent near it: penalty kick.";
    "NO_PROGRESS_IN_GAME", stuck_ball::free_ball, "checker_stuckedball",
        "A ball that is stuck for 5 s: free ball.";
    "PENALTY_KICK_FAILED", shootout::conclude, "checker_ballplay, checker_stuckedball",
        "In the shoot-out the ball leaves the half or the area, or is stuck, or 10 s are over.";
};

/// Whether a place is in the goal area of a team: the smaller one, where there are two.
pub(crate) fn in_goal_area(moment: &Moment, place: Vector, defender: Team) -> bool {
    let lines = moment.lines();
    if lines.inner_area_depth > 0.0 {
        lines.is_in_inner_area(place, defender)
    } else {
        in_large_area(moment, place, defender)
    }
}

/// Whether a place is in the larger area of a team.
pub(crate) fn in_large_area(moment: &Moment, place: Vector, defender: Team) -> bool {
    moment.lines().distance_to_area(place, defender) < 0.0
}
