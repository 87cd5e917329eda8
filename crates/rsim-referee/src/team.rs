//! The two teams, and the sides that they defend.

/// A team. Blue defends the goal at -x, yellow the one at +x.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Team {
    /// Defends the goal at -x; its robots come first in a row.
    Blue,
    /// Defends the goal at +x.
    Yellow,
}

impl Team {
    /// Both teams, in the order of a row.
    pub const BOTH: [Self; 2] = [Self::Blue, Self::Yellow];

    /// Index of the team: 0 for blue, 1 for yellow.
    pub const fn index(self) -> usize {
        match self {
            Self::Blue => 0,
            Self::Yellow => 1,
        }
    }

    /// The other team.
    #[must_use]
    pub const fn opponent(self) -> Self {
        match self {
            Self::Blue => Self::Yellow,
            Self::Yellow => Self::Blue,
        }
    }

    /// Sign of x in the half that the team defends.
    pub const fn own_side(self) -> f32 {
        match self {
            Self::Blue => -1.0,
            Self::Yellow => 1.0,
        }
    }
}
