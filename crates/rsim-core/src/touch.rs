//! What happened during a control step, beside the motion: who touched what, and how hard.

use serde::{Deserialize, Serialize};

/// Touches since the step began; who touched the ball last is kept beyond it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Touched {
    /// Robot that touched the ball last.
    pub(crate) last: Option<u8>,
    robots: Vec<RobotTouched>,
}

/// What one robot touched.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct RobotTouched {
    pub(crate) ball: bool,
    pub(crate) foe: bool,
    /// Closing speed of the hardest contact with another robot, m/s.
    pub(crate) crash_speed: f32,
}

impl Touched {
    pub(crate) fn new(robots: usize) -> Self {
        Self { last: None, robots: vec![RobotTouched::default(); robots] }
    }

    /// A new step begins.
    pub(crate) fn forget(&mut self) {
        self.robots.fill(RobotTouched::default());
    }

    /// A robot touched the ball.
    pub(crate) fn ball(&mut self, robot: usize) {
        self.robots[robot].ball = true;
        self.last = u8::try_from(robot).ok();
    }

    /// Two robots touched, closing in at a speed.
    pub(crate) fn robots(&mut self, pair: [usize; 2], foes: bool, closing: f32) {
        for robot in pair {
            let touched = &mut self.robots[robot];
            touched.foe |= foes;
            touched.crash_speed = touched.crash_speed.max(closing);
        }
    }

    pub(crate) fn of(&self, robot: usize) -> RobotTouched {
        self.robots[robot]
    }
}
