//! A robot that has the ball: dribbling, turning, kicking.

use rsim_referee::Vector;

use crate::aim::{self, Kick, MAX_BALL_SPEED};
use crate::memory::TeamMemory;
use crate::order::Order;
use crate::plane::Plane;
use crate::situation::{KEEPER, Situation};
use crate::view::Player;

/// Control steps after which a kick is chosen anew.
const CHOICE_STEPS: i32 = 5;
/// Value by which a new kick has to be better than the one chosen, as a factor.
const HYSTERESIS: f32 = 1.2;
/// Value of a kick that is made at once.
const GOOD_VALUE: f32 = 0.3;
/// Time after which any kick is made, and the same by the keeper, s.
const PATIENCE: [f32; 2] = [1.8, 0.6];
/// Distance of an opponent from the ball that hurries, m.
const PRESSED: f32 = 0.35;
/// Way that a robot dribbles, m; the rules allow 1.
const DRIBBLE: f32 = 0.6;
/// Way at which it gives the ball up, m.
const MAX_DRIBBLE: f32 = 0.8;
/// Acceleration with the ball, m/s²: the dribbler holds it up to 2.6, and along its back-spin up to 5.6.
const ACCELERATION: f32 = 2.5;
/// Deceleration with the ball, m/s².
const DECELERATION: f32 = 3.2;
/// Acceleration of the ball to the side, in a turn, m/s².
const SIDE_ACCELERATION: f32 = 1.8;
/// Angular acceleration with the ball, rad/s²: 1.4 m/s² at the ball.
const TURN_ACCELERATION: f32 = 15.0;
/// Speed with the ball, m/s.
const SPEED: f32 = 1.0;
/// Angular velocity with the ball, rad/s: TIGERs turn at 5.
const TURNING: f32 = 5.0;
/// Sine of the error of direction for a kick along the floor, and for a chip.
const MAX_SINE: [f32; 2] = [0.025, 0.08];
/// Angular velocity for a kick, rad/s.
const MAX_KICK_TURNING: f32 = 1.5;
/// Time after which a robot in a crowd kicks high where it faces, s.
const STUCK: f32 = 0.7;
/// Speed of the ball in such a crowd, m/s.
const STUCK_SPEED: f32 = 0.5;
/// Least x of the heading for such a kick.
const STUCK_HEADING: f32 = -0.3;
/// Way that such a kick needs within the field, m.
const STUCK_WAY: f32 = 2.0;
/// Speed of such a kick, m/s.
const STUCK_KICK: f32 = 3.5;
/// Gap before the mouth at which a robot still controls the ball, m.
const CONTROL_GAP: f32 = 0.025;
/// Distance to the side at which it does, m.
const CONTROL_ASIDE: f32 = 0.035;
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
    if is_known && !is_same && kick.value < HYSTERESIS * memory.aim_value {
        memory.aim_value *= 0.9; // it fades, so that it is not kept forever
        return remembered(memory);
    }
    memory.aimer = Some(robot);
    (memory.aim, memory.aim_speed, memory.aim_chip) = (kick.at, kick.speed, kick.chip);
    (memory.aim_receiver, memory.aim_value) = (kick.receiver, kick.value);
    kick
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
    let chosen = chosen(s, memory, robot.index, || aim::best_kick(s, ball, robot.index));
    let kick = aim::with_error(s, chosen, ball, robot.index);
    let waited = memory.carry_steps as f32 * s.config.time_step;
    let is_pressed = s.nearest_opponent(ball) < PRESSED;
    let hurry = if is_pressed { 0.5 } else { 1.0 };
    let is_keeper = robot.index == KEEPER;
    let patience = PATIENCE[usize::from(is_keeper)];
    let is_good = kick.value >= GOOD_VALUE * hurry * (1.0 - waited / patience);
    let way = ball.distance(memory.carry_start);
    let facing = kick.at - ball;
    let mut order = Order {
        max_speed: SPEED,
        acceleration: ACCELERATION,
        turning: turning(s, robot),
        turn_acceleration: TURN_ACCELERATION,
        dribbler: 1.0,
        ball_distance: 0.0,
        straight: true,
        ..Order::to(robot.position, facing)
    };
    // A robot that came fast brakes as hard as it has to: then the ball rolls away from it.
    let left = (MAX_DRIBBLE - way).max(0.05);
    let limit = if is_good { DECELERATION } else { ACCELERATION };
    order.acceleration = limit.max(robot.velocity.dot(robot.velocity) / (2.0 * left));
    if is_too_far(s, memory, robot) {
        return give_up(robot, order);
    }
    if !is_good && !is_keeper {
        order.target = dribble_target(s, memory, robot);
    }
    if is_good || is_pressed {
        release(s, memory, robot, &kick, &mut order);
    }
    let is_stuck = is_pressed && waited > STUCK && s.path.speed < STUCK_SPEED;
    if is_stuck && robot.heading.x > STUCK_HEADING {
        let ahead = stuck_kick(s, robot, kick);
        order.kick = kick_command(s, &ahead, 0.0);
    }
    order
}

