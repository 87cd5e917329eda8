//! What a robot handles the ball with, as data.

use serde::{Deserialize, Serialize};

use crate::ConfigError;
use crate::config::{not_negative, positive, share};

/// The opening that a robot handles the ball with: beam, kicker and dribbler.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Mouth {
    /// Width that the ball's centre must be within, m.
    pub width: f32,
    /// How far before the front the break beam runs, m.
    pub beam_distance: f32,
    /// Height of the beam over the floor, m.
    pub beam_height: f32,
    /// Fastest kick along the floor, m/s. What the device can do, not what the rules allow.
    pub max_kick: f32,
    /// Fastest chip, m/s.
    pub max_chip: f32,
    /// Between two kicks, s.
    pub recharge: f32,
    /// Share of the ball's speed across the front that a kick leaves it.
    pub kick_keeps: f32,
    /// Strongest force with which the dribbler holds the ball, N. Beyond it the ball is lost.
    pub grip: f32,
    /// Force of the running bar on the ball, N: its friction gives the ball back-spin.
    pub bar_force: f32,
    /// Surface speed of the dribbler's bar, m/s: the back-spin that it aims at.
    pub bar_speed: f32,
    /// Restitution of the bar, which is damped: of the mouth while the dribbler runs.
    pub bar_restitution: f32,
    /// Coulomb friction of the bar.
    pub bar_friction: f32,
}

impl Mouth {
    pub(crate) fn validate(&self) -> Result<(), ConfigError> {
        for (name, got) in [
            ("robot.mouth_width", self.width),
            ("robot.beam_distance", self.beam_distance),
            ("robot.beam_height", self.beam_height),
        ] {
            positive(name, got)?;
        }
        for (name, got) in [
            ("robot.max_kick", self.max_kick),
            ("robot.max_chip", self.max_chip),
            ("robot.recharge", self.recharge),
            ("robot.grip", self.grip),
            ("robot.bar_force", self.bar_force),
            ("robot.bar_speed", self.bar_speed),
            ("robot.bar_friction", self.bar_friction),
        ] {
            not_negative(name, got)?;
        }
        share("robot.kick_keeps", self.kick_keeps)?;
        share("robot.bar_restitution", self.bar_restitution)
    }
}
