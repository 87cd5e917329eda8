//! The rules, one small function each.

pub mod ball_out;
