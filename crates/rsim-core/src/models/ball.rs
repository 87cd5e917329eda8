//! Balls as data. [`crate::models::ball_presets`] has the presets.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::error::ConfigError;
use crate::models::numbers::{Number, check_all, find, listed, numbers};

numbers! {
    /// A ball with the floor that it rolls on and the surfaces that it hits.
    ///
    /// The numbers describe a venue as much as a ball.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    pub struct BallModel, "ball";
    fields {
        /// Name of the preset.
        name: Cow<'static, str>,
    }
    numbers {
        /// Radius.
        radius: Positive, "m";
        /// Mass.
        mass: Positive, "kg";
        /// Deceleration while the lowest point slips over the floor.
        sliding_deceleration: NotNegative, "m/s²";
        /// Deceleration of a rolling ball; without drag, 0 never stops it.
        rolling_deceleration: NotNegative, "m/s²";
        /// Further deceleration of a rolling ball by its speed.
        rolling_drag: NotNegative, "1/s";
        /// First rolling speed by the speed of the kick; 5/7 for a solid sphere.
        slide_to_roll_ratio: UpperHalf, "1";
        /// Deceleration of the spin about the vertical axis.
        spin_deceleration: NotNegative, "rad/s²";
        /// Part of the horizontal speed kept at the first touch-down of a chip.
        first_hop_factor: Fraction, "1";
        /// Part of the horizontal speed kept at each later touch-down.
        later_hop_factor: Fraction, "1";
        /// Restitution of the vertical speed at a touch-down.
        vertical_restitution: Fraction, "1";
        /// Restitution against robots.
        robot_restitution: Fraction, "1";
        /// Coulomb friction against robots.
        robot_friction: NotNegative, "1";
        /// Restitution against walls and the sides of goals.
        wall_restitution: Fraction, "1";
        /// Coulomb friction against walls and the sides of goals.
        wall_friction: NotNegative, "1";
        /// Restitution against the padded back of a goal.
        goal_back_restitution: Fraction, "1";
        /// Coulomb friction against the back of a goal.
        goal_back_friction: NotNegative, "1";
    }
}

/// Contact coefficients of the ball against one kind of surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Surface {
    /// Separation speed along the normal by closing speed, 0 to 1.
    pub(crate) restitution: f32,
    /// Coulomb friction coefficient.
    pub(crate) friction: f32,
}

impl BallModel {
    /// All numbers of a ball.
    pub fn numbers() -> Vec<Number> {
        listed(Self::NUMBERS).collect()
    }

    /// A number by name; `None` if a ball has none of that name.
    pub fn number_mut(&mut self, name: &str) -> Option<&mut f32> {
        (find(Self::NUMBERS, name)?.get_mut)(self)
    }

    /// Checks every number against its range.
    ///
    /// # Errors
    /// [`ConfigError::Number`] with the name of the first wrong number.
    pub fn validate(&self) -> Result<(), ConfigError> {
        check_all(Self::NUMBERS, self)
    }

    /// Contact with a robot.
    pub(crate) fn robot_surface(&self) -> Surface {
        Surface { restitution: self.robot_restitution, friction: self.robot_friction }
    }

    /// Contact with a wall or the side of a goal.
    pub(crate) fn wall_surface(&self) -> Surface {
        Surface { restitution: self.wall_restitution, friction: self.wall_friction }
    }

    /// Contact with the back of a goal.
    pub(crate) fn goal_back_surface(&self) -> Surface {
        Surface { restitution: self.goal_back_restitution, friction: self.goal_back_friction }
    }
}
