//! Detections of ball and robots.

use serde::{Deserialize, Serialize};

use crate::blocks::{LANES, Lanes, VectorLanes, robot_at};
use crate::math::{Vec3, Vector};

/// A ball as a camera sees it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct DetectedBall {
    /// m.
    pub(super) position: Vector,
    /// Height of the lowest point, m; 0 if the camera cannot tell.
    pub(super) z: f32,
    /// Index of the camera.
    pub(super) camera: u8,
}

/// Robots of a block as the first camera sees each of them. Numbers of robots that were not detected mean nothing.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct DetectedBlock {
    /// m.
    pub(super) position: VectorLanes,
    /// Cosines and sines; their length is near 1.
    pub(super) heading: VectorLanes,
    /// Bodies that were detected, one bit each.
    pub(super) bodies: u8,
    /// Indices of the cameras.
    pub(super) cameras: [u8; LANES],
    /// Bodies that another camera has begun to follow, one bit each: their places have moved by the cameras' errors.
    pub(super) moved: u8,
}

/// A robot as one more camera sees it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct DetectedRobot {
    /// m.
    pub(super) position: Vector,
    /// Cosine and sine; its length is near 1.
    pub(super) heading: Vector,
    /// Index of the robot.
    pub(super) robot: u8,
    /// Index of the camera.
    pub(super) camera: u8,
}

impl DetectedBlock {
    /// A block of which no robot was detected.
    pub(super) const NONE: Self = Self {
        position: VectorLanes::ZERO,
        heading: VectorLanes::ZERO,
        bodies: 0,
        cameras: [0; LANES],
        moved: 0,
    };

    /// The detection of a robot of the block with this index.
    pub(super) fn get(&self, block: usize, lane: usize) -> DetectedRobot {
        #[expect(clippy::cast_possible_truncation, reason = "at most 63 robots")]
        let robot = robot_at(block, lane) as u8;
        let (position, heading) = (self.position.get(lane), self.heading.get(lane));
        DetectedRobot { position, heading, robot, camera: self.cameras[lane] }
    }

    /// Sets the detection of a robot.
    pub(super) fn set(&mut self, lane: usize, detected: &DetectedRobot) {
        self.bodies |= 1 << lane;
        self.position.set(lane, detected.position);
        self.heading.set(lane, detected.heading);
        self.cameras[lane] = detected.camera;
    }
}

/// True motion of a detected ball beside its position, which no camera sees.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct BallMotion {
    /// m/s.
    pub(super) velocity: Vector,
    /// Vertical velocity, m/s; 0 if the camera cannot tell.
    pub(super) v_z: f32,
    /// Spin about the field's axes, rad/s; that of a rolling ball if the camera cannot tell.
    pub(super) spin: Vec3,
}

/// True velocities of the robots of a block, which no camera sees: m/s and rad/s.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(super) struct Velocities {
    pub(super) linear: VectorLanes,
    pub(super) angular: Lanes,
}
