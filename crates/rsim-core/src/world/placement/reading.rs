//! Starts as rows have them: columns as numbers of bodies.

use super::{BallStart, Placement, Start};
use crate::ball::state::BallState;
use crate::blocks::{BALL, robot};
use crate::columns::{ABSENT_COLUMN, BALL_COLUMNS, ROBOT_COLUMNS};
use crate::error::PlaceError;
use crate::geometry::motion::Motion;
use crate::math::{Vec3, Vector};

/// Number of columns of the ball, and of a robot, that a match starts from.
const PLACED_OF_BALL: usize = 9;
const PLACED_OF_ROBOT: usize = 7;

impl Placement {
    /// Reads a start row of finite numbers. Of an absent robot only that it is absent is read.
    pub(in crate::world) fn parse(&self, row: &[f32]) -> Result<Start, PlaceError> {
        let (columns, robots) = row.split_at(BALL_COLUMNS.len());
        let BallStart { motion, ball } = self.parse_ball(columns)?;
        let mut start = Start { motions: vec![motion], ball, absent: 0 };
        for (index, columns) in robots.chunks_exact(ROBOT_COLUMNS.len()).enumerate() {
            let (motion, is_absent) = self.parse_robot(index, columns)?;
            start.motions.push(motion);
            start.absent |= u64::from(is_absent) << index;
        }
        Ok(start)
    }

    /// Reads a ball of finite numbers.
    pub(super) fn parse_ball(&self, columns: &[f32]) -> Result<BallStart, PlaceError> {
        self.check_finite(BALL, &BALL_COLUMNS[..PLACED_OF_BALL], columns)?;
        let (motion, ball) = read_ball(columns);
        Ok(BallStart { motion, ball })
    }

    /// Reads a robot of finite numbers, and whether it is absent. Then only that is read.
    pub(super) fn parse_robot(
        &self,
        index: usize,
        columns: &[f32],
    ) -> Result<(Motion, bool), PlaceError> {
        let who = robot(index);
        match columns[ABSENT_COLUMN] {
            1.0 => return Ok((self.benches[index], true)),
            0.0 => {}
            got => return Err(PlaceError::Absent { who: self.names[who].clone(), got }),
        }
        self.check_finite(who, &ROBOT_COLUMNS[..PLACED_OF_ROBOT], columns)?;
        Ok((read_robot(columns), false))
    }

    /// Checks that the values of these columns are finite.
    fn check_finite(
        &self,
        who: usize,
        names: &[&'static str],
        columns: &[f32],
    ) -> Result<(), PlaceError> {
        let mut wrong = names.iter().zip(columns).filter(|(_, value)| !value.is_finite());
        wrong.next().map_or(Ok(()), |(column, got)| {
            Err(PlaceError::NotFinite { who: self.names[who].clone(), column, got: *got })
        })
    }
}

fn read_ball(columns: &[f32]) -> (Motion, BallState) {
    let [x, y, z, v_x, v_y, v_z, spin_x, spin_y, spin_z, ..] = columns else {
        unreachable!("a ball has {BALL_COLUMNS:?}")
    };
    let at_rest = Motion::at_rest(Vector::new(*x, *y), Vector::X);
    let motion = Motion { velocity: Vector::new(*v_x, *v_y), ..at_rest };
    let spin = Vec3::new(*spin_x, *spin_y, *spin_z);
    (motion, BallState { z: *z, v_z: *v_z, spin, hops: 0 })
}

fn read_robot(columns: &[f32]) -> Motion {
    let [x, y, cos, sin, v_x, v_y, v_theta, ..] = columns else {
        unreachable!("a robot has {ROBOT_COLUMNS:?}")
    };
    Motion {
        position: Vector::new(*x, *y),
        heading: Vector::new(*cos, *sin),
        velocity: Vector::new(*v_x, *v_y),
        angular_velocity: *v_theta,
    }
}
