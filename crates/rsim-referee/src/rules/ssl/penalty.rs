//! Penalty kicks (SSL rules, "Penalty Kick").

use crate::codes::Command;
use crate::events::EventKind;
use crate::game::Game;
use crate::moment::Moment;
use crate::rules::ssl::ball_out::{goal_kick_place, line_crossed};
use crate::rules::ssl::goal::awarded;
use crate::ruling::{Ruling, Rulings};
use crate::team::Team;
use crate::vector::Vector;

/// Way back of the ball that is no measuring noise, m: as much as brings a ball into play.
const WAY_BACK: f32 = 0.05;

/// Ends a penalty kick: by a goal, which a foul of the defenders is too, or without one. A foul of both teams
/// decides nothing, as in the game controller.
pub fn conclude(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    let Some(attacker) = game.penalty_taker() else { return };
    if rulings.has(EventKind::Goal) {
        return;
    }
    let defender = attacker.opponent();
    let committed = |team: Team| {
        rulings.iter().any(|ruling| {
            let kind = ruling.event.kind;
            let is_offense = ruling.is_foul
                || ruling.then.is_some() && !is_ball_out(kind)
                || kind == EventKind::UnsportingBehaviorMinor;
            is_offense && ruling.event.team == Some(team)
        })
    };
    if committed(defender) {
        rulings.add_first(awarded(attacker, game, moment.ball.position));
    } else if committed(attacker)
        || line_crossed(game, moment).is_some()
        || game.command_steps > moment.steps(moment.config.penalty_seconds)
        || moved_back(game, moment, attacker)
        || was_saved(moment, defender)
    {
        let place = moment.ball.position;
        let ruling = Ruling::of_team(EventKind::PenaltyKickFailed, Some(attacker), place);
        let goal_kick = goal_kick_place(moment, place.y, defender);
        rulings.add_first(ruling.stops(Command::DirectFree(defender), goal_kick));
    }
}

const fn is_ball_out(kind: EventKind) -> bool {
    matches!(kind, EventKind::BallLeftFieldGoalLine | EventKind::BallLeftFieldTouchLine)
}

/// Whether the ball has moved away from the goal.
fn moved_back(game: &mut Game, moment: &Moment, attacker: Team) -> bool {
    let way = way_to_goal(game, attacker, moment.ball.position);
    game.penalty_way = game.penalty_way.max(way);
    game.penalty_way - way > WAY_BACK
}

/// Way from the place of the kick to another place, toward the goal, m.
pub(crate) fn way_to_goal(game: &Game, attacker: Team, place: Vector) -> f32 {
    attacker.own_side() * (game.kick_position.x - place.x)
}

/// Whether the keeper touched the ball and changed its direction by at least 90 degrees.
fn was_saved(moment: &Moment, defender: Team) -> bool {
    let keeper = moment.now.robot(moment.keeper(defender));
    // A team without robots has no keeper.
    keeper.is_some_and(|keeper| keeper.team == defender && keeper.touched_ball)
        && moment.ball.velocity.dot(moment.ball_before.velocity) <= 0.0
        && moment.ball_before.velocity.length() > moment.config.stuck_speed
}
