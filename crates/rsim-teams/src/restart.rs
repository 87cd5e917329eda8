//! The robot that takes the team's kick-off or free kick.

use rsim_referee::Vector;

use crate::aim::{self, Kick};
use crate::kicking;
use crate::memory::TeamMemory;
use crate::order::Order;
use crate::phase::{Mode, Restart};
use crate::plane::Plane;
use crate::possession;
use crate::situation::Situation;
use crate::view::Player;

/// Time from the permission until the kick, in which teammates run free, s.
const WAITING: f32 = 1.0;
/// Distance between mouth and ball where the kicker waits, m. The rules want 0.05 between hull and ball.
const STANDOFF: f32 = 0.13;
/// Distance beyond contact at which the kicker aims, m.
const PRESS_DEPTH: f32 = 0.05;
/// Speed into the ball, m/s.
const KICK_APPROACH: f32 = 0.5;
/// Gap between mouth and ball below which the kick happens within the step, m.
const TOUCHING: f32 = 0.025;
/// Error to the side for the final approach, m.
const MAX_ASIDE: f32 = 0.012;
/// Sine of the heading's error for the final approach.
const MAX_SINE: f32 = 0.025;
/// Time from the permission after which the kick is settled and the errors may grow, s: late or noisy
/// senses hardly ever show a robot without one, and a free kick that is not taken in time is lost.
const PRECISE: f32 = 2.5;
/// Growth of the errors after that, 1/s.
const GROWTH: f32 = 1.0;
/// Largest errors, as factors.
const MAX_TOLERANCE: f32 = 2.5;

/// Order of the robot that takes the kick-off or free kick.
pub(crate) fn take_kick(s: &Situation, memory: &mut TeamMemory, robot: &Player) -> Order {
    let ball = s.ball();
    let choose = || aim::best_kick(s, ball, robot.index);
    // Noisy senses change the best kick all the time, and the robot would drive around the ball.
    let chosen = if s.command_time < PRECISE {
        possession::chosen(s, memory, robot.index, choose)
    } else {
        possession::settled(s, memory, robot.index, choose)
    };
    let kick = aim::with_error(s, chosen, ball, robot.index);
    take(s, memory, robot, &kick)
}

/// Order of a robot that makes a kick from behind a resting ball. It touches the ball only to kick it.
pub(crate) fn take(s: &Situation, memory: &mut TeamMemory, robot: &Player, kick: &Kick) -> Order {
    let ball = s.ball();
    let direction = (kick.at - ball).unit_or(Vector::new(1.0, 0.0));
    let mouth = s.config.mouth();
    let behind = ball - direction * (mouth + STANDOFF);
    let own = (ball - robot.position).seen_from(direction);
    let tolerance = (1.0 + GROWTH * (s.command_time - PRECISE)).clamp(1.0, MAX_TOLERANCE);
    let is_aligned = own.x > 0.0
        && own.y.abs() < MAX_ASIDE * tolerance
        && robot.heading.dot(direction) > 0.0
        && robot.heading.cross(direction).abs() < MAX_SINE * tolerance;
    let may_kick = s.phase.mode == Mode::Kick && s.command_time > WAITING;
    let is_kicking = may_kick && own.x < mouth + STANDOFF + 0.03 && is_aligned;
    if !is_kicking {
        return Order { ball_distance: mouth + 0.1, ..Order::to(behind, direction) };
    }
    let ahead = robot.velocity.dot(robot.heading);
    if robot.has_ball || own.x < mouth + TOUCHING {
        kicking::expect(memory, kick);
    }
    Order {
        target: ball - direction * (mouth - PRESS_DEPTH),
        max_speed: KICK_APPROACH,
        kick: kicking::command(s, kick, ahead.max(0.0)),
        ball_distance: 0.0,
        straight: true,
        ..Order::to(ball, direction)
    }
}