/// A kick in the direction that a robot in a crowd faces: a shot, or over the others.
fn stuck_kick(s: &Situation, robot: &Player, kick: Kick) -> Kick {
    let (ball, goal) = (s.ball(), s.pitch.their_goal());
    let share = (goal.x - ball.x) / robot.heading.x;
    let y = ball.y + robot.heading.y * share;
    let is_shot = robot.heading.x > 0.0 && y.abs() < s.pitch.lines.half_goal_width;
    let at = ball + robot.heading * STUCK_WAY;
    if is_shot {
        return Kick { at: goal, speed: MAX_BALL_SPEED, chip: false, ..kick };
    }
    Kick { at, speed: STUCK_KICK, chip: s.pitch.lines.is_inside(at, 0.0), ..kick }
}

/// Angular velocity at which the ball stays in the mouth of a robot that drives, rad/s.
pub(crate) fn turning(s: &Situation, robot: &Player) -> f32 {
    // w² r + w v is the acceleration of the ball in the turn.
    let (r, v) = (s.config.mouth(), robot.velocity.length());
    let held = ((v * v + 4.0 * r * SIDE_ACCELERATION).sqrt() - v) / (2.0 * r);
    held.min(TURNING * s.skill.turning)
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
    let from_start = (wanted - memory.carry_start).limited(DRIBBLE);
    memory.carry_start + from_start
}

/// Kicks if the ball would go where the kick is to go.
pub(crate) fn release(
    s: &Situation,
    memory: &mut TeamMemory,
    robot: &Player,
    kick: &Kick,
    order: &mut Order,
) {
    let Some(command) = aligned_kick(s, robot, kick) else { return };
    order.kick = command;
    if robot.has_ball {
        memory.receiver = kick.receiver;
        memory.pass_steps = 100;
        memory.aimer = None;
    }
}

/// Command of a kick, if the ball would leave in the direction of the kick.
pub(crate) fn aligned_kick(s: &Situation, robot: &Player, kick: &Kick) -> Option<[f32; 2]> {
    let ball = s.ball();
    let direction = (kick.at - ball).unit_or(robot.heading);
    let arm = ball - robot.position;
    let mouth_velocity = robot.velocity + arm.left() * robot.angular_velocity;
    let ahead = mouth_velocity.dot(robot.heading);
    let command = kick_command(s, kick, ahead);
    let result = mouth_velocity + robot.heading * command[0];
    let result = result.unit_or(robot.heading);
    let is_aligned = result.dot(direction) > 0.0
        && result.cross(direction).abs() < MAX_SINE[usize::from(kick.chip)]
        && robot.angular_velocity.abs() < MAX_KICK_TURNING;
    is_aligned.then_some(command)
}

/// Speeds along the heading and upward that give the ball the speed of a kick, from a robot that moves ahead
/// at `ahead` m/s.
pub(crate) fn kick_command(s: &Situation, kick: &Kick, ahead: f32) -> [f32; 2] {
    const DIAGONAL: f32 = std::f32::consts::FRAC_1_SQRT_2;
    let robot = &s.config.robot;
    if kick.chip {
        let speed = kick.speed.min(robot.max_chip_speed).min(MAX_BALL_SPEED) * DIAGONAL;
        [(speed - ahead).clamp(0.3, speed), speed]
    } else {
        let speed = kick.speed.min(robot.max_kick_speed).min(MAX_BALL_SPEED);
        [(speed - ahead).clamp(0.3, MAX_BALL_SPEED), 0.0]
    }
}
