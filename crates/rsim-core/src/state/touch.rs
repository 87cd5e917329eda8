//! Touches during a control step: of the ball, and between opponents.

use serde::{Deserialize, Serialize};

/// Touches since the control step began, and the last robot that touched the ball.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct TouchRecord {
    /// Last robot that touched the ball, kept over control steps.
    pub(crate) last: Option<u8>,
    /// Robots that touched the ball, one bit each.
    ball: u64,
    /// Robots that touched an opponent, one bit each.
    opponents: u64,
}

impl TouchRecord {
    /// Clears the record for a new control step.
    pub(crate) fn start_step(&mut self) {
        (self.ball, self.opponents) = (0, 0);
    }

    /// Records that a robot touched the ball.
    pub(crate) fn add_ball(&mut self, robot: usize) {
        self.ball |= 1 << robot;
        self.last = u8::try_from(robot).ok();
    }

    /// Records that two opponents touched each other.
    pub(crate) fn add_opponents(&mut self, pair: [usize; 2]) {
        self.opponents |= 1 << pair[0] | 1 << pair[1];
    }

    /// Forgets the touches of a robot during the step, unless it was the last that touched the ball.
    pub(crate) fn forget(&mut self, robot: usize) {
        self.ball &= !(1 << robot);
        self.opponents &= !(1 << robot);
    }

    /// Whether a robot touched the ball.
    pub(crate) fn touched_ball(&self, robot: usize) -> bool {
        self.ball >> robot & 1 == 1
    }

    /// Whether a robot touched an opponent.
    pub(crate) fn touched_opponent(&self, robot: usize) -> bool {
        self.opponents >> robot & 1 == 1
    }
}
