//! Scenes of SSL matches: each rule, the course of a match, and what holds in all of them.

mod areas;
mod ball_out;
mod cards;
mod contacts;
mod features;
mod flow;
mod goals;
mod kicks;
mod limits;
mod offenses_at_once;
mod penalty;
mod penalty_positions;
mod placement;
mod positions;
mod scene;
mod shootout;
mod stages;
mod statistics;
mod stops;
mod touchers;
mod touches;
mod walk;
