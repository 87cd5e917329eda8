//! Fields as data.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::ConfigError;

/// A walled field: its play area, goals, corner blocks, and the lines and marks on it. Metres.
///
/// Goals are pockets behind the short sides, centred on the x axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Field {
    /// Name of the preset.
    pub name: Cow<'static, str>,
    /// Between the goal lines, along x.
    pub length: f32,
    /// Between the side walls, along y.
    pub width: f32,
    /// Inner width of a goal, along y.
    pub goal_width: f32,
    /// Depth of a goal behind its line, along x.
    pub goal_depth: f32,
    /// Leg of the 45-degree block in each corner.
    pub corner: f32,
    /// Height of the walls.
    pub wall_height: f32,
    /// Radius of the centre circle.
    pub center_radius: f32,
    /// Width of the area before a goal, along y.
    pub goal_area_width: f32,
    /// Depth of the area before a goal, along x.
    pub goal_area_depth: f32,
    /// Distance of the penalty marks from the centre, along x.
    pub penalty_mark: f32,
    /// Distance of the free-ball marks from the centre, along x.
    pub free_ball_x: f32,
    /// Distance of the free-ball marks from the centre, along y.
    pub free_ball_y: f32,
    /// Width of the painted lines.
    pub line_width: f32,
    /// Most robots that the league lets a side field.
    pub max_robots: usize,
}

impl Field {
    /// IEEE VSSS, three a side. Dimensions: the league's rules (LARC 2008 v1.0 and its later
    /// edition for the goal); marks and areas: `VSSReferee`, `src/utils/types/field`.
    pub const VSS_3V3: Self = Self {
        name: Cow::Borrowed("vss_3v3"),
        length: 1.50,
        width: 1.30,
        goal_width: 0.40,
        goal_depth: 0.10,
        corner: 0.07,
        wall_height: 0.05,
        center_radius: 0.20,
        goal_area_width: 0.70,
        goal_area_depth: 0.15,
        penalty_mark: 0.375,
        free_ball_x: 0.375,
        free_ball_y: 0.40,
        line_width: 0.003,
        max_robots: 5,
    };

    /// IEEE VSSS, five a side. Sources as for three a side.
    pub const VSS_5V5: Self = Self {
        name: Cow::Borrowed("vss_5v5"),
        length: 2.20,
        width: 1.80,
        goal_width: 0.40,
        goal_depth: 0.15,
        corner: 0.07,
        wall_height: 0.05,
        center_radius: 0.25,
        goal_area_width: 0.80,
        goal_area_depth: 0.35,
        penalty_mark: 0.725,
        free_ball_x: 0.55,
        free_ball_y: 0.60,
        line_width: 0.003,
        max_robots: 5,
    };

    /// Every preset.
    pub const PRESETS: [Self; 2] = [Self::VSS_3V3, Self::VSS_5V5];

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

    /// Distance of a side wall from the centre.
    pub fn half_width(&self) -> f32 {
        self.width / 2.0
    }

    pub(crate) fn validate(&self) -> Result<(), ConfigError> {
        for (name, got) in [
            ("field.length", self.length),
            ("field.width", self.width),
            ("field.goal_width", self.goal_width),
            ("field.goal_depth", self.goal_depth),
            ("field.corner", self.corner),
            ("field.wall_height", self.wall_height),
        ] {
            crate::config::positive(name, got)?;
        }
        if self.goal_width + 2.0 * self.corner >= self.width {
            return Err(ConfigError::Inconsistent(format!(
                "field.goal_width and the corner blocks must leave wall between them on a side of {} m, got {} and {} m",
                self.width, self.goal_width, self.corner
            )));
        }
        Ok(())
    }
}
