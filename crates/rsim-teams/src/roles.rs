//! Choice of who goes to the ball, and what the others do.

use crate::config::MAX_ROBOTS;
use crate::defense;
use crate::jobs::{Job, Jobs};
use crate::memory::{Memory, TeamMemory};
use crate::phase::{Mode, Restart};
use crate::situation::Situation;
use crate::support::RUNNER;

/// Speed below which a ball is no pass, m/s.
const PASS_SPEED: f32 = 0.4;

/// The robot that goes to the ball; none if no robot is there that may.
pub(crate) fn taker(s: &Situation, memory: &TeamMemory) -> Option<usize> {
    if let Some(carrier) = memory.carrier.filter(|index| Some(*index) != s.barred) {
        if !s.keeps(carrier) && s.phase.mode == Mode::Play {
            return Some(carrier);
        }
    }
    if is_penalty(s) && s.in_play && memory.taker.is_some() {
        return memory.taker; // the kicker goes on alone
    }
    // Before a kick only places count, and the ball lies where it has to be.
    let is_restart = s.phase.mode != Mode::Play;
    let time = |index: usize| {
        let robot = s.view.own.with_index(index)?;
        let time = if is_restart {
            robot.position.distance(if s.phase.mode == Mode::Place { s.ball() } else { s.place })
        } else {
            s.own.of(index)?.time
        };
        let bonus = if memory.receiver == Some(index) {
            s.tactics.receiver_loyalty
        } else if memory.taker == Some(index) {
            s.tactics.taker_loyalty
        } else {
            0.0
        };
        Some(time - bonus)
    };
    (0..MAX_ROBOTS)
        .filter(|index| !s.keeps(*index) && Some(*index) != s.barred)
        .filter_map(|index| Some((index, time(index)?)))
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(index, _)| index)
}

/// Brings up to date whether the team attacks, and whether a pass is on its way.
pub(crate) fn follow(s: &Situation, memory: &mut TeamMemory) {
    memory.pass_steps = (memory.pass_steps - 1).max(0);
    let is_over = memory.pass_steps == 0
        || memory.pass_steps < 90 && s.path.speed < PASS_SPEED
        || s.phase.mode != Mode::Play && s.phase.mode != Mode::Kick
        || memory.carrier.is_some() && memory.carrier == memory.receiver;
    if is_over {
        memory.receiver = None;
    }
    let time = |meeting: Option<(usize, crate::intercept::Meeting)>| {
        meeting.map_or(f32::INFINITY, |(_, meeting)| meeting.time)
    };
    let own = time(s.own.first(|index| Some(index) != s.barred));
    let others = time(s.rival());
    let lead = if memory.attacks { s.tactics.attitude_time } else { -s.tactics.attitude_time };
    memory.attacks = match s.phase.mode {
        Mode::Play => memory.carrier.is_some() || memory.receiver.is_some() || own < others + lead,
        _ => s.phase.ours,
    };
}

/// Jobs of the robots of `free`, one bit each.
pub(crate) fn jobs(s: &Situation, memory: &Memory, free: u32) -> [Option<Job>; MAX_ROBOTS] {
    let count = free.count_ones() as usize;
    let mut jobs = Jobs::default();
    let is_far = s.ball().x > 0.5;
    let wall = match count {
        0 => 0,
        1 | 2 => 1,
        3 if memory.team.attacks => 1,
        _ if memory.team.attacks && is_far && count < 6 => 1,
        _ => 2,
    };
    if wall > 0 && !(count == 1 && memory.team.attacks && is_far) {
        defense::add_wall(s, wall, &mut jobs);
    }
    if !memory.team.attacks {
        let marks = count.saturating_sub(jobs.len() + usize::from(count > 3 && is_far));
        defense::add_marks(s, marks, &mut jobs);
    } else if count > 6 {
        defense::add_marks(s, (count - 5) / 2, &mut jobs);
    }
    while jobs.len() < count {
        jobs.add(Job { number: RUNNER, place: None });
    }
    jobs.assign(&s.view.own, free, |index| memory.robots[index].job)
}

/// Whether a penalty kick is prepared or taken.
pub(crate) fn is_penalty(s: &Situation) -> bool {
    s.phase.restart == Restart::Penalty && s.phase.mode != Mode::Play
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::situation::KEEPER;
    use crate::testing::{PLAY, Scene};

    fn scene() -> Scene {
        let mut scene = Scene::new(4, 4);
        scene.ball([0.0, 0.0], [0.0, 0.0]);
        scene.robot(0, [-0.3, 0.0]);
        scene.robot(1, [-0.5, 0.0]);
        scene.robot(2, [-0.5, 0.3]);
        scene
    }

    #[test]
    fn the_first_robot_that_may_goes_to_the_ball_and_never_the_keeper() {
        let mut memory = TeamMemory::new(1);
        scene().situation(PLAY, |s| {
            assert_eq!(taker(s, &memory), Some(1));
            memory.taker = Some(2);
            assert_eq!(taker(s, &memory), Some(2), "it is hardly later");
            memory.receiver = Some(3);
            memory.taker = None;
            let barred = Situation { barred: Some(1), path: s.path.clone(), ..*s };
            assert_eq!(taker(&barred, &memory), Some(2));
        });
    }

    #[test]
    fn a_robot_without_teammates_plays_the_ball_itself() {
        let mut scene = Scene::new(2, 0);
        scene.take_out(1);
        scene.situation(PLAY, |s| {
            assert_eq!(taker(s, &TeamMemory::new(1)), Some(KEEPER));
        });
    }

    #[test]
    fn a_team_without_the_ball_defends() {
        let mut memory = Memory::new(1);
        let mut scene = scene();
        let marks = |scene: &Scene, memory: &mut Memory| {
            scene.situation(PLAY, |s| {
                follow(s, &mut memory.team);
                let all = jobs(s, memory, 0b1110);
                all.iter().flatten().filter(|job| (10..RUNNER).contains(&job.number)).count()
            })
        };
        assert_eq!(marks(&scene, &mut memory), 0);
        assert!(memory.team.attacks);
        scene.ball([-1.9, -1.25], [0.0, 0.0]);
        scene.robot(4, [-1.8, -1.25]);
        scene.robot(3, [3.0, 0.0]);
        for robot in 1..4 {
            scene.robot(robot, [2.0 + robot as f32 * 0.3, 2.0]);
        }
        scene.robot(0, [-4.0, 0.0]);
        assert_eq!(marks(&scene, &mut memory), 1);
        assert!(!memory.team.attacks);
    }
}
