//! Kicks of a robot that has the ball: when it makes them, and with which command.

use crate::aim::Kick;
use crate::memory::TeamMemory;
use crate::order::Order;
use crate::plane::Plane;
use crate::situation::Situation;
use crate::view::Player;

/// Way within the field that a kick out of a crowd needs, m.
const STUCK_WAY: f32 = 2.0;
/// Speed of a kick out of a crowd, m/s.
const STUCK_KICK: f32 = 3.5;
/// Least speed of a kick against the mouth, m/s: from 0 on there is none.
const MIN_KICK: f32 = 0.3;
/// Time that a pass may take, in control steps.
const PASS_STEPS: i32 = 100;

/// Kicks if the ball would go where the kick is to go.
pub(crate) fn release(
    s: &Situation,
    memory: &mut TeamMemory,
    robot: &Player,
    kick: &Kick,
    order: &mut Order,
) {
    release_within(s, memory, robot, kick, max_sine(s, kick), order);
}

/// Kicks if the ball would go where the kick is to go, up to the sine of an angle.
pub(crate) fn release_within(
    s: &Situation,
    memory: &mut TeamMemory,
    robot: &Player,
    kick: &Kick,
    sine: f32,
    order: &mut Order,
) {
    let Some(command) = aligned(s, robot, kick, sine) else { return };
    order.kick = command;
    if robot.has_ball {
        expect(memory, kick);
    }
}

/// Lets the receiver of a kick expect it.
pub(crate) fn expect(memory: &mut TeamMemory, kick: &Kick) {
    memory.receiver = kick.receiver;
    memory.pass_steps = PASS_STEPS;
    (memory.aimer, memory.corner_kicker) = (None, None);
}

/// Command of a kick, if the ball would leave in the direction of the kick.
fn aligned(s: &Situation, robot: &Player, kick: &Kick, sine: f32) -> Option<[f32; 2]> {
    let ball = s.ball();
    let direction = (kick.at - ball).unit_or(robot.heading);
    let arm = ball - robot.position;
    let mouth_velocity = robot.velocity + arm.left() * robot.angular_velocity;
    let ahead = mouth_velocity.dot(robot.heading);
    let command = command(s, kick, ahead);
    let result = mouth_velocity + robot.heading * command[0];
    let result = result.unit_or(robot.heading);
    let is_aligned = result.dot(direction) > 0.0
        && result.cross(direction).abs() < sine
        && robot.angular_velocity.abs() < s.tactics.kick_turning;
    is_aligned.then_some(command)
}

/// Sine of the error of direction within which a kick is made: a receiver corrects that of a pass.
fn max_sine(s: &Situation, kick: &Kick) -> f32 {
    match kick.receiver {
        _ if kick.chip => s.tactics.chip_sine,
        Some(_) => s.tactics.pass_sine,
        None => s.tactics.shot_sine,
    }
}

/// Speeds along the heading and upward that give the ball the speed of a kick, from a robot that moves ahead
/// at `ahead` m/s.
pub(crate) fn command(s: &Situation, kick: &Kick, ahead: f32) -> [f32; 2] {
    const DIAGONAL: f32 = std::f32::consts::FRAC_1_SQRT_2;
    let robot = &s.config.robot;
    if kick.chip {
        let speed = kick.speed.min(robot.max_chip_speed).min(s.tactics.ball_speed) * DIAGONAL;
        [(speed - ahead).min(speed).max(MIN_KICK), speed]
    } else {
        let speed = kick.speed.min(robot.max_kick_speed).min(s.tactics.ball_speed);
        [(speed - ahead).clamp(MIN_KICK, s.tactics.ball_speed), 0.0]
    }
}

/// A kick in the direction that a robot in a crowd faces: a shot, or over the others.
pub(crate) fn out_of_crowd(s: &Situation, robot: &Player, kick: Kick) -> Kick {
    let (ball, goal) = (s.ball(), s.pitch.their_goal());
    let share = (goal.x - ball.x) / robot.heading.x;
    let y = ball.y + robot.heading.y * share;
    let is_shot = robot.heading.x > 0.0 && y.abs() < s.pitch.lines.half_goal_width;
    let at = ball + robot.heading * STUCK_WAY;
    if is_shot {
        return Kick { at: goal, speed: s.tactics.ball_speed, chip: false, ..kick };
    }
    Kick { at, speed: STUCK_KICK, chip: s.pitch.lines.is_inside(at, 0.0), ..kick }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{PLAY, Scene};
    use rsim_referee::Vector;

    fn flat(at: Vector, speed: f32) -> Kick {
        Kick { at, speed, chip: false, receiver: None, value: 1.0 }
    }

    #[test]
    fn robots_kick_only_where_the_ball_is_to_go() {
        let mut scene = Scene::new(1, 0);
        scene.ball([0.093, 0.0], [0.0, 0.0]);
        scene.robot(0, [0.0, 0.0]);
        let command_to = |scene: &Scene, at| {
            scene.situation(PLAY, |s| {
                let kick = flat(at, 6.0);
                aligned(s, &s.view.own[0], &kick, max_sine(s, &kick))
            })
        };
        assert!(command_to(&scene, Vector::new(4.5, 0.0)).is_some());
        assert!(command_to(&scene, Vector::new(4.5, 0.4)).is_none());
        scene.set(0, "v_y", 0.6);
        let ahead = command_to(&scene, Vector::new(4.5, 0.0));
        assert!(ahead.is_none(), "the ball would go to the left");
        assert!(command_to(&scene, Vector::new(4.5, 0.45)).is_some());
    }

    #[test]
    fn the_speed_of_the_robot_is_part_of_that_of_the_ball() {
        let scene = Scene::new(1, 0);
        scene.situation(PLAY, |s| {
            let kick = flat(Vector::new(4.5, 0.0), 9.0);
            let total = command(s, &kick, 1.5)[0] + 1.5;
            assert!((total - s.tactics.ball_speed).abs() < 1e-5, "{total}");
            let [ahead, up] = command(s, &Kick { chip: true, speed: 4.0, ..kick }, 0.5);
            assert!((ahead + 0.5 - up).abs() < 1e-5 && (up - 2.828).abs() < 1e-2);
        });
    }

    #[test]
    fn out_of_a_crowd_balls_fly_but_into_the_goal_they_roll() {
        let mut scene = Scene::new(1, 0);
        scene.ball([3.0, 0.0], [0.0, 0.0]);
        let chip = |scene: &Scene| {
            scene.situation(PLAY, |s| out_of_crowd(s, &s.view.own[0], flat(s.ball(), 1.0)).chip)
        };
        assert!(!chip(&scene), "it faces the goal");
        scene.set(0, "cos", 0.0);
        scene.set(0, "sin", 1.0);
        assert!(chip(&scene));
    }
}
