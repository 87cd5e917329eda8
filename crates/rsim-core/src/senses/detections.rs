//! Frames of the cameras: detections of ball and robots.

use serde::{Deserialize, Serialize};

use crate::geometry::motion::Motion;
use crate::math::{Vec3, Vector};

/// A frame: detections of all cameras at one instant.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Detections {
    /// Time of the exposure since the senses began, s.
    pub(super) time: f64,
    /// Time of the arrival, s.
    pub(super) due: f64,
    pub(super) balls: Vec<DetectedBall>,
    pub(super) robots: Vec<DetectedRobot>,
}

impl Detections {
    /// Begins a frame in the memory of another one.
    pub(super) fn begin(&mut self, time: f64, due: f64) {
        (self.time, self.due) = (time, due);
        self.balls.clear();
        self.robots.clear();
    }
}

/// A ball as a camera sees it. It has its motion, which is used without a tracker.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct DetectedBall {
    /// m.
    pub(super) position: Vector,
    /// m/s.
    pub(super) velocity: Vector,
    /// Height of the lowest point (m) and vertical velocity (m/s); 0 if the camera cannot tell.
    pub(super) height: [f32; 2],
    /// Spin about the field's axes, rad/s; that of a rolling ball if the camera cannot tell.
    pub(super) spin: Vec3,
}

/// A robot as a camera sees it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct DetectedRobot {
    /// Index of the robot.
    pub(super) robot: usize,
    /// Its heading is near 1 in length.
    pub(super) motion: Motion,
}
