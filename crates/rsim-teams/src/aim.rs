//! Choice of a kick: shot, pass or clearance.

use rsim_referee::Vector;

use crate::anticipation;
use crate::lanes::{Lane, chance, margin};
use crate::pitch::Area;
use crate::plane::Plane;
use crate::rolling::kick_speed;
use crate::situation::Situation;
use crate::view::Player;

/// Places in the goal that are tried, as shares of half its width.
const GOAL_PLACES: [f32; 9] = [0.0, -0.22, 0.22, -0.44, 0.44, -0.63, 0.63, -0.8, 0.8];
/// Places in the goal by which a position is valued.
const FEW_PLACES: [f32; 3] = [0.0, -0.7, 0.7];
/// Shortest and longest pass, m.
const PASS_DISTANCES: [f32; 2] = [0.9, 6.5];
/// Share of a long pass's way that a chip flies.
const FLIGHT_SHARE: f32 = 0.6;
/// Way before its landing on which a chip is low, m.
const LOW: f32 = 0.25;
/// Share of a pass's first speed that it has on its way, along the floor and in the air.
const MEAN_PASS_SPEED: [f32; 2] = [0.7, 0.6];
/// Directions of clearances.
const CLEARANCES: [Vector; 5] = [
    Vector::new(1.0, 0.0),
    Vector::new(0.87, 0.5),
    Vector::new(0.87, -0.5),
    Vector::new(0.5, 0.87),
    Vector::new(0.5, -0.87),
];
/// Way of a clearance, m.
const CLEARANCE: f32 = 3.0;
/// Speed of a clearance, m/s.
const CLEARANCE_SPEED: f32 = 4.5;
/// Way of a ball that its kicker follows, m.
const RUN: f32 = 1.2;
/// Speed of such a kick, m/s.
const RUN_SPEED: f32 = 2.0;
const GRAVITY: f32 = 9.81;

/// A kick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Kick {
    /// Place where the ball goes, m.
    pub(crate) at: Vector,
    /// Speed of the ball, m/s.
    pub(crate) speed: f32,
    /// Whether it flies at 45 degrees.
    pub(crate) chip: bool,
    /// Robot that is to receive it.
    pub(crate) receiver: Option<usize>,
    /// Value: the likelihood of a goal, roughly.
    pub(crate) value: f32,
}

/// The best kick from a place by a robot.
pub(crate) fn best_kick(s: &Situation, from: Vector, kicker: usize) -> Kick {
    let mut best = clearance(s, from);
    let mut consider = |kick: Kick| {
        if kick.value > best.value {
            best = kick;
        }
    };
    consider(shot(s, from));
    consider(run(s, from));
    for teammate in s.field_players().filter(|teammate| teammate.index != kicker) {
        if let Some(pass) = pass(s, from, teammate) {
            consider(pass);
        }
    }
    best
}

/// The best shot at the goal.
pub(crate) fn shot(s: &Situation, from: Vector) -> Kick {
    let (at, chance) = best_goal_place(s, from, &GOAL_PLACES, &s.view.others);
    let value = if from.x < 0.0 { s.tactics.long_shot_share * chance } else { chance };
    Kick { at, speed: s.tactics.ball_speed, chip: false, receiver: None, value }
}

/// The place in the goal that is most likely hit, and the likelihood.
fn best_goal_place(
    s: &Situation,
    from: Vector,
    places: &[f32],
    opponents: &[Player],
) -> (Vector, f32) {
    let goal = s.pitch.their_goal();
    let half = s.pitch.lines.half_goal_width - s.config.ball.radius;
    let mut best = (goal, -1.0);
    for share in places {
        let end = Vector::new(goal.x, share * half);
        let lane = Lane { start: from, end, speed: s.tactics.ball_speed, flies: 0.0 };
        let found = margin(s.tactics, &lane, opponents, s.body());
        if found > best.1 {
            best = (end, found);
        }
    }
    // From the side the mouth of the goal is narrow.
    let way = goal - from;
    let frontal = (way.x / way.length().max(0.1)).clamp(0.0, 1.0);
    (best.0, chance(s.tactics, best.1) * frontal)
}

/// Value of receiving the ball at a place, `time` (s) after a kick to it: the opponents use that time.
pub(crate) fn value_at(s: &Situation, place: Vector, time: f32) -> f32 {
    let opponents = anticipation::opponents(s, place, time);
    let (_, goal) = best_goal_place(s, place, &FEW_PLACES, &opponents);
    let half_length = s.pitch.lines.half_length;
    let progress = (place.x + half_length) / (2.0 * half_length);
    s.tactics.goal_value * goal + s.tactics.progress_value * progress
}

