//! Break beam, kicker and dribbler of a robot, as data.

use serde::{Deserialize, Serialize};

use crate::models::numbers::numbers;

numbers! {
    /// Opening at the front in which a robot handles the ball, with break beam, kicker and dribbler.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
    pub struct Mouth, "robot";
    fields {}
    numbers {
        /// Width of the opening; the ball's center must be within it.
        mouth_width: Positive, "m";
        /// Distance of the break beam before the front.
        beam_distance: Positive, "m";
        /// Height of the break beam over the floor.
        beam_height: Positive, "m";
        /// Maximum speed of a kick along the floor; rules may allow less.
        max_kick_speed: NotNegative, "m/s";
        /// Maximum speed of a chip; rules may allow less.
        max_chip_speed: NotNegative, "m/s";
        /// Minimum time between two kicks.
        kicker_recharge_time: NotNegative, "s";
        /// Gap between front and ball up to which the kicker reaches it.
        kicker_reach: NotNegative, "m";
        /// Part of the ball's speed across the front kept in a kick.
        kick_lateral_factor: Fraction, "1";
        /// Maximum force of the dribbler; beyond it the ball is lost.
        dribbler_grip: NotNegative, "N";
        /// Force of the dribbler bar on the ball; its friction gives back-spin.
        dribbler_force: NotNegative, "N";
        /// Surface speed of the dribbler bar, the target of the back-spin.
        dribbler_speed: NotNegative, "m/s";
        /// Restitution of the mouth while the dribbler runs.
        dribbler_restitution: Fraction, "1";
        /// Coulomb friction of the dribbler bar.
        dribbler_friction: NotNegative, "1";
    }
}
