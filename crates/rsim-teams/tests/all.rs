//! Tests of the scripted side with physics and referee.

mod arena;
mod matches;
mod penalties;
mod restarts;
mod saves;
