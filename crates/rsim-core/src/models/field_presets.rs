//! Presets of fields, with the source of every number.

use std::borrow::Cow;

use crate::error::ConfigError;
use crate::models::field::Field;
use crate::models::presets::find_preset;

impl Field {
    /// IEEE VSSS, three per team. Dimensions: the league's rules (LARC 2008 v1.0 and its later
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
        goal_wall_thickness: 0.0,
        corner_leg: 0.07,
        wall_height: 0.05,
        center_circle_radius: 0.20,
        goal_area_width: 0.70,
        goal_area_depth: 0.15,
        inner_area_width: 0.0,
        inner_area_depth: 0.0,
        area_arc_width: 0.20,
        area_arc_depth: 0.05,
        penalty_mark_distance: 0.375,
        free_ball_x: 0.375,
        free_ball_y: 0.40,
        line_width: 0.003,
        max_robots: 5,
    };

    /// IEEE VSSS, five per team. Sources as for three per team; both areas are `VSSReferee`'s.
    pub const VSS_5V5: Self = Self {
        name: Cow::Borrowed("vss_5v5"),
        length: 2.20,
        width: 1.80,
        goal_depth: 0.15,
        center_circle_radius: 0.25,
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
        penalty_mark_distance: 8.0,
        max_robots: 11,
        ..Self::SSL_B
    };

    /// SSL division B: the rules of 2026. They allow six robots per team; `max_robots` is division
    /// A's limit, so that any number can be tried.
    pub const SSL_B: Self = Self {
        name: Cow::Borrowed("ssl_b"),
        length: 9.0,
        width: 6.0,
        goal_line_margin: 0.3,
        touch_line_margin: 0.3,
        goal_width: 1.0,
        goal_depth: 0.18,
        goal_height: 0.16,
        goal_wall_thickness: 0.02,
        corner_leg: 0.0,
        wall_height: 0.0,
        center_circle_radius: 0.5,
        goal_area_width: 2.0,
        goal_area_depth: 1.0,
        inner_area_width: 0.0,
        inner_area_depth: 0.0,
        area_arc_width: 0.0,
        area_arc_depth: 0.0,
        penalty_mark_distance: 6.0,
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
        penalty_mark_distance: 0.0,
        ..Self::SSL_B
    };

    /// All presets.
    pub const PRESETS: [Self; 5] =
        [Self::VSS_3V3, Self::VSS_5V5, Self::SSL_A, Self::SSL_B, Self::SSL_CHALLENGE];

    /// The preset with this name.
    ///
    /// # Errors
    /// [`ConfigError::UnknownPreset`], which lists the known names.
    pub fn preset(name: &str) -> Result<Self, ConfigError> {
        find_preset("field", &Self::PRESETS, |field| &field.name, name)
    }
}
