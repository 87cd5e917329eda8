//! Fields as data.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::ConfigError;
use crate::config::{not_negative, positive};

/// A field: its play area, goals, walls, and the lines and marks on it. Metres; distances are to
/// the middle of a line.
///
/// Goals are pockets behind the short sides, centred on the x axis. The lines lie at the walls of
/// a VSSS table, and inside them, by the margins, on an SSL field. What a league does not have is
/// 0.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Field {
    /// Name of the preset.
    pub name: Cow<'static, str>,
    /// Between the goal lines, along x.
    pub length: f32,
    /// Between the touch lines, along y.
    pub width: f32,
    /// From the goal lines to the walls behind them.
    pub goal_line_margin: f32,
    /// From the touch lines to the walls beside them.
    pub touch_line_margin: f32,
    /// Inner width of a goal, along y.
    pub goal_width: f32,
    /// Depth of a goal behind its line, along x.
    pub goal_depth: f32,
    /// Height under which the ball is in the goal. With a crossbar above it when the goal has
    /// walls of its own.
    pub goal_height: f32,
    /// Thickness of a goal's own walls and of its bar. 0: the goal is a gap in the table's wall.
    pub goal_wall: f32,
    /// Leg of the 45-degree block in each corner.
    pub corner: f32,
    /// Height of the walls around the field; 0 for walls that nothing flies over.
    pub wall_height: f32,
    /// Radius of the centre circle.
    pub center_radius: f32,
    /// Width of the area before a goal (SSL: defence area), along y.
    pub goal_area_width: f32,
    /// Depth of the area before a goal, along x.
    pub goal_area_depth: f32,
    /// Width of the smaller area inside it, along y.
    pub inner_area_width: f32,
    /// Depth of the smaller area, along x.
    pub inner_area_depth: f32,
    /// Chord of the arc on the front of the goal area, along y.
    pub area_arc_width: f32,
    /// How far that arc reaches beyond the front, along x.
    pub area_arc_depth: f32,
    /// Distance of a penalty mark from the goal line that is shot at.
    pub penalty_mark: f32,
    /// Distance of the free-ball marks from the centre, along x.
    pub free_ball_x: f32,
    /// Distance of the free-ball marks from the centre, along y.
    pub free_ball_y: f32,
    /// Width of the painted lines.
    pub line_width: f32,
    /// Most robots that the league lets a side field on any of its fields.
    pub max_robots: usize,
}

impl Field {
    /// IEEE VSSS, three a side. Dimensions: the league's rules (LARC 2008 v1.0 and its later
    /// edition for the goal and the arc); marks and areas: `VSSReferee`, `src/utils/types/field`.
    pub const VSS_3V3: Self = Self {
        name: Cow::Borrowed("vss_3v3"),
        length: 1.50,
        width: 1.30,
        goal_line_margin: 0.0,
        touch_line_margin: 0.0,
        goal_width: 0.40,
        goal_depth: 0.10,
        goal_height: 0.05,
        goal_wall: 0.0,
        corner: 0.07,
        wall_height: 0.05,
        center_radius: 0.20,
        goal_area_width: 0.70,
        goal_area_depth: 0.15,
        inner_area_width: 0.0,
        inner_area_depth: 0.0,
        area_arc_width: 0.20,
        area_arc_depth: 0.05,
        penalty_mark: 0.375,
        free_ball_x: 0.375,
        free_ball_y: 0.40,
        line_width: 0.003,
        max_robots: 5,
    };

    /// IEEE VSSS, five a side. Sources as for three a side; both areas are `VSSReferee`'s.
    pub const VSS_5V5: Self = Self {
        name: Cow::Borrowed("vss_5v5"),
        length: 2.20,
        width: 1.80,
        goal_depth: 0.15,
        center_radius: 0.25,
        goal_area_width: 0.80,
        goal_area_depth: 0.35,
        inner_area_width: 0.50,
        inner_area_depth: 0.15,
        area_arc_width: 0.0,
        area_arc_depth: 0.0,
        free_ball_x: 0.55,
        free_ball_y: 0.60,
        ..Self::VSS_3V3
    };

    /// SSL division A: the rules of 2026, chapter on the playing environment.
    pub const SSL_A: Self = Self {
        name: Cow::Borrowed("ssl_a"),
        length: 12.0,
        width: 9.0,
        goal_line_margin: 0.6,
        goal_width: 1.8,
        goal_area_width: 3.6,
        goal_area_depth: 1.8,
        penalty_mark: 8.0,
        max_robots: 11,
        ..Self::SSL_B
    };