/// Order of the robot that will take the kick, until it may: behind the ball, as near as it may be.
pub(crate) fn wait_for_kick(s: &Situation) -> Order {
    let toward = match s.phase.restart {
        Restart::Free => s.pitch.their_goal() - s.place,
        Restart::Kickoff | Restart::Penalty => Vector::new(1.0, 0.0),
    };
    let direction = toward.unit_or(Vector::new(1.0, 0.0));
    let distance = match s.phase.mode {
        Mode::Prepare => s.config.mouth() + STANDOFF,
        _ => 0.75,
    };
    let target = s.place - direction * distance;
    Order { ball_distance: 0.3, ..Order::to(target, direction * s.tactics.ball_speed) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::phase::Phase;
    use crate::testing::Scene;

    const KICK: Phase =
        Phase { mode: Mode::Kick, restart: Restart::Kickoff, ours: true, kicks_next: false };

    fn order(scene: &Scene) -> Order {
        let mut memory = TeamMemory::new(1);
        scene.situation(KICK, |s| take_kick(s, &mut memory, &s.view.own[0]))
    }

    #[test]
    fn the_kicker_touches_the_ball_only_from_behind_and_with_its_kick() {
        let mut scene = Scene::new(1, 0);
        scene.ball([1.5, 0.0], [0.0, 0.0]);
        scene.robot(0, [1.8, 0.3]);
        let around = order(&scene);
        assert!(around.kick[0] <= 0.0 && around.target.x < 1.3, "{around:?}");
        assert!(around.ball_distance > 0.15, "{around:?}");
        scene.robot(0, [1.5 - 0.093 - 0.1, 0.0]);
        let kicks = order(&scene);
        assert!(kicks.kick[0] > 5.0 && kicks.target.x > 1.4, "{kicks:?}");
    }

    #[test]
    fn a_kicker_that_never_seems_to_stand_exactly_kicks_all_the_same() {
        let mut scene = Scene::new(1, 0);
        scene.ball([1.5, 0.0], [0.0, 0.0]);
        scene.robot(0, [1.5 - 0.093 - 0.1, 0.02]);
        let kicks_after = |command_time| {
            let mut memory = TeamMemory::new(1);
            scene.situation(KICK, |s| {
                let s = Situation { command_time, path: s.path.clone(), ..*s };
                take_kick(&s, &mut memory, &s.view.own[0]).kick[0] > 5.0
            })
        };
        assert!(!kicks_after(2.0) && kicks_after(5.0));
    }

    #[test]
    fn a_kicker_that_has_waited_keeps_what_it_has_chosen() {
        let mut scene = Scene::new(1, 0);
        scene.ball([0.0, 0.0], [0.0, 0.0]);
        scene.robot(0, [-0.5, 0.0]);
        let aside = Vector::new(0.0, 2.0);
        let facing = |command_time| {
            let mut memory = TeamMemory { aimer: Some(0), aim: aside, ..TeamMemory::new(1) };
            scene.situation(KICK, |s| {
                let s = Situation { command_time, step: 0, path: s.path.clone(), ..*s };
                take_kick(&s, &mut memory, &s.view.own[0]).facing
            })
        };
        assert!(facing(2.0).y.abs() < 0.5, "before, it takes the better shot");
        assert!(facing(5.0).y > 0.9);
    }

    #[test]
    fn in_a_stop_the_kicker_waits_far_behind_the_ball() {
        let mut scene = Scene::new(1, 0);
        scene.ball([1.0, 1.0], [0.0, 0.0]);
        for (mode, least, most) in [(Mode::Stop, 0.6, 0.9), (Mode::Prepare, 0.17, 0.3)] {
            let order = scene.situation(Phase { mode, ..KICK }, wait_for_kick);
            let distance = order.target.distance(Vector::new(1.0, 1.0));
            assert!((least..most).contains(&distance) && order.target.x < 1.0, "{order:?}");
        }
    }
}
