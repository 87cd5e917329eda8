//! Features that tasks compute for every robot in every step: views, observations, terms of reward
//! shaping, commands from actions.

pub(crate) mod ego_features;
pub mod shaping;
pub mod steering;
pub(crate) mod viewpoint;