    /// SSL division B: the rules of 2026. They allow six robots a side; the core's limit is
    /// division A's, so that any number can be tried.
    pub const SSL_B: Self = Self {
        name: Cow::Borrowed("ssl_b"),
        length: 9.0,
        width: 6.0,
        goal_line_margin: 0.3,
        touch_line_margin: 0.3,
        goal_width: 1.0,
        goal_depth: 0.18,
        goal_height: 0.16,
        goal_wall: 0.02,
        corner: 0.0,
        wall_height: 0.0,
        center_radius: 0.5,
        goal_area_width: 2.0,
        goal_area_depth: 1.0,
        inner_area_width: 0.0,
        inner_area_depth: 0.0,
        area_arc_width: 0.0,
        area_arc_depth: 0.0,
        penalty_mark: 6.0,
        free_ball_x: 0.0,
        free_ball_y: 0.0,
        line_width: 0.01,
        max_robots: 11,
    };

    /// SSL hardware challenges: the whole field of two 3 x 4 m halves, goals 0.7 m wide, areas 0.8 x
    /// 2.0 m (their rules of 2021), the rest as in division B. The penalty mark would lie outside.
    pub const SSL_CHALLENGE: Self = Self {
        name: Cow::Borrowed("ssl_challenge"),
        length: 6.0,
        width: 4.0,
        goal_width: 0.7,
        goal_area_width: 2.0,
        goal_area_depth: 0.8,
        penalty_mark: 0.0,
        ..Self::SSL_B
    };

    /// Every preset.
    pub const PRESETS: [Self; 5] =
        [Self::VSS_3V3, Self::VSS_5V5, Self::SSL_A, Self::SSL_B, Self::SSL_CHALLENGE];

    /// The preset of that name.
    ///
    /// # Errors
    /// [`ConfigError::UnknownPreset`] names those there are.
    pub fn preset(name: &str) -> Result<Self, ConfigError> {
        crate::config::find_preset("field", &Self::PRESETS, |field| &field.name, name)
    }

    /// Distance of a goal line from the centre.
    pub fn half_length(&self) -> f32 {
        self.length / 2.0
    }

    /// Distance of a touch line from the centre.
    pub fn half_width(&self) -> f32 {
        self.width / 2.0
    }

    /// How far from the centre anything can get along x: to the wall, or to the back of a goal.
    pub fn reach_x(&self) -> f32 {
        self.half_length() + self.goal_line_margin.max(self.goal_depth)
    }

    /// How far from the centre anything can get along y.
    pub fn reach_y(&self) -> f32 {
        self.half_width() + self.touch_line_margin
    }

    /// Checks that every number is in its range.
    ///
    /// # Errors
    /// The first that is not, by name.
    pub fn validate(&self) -> Result<(), ConfigError> {
        for (name, got) in [
            ("field.length", self.length),
            ("field.width", self.width),
            ("field.goal_width", self.goal_width),
            ("field.goal_depth", self.goal_depth),
            ("field.goal_height", self.goal_height),
        ] {
            positive(name, got)?;
        }
        for (name, got) in [
            ("field.goal_line_margin", self.goal_line_margin),
            ("field.touch_line_margin", self.touch_line_margin),
            ("field.goal_wall", self.goal_wall),
            ("field.corner", self.corner),
            ("field.wall_height", self.wall_height),
            ("field.center_radius", self.center_radius),
            ("field.goal_area_width", self.goal_area_width),
            ("field.goal_area_depth", self.goal_area_depth),
            ("field.inner_area_width", self.inner_area_width),
            ("field.inner_area_depth", self.inner_area_depth),
            ("field.area_arc_width", self.area_arc_width),
            ("field.area_arc_depth", self.area_arc_depth),
            ("field.penalty_mark", self.penalty_mark),
            ("field.free_ball_x", self.free_ball_x),
            ("field.free_ball_y", self.free_ball_y),
            ("field.line_width", self.line_width),
        ] {
            not_negative(name, got)?;
        }
        if self.goal_width + 2.0 * self.corner.max(self.goal_wall) >= self.width {
            return Err(ConfigError::Inconsistent(format!(
                "field.goal_width and what stands beside it must leave room on a side of {} m, got \
                 {} m, corners of {} m and goal walls of {} m",
                self.width, self.goal_width, self.corner, self.goal_wall
            )));
        }
        let in_wall = self.goal_wall == 0.0;
        if in_wall != (self.goal_line_margin == 0.0) {
            return Err(ConfigError::Inconsistent(format!(
                "field.goal_wall and field.goal_line_margin must both be 0 (a goal in the table's \
                 wall) or both positive (a goal that stands free), got {} and {} m",
                self.goal_wall, self.goal_line_margin
            )));
        }
        if !in_wall && self.goal_depth + self.goal_wall > self.goal_line_margin {
            return Err(ConfigError::Inconsistent(format!(
                "field.goal_depth and field.goal_wall must fit into field.goal_line_margin of {} m, \
                 got {} and {} m",
                self.goal_line_margin, self.goal_depth, self.goal_wall
            )));
        }
        Ok(())
    }
}
