//! Laws of the ball: rolling, impacts, kicks and dribbling, each without the rest of the match.

pub(crate) mod impact;
pub(crate) mod kicker;
pub(crate) mod kicks;
pub(crate) mod mouth;
pub(crate) mod rolling;
pub(crate) mod state;
