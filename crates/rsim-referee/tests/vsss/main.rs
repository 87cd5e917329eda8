//! The referee of VSSS, three and five a side, in scenes without physics.

mod course;
mod crowds;
mod formation;
mod goals;
mod halves;
mod input;
mod outlines;
mod pitches;
mod random;
mod scene;
mod shootout;
mod stuck_ball;
mod walk;
