//! The team's penalty kick: the kicker drives the ball ahead of it, and shoots from near into a corner.

use rsim_referee::Vector;

use crate::aim::{self, Kick};
use crate::approach;
use crate::kicking;
use crate::lanes::{Lane, chance, margin};
use crate::memory::TeamMemory;
use crate::order::Order;
use crate::plane::Plane;
use crate::possession;
use crate::restart;
use crate::rolling;
use crate::situation::Situation;
use crate::view::Player;

/// Distance from the goal line at which the kicker takes the ball to shoot, m.
const SHOOTING_DISTANCE: f32 = 2.9;
/// Shortest way of the ball ahead of the kicker, m.
const MIN_WAY: f32 = 0.8;
/// Speed of the ball after that way, m/s.
const ARRIVAL_SPEED: f32 = 0.8;
/// Speed of a ball that is followed, m/s.
const ROLLING: f32 = 0.5;
/// Distance behind it, m.
const FOLLOWING_DISTANCE: f32 = 0.35;
/// Likelihood of a goal from which it shoots at once.
const GOOD_SHOT: f32 = 0.5;
/// Time after which it shoots from anywhere, s; it has 10.
const PATIENCE: f32 = 7.0;
/// Place of a corner, as a share of half the width of the goal: at best, and for a kicker that aims badly.
const CORNER: [f32; 2] = [0.92, 0.7];
/// Standard deviations of the kick's direction that a corner leaves to the post.
const CORNER_ROOM: f32 = 2.0;
/// Margin by which the other corner has to be better until the kicker turns to it, m.
const LOYALTY: f32 = 0.1;
/// Margin up to which two corners are alike, m.
const TIE: f32 = 0.01;
/// Sine of the error of direction within which it shoots.
const SHOT_SINE: f32 = 0.01;
/// Purpose of the random number that chooses between corners.
const CORNER_DRAW: u32 = 2;

/// Order of the kicker.
pub(crate) fn kick(s: &Situation, memory: &mut TeamMemory, robot: &Player) -> Order {
    let ball = s.ball();
    if !s.in_play {
        memory.corner_kicker = None;
        return restart::take(s, memory, robot, &ahead(s));
    }
    let goal = (s.pitch.their_goal() - ball).unit_or(Vector::new(1.0, 0.0));
    let is_near = s.pitch.their_goal().x - ball.x < SHOOTING_DISTANCE;
    if !is_near && s.view.ball.velocity.x > ROLLING {
        // It drives behind the ball and leaves it alone: dribbling ends after 1 m.
        let order = Order::to(ball - goal * FOLLOWING_DISTANCE, goal);
        return Order { moving: s.view.ball.velocity, ..order };
    }
    if !possession::controls(s, robot) {
        return approach::take(s, robot, s.own.of(robot.index).unwrap_or_default(), goal);
    }
    let shot = corner(s, memory, robot);
    let shoots = is_near || shot.value > GOOD_SHOT || s.command_time > PATIENCE;
    let chosen = if shoots { shot } else { ahead(s) };
    let kick = aim::with_error(s, chosen, ball, robot.index);
    let mut order = possession::turn(s, robot, kick.at - ball);
    kicking::release_within(s, memory, robot, &kick, SHOT_SINE, &mut order);
    order
}

/// The kick that the kicker follows.
fn ahead(s: &Situation) -> Kick {
    let way = s.pitch.their_goal() - s.ball();
    let length = (way.length() - SHOOTING_DISTANCE).max(MIN_WAY);
    let at = s.ball() + way.unit_or(Vector::new(1.0, 0.0)) * length;
    let speed = rolling::kick_speed(length, ARRIVAL_SPEED, &s.config.ball);
    Kick { at, speed, chip: false, receiver: None, value: 0.0 }
}

