//! Rules of the Small Size League. Source: RoboCup-SSL/ssl-rules 4300196 (2026-05-21).

pub mod areas;
pub mod ball_out;
pub mod ball_speed;
pub mod boundary;
pub mod crash;
pub mod double_touch;
pub mod dribbling;
pub mod goal;
pub mod kick_point;
pub mod penalty;
pub mod penalty_positions;
pub mod placement;
pub mod progress;
pub mod pushing;
pub mod stop;

use crate::moment::Moment;
use crate::rules::{Rule, table};
use crate::vector::Vector;

/// All rules, in the order in which they are judged: fouls that a goal depends on come first.
pub const RULES: &[Rule] = table! {
    "ATTACKER_TOUCHED_BALL_IN_DEFENSE_AREA", areas::attacker_touch,
        "Attacker Touched Ball In Opponent Defense Area",
        "A robot touches the ball while it is partly in the opponents' area.";
    "BOT_KICKED_BALL_TOO_FAST", ball_speed::ball_speed, "Ball Speed",
        "A robot accelerates the ball beyond 6.5 m/s.";
    "BOT_CRASH_UNIQUE", crash::crash_unique, "Crashing",
        "Robots collide faster than 1.5 m/s: foul of the faster one.";
    "BOT_CRASH_DRAWN", crash::crash_drawn, "Crashing",
        "Robots collide faster than 1.5 m/s at about the same speed: foul of both.";
    "INVALID_GOAL", goal::invalid_goal, "Scoring Goals",
        "A goal does not count: ball too high, too many robots, or a foul within 2 s before.";
    "GOAL", goal::goal, "Scoring Goals",
        "The ball is behind the line between the posts, and nothing speaks against the goal.";
    "BOUNDARY_CROSSING", boundary::boundary_crossing, "Boundary Crossing",
        "A robot kicks the ball over the walls.";
    "AIMLESS_KICK", ball_out::aimless_kick, "Aimless Kick",
        "Division B: free kick where the ball was kicked from the own half over the far goal line.";
    "BALL_LEFT_FIELD_TOUCH_LINE", ball_out::touch_line, "Throw-In",
        "Free kick for the opponents of the last toucher, 0.2 m inside the touch line.";
    "BALL_LEFT_FIELD_GOAL_LINE", ball_out::goal_line, "Goal Kick, Corner Kick",
        "Goal kick, or corner kick if a defender touched the ball last.";
    "DEFENDER_IN_DEFENSE_AREA", areas::multiple_defenders, "Multiple Defenders",
        "A robot other than the keeper touches the ball inside its own area: penalty kick.";
    "ATTACKER_DOUBLE_TOUCHED_BALL", double_touch::double_touch, "Double Touch",
        "The kicker touches the ball again before another robot does.";
    "BOT_DRIBBLED_BALL_TOO_FAR", dribbling::excessive_dribbling, "Excessive Dribbling",
        "A robot dribbles the ball farther than 1 m.";
    "KEEPER_HELD_BALL", areas::keeper_held_ball, "Keeper Held Ball",
        "The ball stays in a goal area for too long.";
    "BOT_PUSHED_BOT", pushing::pushing, "Pushing",
        "A robot pushes an opponent.";
    "ATTACKER_TOO_CLOSE_TO_DEFENSE_AREA", stop::too_close_to_area,
        "Robot Too Close To Opponent Defense Area",
        "A robot is within 0.2 m of the opponents' area in a stop or before a free kick.";
    "NO_PROGRESS_IN_GAME", progress::no_progress, "No Progress In Game",
        "The ball makes no progress.";
    "DEFENDER_TOO_CLOSE_TO_KICK_POINT", kick_point::defender_too_close, "Defender Too Close To Ball",
        "A robot is within 0.5 m of the ball before the opponents' kick.";
    "BOT_TOO_FAST_IN_STOP", stop::too_fast, "Robot Stop Speed",
        "A robot moves faster than 1.5 m/s in a stop.";
    "BOT_INTERFERED_PLACEMENT", placement::interference, "Ball Placement Interference",
        "A robot is within 0.5 m of the way of the opponents' ball placement.";
    "PLACEMENT_SUCCEEDED", placement::succeeded, "Ball Placement",
        "The ball rests at its place, and robots keep their distance.";
    "PLACEMENT_FAILED", placement::failed, "Ball Placement",
        "The ball is not placed in time.";
    "UNSPORTING_BEHAVIOR_MINOR", penalty_positions::judge, "Penalty Kick, Disrespect Procedures",
        "At a penalty kick the keeper leaves its line before the kick, or another robot but the kicker is less \
         than 1 m behind the ball.";
    "PENALTY_KICK_FAILED", penalty::conclude, "Penalty Kick",
        "A penalty kick ends without a goal: ball out, turned by 90 degrees by the keeper, moved back, a \
         foul of the attackers, or 10 s. A foul of the defenders is a goal.";
};

/// The valid place of a free kick that is nearest to a place ("Free Kick").
pub(crate) fn kick_place(moment: &Moment, place: Vector) -> Vector {
    let config = moment.config;
    let distances = (config.kick_line_distance, config.kick_area_distance);
    moment.lines().nearest_kick_place(place, distances.0, distances.1)
}
