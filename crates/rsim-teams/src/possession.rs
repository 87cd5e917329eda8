//! A robot that has the ball: dribbling, turning, kicking.

use rsim_referee::Vector;

use crate::aim::{self, Kick};
use crate::kicking;
use crate::memory::TeamMemory;
use crate::order::Order;
use crate::plane::Plane;
use crate::situation::{KEEPER, Situation};
use crate::view::Player;

/// Control steps after which a kick is chosen anew.
const CHOICE_STEPS: i32 = 5;
/// Time after which the keeper makes any kick, s.
const KEEPER_PATIENCE: f32 = 0.6;
/// Way at which it gives the ball up, m.
const MAX_DRIBBLE: f32 = 0.8;
/// Time after which a robot in a crowd kicks high where it faces, s: without a pass that it aims at, and with.
const STUCK: [f32; 2] = [0.7, 1.2];
/// Speed of the ball in such a crowd, m/s.
const STUCK_SPEED: f32 = 0.5;
/// Least x of the heading for such a kick.
const STUCK_HEADING: f32 = -0.3;
/// Gap before the mouth at which a robot still controls the ball, m.
const CONTROL_GAP: f32 = 0.025;
/// Distance to the side at which it does, m.
const CONTROL_ASIDE: f32 = 0.03;
/// Gap between hull and ball at which a robot still has it, m.
const GAP: f32 = 0.03;

/// Follows which robot has the ball, and where it began to have it.
pub(crate) fn follow(s: &Situation, memory: &mut TeamMemory) {
    let ball = s.ball();
    let has = |player: &Player, gap: f32| {
        player.has_ball || player.position.distance(ball) < s.body() + gap
    };
    let still = memory.carrier.and_then(|index| s.view.own.with_index(index));
    if still.is_some_and(|player| has(player, GAP)) {
        memory.carry_steps += 1;
        return;
    }
    memory.carrier = s.view.own.iter().find(|player| has(player, 0.0)).map(|player| player.index);
    memory.carry_start = ball;
    memory.carry_steps = 0;
}

/// Whether a robot has moved the ball so far that it must not go on.
pub(crate) fn is_too_far(s: &Situation, memory: &TeamMemory, robot: &Player) -> bool {
    let way = s.ball().distance(memory.carry_start);
    memory.carrier == Some(robot.index) && way > MAX_DRIBBLE
}

/// Order of a robot that lets the ball roll away.
pub(crate) fn stand(robot: &Player) -> Order {
    Order { straight: true, ball_distance: 0.0, ..Order::to(robot.position, robot.heading) }
}

/// Whether a robot has the ball before its mouth.
pub(crate) fn controls(s: &Situation, robot: &Player) -> bool {
    let own = (s.ball() - robot.position).seen_from(robot.heading);
    let is_near = own.x < s.config.mouth() + CONTROL_GAP && own.y.abs() < CONTROL_ASIDE;
    robot.has_ball || own.x > 0.0 && is_near
}

/// The kick that a robot with the ball at `from` aims at. It is chosen anew every few steps.
pub(crate) fn chosen(
    s: &Situation,
    memory: &mut TeamMemory,
    robot: usize,
    choose: impl Fn() -> Kick,
) -> Kick {
    let is_known = memory.aimer == Some(robot);
    if is_known && s.step % CHOICE_STEPS != 0 {
        return remembered(memory);
    }
    let kick = choose();
    let is_same = is_known && memory.aim_receiver == kick.receiver && memory.aim_chip == kick.chip;
    if is_known && !is_same && kick.value < s.tactics.kick_hysteresis * memory.aim_value {
        memory.aim_value *= 0.9; // it fades, so that it is not kept forever
        return remembered(memory);
    }
    memory.aimer = Some(robot);
    (memory.aim, memory.aim_speed, memory.aim_chip) = (kick.at, kick.speed, kick.chip);
    (memory.aim_receiver, memory.aim_value) = (kick.receiver, kick.value);
    kick
}

/// The kick that a robot has chosen before, whatever has changed since; its choice where there is none.
pub(crate) fn settled(
    s: &Situation,
    memory: &mut TeamMemory,
    robot: usize,
    choose: impl Fn() -> Kick,
) -> Kick {
    if memory.aimer == Some(robot) { remembered(memory) } else { chosen(s, memory, robot, choose) }
}

fn remembered(memory: &TeamMemory) -> Kick {
    Kick {
        at: memory.aim,
        speed: memory.aim_speed,
        chip: memory.aim_chip,
        receiver: memory.aim_receiver,
        value: memory.aim_value,
    }
}

