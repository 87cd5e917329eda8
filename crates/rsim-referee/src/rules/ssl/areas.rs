//! Touches of the ball in the goal areas (SSL rules, "Multiple Defenders", "Attacker Touched Ball In
//! Opponent Defense Area", "Keeper Held Ball").

use crate::codes::Command;
use crate::events::EventKind;
use crate::game::Game;
use crate::moment::Moment;
use crate::repeats::{PAUSE_SECONDS, Repeated};
use crate::rules::ssl::kick_place;
use crate::ruling::{Ruling, Rulings};
use crate::team::Team;

/// A robot other than the keeper touches the ball while it is entirely inside its own area: a penalty kick.
pub fn multiple_defenders(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    if !game.in_play {
        return;
    }
    let radius = moment.pitch.robot_radius;
    let offender = moment.now.robots().find(|robot| {
        robot.touched_ball
            && robot.index != moment.keeper(robot.team)
            && moment.lines().distance_to_area(robot.position, robot.team) <= -radius
    });
    let Some(robot) = offender else { return };
    let attacker = robot.team.opponent();
    let kind = EventKind::DefenderInDefenseArea;
    let ruling = Ruling::of_robot(kind, robot.team, robot.index, robot.position);
    let mark = moment.lines().penalty_mark(attacker);
    rulings.add(ruling.stops(Command::PreparePenalty(attacker), mark));
}

/// A robot touches the ball while it is at least partly inside the opponents' area.
pub fn attacker_touch(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    if !game.in_play {
        return;
    }
    let radius = moment.pitch.robot_radius;
    for robot in moment.now.robots().filter(|robot| robot.touched_ball) {
        let distance = moment.lines().distance_to_area(robot.position, robot.team.opponent());
        if distance < radius && commit(Repeated::AttackerTouch, game, moment, robot.team) {
            let kind = EventKind::AttackerTouchedBallInDefenseArea;
            rulings.add(Ruling::of_robot(kind, robot.team, robot.index, robot.position).foul());
        }
    }
}

/// Records a foul that does not stop play. Returns whether it is raised.
pub(crate) fn commit(foul: Repeated, game: &mut Game, moment: &Moment, team: Team) -> bool {
    let repeat = moment.steps(moment.config.repeat_seconds);
    foul.commit(game, team, repeat, moment.steps(PAUSE_SECONDS))
}

/// The ball stays in the goal area of a team.
pub fn keeper_held_ball(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    let limit = moment.steps(moment.config.held_ball_seconds);
    for team in Team::BOTH {
        if game.area_steps[team] > limit && game.penalty_taker().is_none() {
            let place = moment.ball.position;
            let ruling = Ruling::of_team(EventKind::KeeperHeldBall, Some(team), place).foul();
            let place = kick_place(moment, place);
            rulings.add(ruling.stops(Command::DirectFree(team.opponent()), place));
        }
    }
}