/// The better of the flat and the high pass to a teammate; none if it is unlikely to arrive.
fn pass(s: &Situation, from: Vector, teammate: &Player) -> Option<Kick> {
    let wanted =
        s.pitch.inside(teammate.position + teammate.velocity * s.tactics.receiver_lead, 0.15);
    let at = s.pitch.outside(Area::Theirs, wanted, s.config.robot.radius);
    let distance = from.distance(at);
    if !(PASS_DISTANCES[0]..PASS_DISTANCES[1]).contains(&distance)
        || s.pitch.distance_to(Area::Own, at) < 0.1
    {
        return None;
    }
    let speed =
        kick_speed(distance, s.tactics.arrival_speed, &s.config.ball).min(s.tactics.ball_speed);
    let flat = Lane { start: from, end: at, speed, flies: 0.0 };
    let passes = chance(s.tactics, margin(s.tactics, &flat, &s.view.others, s.body()));
    let flight = FLIGHT_SHARE * distance;
    let chip_speed = (GRAVITY * flight).sqrt();
    let high = Lane { speed: chip_speed, flies: flight - LOW, ..flat };
    let flies = if passes > s.tactics.chip_reception
        || flight < 2.0 * LOW
        || chip_speed > s.tactics.ball_speed
    {
        0.0
    } else {
        s.tactics.chip_reception
            * chance(s.tactics, margin(s.tactics, &high, &s.view.others, s.body()))
    };
    let arrives = passes.max(flies);
    if arrives < s.skill.pass_threshold_with(s.tactics) {
        return None;
    }
    let chip = flies > passes;
    let speed = if chip { chip_speed } else { speed };
    let time = distance / (speed * MEAN_PASS_SPEED[usize::from(chip)]);
    let value = arrives * value_at(s, at, time);
    Some(Kick { at, speed, chip, receiver: Some(teammate.index), value })
}

/// A weak kick ahead that the robot follows, where it has much space: it may not dribble far.
fn run(s: &Situation, from: Vector) -> Kick {
    let goal = (s.pitch.their_goal() - from).unit_or(Vector::new(1.0, 0.0));
    let at = from + goal * RUN;
    let is_free = s.nearest_opponent(from) > s.tactics.run_space
        && s.nearest_opponent(at) > s.tactics.run_space;
    let value = if is_free && s.pitch.distance_to(Area::Theirs, at) > 0.3 {
        s.tactics.run_value
    } else {
        0.0
    };
    Kick { at, speed: RUN_SPEED, chip: false, receiver: None, value }
}

/// The best high kick out of danger.
fn clearance(s: &Situation, from: Vector) -> Kick {
    let mut best =
        Kick { at: from + CLEARANCES[0], speed: 2.0, chip: false, receiver: None, value: 0.0 };
    for direction in CLEARANCES {
        let end = from + direction * CLEARANCE;
        if !s.pitch.lines.is_inside(end, -0.2) {
            continue;
        }
        let flies = CLEARANCE_SPEED * CLEARANCE_SPEED / GRAVITY - LOW;
        let lane = Lane { start: from, end, speed: CLEARANCE_SPEED, flies };
        let clear = chance(s.tactics, margin(s.tactics, &lane, &s.view.others, s.body()));
        let value = s.tactics.clearance_value * clear;
        if value > best.value {
            best = Kick { at: end, speed: CLEARANCE_SPEED, chip: true, receiver: None, value };
        }
    }
    best
}

/// The kick as the robot makes it: its direction is off by the error of the team's skill.
pub(crate) fn with_error(s: &Situation, kick: Kick, from: Vector, robot: usize) -> Kick {
    let error = s.skill.aim_error * s.random.normal(robot, 1);
    let way = kick.at - from;
    let turned = Vector::new(1.0, error).unit_or(Vector::new(1.0, 0.0));
    Kick { at: from + turned.turned_by(way), ..kick }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{PLAY, Scene};

    #[test]
    fn shots_go_beside_the_keeper() {
        let mut scene = Scene::new(1, 1);
        scene.ball([2.5, 0.0], [0.0, 0.0]);
        scene.robot(1, [4.4, 0.3]);
        scene.situation(PLAY, |s| {
            let kick = shot(s, s.ball());
            assert!(kick.at.y < -0.1 && kick.at.y > -0.5 && kick.value > 0.5, "{kick:?}");
            assert!(kick.speed <= s.tactics.ball_speed && !kick.chip);
            let far = shot(s, Vector::new(-2.0, 0.0));
            assert!(far.value < 0.3, "{far:?}");
        });
    }

    #[test]
    fn a_free_teammate_before_the_goal_is_better_than_a_blocked_shot() {
        let mut scene = Scene::new(2, 2);
        scene.ball([2.0, -2.0], [0.0, 0.0]);
        scene.robot(0, [-4.0, 0.0]);
        scene.robot(1, [3.0, 1.5]);
        scene.robot(2, [2.3, -1.75]);
        scene.robot(3, [4.3, -0.4]);
        scene.situation(PLAY, |s| {
            let kick = best_kick(s, s.ball(), 5);
            assert_eq!(kick.receiver, Some(1), "{kick:?}");
        });
    }

    #[test]
    fn passes_fly_over_an_opponent_in_the_way() {
        let mut scene = Scene::new(2, 1);
        scene.ball([-1.0, 0.0], [0.0, 0.0]);
        scene.robot(1, [2.0, 0.0]);
        scene.robot(2, [-0.2, 0.0]);
        scene.situation(PLAY, |s| {
            let teammate = s.view.own.with_index(1).expect("a teammate");
            let over = pass(s, s.ball(), teammate).expect("it flies");
            assert!(over.chip && over.speed <= s.tactics.ball_speed, "{over:?}");
        });
        scene.robot(2, [-0.2, 1.5]);
        scene.situation(PLAY, |s| {
            let teammate = s.view.own.with_index(1).expect("a teammate");
            assert!(!pass(s, s.ball(), teammate).expect("it rolls").chip);
        });
    }

    #[test]
    fn less_skill_kicks_less_accurately() {
        let error = |skill: f32| {
            let mut scene = Scene::new(1, 0);
            scene.config.skill = skill;
            scene.situation(PLAY, |s| {
                let kick = shot(s, s.ball());
                (with_error(s, kick, s.ball(), 0).at - kick.at).length()
            })
        };
        assert!(error(1.0) > 0.0 && error(0.0) > 10.0 * error(1.0));
    }
}