/// The shot into the corner that the keeper reaches last. The kicker keeps to a corner, since it turns while the
/// keeper moves.
fn corner(s: &Situation, memory: &mut TeamMemory, robot: &Player) -> Kick {
    let ball = s.ball();
    let goal = s.pitch.their_goal();
    let half = s.pitch.lines.half_goal_width - s.config.ball.radius;
    let error = CORNER_ROOM * s.skill.aim_error * (goal.x - ball.x) / half;
    let share = (1.0 - error).clamp(CORNER[1], CORNER[0]);
    let places = [share * half, -share * half].map(|y| Vector::new(goal.x, y));
    let margins = places.map(|end| {
        let lane = Lane { start: ball, end, speed: s.tactics.ball_speed, flies: 0.0 };
        margin(s.tactics, &lane, &s.view.others, s.body())
    });
    let is_known = memory.corner_kicker == Some(robot.index);
    // A keeper in the middle leaves both corners alike: then the seed decides.
    let (side, lead) = if is_known {
        (memory.corner, LOYALTY)
    } else {
        (s.random.uniform(robot.index, CORNER_DRAW), TIE)
    };
    let lead = lead.copysign(side);
    let nth = usize::from(margins[0] + lead < margins[1]);
    (memory.corner_kicker, memory.corner) = (Some(robot.index), places[nth].y);
    Kick {
        at: places[nth],
        speed: s.tactics.ball_speed,
        chip: false,
        receiver: None,
        value: chance(s.tactics, margins[nth]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::phase::{Mode, Phase, Restart};
    use crate::testing::Scene;

    const PENALTY: Phase =
        Phase { mode: Mode::Kick, restart: Restart::Penalty, ours: true, kicks_next: false };

    /// A kicker with the ball in its mouth, and a keeper.
    fn scene(x: f32, keeper: [f32; 2]) -> Scene {
        let mut scene = Scene::new(1, 1);
        scene.ball([x, 0.0], [0.0, 0.0]);
        scene.robot(0, [x - 0.093, 0.0]);
        scene.set(0, "infrared", 1.0);
        scene.robot(1, keeper);
        scene
    }

    fn order(scene: &Scene, memory: &mut TeamMemory, in_play: bool) -> Order {
        scene.situation(PENALTY, |s| {
            let s = Situation { in_play, command_time: 3.0, path: s.path.clone(), ..*s };
            kick(&s, memory, &s.view.own[0])
        })
    }

    #[test]
    fn the_first_kick_is_one_that_the_kicker_follows() {
        let first = order(&scene(-1.5, [4.4, 0.0]), &mut TeamMemory::new(1), false);
        assert!((1.0..4.0).contains(&first.kick[0]), "{first:?}");
    }

    #[test]
    fn the_shot_goes_into_the_corner_away_from_the_keeper() {
        for aside in [-0.2, 0.2] {
            let mut memory = TeamMemory::new(1);
            let mut scene = scene(2.4, [4.0, aside]);
            let turning = order(&scene, &mut memory, true);
            assert!(turning.kick[0] <= 0.0, "it faces the keeper: {turning:?}");
            let ahead = turning.facing.unit_or(Vector::default());
            let y = 2.1 * ahead.y / ahead.x;
            assert!(y * aside < 0.0 && (0.35..0.48).contains(&y.abs()), "{aside}: {y}");
            scene.robot(0, [2.4 - 0.093 * ahead.x, -0.093 * ahead.y]);
            scene.set(0, "infrared", 1.0);
            scene.set(0, "cos", ahead.x);
            scene.set(0, "sin", ahead.y);
            let shot = order(&scene, &mut memory, true);
            assert!(shot.kick[0] > 5.0, "{shot:?}");
        }
    }

    /// The side to which the kicker turns: -1.0 away from a keeper that stands a little to the left.
    fn side(memory: &mut TeamMemory, keeper: f32) -> f32 {
        order(&scene(2.4, [4.0, keeper]), memory, true).facing.y.signum()
    }

    #[test]
    fn corners_and_kicks_in_play_are_remembered_apart() {
        let mut memory = TeamMemory::new(1);
        memory.aimer = Some(0);
        memory.aim = Vector::new(4.5, 1.0);
        (memory.aim_speed, memory.aim_receiver, memory.aim_value) = (2.0, Some(1), 0.4);
        let in_play = |memory: &TeamMemory| {
            let TeamMemory { aimer, aim, aim_speed, aim_receiver, aim_value, .. } = *memory;
            (aimer, aim, aim_speed, aim_receiver, aim_value)
        };
        let before = in_play(&memory);
        assert!(side(&mut memory, 0.02) < 0.0, "the kick in play was to the left");
        assert_eq!(in_play(&memory), before);
    }

    #[test]
    fn a_new_penalty_begins_without_a_corner() {
        let mut memory = TeamMemory::new(1);
        assert!(side(&mut memory, -0.02) > 0.0);
        assert!(side(&mut memory, 0.02) > 0.0, "it keeps to it");
        let mut begins = scene(-1.5, [4.4, 0.0]);
        begins.robot(0, [-2.0, 0.4]);
        begins.set(0, "infrared", 0.0);
        let waiting = order(&begins, &mut memory, false);
        assert!(waiting.kick[0] <= 0.0, "a kick would end the choice as well: {waiting:?}");
        assert!(side(&mut memory, 0.02) < 0.0);
    }

    #[test]
    fn a_kicker_keeps_to_its_corner_while_the_keeper_moves_a_little() {
        let mut memory = TeamMemory::new(1);
        let mut side = |y: f32| order(&scene(2.4, [4.0, y]), &mut memory, true).facing.y;
        assert!(side(0.2) < 0.0);
        assert!(side(-0.01) < 0.0, "it turns there already");
        assert!(side(-0.2) > 0.0, "this corner is free now");
    }
}
