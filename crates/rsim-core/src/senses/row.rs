//! Rows of what robots know, in the columns of state rows.

use crate::blocks::{BALL, LANES, Lanes, lanes_of_robots, mask_of_bits, robot, set_bits};
use crate::columns::{ABSENT_COLUMN, BALL_COLUMNS, ROBOT_COLUMNS};
use crate::geometry::motion::Motion;
use crate::geometry::motion_block::MotionBlock;
use crate::math::Vector;
use crate::senses::driven::DrivenRobots;
use crate::senses::reports::Reported;
use crate::senses::tracker::Tracker;
use crate::state::State;

/// Number of a robot's columns for its motion, which come first; the break beam follows.
const MOTION_COLUMNS: usize = 7;

/// Writes what is known. Nobody senses touches, collisions and lines crossed: these columns are as of a match
/// that has just begun. Which robots are absent is known.
pub(super) fn write(tracker: &Tracker, reported: Reported<'_>, state: &State, out: &mut [f32]) {
    let place = |index| {
        let Motion { position, heading, .. } = state.bodies.motion(robot(index));
        (index, position, heading)
    };
    write_known(tracker, reported, set_bits(state.absent).map(place), out);
}

/// The same with index, position and heading of each robot that is `absent`.
pub(super) fn write_known(
    tracker: &Tracker,
    reported: Reported<'_>,
    absent: impl Iterator<Item = (usize, Vector, Vector)>,
    out: &mut [f32],
) {
    let (ball, robots) = out.split_at_mut(BALL_COLUMNS.len());
    write_ball(tracker, ball);
    let mut rows = robots.chunks_exact_mut(ROBOT_COLUMNS.len());
    for (block, &motion) in tracker.motions().enumerate() {
        let MotionBlock { position, heading, mut velocity, mut angular_velocity } = motion;
        if let Some(own) = reported.motions.get(block) {
            velocity = own.velocity.rotated_by(heading);
            angular_velocity = own.angular_velocity;
        }
        let cut = Lanes::ONE & mask_of_bits(lanes_of_robots(reported.cut, block).into());
        let poses = Lanes::transpose([position.x, position.y, heading.x, heading.y]);
        let motions = Lanes::transpose([velocity.x, velocity.y, angular_velocity, cut]);
        let ball = usize::from(block == 0);
        for lane in ball..LANES {
            let Some(columns) = rows.next() else { break };
            columns.fill(0.0);
            columns[..LANES].copy_from_slice(poses[lane].as_array());
            columns[LANES..2 * LANES].copy_from_slice(motions[lane].as_array());
        }
    }
    for (index, position, heading) in absent {
        let columns = &mut robots[index * ROBOT_COLUMNS.len()..][..ROBOT_COLUMNS.len()];
        columns.fill(0.0);
        columns[..4].copy_from_slice(&[position.x, position.y, heading.x, heading.y]);
        columns[ABSENT_COLUMN] = 1.0;
    }
}

fn write_ball(tracker: &Tracker, columns: &mut [f32]) {
    let Motion { position, velocity, .. } = tracker.motion(BALL);
    let ([z, v_z], spin) = tracker.ball();
    let no_touch = -1.0;
    columns.fill(0.0);
    let motion = [position.x, position.y, z, velocity.x, velocity.y, v_z, spin.x, spin.y, spin.z];
    columns[..motion.len()].copy_from_slice(&motion);
    columns[motion.len()] = no_touch;
}

/// Writes a motion into the columns of a robot.
fn write_motion(motion: &Motion, columns: &mut [f32]) {
    let Motion { position, heading, velocity, angular_velocity } = *motion;
    columns[..MOTION_COLUMNS].copy_from_slice(&[
        position.x,
        position.y,
        heading.x,
        heading.y,
        velocity.x,
        velocity.y,
        angular_velocity,
    ]);
}

/// Writes what forecasts begin with into a row of what cameras tell: of the robots that are `present`, one bit each,
/// those whose commands are `known` and a ball that one of them holds as drives carry them, and others that stand.
pub(super) fn write_driven(driven: &DrivenRobots, known: u64, present: u64, out: &mut [f32]) {
    let (known, others) = (known & present, !known & present);
    let (ball, rows) = out.split_at_mut(BALL_COLUMNS.len());
    let resting = driven.resting();
    let stands = set_bits(others).filter_map(|index| Some((index, resting.robot(index)?)));
    let stands = stands.map(|(index, place)| (index, place.at_rest()));
    let moves = set_bits(known).map(|index| (index, driven.motion(index)));
    for (index, motion) in moves.chain(stands) {
        write_motion(&motion, &mut rows[index * ROBOT_COLUMNS.len()..]);
    }
    if let Some(held) = driven.held().filter(|held| known >> held.robot & 1 == 1) {
        let (position, velocity) = held.motion(&driven.motion(held.robot));
        ball[..2].copy_from_slice(&[position.x, position.y]);
        ball[3..5].copy_from_slice(&[velocity.x, velocity.y]);
    }
}
