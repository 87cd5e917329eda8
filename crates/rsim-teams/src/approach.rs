//! Taking the ball: stand in its way, or drive behind it and into it.

use rsim_referee::Vector;

use crate::aim;
use crate::intercept::Meeting;
use crate::order::Order;
use crate::plane::Plane;
use crate::situation::Situation;
use crate::view::Player;

/// Speed of a ball that is received rather than fetched, m/s.
const RECEIVED_SPEED: f32 = 0.5;
/// Cosine of the heading's error for the final approach.
const FACING_COSINE: f32 = 0.97;
/// Error to the side for the final approach, m.
const MAX_ASIDE: f32 = 0.025;
/// Room to the ball while driving around it, m.
const BALL_ROOM: f32 = 0.03;

/// Order to take the ball, facing `direction` (a unit vector) where that does not matter for time.
pub(crate) fn take(s: &Situation, robot: &Player, meeting: Meeting, direction: Vector) -> Order {
    let ball = &s.view.ball;
    let from_ball = robot.position - ball.position;
    let speed = ball.velocity.length();
    let is_coming =
        speed > RECEIVED_SPEED && s.path.direction.dot(from_ball) > 0.7 * from_ball.length();
    if is_coming { receive(s, robot, meeting) } else { fetch(s, robot, meeting, direction) }
}

/// Stands in the way of a coming ball.
fn receive(s: &Situation, robot: &Player, meeting: Meeting) -> Order {
    let ball = s.ball();
    let ahead = s.path.direction;
    let from_ball = robot.position - ball;
    let along = ahead.dot(from_ball);
    let foot = ball + ahead * along;
    // A robot that is there in time waits where it is; others go where they meet it.
    let aside = robot.position.distance(foot);
    let waits = aside < 0.25 && s.pitch.lines.is_inside(foot, 0.0);
    let mouth = s.config.mouth();
    let touch = if waits { foot - ahead * mouth } else { meeting.place };
    let order = Order { ball_distance: 0.0, ..Order::to(touch + ahead * mouth, ahead * -1.0) };
    let kick = aim::shot(s, touch);
    let direction = (kick.at - touch).unit_or(ahead);
    if kick.value < s.tactics.first_touch_value || direction.dot(ahead) > -s.tactics.redirection {
        return Order { dribbler: 1.0, ..order };
    }
    // The kick keeps part of the speed across the front, so the front turns a little the other way.
    let kick = aim::with_error(s, kick, touch, robot.index);
    let direction = (kick.at - touch).unit_or(ahead);
    let across = s.tactics.kept_across * s.view.ball.velocity.dot(direction.left()) / kick.speed;
    let heading = (direction - direction.left() * across).unit_or(direction);
    let is_facing = robot.heading.dot(heading) > 0.98;
    let shoots = [if is_facing { kick.speed - 0.3 } else { 0.0 }, 0.0];
    Order { target: touch - heading * mouth, facing: heading, kick: shoots, ..order }
}

/// Drives behind a slow or leaving ball, then into it.
fn fetch(s: &Situation, robot: &Player, meeting: Meeting, direction: Vector) -> Order {
    let mouth = s.config.mouth();
    let ball = &s.view.ball;
    let near = robot.position.distance(ball.position) < mouth + 0.3;
    let at = if near { ball.position + ball.velocity * s.config.time_step } else { meeting.place };
    let to_ball = at - robot.position;
    let own = to_ball.seen_from(direction);
    let is_aligned = own.x > 0.0
        && own.y.abs() < MAX_ASIDE + 0.3 * (own.x - mouth).max(0.0)
        && robot.heading.dot(direction) > FACING_COSINE;
    if near && is_aligned {
        let target = at - direction * mouth;
        return Order {
            moving: ball.velocity + direction * s.tactics.press_speed,
            dribbler: 1.0,
            ball_distance: 0.0,
            straight: true,
            ..Order::to(target, direction)
        };
    }
    let target = at - direction * (mouth + s.tactics.standoff);
    let moving = if near { ball.velocity } else { Vector::default() };
    let dribbler = if near { 1.0 } else { 0.0 };
    Order { moving, dribbler, ball_distance: mouth + BALL_ROOM, ..Order::to(target, direction) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{PLAY, Scene};

    const AHEAD: Vector = Vector::new(1.0, 0.0);

    fn order(scene: &Scene) -> Order {
        scene.situation(PLAY, |s| take(s, &s.view.own[0], s.own.of(0).expect("it is there"), AHEAD))
    }

    #[test]
    fn a_robot_drives_behind_a_resting_ball_before_it_drives_into_it() {
        let mut scene = Scene::new(1, 0);
        scene.robot(0, [0.5, 0.0]);
        let around = order(&scene);
        assert!(around.target.x < -0.15 && around.ball_distance > 0.0, "{around:?}");
        scene.robot(0, [-0.2, 0.0]);
        let into = order(&scene);
        assert!(into.straight && into.dribbler > 0.0 && into.moving.x > 0.0, "{into:?}");
        scene.robot(0, [-0.2, 0.06]);
        assert!(!order(&scene).straight, "it is too far to the side");
    }

    #[test]
    fn a_robot_stands_in_the_way_of_a_coming_ball_and_faces_it() {
        let mut scene = Scene::new(1, 0);
        scene.ball([-2.0, 0.1], [2.0, 0.0]);
        scene.robot(0, [-0.5, 0.0]);
        let order = order(&scene);
        assert!((order.target.y - 0.1).abs() < 1e-4, "{order:?}");
        assert!(order.facing.x < -0.9 && order.dribbler > 0.0, "{order:?}");
    }

    #[test]
    fn a_good_shot_is_made_at_first_touch() {
        let mut scene = Scene::new(1, 0);
        scene.ball([4.2, 1.5], [-1.25, -1.56]);
        scene.robot(0, [2.9, -0.1]);
        let order = order(&scene);
        assert!(order.kick[0] > 5.0 && order.dribbler < 0.5, "{order:?}");
        assert!(order.facing.x > 0.8, "{order:?}");
    }
}
