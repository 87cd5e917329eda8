//! Geometry of fields and bodies: outlines, walls, distances, motion in the plane.

pub(crate) mod arena;
pub(crate) mod bench;
pub(crate) mod clearance;
pub(crate) mod free_space;
pub(crate) mod motion;
pub(crate) mod motion_block;
pub(crate) mod outline;
