//! Vectors, rotations and poses: the types of the contact engine's mathematics library, which all
//! modules share.

pub(crate) use rapier2d::glamx::Vec3;
pub(crate) use rapier2d::math::{Pose, Rotation, Vector};
