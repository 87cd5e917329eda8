//! Touches during a control step: of the ball, and between robots.

use serde::{Deserialize, Serialize};

/// Touches since the control step began, and the last robot that touched the ball.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct TouchRecord {
    /// Last robot that touched the ball, kept over control steps.
    pub(crate) last: Option<u8>,
    robots: Vec<RobotTouches>,
}

/// Touches of one robot.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct RobotTouches {
    pub(crate) ball: bool,
    pub(crate) opponent: bool,
    /// Closing speed of the hardest contact with another robot, m/s.
    pub(crate) collision_speed: f32,
}

impl TouchRecord {
    pub(crate) fn new(robots: usize) -> Self {
        Self { last: None, robots: vec![RobotTouches::default(); robots] }
    }

    /// Clears the record for a new control step.
    pub(crate) fn start_step(&mut self) {
        self.robots.fill(RobotTouches::default());
    }

    /// Records that a robot touched the ball.
    pub(crate) fn add_ball(&mut self, robot: usize) {
        self.robots[robot].ball = true;
        self.last = u8::try_from(robot).ok();
    }

    /// Records that two robots touched at a closing speed, m/s.
    pub(crate) fn add_robots(&mut self, pair: [usize; 2], opponents: bool, closing: f32) {
        for robot in pair {
            let touches = &mut self.robots[robot];
            touches.opponent |= opponents;
            touches.collision_speed = touches.collision_speed.max(closing);
        }
    }

    pub(crate) fn of(&self, robot: usize) -> RobotTouches {
        self.robots[robot]
    }
}
