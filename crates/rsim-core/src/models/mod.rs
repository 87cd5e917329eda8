//! Fields, balls and robots as data, and the configuration of a simulator made of them.

pub(crate) mod ball;
pub(crate) mod ball_presets;
pub(crate) mod config;
pub(crate) mod field;
pub(crate) mod field_presets;
pub(crate) mod league;
pub(crate) mod mouth;
pub(crate) mod numbers;
pub(crate) mod presets;
pub(crate) mod robot;
pub(crate) mod robot_presets;
pub(crate) mod sensing;
pub(crate) mod sensing_presets;
