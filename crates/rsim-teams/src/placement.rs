//! The robot that places the ball: takes it, carries it, leaves it.

use rsim_referee::Vector;

use crate::approach;
use crate::intercept::Meeting;
use crate::memory::TeamMemory;
use crate::order::Order;
use crate::plane::Plane;
use crate::possession;
use crate::situation::Situation;
use crate::view::Player;

/// Distance of the ball from its place at which it is left, m; the rules want 0.15.
const PLACED: f32 = 0.05;
/// Distance from which it is placed again, m.
const MISPLACED: f32 = 0.12;
/// Speed of a ball that is left, m/s.
const RESTING: f32 = 0.08;
/// Speed with the ball, m/s.
const SPEED: f32 = 1.3;
/// Acceleration with the ball, m/s².
const ACCELERATION: f32 = 1.2;
/// Deceleration with which it comes to the place, m/s².
const BRAKING: f32 = 0.6;
/// Speed at which the ball is pulled into the field, m/s.
const PULL_SPEED: f32 = 0.5;
/// Acceleration with which it is, m/s².
const PULL_ACCELERATION: f32 = 0.6;
/// Speed over the last centimeters, m/s.
const LAST_SPEED: f32 = 0.12;
/// Angular acceleration with the ball, rad/s².
const TURN_ACCELERATION: f32 = 10.0;
/// Angular velocity with the ball, rad/s.
const TURNING: f32 = 2.5;
/// Cosine of the angle to the place within which the robot drives ahead.
const FACING_COSINE: f32 = 0.995;
/// Distance from the lines beyond which the ball is pulled back into the field, m.
const BEYOND: f32 = 0.05;
/// Distance from the lines at which a robot waits for a ball beyond them, m.
const INNER: f32 = 0.3;
/// Room between a robot and walls, m.
const WALL_ROOM: f32 = 0.015;
/// Gap between hull and ball that is left before an own free kick, and before another command, m.
const LEFT: [f32; 2] = [0.12, 0.56];
/// Gap between hull and ball at which the robot still has it, m.
const GAP: f32 = 0.03;

/// Order of the robot that places the ball.
pub(crate) fn place(s: &Situation, memory: &mut TeamMemory, robot: &Player) -> Order {
    let ball = s.ball();
    let missing = ball.distance(s.place);
    if missing > MISPLACED {
        memory.releases = false;
    } else if missing < PLACED && s.path.speed < RESTING {
        memory.releases = true;
    }
    if memory.releases {
        return leave(s, robot);
    }
    let has_ball = robot.has_ball
        || robot.position.distance(ball) < s.config.mouth() + GAP
            && (ball - robot.position).dot(robot.heading) > s.config.robot.front_distance;
    if has_ball { carry(s, robot) } else { fetch(s, robot) }
}

/// Takes the ball, from the side from which it can go on.
fn fetch(s: &Situation, robot: &Player) -> Order {
    let ball = s.ball();
    let direction = if s.pitch.lines.is_inside(ball, BEYOND) {
        (s.place - ball).unit_or(robot.heading)
    } else {
        outward(s, ball)
    };
    let meeting = Meeting { place: ball, ..s.own.of(robot.index).unwrap_or_default() };
    approach::take(s, robot, meeting, direction)
}

/// Direction in which a robot can get a ball beyond the lines into its mouth, clear of walls and goals.
fn outward(s: &Situation, ball: Vector) -> Vector {
    let lines = &s.pitch.lines;
    let mouth = s.config.mouth();
    let room = s.config.robot.radius + WALL_ROOM;
    let inner = s.pitch.inside(ball, INNER);
    let straight = (ball - inner).unit_or(Vector::new(1.0, 0.0));
    let mut center = s.pitch.within_walls(ball - straight * mouth, room);
    if ball.x.abs() > lines.half_length {
        let [within, beside] = [
            lines.half_goal_width - room,
            lines.half_goal_width + lines.goal_wall_thickness + room,
        ];
        let y = center.y.abs();
        let clear =
            if ball.y.abs() < lines.half_goal_width { y.min(within) } else { y.max(beside) };
        center.y = clear.copysign(ball.y);
    }
    (ball - center).unit_or(straight)
}

