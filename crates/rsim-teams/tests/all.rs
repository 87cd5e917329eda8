//! Tests of scripted sides in matches with physics and referee.

mod arena;
mod matches;
