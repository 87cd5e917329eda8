//! The keeper: saves, covers the goal, clears.

use rsim_referee::Vector;

use crate::order::Order;
use crate::phase::{Mode, Restart};
use crate::pitch::Area;
use crate::plane::Plane;
use crate::situation::Situation;
use crate::view::Player;

/// Speed of a ball toward the goal from which it is a shot, m/s.
const SHOT_SPEED: f32 = 0.6;
/// Distance beside the posts at which a shot still counts as one, m.
const POST_ROOM: f32 = 0.15;
/// Distance from the goal of a keeper that a kicker comes to, as a share of the ball's, and at most, m.
const OUT_SHARE: f32 = 0.7;
const MAX_OUT: f32 = 1.8;
/// Distance from the goal line, m, so that it stays clear of the posts.
const LINE_ROOM: f32 = 0.1;
/// Time until the ball is there in which the keeper hurries, s.
const HURRY: f32 = 0.5;
/// Depth within its area at which the ball is the keeper's, m.
const DEPTH: f32 = 0.0;
/// Speed of a ball that the keeper goes for, m/s.
const FETCHED_SPEED: f32 = 1.2;

/// Place where the ball crosses the goal line; `None` for one that does not come, or goes beside the goal.
fn shot_place(s: &Situation) -> Option<Vector> {
    let ball = &s.view.ball;
    let line = s.pitch.own_goal().x;
    if ball.velocity.x > -SHOT_SPEED || ball.position.x < line {
        return None;
    }
    let time = (line - ball.position.x) / ball.velocity.x;
    let place = Vector::new(line, ball.position.y + ball.velocity.y * time);
    let is_on_goal = place.y.abs() < s.pitch.lines.half_goal_width + POST_ROOM;
    (is_on_goal && s.path.rest.x < line + 0.1).then_some(place)
}

/// Whether the ball is the keeper's to take.
pub(crate) fn takes_ball(s: &Situation) -> bool {
    let depth = -s.pitch.distance_to(Area::Own, s.ball());
    depth > DEPTH && s.path.speed < FETCHED_SPEED && s.ball().x > s.pitch.own_goal().x - 0.02
}

/// Order of a keeper that does not take the ball.
pub(crate) fn guard(s: &Situation, keeper: &Player) -> Order {
    let ball = s.ball();
    let facing = ball - keeper.position;
    let target = match shot_place(s) {
        Some(place) => save(s, keeper, place),
        None => cover(s, ball, off_line(s)),
    };
    Order { dribbler: 0.0, ball_distance: 0.0, ..Order::to(target, facing) }
}

/// The place on the way of a shot that the keeper reaches first.
fn save(s: &Situation, keeper: &Player, crossing: Vector) -> Vector {
    let ball = s.ball();
    let way = crossing - ball;
    let ahead = way.unit_or(Vector::new(-1.0, 0.0));
    let along = (keeper.position - ball).dot(ahead).clamp(0.0, way.length());
    let mut foot = ball + ahead * along;
    foot.x = foot.x.max(s.pitch.own_goal().x + 0.5 * LINE_ROOM);
    // If it comes late at its speed, it drives through the foot, so that it does not brake before the ball is
    // there. Beyond the foot the ball would bounce from its side into the goal.
    let to = foot - keeper.position;
    let room = to.length();
    let time = along / s.path.speed.max(SHOT_SPEED);
    let is_late = keeper.velocity.dot(to) * time < room * room;
    if room > 0.05 && time < HURRY && is_late { foot + to * (0.15 / room) } else { foot }
}

/// Distance of the keeper from the middle of the goal, m: against a kicker that comes alone it comes out.
fn off_line(s: &Situation) -> f32 {
    let usual = s.tactics.keeper_distance * s.pitch.lines.half_goal_width;
    if s.phase.mode == Mode::Play || s.phase.restart != Restart::Penalty {
        return usual;
    }
    (OUT_SHARE * s.ball().distance(s.pitch.own_goal())).clamp(usual, MAX_OUT)
}

/// The place that covers the goal against a shot from a place.
fn cover(s: &Situation, from: Vector, off_line: f32) -> Vector {
    let goal = s.pitch.own_goal();
    let half = s.pitch.lines.half_goal_width;
    let from = Vector::new(from.x.max(goal.x + 0.05), from.y);
    let out = (from - goal).unit_or(Vector::new(1.0, 0.0));
    let place = goal + out * off_line;
    Vector::new(place.x.max(goal.x + LINE_ROOM), place.y.clamp(-half + LINE_ROOM, half - LINE_ROOM))
}

/// Order of the keeper before a penalty kick: on its line, before the ball.
pub(crate) fn on_line(s: &Situation, keeper: &Player) -> Order {
    let goal = s.pitch.own_goal();
    let ball = s.ball();
    let aside = (ball.y / (ball.x - goal.x).max(0.5)) * 0.1;
    let target = Vector::new(goal.x + 0.03, aside);
    Order::to(target, ball - keeper.position)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{PLAY, Scene};

    fn order(scene: &Scene) -> Order {
        scene.situation(PLAY, |s| guard(s, &s.view.own[0]))
    }

    #[test]
    fn the_keeper_stands_between_ball_and_goal() {
        let mut scene = Scene::new(1, 0);
        scene.ball([-3.0, 1.5], [0.0, 0.0]);
        scene.robot(0, [-4.2, 0.0]);
        let target = order(&scene).target;
        let off = target.distance_to_segment(Vector::new(-4.5, 0.0), Vector::new(-3.0, 1.5));
        assert!(off < 0.05 && target.x > -4.5, "{target:?}");
    }

    #[test]
    fn the_keeper_goes_into_the_way_of_a_shot() {
        let mut scene = Scene::new(1, 0);
        scene.ball([-2.0, 0.0], [-4.0, 0.7]);
        scene.robot(0, [-4.2, 0.0]);
        let target = order(&scene).target;
        assert!(target.y > 0.3, "{target:?}");
        scene.ball([-2.0, 0.0], [-4.0, 4.0]);
        let beside = order(&scene).target;
        assert!(beside.y.abs() < 0.1, "this one goes beside the goal: {beside:?}");
    }

    #[test]
    fn only_slow_balls_in_its_area_are_the_keepers() {
        let mut scene = Scene::new(1, 0);
        let takes = |scene: &Scene| scene.situation(PLAY, takes_ball);
        scene.ball([-4.0, 0.5], [0.2, 0.0]);
        assert!(takes(&scene));
        scene.ball([-4.0, 0.5], [-3.0, 0.0]);
        assert!(!takes(&scene));
        scene.ball([-3.4, 0.5], [0.0, 0.0]);
        assert!(!takes(&scene));
    }
}
