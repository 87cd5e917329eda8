//! One whole match without Python: physics, referee, scripted SSL teams, networks and people.
//!
//! A [`Match`] is what `rsoccer` plays as `SSLMatch-v0` and `VSSMatch-v0`, or as the self-play tasks of both
//! leagues, for one world at a time and in programs that have no Python, such as a page in a browser. A [`Side`]
//! drives a team; a person may drive single robots of it. The same setup and the same calls give the same bytes on
//! every platform.

mod actions;
mod area_shield;
mod attack_shield;
mod conditions;
mod error;
mod files;
mod knowledge;
mod network;
mod observations;
mod person;
mod player;
mod policy_file;
mod self_play;
mod setup;
mod side;
mod whole_match;

pub use area_shield::AreaShield;
pub use attack_shield::AttackShield;
pub use conditions::Conditions;
pub use error::MatchError;
pub use knowledge::{layout, lines, pitch, team_config};
pub use network::Network;
pub use observations::Observations;
pub use person::Controls;
pub use player::Player;
pub use policy_file::PolicyFile;
pub use setup::{Play, Setup};
pub use side::Side;
pub use whole_match::{Decision, Match};
