//! The referee of VSSS, three and five a side, in scenes without physics.

mod course;
mod crowd_limits;
mod crowds;
mod formation;
mod goals;
mod halves;
mod input;
mod outlines;
mod pitches;
mod random;
mod room;
mod scene;
mod shootout;
mod stuck_ball;
mod symmetry;
mod walk;