/// Order of a robot that has the ball.
pub(crate) fn play(s: &Situation, memory: &mut TeamMemory, robot: &Player) -> Order {
    let ball = s.ball();
    let waited = memory.carry_steps as f32 * s.config.time_step;
    let is_keeper = robot.index == KEEPER;
    let patience = if is_keeper { KEEPER_PATIENCE } else { s.tactics.patience };
    let best = || aim::best_kick(s, ball, robot.index);
    // The ball moves as the robot turns, and other kicks become better: it could turn to and fro forever.
    let choice = if waited > patience { settled } else { chosen };
    let chosen = choice(s, memory, robot.index, best);
    let kick = aim::with_error(s, chosen, ball, robot.index);
    let is_pressed = s.nearest_opponent(ball) < s.tactics.pressed_distance;
    let hurry = if is_pressed { 0.5 } else { 1.0 };
    let is_good = kick.value >= s.tactics.good_value * hurry * (1.0 - waited / patience);
    let way = ball.distance(memory.carry_start);
    let facing = kick.at - ball;
    let mut order = turn(s, robot, facing);
    // A robot that came fast brakes as hard as it has to: then the ball rolls away from it.
    let left = (MAX_DRIBBLE - way).max(0.05);
    let limit = if is_good { s.tactics.carry_deceleration } else { s.tactics.carry_acceleration };
    order.acceleration = limit.max(robot.velocity.dot(robot.velocity) / (2.0 * left));
    if is_too_far(s, memory, robot) {
        return give_up(robot, order);
    }
    if !is_good && !is_keeper {
        order.target = dribble_target(s, memory, robot);
    } else if !robot.has_ball {
        order.target = caught_up(s, robot);
    }
    if is_good || is_pressed {
        kicking::release(s, memory, robot, &kick, &mut order);
    }
    let longest = STUCK[usize::from(kick.receiver.is_some())];
    let is_stuck = is_pressed && waited > longest && s.path.speed < STUCK_SPEED;
    if is_stuck && robot.heading.x > STUCK_HEADING {
        let ahead = kicking::out_of_crowd(s, robot, kick);
        order.kick = kicking::command(s, &ahead, 0.0);
    }
    order
}

/// Place at which a robot has the ball in the middle of its mouth again.
fn caught_up(s: &Situation, robot: &Player) -> Vector {
    let own = (s.ball() - robot.position).seen_from(robot.heading);
    let ahead = (own.x - s.config.mouth()).max(0.0);
    robot.position + robot.heading * ahead + robot.heading.left() * own.y
}

/// Angular velocity at which the ball stays in the mouth of a robot that drives, rad/s.
pub(crate) fn turning(s: &Situation, robot: &Player) -> f32 {
    // w² r + w v is the acceleration of the ball in the turn.
    let (r, v) = (s.config.mouth(), robot.velocity.length());
    let held = ((v * v + 4.0 * r * s.tactics.carry_side_acceleration).sqrt() - v) / (2.0 * r);
    held.min(s.tactics.carry_turning * s.skill.turning)
}

/// Order of a robot that turns on the spot with the ball.
pub(crate) fn turn(s: &Situation, robot: &Player, facing: Vector) -> Order {
    Order {
        max_speed: s.tactics.carry_speed,
        acceleration: s.tactics.carry_acceleration,
        turning: turning(s, robot),
        turn_acceleration: s.tactics.carry_turn_acceleration,
        dribbler: 1.0,
        ball_distance: 0.0,
        straight: true,
        ..Order::to(robot.position, facing)
    }
}

/// Lets go of a ball that has been dribbled far: a weak kick ahead, or none backward.
fn give_up(robot: &Player, order: Order) -> Order {
    let ahead = if robot.heading.x > -0.3 { 2.0 } else { 0.5 };
    Order { kick: [ahead, 0.0], dribbler: 0.0, ..order }
}