/// Drives with the ball: from beyond the lines as it is, then ahead to its place.
fn carry(s: &Situation, robot: &Player) -> Order {
    let ball = s.ball();
    let to_place = s.place - ball;
    let direction = to_place.unit_or(robot.heading);
    let order = Order {
        acceleration: ACCELERATION,
        turning: TURNING.min(possession::turning(s, robot)),
        turn_acceleration: TURN_ACCELERATION,
        dribbler: 1.0,
        ball_distance: 0.0,
        straight: true,
        ..Order::to(robot.position, robot.heading)
    };
    let is_outside = !s.pitch.lines.is_inside(ball, -0.1);
    let place_is_outside = !s.pitch.lines.is_inside(s.place, -0.1);
    if is_outside && !place_is_outside {
        let inward = (s.pitch.inside(ball, INNER) - ball).unit_or(robot.heading * -1.0);
        let target = robot.position + inward * 0.5;
        return Order { target, max_speed: PULL_SPEED, acceleration: PULL_ACCELERATION, ..order };
    }
    if robot.heading.dot(direction) < FACING_COSINE && to_place.length() > PLACED {
        return Order { facing: direction, ..order };
    }
    let speed = (2.0 * BRAKING * to_place.length()).sqrt().clamp(LAST_SPEED, SPEED);
    Order {
        target: robot.position + to_place,
        facing: if to_place.length() > 0.2 { direction } else { robot.heading },
        max_speed: speed,
        ..order
    }
}

/// Drives straight back from a placed ball, once it rests.
fn leave(s: &Situation, robot: &Player) -> Order {
    let ball = s.ball();
    let gap = LEFT[usize::from(!s.phase.kicks_next)];
    let away = (robot.position - ball).unit_or(robot.heading * -1.0);
    let touches = robot.position.distance(ball) < s.body();
    let distance = s.body() + gap;
    let target =
        if touches && s.path.speed > RESTING { robot.position } else { ball + away * distance };
    let order = Order::to(target, away * -1.0);
    Order { max_speed: 0.8, acceleration: 1.5, ball_distance: 0.0, straight: true, ..order }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::phase::{Mode, Phase, Restart};
    use crate::testing::Scene;

    const PLACE: Phase =
        Phase { mode: Mode::Place, restart: Restart::Free, ours: true, kicks_next: true };

    fn order(scene: &Scene, to: [f32; 2], kicks_next: bool) -> Order {
        let mut memory = TeamMemory::new(1);
        scene.situation(Phase { kicks_next, ..PLACE }, |s| {
            let s = Situation { place: Vector::new(to[0], to[1]), path: s.path.clone(), ..*s };
            place(&s, &mut memory, &s.view.own[0])
        })
    }

    #[test]
    fn balls_at_walls_and_goals_are_taken_from_where_there_is_room() {
        let scene = Scene::new(1, 0);
        for (x, y) in
            [(4.75, 3.25), (-4.75, -3.25), (4.75, 0.58), (-4.6, 0.46), (4.66, 0.0), (1.0, -3.25)]
        {
            scene.situation(PLACE, |s| {
                let ball = Vector::new(x, y);
                let center = ball - outward(s, ball) * s.config.mouth();
                let (wall_x, wall_y) = (4.8 - center.x.abs(), 3.3 - center.y.abs());
                assert!(wall_x > 0.09 && wall_y > 0.09, "{ball:?}: {center:?}");
                let beside_net = (center.y.abs() - 0.5).abs();
                assert!(center.x.abs() < 4.4 || beside_net > 0.09, "{ball:?}: {center:?}");
            });
        }
    }

    #[test]
    fn a_ball_in_the_mouth_is_carried_and_left_at_its_place() {
        let mut scene = Scene::new(1, 0);
        scene.robot(0, [0.0, 0.0]);
        scene.ball([0.093, 0.0], [0.0, 0.0]);
        scene.set(0, "infrared", 1.0);
        let carries = order(&scene, [2.0, 0.0], true);
        assert!(carries.target.x > 1.5 && carries.dribbler > 0.0, "{carries:?}");
        let aside = order(&scene, [0.0, 2.0], true);
        assert!(aside.target.x.abs() < 1e-3 && aside.facing.y > 0.9, "it turns first: {aside:?}");
        for (kicks_next, gap) in [(true, 0.12), (false, 0.56)] {
            let leaves = order(&scene, [0.093, 0.0], kicks_next);
            let distance = leaves.target.distance(Vector::new(0.093, 0.0));
            assert!((distance - 0.1115 - gap).abs() < 1e-3, "{leaves:?}");
            assert!(leaves.dribbler <= 0.0 && leaves.target.x < 0.0, "{leaves:?}");
        }
    }
}
