//! Too many robots of a team in an area with the ball.

use crate::codes::Command;
use crate::events::EventKind;
use crate::game::Game;
use crate::moment::Moment;
use crate::rules::vsss::{in_goal_area, in_large_area};
use crate::ruling::{Ruling, Rulings};
use crate::team::Team;
use crate::vector::Vector;

/// Too many attackers for some time, or when the ball leaves the area: a goal kick.
pub fn too_many_attackers(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    for attacker in Team::BOTH {
        let defender = attacker.opponent();
        let most = [moment.config.area_robots, moment.config.large_area_attackers];
        let is_now = game.in_play && is_crowded(moment, attacker, defender, most);
        let steps = if is_now { game.attackers_steps[attacker] + 1 } else { 0 };
        let had = game.had_attackers[attacker];
        let left = had && !has_ball(moment, defender);
        game.attackers_steps[attacker] = steps;
        game.had_attackers[attacker] = (had || is_now) && !left;
        if steps >= limit(moment) || left && !is_decided(rulings) {
            let kind = EventKind::AttackerTouchedBallInDefenseArea;
            let ruling = Ruling::of_team(kind, Some(attacker), moment.ball.position);
            let (command, place) = goal_kick(moment, defender);
            rulings.add(ruling.stops(command, place));
        }
    }
}

/// Too many defenders for some time, or when the ball leaves the area: a penalty kick.
pub fn too_many_defenders(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    for defender in Team::BOTH {
        let attacker = defender.opponent();
        let most = [moment.config.area_robots, moment.config.large_area_defenders];
        let is_now = game.in_play && is_crowded(moment, defender, defender, most);
        let steps = if is_now { game.defenders_steps[defender] + 1 } else { 0 };
        let had = game.had_defenders[defender];
        let left = had && !has_ball(moment, defender);
        game.defenders_steps[defender] = steps;
        game.had_defenders[defender] = (had || is_now) && !left;
        if steps >= limit(moment) || left && !is_decided(rulings) {
            let kind = EventKind::DefenderInDefenseArea;
            let ruling = Ruling::of_team(kind, Some(defender), moment.ball.position);
            let mark = moment.lines().penalty_mark(attacker);
            rulings.add(ruling.stops(Command::PreparePenalty(attacker), mark));
        }
    }
}

/// Whether `team` has too many robots in the areas that `defender` defends, with the ball. `most` are the
/// numbers that are too many in the goal area and in the larger one; 0 is any number.
fn is_crowded(moment: &Moment, team: Team, defender: Team, most: [f32; 2]) -> bool {
    let areas: [fn(&Moment, Vector, Team) -> bool; 2] = [in_goal_area, in_large_area];
    areas.into_iter().zip(most).any(|(is_inside, most)| {
        most > 0.0
            && is_inside(moment, moment.ball.position, defender)
            && count(moment, team, |place| is_inside(moment, place, defender)) >= most
    })
}

#[allow(clippy::cast_precision_loss)] // a few robots
fn count(moment: &Moment, team: Team, is_inside: impl Fn(Vector) -> bool) -> f32 {
    moment.now.team(team).filter(|robot| is_inside(robot.position)).count() as f32
}

/// Whether the ball is in the larger area of a team, on the field.
fn has_ball(moment: &Moment, defender: Team) -> bool {
    in_large_area(moment, moment.ball.position, defender)
}

/// Whether a goal, or a goal that does not count, has decided how play goes on.
fn is_decided(rulings: &Rulings) -> bool {
    rulings.has(EventKind::Goal) || rulings.has(EventKind::InvalidGoal)
}

fn limit(moment: &Moment) -> i32 {
    moment.steps(moment.config.held_ball_seconds)
}

/// Distance of the ball of a goal kick from the goal line, m (`replacer.cpp`).
const GOAL_KICK_X: f32 = 0.15;
/// Distance of the ball of a goal kick from the middle at three a side, to its far side, m.
const GOAL_KICK_Y: f32 = 0.375;

/// Command and place of the goal kick of a team. At three a side the league draws the side; here it is the
/// one on which the ball is.
pub(crate) fn goal_kick(moment: &Moment, defender: Team) -> (Command, Vector) {
    let lines = moment.lines();
    let x = defender.own_side() * (lines.half_length - GOAL_KICK_X);
    let is_small = lines.inner_area_depth == 0.0;
    let y = if is_small { GOAL_KICK_Y - moment.pitch.ball_radius } else { 0.0 };
    (Command::GoalKick(defender), Vector::new(x, y.copysign(moment.ball.position.y)))
}
