//! Tests of the scripted side with physics and referee.

mod arena;
mod matches;
mod restarts;
mod saves;
