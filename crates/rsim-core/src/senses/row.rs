//! Rows of what robots know, in the columns of state rows.

use crate::blocks::{BALL, robot, set_bits};
use crate::columns::{ABSENT_COLUMN, BALL_COLUMNS, ROBOT_COLUMNS};
use crate::geometry::motion::Motion;
use crate::math::Vector;
use crate::senses::driven::DrivenRobots;
use crate::senses::tracker::Tracker;
use crate::state::State;

/// Number of a robot's columns for its motion, which come first; the break beam follows.
const MOTION_COLUMNS: usize = 7;

/// Writes what is known. Nobody senses touches, collisions and lines crossed: these columns are as of a match
/// that has just begun. Which robots are absent is known. `cut` has a bit for each robot whose beam is cut;
/// `own` gives velocities that robots report, or `None` for those by cameras.
pub(super) fn write(
    tracker: &Tracker,
    cut: u64,
    own: impl Fn(usize) -> Option<(Vector, f32)>,
    state: &State,
    out: &mut [f32],
) {
    let absent = |index| {
        let Motion { position, heading, .. } = state.bodies.motion(robot(index));
        state.is_absent(index).then_some((position, heading))
    };
    write_known(tracker, cut, own, absent, out);
}

/// The same with position and heading of each robot that is `absent`, by its index.
pub(super) fn write_known(
    tracker: &Tracker,
    cut: u64,
    own: impl Fn(usize) -> Option<(Vector, f32)>,
    absent: impl Fn(usize) -> Option<(Vector, Vector)>,
    out: &mut [f32],
) {
    let (ball, robots) = out.split_at_mut(BALL_COLUMNS.len());
    let Motion { position, velocity, .. } = tracker.motion(BALL);
    let ([z, v_z], spin) = tracker.ball();
    let no_touch = -1.0;
    ball.fill(0.0);
    let motion = [position.x, position.y, z, velocity.x, velocity.y, v_z, spin.x, spin.y, spin.z];
    ball[..motion.len()].copy_from_slice(&motion);
    ball[motion.len()] = no_touch;
    for (index, columns) in robots.chunks_exact_mut(ROBOT_COLUMNS.len()).enumerate() {
        if let Some((position, heading)) = absent(index) {
            columns.fill(0.0);
            columns[..4].copy_from_slice(&[position.x, position.y, heading.x, heading.y]);
            columns[ABSENT_COLUMN] = 1.0;
            continue;
        }
        let mut motion = tracker.motion(robot(index));
        if let Some((Vector { x: forward, y: left }, angular_velocity)) = own(index) {
            motion.velocity = motion.heading * forward + motion.heading.perp() * left;
            motion.angular_velocity = angular_velocity;
        }
        columns.fill(0.0);
        write_motion(&motion, columns);
        columns[MOTION_COLUMNS] = f32::from(u8::from(cut >> index & 1 == 1));
    }
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