/// Direction to dribble: ahead, and away from opponents.
fn dribble_target(s: &Situation, memory: &TeamMemory, robot: &Player) -> Vector {
    let goal = (s.pitch.their_goal() - robot.position).unit_or(Vector::new(1.0, 0.0));
    let mut direction = goal * 0.5;
    for other in s.view.others.iter() {
        let away = robot.position - other.position;
        let distance = away.length();
        if distance < 1.0 {
            direction = direction + away * ((1.0 - distance) / distance.max(0.1));
        }
    }
    let wanted = robot.position + direction.unit_or(goal) * 0.4;
    let from_start = (wanted - memory.carry_start).limited(s.tactics.dribble_way);
    memory.carry_start + from_start
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tactics::Tactics;
    use crate::testing::{PLAY, Scene};

    /// A robot with the ball in its mouth, which it has taken at a distance.
    fn order(scene: &mut Scene, taken: f32) -> Order {
        scene.ball([0.093, 0.0], [0.0, 0.0]);
        scene.robot(0, [0.0, 0.0]);
        scene.set(0, "infrared", 1.0);
        let mut memory = TeamMemory::new(1);
        memory.carrier = Some(0);
        memory.carry_start = Vector::new(0.093 - taken, 0.0);
        scene.situation(PLAY, |s| {
            follow(s, &mut memory);
            play(s, &mut memory, &s.view.own[0])
        })
    }

    #[test]
    fn a_robot_that_has_dribbled_far_gives_the_ball_up() {
        let mut scene = Scene::new(1, 1);
        scene.robot(1, [0.5, 0.0]);
        assert!(order(&mut scene, 0.3).dribbler > 0.0);
        let far = order(&mut scene, 0.85);
        assert!(far.dribbler < 0.5 && far.kick[0] > 0.0, "{far:?}");
    }

    #[test]
    fn a_ball_beside_the_mouth_is_not_controlled() {
        let mut scene = Scene::new(1, 0);
        scene.robot(0, [0.0, 0.0]);
        for (aside, expected) in [(0.028, true), (0.033, false)] {
            scene.ball([0.093, aside], [0.0, 0.0]);
            assert_eq!(scene.situation(PLAY, |s| controls(s, &s.view.own[0])), expected, "{aside}");
        }
    }

    #[test]
    fn a_robot_catches_up_with_a_ball_before_its_mouth() {
        let mut scene = Scene::new(1, 1);
        scene.robot(0, [0.0, 0.0]);
        scene.robot(1, [0.3, 0.0]);
        for (ball, expected) in [([0.11, 0.0], [0.017, 0.0]), ([0.11, -0.02], [0.017, -0.02])] {
            scene.ball(ball, [0.0, 0.0]);
            let mut memory = TeamMemory::new(1);
            let order = scene.situation(PLAY, |s| {
                follow(s, &mut memory);
                memory.carry_steps = 200; // its patience is over: it makes any kick
                assert!(controls(s, &s.view.own[0]), "{ball:?}");
                play(s, &mut memory, &s.view.own[0])
            });
            let expected = Vector::new(expected[0], expected[1]);
            assert!(order.target.distance(expected) < 1e-3, "{:?} for {ball:?}", order.target);
        }
    }

    #[test]
    fn a_robot_without_patience_keeps_its_choice() {
        let mut scene = Scene::new(2, 1);
        scene.ball([-0.093, 0.0], [0.0, 0.0]);
        scene.robot(0, [-4.0, 0.0]);
        scene.robot(1, [0.0, 0.0]);
        scene.set(1, "cos", -1.0); // it has to turn before it kicks
        scene.set(1, "infrared", 1.0);
        let mut memory = TeamMemory::new(1);
        let mut aim = |scene: &Scene, steps: i32| {
            memory.carry_steps = steps;
            scene.situation(PLAY, |s| play(s, &mut memory, &s.view.own[1]));
            memory.aim
        };
        let first = aim(&scene, 0);
        scene.robot(2, [1.0, 0.3 * first.y]); // an opponent in its way
        assert!(aim(&scene, 200).distance(first) < 1e-6);
        assert!(aim(&scene, 20).distance(first) > 0.05, "{first:?} was chosen anew");
    }

    #[test]
    fn fast_robots_turn_slowly_with_the_ball() {
        let mut scene = Scene::new(1, 0);
        let at = |scene: &Scene| scene.situation(PLAY, |s| turning(s, &s.view.own[0]));
        let resting = at(&scene);
        scene.set(0, "v_x", 2.0);
        let fast = at(&scene);
        assert!(resting > 3.0 && fast < 1.0, "{resting} {fast}");
        let held = fast * fast * 0.093 + fast * 2.0;
        assert!((held - Tactics::DEFAULT.carry_side_acceleration).abs() < 1e-3);
    }

    #[test]
    fn the_way_with_the_ball_counts_from_where_it_was_taken() {
        let mut scene = Scene::new(1, 0);
        let mut memory = TeamMemory::new(1);
        let mut step = |scene: &Scene| {
            scene.situation(PLAY, |s| follow(s, &mut memory));
            (memory.carrier, memory.carry_start.x)
        };
        scene.ball([1.0, 0.0], [0.0, 0.0]);
        scene.robot(0, [0.0, 0.0]);
        assert_eq!(step(&scene).0, None);
        scene.robot(0, [0.9, 0.0]);
        assert_eq!(step(&scene), (Some(0), 1.0));
        scene.ball([1.5, 0.0], [0.0, 0.0]);
        scene.robot(0, [1.38, 0.0]);
        assert_eq!(step(&scene), (Some(0), 1.0), "a small gap does not end it");
        scene.robot(0, [1.3, 0.0]);
        assert_eq!(step(&scene).0, None);
    }
}
