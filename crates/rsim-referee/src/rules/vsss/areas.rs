//! Too many robots of a team in an area with the ball.

use crate::codes::Command;
use crate::events::EventKind;
use crate::game::Game;
use crate::moment::Moment;
use crate::rules::vsss::{in_goal_area, in_large_area};
use crate::ruling::{Ruling, Rulings};
use crate::stages::is_shootout;
use crate::team::Team;
use crate::vector::Vector;

/// Too many attackers for some time, or when the ball leaves the area: a goal kick. Where both teams were too
/// many when it leaves, the foul is the defenders'.
pub fn too_many_attackers(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    if !is_judged(game, rulings) {
        return;
    }
    let most = [moment.config.area_robots, moment.config.large_area_attackers];
    for attacker in Team::BOTH {
        let defender = attacker.opponent();
        let is_now = is_crowded(moment, attacker, defender, most);
        let had_defenders = game.had_defenders[defender];
        let crowd = (&mut game.attackers_steps[attacker], &mut game.had_attackers[attacker]);
        let is_foul = match follow(crowd, is_now, moment, defender) {
            Crowd::Lasted => true,
            Crowd::Left => !had_defenders,
            Crowd::Allowed => false,
        };
        if is_foul {
            let kind = EventKind::AttackerTouchedBallInDefenseArea;
            let ruling = Ruling::of_team(kind, Some(attacker), moment.ball.position);
            let (command, place) = goal_kick(moment, defender);
            rulings.add(ruling.stops(command, place));
        }
    }
}

/// Too many defenders for some time, or when the ball leaves the area: a penalty kick.
pub fn too_many_defenders(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    if !is_judged(game, rulings) {
        return;
    }
    let most = [moment.config.area_robots, moment.config.large_area_defenders];
    for defender in Team::BOTH {
        let is_now = is_crowded(moment, defender, defender, most);
        let crowd = (&mut game.defenders_steps[defender], &mut game.had_defenders[defender]);
        if follow(crowd, is_now, moment, defender) != Crowd::Allowed {
            let kind = EventKind::DefenderInDefenseArea;
            let ruling = Ruling::of_team(kind, Some(defender), moment.ball.position);
            let (command, place) = penalty_kick(moment, defender.opponent());
            rulings.add(ruling.stops(command, place));
        }
    }
}

/// Whether the areas are judged: in play, but not in the shoot-out, and not after another rule has stopped
/// play. A stop forgets all crowds.
fn is_judged(game: &Game, rulings: &Rulings) -> bool {
    game.in_play && !is_shootout(game) && rulings.stop().is_none()
}

/// Change of a crowd in an area in a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Crowd {
    /// There is none, or it has not lasted.
    Allowed,
    /// It has lasted too long.
    Lasted,
    /// There was one, and the ball has left the area.
    Left,
}

/// Follows for how long there is a crowd, and whether there was one since the ball came into the area.
fn follow(
    (steps, had): (&mut i32, &mut bool),
    is_now: bool,
    moment: &Moment,
    defender: Team,
) -> Crowd {
    let had_before = *had;
    let has_ball = in_large_area(moment, moment.ball.position, defender);
    *steps = if is_now { *steps + 1 } else { 0 };
    *had = has_ball && (had_before || is_now);
    if is_now && *steps >= moment.steps(moment.config.held_ball_seconds) {
        Crowd::Lasted
    } else if had_before && !has_ball {
        Crowd::Left
    } else {
        Crowd::Allowed
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
    let aside = (GOAL_KICK_Y - moment.pitch.ball_radius).copysign(moment.ball.position.y);
    (Command::GoalKick(defender), Vector::new(x, if is_small { aside } else { 0.0 }))
}

/// Command and place of the penalty kick of a team.
pub(crate) fn penalty_kick(moment: &Moment, attacker: Team) -> (Command, Vector) {
    (Command::PreparePenalty(attacker), moment.lines().penalty_mark(attacker))
}
