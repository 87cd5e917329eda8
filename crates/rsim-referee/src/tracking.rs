//! Quantities that the referee follows from step to step: touches, heights, dribbling, times.

use crate::game::Game;
use crate::moment::Moment;
use crate::repeats;
use crate::team::Team;

/// Gap between the hull of a robot and the ball from which their separation is observed, m: more than
/// contacts flicker by, and less than a camera misses.
pub(crate) const SEPARATION: f32 = 0.02;

/// Brings the state of a match up to the end of a step.
pub(crate) fn follow(game: &mut Game, moment: &Moment) {
    game.command_steps += 1;
    repeats::pass(game);
    for team in Team::BOTH {
        if game.foul_steps[team] >= 0 {
            game.foul_steps[team] += 1;
        }
    }
    follow_touches(game, moment);
    follow_dribbling(game, moment);
}

/// Follows who touched the ball last, where, and how high it has been since. The row knows the order of touches
/// within the step, and the height between them and its end.
fn follow_touches(game: &mut Game, moment: &Moment) {
    let ball = moment.ball;
    for team in Team::BOTH {
        let highest = ball.height.max(ball.height_since_touch);
        game.height_since_touch[team] = game.height_since_touch[team].max(highest);
    }
    for robot in moment.now.robots().filter(|robot| robot.touched_ball) {
        game.height_since_touch[robot.team] = ball.height_since_touch;
        if game.kick_taker.is_some_and(|taker| taker != robot.index) {
            game.kick_taker = None;
        }
    }
    if let Some(robot) = moment.toucher() {
        game.last_touch = Some(robot.index);
        game.last_touch_position = moment.touch_position(&robot);
    }
}

/// Follows which robot has the ball, and where it began to have it. A ball that was kicked away in the step has
/// been dribbled up to its start only.
fn follow_dribbling(game: &mut Game, moment: &Moment) {
    let reach = moment.pitch.ball_radius + SEPARATION;
    let has_ball = |index: usize| {
        moment.now.robot(index).is_some_and(|robot| {
            robot.has_ball || moment.hull_distance(&robot, moment.ball.position) < reach
        })
    };
    if game.dribbler.is_some_and(has_ball) {
        return;
    }
    game.dribbler = moment.toucher().map(|robot| robot.index);
    game.dribble_start = moment.ball.position;
}

/// SSL: follows for how long the ball makes no progress, and for how long it is in an area.
pub(crate) fn follow_progress(game: &mut Game, moment: &Moment) {
    let ball = moment.ball.position;
    let moved = ball.distance(game.stuck_position) > moment.config.no_progress_distance;
    if moved || !game.in_play {
        (game.stuck_position, game.stuck_steps) = (ball, 0);
    } else {
        game.stuck_steps += 1;
    }
    for team in Team::BOTH {
        let is_inside = game.in_play && moment.lines().distance_to_area(ball, team) <= 0.0;
        game.area_steps[team] = if is_inside { game.area_steps[team] + 1 } else { 0 };
    }
}
