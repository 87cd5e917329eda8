//! Fields as data. [`crate::models::field_presets`] has the presets.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::error::ConfigError;
use crate::models::numbers::{Number, check_all, find, listed, numbers};

numbers! {
    /// A field: play area, goals, walls, and the lines and marks on the floor.
    ///
    /// Distances are measured to the middle of a line. Goals are pockets behind the short sides,
    /// centered on the x axis. The lines of a VSSS table lie at its walls, those of an SSL field inside
    /// them by the margins. A number that a league does not use is 0.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    pub struct Field, "field";
    fields {
        /// Name of the preset.
        name: Cow<'static, str>,
        /// Maximum number of robots per team that the league allows on any of its fields.
        max_robots: usize,
    }
    numbers {
        /// Distance between the goal lines, along x.
        length: Positive, "m";
        /// Distance between the touch lines, along y.
        width: Positive, "m";
        /// Distance from a goal line to the wall behind it; 0 at the wall.
        goal_line_margin: NotNegative, "m";
        /// Distance from a touch line to the wall beside it; 0 at the wall.
        touch_line_margin: NotNegative, "m";
        /// Inner width of a goal, along y.
        goal_width: Positive, "m";
        /// Depth of a goal behind its line, along x.
        goal_depth: Positive, "m";
        /// Height of a goal, below its crossbar if it has one.
        goal_height: Positive, "m";
        /// Thickness of a goal's own walls and crossbar; 0 without them.
        goal_wall_thickness: NotNegative, "m";
        /// Leg of the 45-degree block in each corner; 0 for none.
        corner_leg: NotNegative, "m";
        /// Height of the outer walls; 0 for walls that no ball can fly over.
        wall_height: NotNegative, "m";
        /// Radius of the center circle.
        center_circle_radius: NotNegative, "m";
        /// Width of the goal area (SSL: defense area), along y.
        goal_area_width: NotNegative, "m";
        /// Depth of the goal area, along x.
        goal_area_depth: NotNegative, "m";
        /// Width of the smaller area inside the goal area, along y.
        inner_area_width: NotNegative, "m";
        /// Depth of the smaller area inside the goal area, along x.
        inner_area_depth: NotNegative, "m";
        /// Chord of the arc on the front of the goal area, along y.
        area_arc_width: NotNegative, "m";
        /// Depth of the arc beyond the front of the goal area, along x.
        area_arc_depth: NotNegative, "m";
        /// Distance of a penalty mark from the attacked goal line.
        penalty_mark_distance: NotNegative, "m";
        /// Distance of the free-ball marks from the center, along x.
        free_ball_x: NotNegative, "m";
        /// Distance of the free-ball marks from the center, along y.
        free_ball_y: NotNegative, "m";
        /// Width of the painted lines.
        line_width: NotNegative, "m";
    }
}

/// Most robots of a team: those of both teams and the ball have a bit each of 64.
const MOST_ROBOTS: usize = 31;

impl Field {
    /// All numbers of a field.
    pub fn numbers() -> Vec<Number> {
        listed(Self::NUMBERS).collect()
    }

    /// A number by name; `None` if a field has none of that name.
    pub fn number_mut(&mut self, name: &str) -> Option<&mut f32> {
        (find(Self::NUMBERS, name)?.get_mut)(self)
    }

    /// Distance of a goal line from the center, m.
    pub fn half_length(&self) -> f32 {
        self.length / 2.0
    }

    /// Distance of a touch line from the center, m.
    pub fn half_width(&self) -> f32 {
        self.width / 2.0
    }

    /// Maximum distance of a body from the center along x, to the wall or the back of a goal, m.
    pub fn max_x(&self) -> f32 {
        self.half_length() + self.goal_line_margin.max(self.goal_depth)
    }

    /// Maximum distance of a body from the center along y, m.
    pub fn max_y(&self) -> f32 {
        self.half_width() + self.touch_line_margin
    }

    /// Checks every number against its range and the others.
    ///
    /// # Errors
    /// [`ConfigError`] with the name of the first wrong number.
    pub fn validate(&self) -> Result<(), ConfigError> {
        check_all(Self::NUMBERS, self)?;
        if self.max_robots > MOST_ROBOTS {
            return Err(ConfigError::Inconsistent(format!(
                "field.max_robots must be at most {MOST_ROBOTS}, got {}",
                self.max_robots
            )));
        }
        if self.goal_width + 2.0 * self.corner_leg.max(self.goal_wall_thickness) >= self.width {
            return Err(ConfigError::Inconsistent(format!(
                "field.goal_width with field.corner_leg or field.goal_wall_thickness on both sides \
                 must be below field.width of {} m, got {} m, corners of {} m and goal walls of {} m",
                self.width, self.goal_width, self.corner_leg, self.goal_wall_thickness
            )));
        }
        let in_wall = self.goal_wall_thickness == 0.0;
        if in_wall != (self.goal_line_margin == 0.0) {
            return Err(ConfigError::Inconsistent(format!(
                "field.goal_wall_thickness and field.goal_line_margin must both be 0 (a goal in the \
                 table's wall) or both positive (a goal that stands free), got {} and {} m",
                self.goal_wall_thickness, self.goal_line_margin
            )));
        }
        if !in_wall && self.goal_depth + self.goal_wall_thickness > self.goal_line_margin {
            return Err(ConfigError::Inconsistent(format!(
                "field.goal_depth and field.goal_wall_thickness must fit into \
                 field.goal_line_margin of {} m, got {} and {} m",
                self.goal_line_margin, self.goal_depth, self.goal_wall_thickness
            )));
        }
        Ok(())
    }
}
