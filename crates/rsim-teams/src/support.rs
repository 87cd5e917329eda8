//! Running free: places at which a pass can be received, and from which something can be made of it.

use rsim_referee::Vector;

use crate::aim::value_at;
use crate::lanes::{Lane, chance, margin};
use crate::memory::RobotMemory;
use crate::pitch::Area;
use crate::random::Random;
use crate::situation::Situation;
use crate::view::Player;

/// Control steps after which a robot looks for a better place.
const SEARCH_STEPS: i32 = 8;
/// New places that are tried.
const TRIALS: u32 = 5;
/// Distance from the opponents' area, m.
const AREA_ROOM: f32 = 0.15;
/// Distance from the lines, m.
const LINE_ROOM: f32 = 0.3;

/// Place where a robot runs free. `spots` has the places of all robots; that of `robot` is brought up to date.
pub(crate) fn spot(
    s: &Situation,
    robot: &Player,
    runners: u32,
    robots: &mut [RobotMemory],
) -> Vector {
    let index = robot.index;
    let is_new = robots[index].job < RUNNER;
    let phase = i32::try_from(index).unwrap_or(0) * 3;
    if !is_new && (s.step + phase) % SEARCH_STEPS != 0 {
        return robots[index].spot;
    }
    let value = |place: Vector| {
        let teammates = robots.iter().enumerate();
        let teammates =
            teammates.filter(|(teammate, _)| *teammate != index && runners >> teammate & 1 == 1);
        let nearest = teammates
            .map(|(_, teammate)| teammate.spot.distance(place))
            .fold(s.tactics.teammate_distance, f32::min);
        value_of(s, robot, place) - 0.5 * (1.0 - nearest / s.tactics.teammate_distance)
    };
    let start = if is_new { robot.position } else { robots[index].spot };
    let mut best = (start, value(legal(s, start)) + 0.02);
    let random = Random::new(s.random.seed(), s.step.unsigned_abs());
    for trial in 0..TRIALS {
        let place = trial_place(s, start, random, index, trial);
        let found = value(place);
        if found > best.1 {
            best = (place, found);
        }
    }
    let found = legal(s, best.0);
    robots[index].spot = found;
    found
}

/// Number of the job of running free.
pub(crate) const RUNNER: i32 = 100;

/// A place near the last one, or anywhere ahead.
fn trial_place(s: &Situation, start: Vector, random: Random, robot: usize, trial: u32) -> Vector {
    let purpose = 16 + 2 * trial;
    let [x, y] = [random.uniform(robot, purpose), random.uniform(robot, purpose + 1)];
    let lines = &s.pitch.lines;
    let place = if trial < 2 {
        start + Vector::new(x, y) * 0.6
    } else {
        let back = (s.ball().x - 1.5).clamp(-2.0, 1.0);
        let middle = 0.5 * (lines.half_length + back);
        Vector::new(middle + x * (lines.half_length - middle), y * lines.half_width)
    };
    legal(s, place)
}

fn legal(s: &Situation, place: Vector) -> Vector {
    let inside = s.pitch.inside(place, LINE_ROOM);
    s.pitch.outside(Area::Theirs, inside, s.config.robot.radius + AREA_ROOM)
}

/// Value of standing at a place.
fn value_of(s: &Situation, robot: &Player, place: Vector) -> f32 {
    let ball = s.ball();
    let distance = place.distance(ball);
    let lane = Lane {
        start: ball,
        end: place,
        speed: s.tactics.lane_pass_share * s.tactics.ball_speed,
        flies: 0.0,
    };
    let arrives = chance(s.tactics, margin(s.tactics, &lane, &s.view.others, s.body()));
    let free = (s.nearest_opponent(place) / s.tactics.free_distance).min(1.0);
    let off = (s.tactics.ball_distance_least - distance)
        .max(distance - s.tactics.ball_distance_most)
        .max(0.0);
    (0.3 + arrives)
        * (0.3 + value_at(s, place, distance / (s.tactics.lane_pass_share * s.tactics.ball_speed)))
        * (0.5 + 0.5 * free)
        - 0.15 * off
        - s.tactics.way_cost * place.distance(robot.position)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::memory::Memory;
    use crate::testing::{PLAY, Scene};

    #[test]
    fn runners_leave_the_shadow_of_an_opponent() {
        let mut scene = Scene::new(2, 1);
        scene.ball([0.0, 0.0], [0.0, 0.0]);
        scene.robot(1, [2.5, 0.0]);
        scene.robot(2, [1.5, 0.0]);
        let mut memory = Memory::new(3);
        let (mut at, mut value) = (Vector::default(), [0.0; 2]);
        for step in 0..400 {
            scene.situation(PLAY, |s| {
                let s = Situation { step, path: s.path.clone(), ..*s };
                let robot = s.view.own.with_index(1).expect("a runner");
                at = spot(&s, robot, 0b10, &mut memory.robots);
                memory.robots[1].job = RUNNER;
                value = [robot.position, at].map(|place| value_of(&s, robot, place));
                assert!(s.pitch.distance_to(Area::Theirs, at) > 0.2, "{at:?}");
                assert!(s.pitch.lines.is_inside(at, -0.2), "{at:?}");
            });
        }
        assert!(value[1] > value[0] + 0.05 && at.y.abs() > 0.3, "{at:?}: {value:?}");
    }
}
