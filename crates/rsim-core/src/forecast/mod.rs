//! Parts of a forecast beside the physics: whose commands are known, those on their way, and the motion of
//! robots whose commands are unknown. `world/forecast.rs` runs the physics forward.

pub(crate) mod coasting;
pub(crate) mod commands;

use crate::models::config::SimConfig;

/// Maximum time from what is known to a forecast, s; beyond it a forecast means nothing.
pub(crate) const MAX_FORECAST: f64 = 2.0;

/// The robots whose commands on their way are known; the others coast.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Knowledge {
    /// Those of the first team.
    #[default]
    Blue,
    /// Those of the second team.
    Yellow,
    /// Those of both teams.
    All,
}

impl Knowledge {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Blue, Self::Yellow, Self::All];

    /// Name of the knowledge.
    pub fn name(self) -> &'static str {
        match self {
            Self::Blue => "blue",
            Self::Yellow => "yellow",
            Self::All => "all",
        }
    }

    /// The knowledge with this name; `None` for another name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|known| known.name() == name)
    }

    /// The robots whose commands are known, one bit each.
    pub(crate) fn robots(self, config: &SimConfig) -> u64 {
        let bits = |count: usize| if count < 64 { (1 << count) - 1 } else { u64::MAX };
        let (blue, all) = (bits(config.blue.len()), bits(config.n_robots()));
        match self {
            Self::Blue => blue,
            Self::Yellow => all & !blue,
            Self::All => all,
        }
    }
}
