//! Touches during a control step, of the ball and between opponents, and the last touch of the ball.

use serde::{Deserialize, Serialize};

/// Touches since the control step began, and the last robot that touched the ball.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct TouchRecord {
    /// Last touch of the ball, kept over control steps.
    pub(crate) last: Option<LastTouch>,
    /// Robots that touched the ball, one bit each.
    ball: u64,
    /// Robots that touched an opponent, one bit each.
    opponents: u64,
}

/// The last touch of the ball by a robot.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct LastTouch {
    /// Index of the robot.
    pub(crate) robot: u8,
    /// Ticks since the one in which it touched the ball; -1 in that tick.
    ticks: i32,
    /// Speed of the ball at the end of that tick, m/s.
    pub(crate) speed: f32,
    /// Maximum height of the ball since then, m.
    pub(crate) height: f32,
}

impl LastTouch {
    /// Time since the touch, s. `tick` is the duration of a tick, s.
    #[allow(clippy::cast_precision_loss)] // exact for hours
    pub(crate) fn seconds(&self, tick: f32) -> f32 {
        self.ticks as f32 * tick
    }
}

impl TouchRecord {
    /// Clears the record for a new control step.
    pub(crate) fn start_step(&mut self) {
        (self.ball, self.opponents) = (0, 0);
    }

    /// Records that a robot touched the ball.
    pub(crate) fn add_ball(&mut self, robot: usize) {
        self.ball |= 1 << robot;
        let robot = u8::try_from(robot).ok();
        self.last = robot.map(|robot| LastTouch { robot, ticks: -1, speed: 0.0, height: 0.0 });
    }

    /// Follows the ball since its last touch up to the end of a tick, where it has a height, m. `speed` says how
    /// fast it then is, m/s.
    pub(crate) fn end_tick(&mut self, height: f32, speed: impl FnOnce() -> f32) {
        let Some(last) = &mut self.last else { return };
        last.ticks += 1;
        last.height = last.height.max(height);
        if last.ticks == 0 {
            last.speed = speed();
        }
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
