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
    /// Numbers of balls and of robots up to the end of each camera's.
    pub(super) ends: Vec<[usize; 2]>,
}

impl Detections {
    /// Begins a frame in the memory of another one.
    pub(super) fn begin(&mut self, time: f64, due: f64) {
        (self.time, self.due) = (time, due);
        self.balls.clear();
        self.robots.clear();
        self.ends.clear();
    }

    /// Ends the detections of a camera.
    pub(super) fn end_camera(&mut self) {
        self.ends.push([self.balls.len(), self.robots.len()]);
    }

    /// The frame as readers outside the senses get it.
    pub(super) fn to_camera_frame(&self) -> CameraFrame {
        // The camera of a detection is the number of those that ended before it.
        #[expect(clippy::cast_precision_loss, reason = "at most 64 cameras")]
        let camera = |nth: usize, which: usize| {
            self.ends.iter().filter(|ends| ends[which] <= nth).count() as f32
        };
        let balls = self.balls.iter().enumerate().map(|(nth, ball)| {
            let (position, [z, _]) = (ball.position, ball.height);
            [camera(nth, 0), position.x, position.y, z]
        });
        let robots = self.robots.iter().enumerate().map(|(nth, seen)| {
            #[expect(clippy::cast_precision_loss, reason = "at most 22 robots")]
            let robot = seen.robot as f32;
            let Motion { position, heading, .. } = seen.motion;
            [camera(nth, 1), robot, position.x, position.y, heading.x, heading.y]
        });
        CameraFrame { time: self.time, balls: balls.collect(), robots: robots.collect() }
    }
}

/// Detections of all cameras at one instant, as software of teams gets them.
#[derive(Debug, Clone, PartialEq)]
pub struct CameraFrame {
    /// Time of the exposure since the senses began, s.
    pub time: f64,
    /// For each detected ball the index of the camera, and position x, y and height, m.
    pub balls: Vec<[f32; 4]>,
    /// For each detected robot the index of the camera, its index in a state row, position x and y (m), and
    /// cosine and sine of the heading, whose length is near 1.
    pub robots: Vec<[f32; 6]>,
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
