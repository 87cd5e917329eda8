//! A ball that is stuck in VSSS.

use crate::codes::Command;
use crate::events::EventKind;
use crate::game::Game;
use crate::moment::Moment;
use crate::rules::vsss::areas::penalty_kick;
use crate::rules::vsss::in_goal_area;
use crate::ruling::{Ruling, Rulings};
use crate::stages::is_shootout;
use crate::team::Team;

/// Follows for how long the ball is stuck, in or outside a goal area.
pub(crate) fn follow(game: &mut Game, moment: &Moment) {
    let is_slow = moment.ball.speed() <= moment.config.stuck_speed;
    let [now, before] = [moment.ball, moment.ball_before]
        .map(|ball| Team::BOTH.map(|team| in_goal_area(moment, ball.position, team)));
    game.stuck_steps =
        if is_slow && game.in_play && now == before { game.stuck_steps + 1 } else { 0 };
}

/// Whether the ball has been stuck for too long.
pub(crate) fn is_stuck(game: &Game, moment: &Moment) -> bool {
    let limit = moment.steps(moment.config.no_progress_seconds);
    game.stuck_steps > 0 && game.stuck_steps >= limit
}

/// Whether a ball that is stuck stops play. In the shoot-out it ends the kick, by another rule.
fn is_judged(game: &Game, moment: &Moment, rulings: &Rulings) -> bool {
    is_stuck(game, moment) && !is_shootout(game) && rulings.stop().is_none()
}

/// The team whose penalty kick it would be: the other one than that in whose goal area the ball is, where not
/// both play for it.
fn penalty_for(moment: &Moment) -> Option<Team> {
    let ball = moment.ball.position;
    let defender = Team::BOTH.into_iter().find(|team| in_goal_area(moment, ball, *team))?;
    (!is_contested(moment)).then_some(defender.opponent())
}

/// A ball that is stuck in a goal area, and not between both teams: a penalty kick.
pub fn held_in_area(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    let Some(attacker) = penalty_for(moment) else { return };
    if is_judged(game, moment, rulings) {
        let defender = Some(attacker.opponent());
        let ruling = Ruling::of_team(EventKind::KeeperHeldBall, defender, moment.ball.position);
        let (command, place) = penalty_kick(moment, attacker);
        rulings.add(ruling.stops(command, place));
    }
}

/// A ball that is stuck elsewhere, or between both teams: a free ball at the mark of its quarter.
pub fn free_ball(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    if is_judged(game, moment, rulings) && penalty_for(moment).is_none() {
        let ball = moment.ball.position;
        let ruling = Ruling::of_team(EventKind::NoProgressInGame, None, ball);
        rulings.add(ruling.stops(Command::FreeBall, moment.lines().free_ball_mark(ball)));
    }
}

/// Whether robots of both teams are near the ball.
fn is_contested(moment: &Moment) -> bool {
    Team::BOTH.into_iter().all(|team| {
        moment.now.team(team).any(|robot| {
            robot.position.distance(moment.ball.position) <= moment.config.contest_distance
        })
    })
}
