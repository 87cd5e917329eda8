//! The ball leaves the field (SSL rules, "Ball Leaves The Field").

use crate::codes::Command;
use crate::crossing::{Line, crossed};
use crate::events::EventKind;
use crate::game::Game;
use crate::moment::Moment;
use crate::rules::ssl::kick_place;
use crate::ruling::{Ruling, Rulings};
use crate::team::Team;
use crate::vector::Vector;

/// The line that the ball crossed completely in the step, and where. Lines belong to the field.
pub(crate) fn line_crossed(game: &Game, moment: &Moment) -> Option<(Line, Vector)> {
    let beyond = moment.lines().line_width / 2.0 + moment.pitch.ball_radius;
    if game.is_running() { crossed(moment, beyond) } else { None }
}

/// "Aimless Kick": a kick from the own half over the opponents' goal line that no other robot touched. A
/// kick-off is none.
pub fn aimless_kick(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    let line = line_crossed(game, moment).filter(|_| moment.config.aimless_kick);
    let Some((Line::End(defender) | Line::Goal(defender), left_at)) = line else { return };
    let Some(kicker) = game.last_touch else { return };
    let (team, kicked_at) = (moment.team_of(kicker), game.last_touch_position);
    let is_in_own_half = team.own_side() * kicked_at.x > 0.0;
    let is_kickoff =
        game.kick_taker == Some(kicker) && matches!(game.kick, Some(Command::PrepareKickoff(_)));
    if !is_goal(rulings) && team != defender && is_in_own_half && !is_kickoff {
        let ruling = Ruling::of_robot(EventKind::AimlessKick, team, kicker, left_at);
        let place = kick_place(moment, kicked_at);
        rulings.add(ruling.stops(Command::DirectFree(team.opponent()), place));
    }
}

/// "Throw-In": inside the touch line, where the ball crossed it. That is the nearest place of a free kick.
pub fn touch_line(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    let Some((Line::Touch, left_at)) = line_crossed(game, moment) else { return };
    let place = kick_place(moment, left_at);
    rulings.add(left_field(EventKind::BallLeftFieldTouchLine, game, moment, left_at, place));
}

/// "Goal Kick" and "Corner Kick": beside the corner on the side on which the ball left. A goal that does
/// not count is a ball over the goal line.
pub fn goal_line(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    let line = line_crossed(game, moment);
    let Some((Line::End(defender) | Line::Goal(defender), left_at)) = line else { return };
    if is_goal(rulings) || rulings.has(EventKind::AimlessKick) {
        return;
    }
    let from_goal_line = match game.last_touch.map(|robot| moment.team_of(robot)) {
        Some(team) if team == defender => 0.0,
        _ => moment.config.goal_kick_distance,
    };
    let place = beside_corner(moment, left_at.y, defender, from_goal_line);
    rulings.add(left_field(EventKind::BallLeftFieldGoalLine, game, moment, left_at, place));
}

fn is_goal(rulings: &Rulings) -> bool {
    rulings.has(EventKind::Goal)
}

/// The place of a goal kick of a team, on the side of `y`.
pub(crate) fn goal_kick_place(moment: &Moment, y: f32, defender: Team) -> Vector {
    beside_corner(moment, y, defender, moment.config.goal_kick_distance)
}

/// The place of a free kick that is nearest to a point of the touch line.
fn beside_corner(moment: &Moment, y: f32, defender: Team, from_goal_line: f32) -> Vector {
    let lines = moment.lines();
    let x = defender.own_side() * (lines.half_length - from_goal_line);
    kick_place(moment, Vector::new(x, lines.half_width.copysign(y)))
}

/// A free kick for the opponents of the last toucher. If nobody touched the ball since play went on, it is
/// free for both.
fn left_field(
    kind: EventKind,
    game: &Game,
    moment: &Moment,
    left_at: Vector,
    place: Vector,
) -> Ruling {
    match game.last_touch {
        Some(robot) => {
            let team = moment.team_of(robot);
            Ruling::of_robot(kind, team, robot, left_at)
                .stops(Command::DirectFree(team.opponent()), place)
        }
        None => Ruling::of_team(kind, None, left_at).stops(Command::ForceStart, place),
    }
}
