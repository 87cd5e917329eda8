//! Estimated motions of all bodies, and their filters.

use serde::{Deserialize, Serialize};

use crate::blocks::{blocks_of, place_of, robot};
use crate::geometry::motion::Motion;
use crate::models::sensing::Sensing;
use crate::senses::fetch::Fetched;
use crate::senses::filter::Filter;
use crate::senses::frames::Frame;
use crate::senses::noise::Noise;
use crate::senses::track::TrackBlock;

/// Acceleration that the filter of the ball counts with, m/s²: that of a ball that slides.
const BALL_ACCELERATION: f32 = 3.0;

/// Estimated motions of all bodies, by block.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Tracks {
    pub(super) blocks: Vec<TrackBlock>,
}

impl Tracks {
    /// The ball and `robots` robots, none of which was ever seen.
    pub(super) fn new(robots: usize) -> Self {
        Self { blocks: vec![TrackBlock::new(); blocks_of(robots)] }
    }

    /// Fetches all estimates.
    pub(super) fn fetch(&self, fetched: &mut Fetched) {
        self.blocks.iter().for_each(|block| block.fetch(fetched));
    }

    /// The estimated motion of a body.
    pub(super) fn motion(&self, body: usize) -> Motion {
        let (block, lane) = place_of(body);
        self.blocks[block].motion(lane)
    }

    /// The block of a body and its lane there.
    pub(super) fn of(&mut self, body: usize) -> (&mut TrackBlock, usize) {
        let (block, lane) = place_of(body);
        (&mut self.blocks[block], lane)
    }

    /// Begins with the robots of a frame, which have been watched before.
    pub(super) fn begin(&mut self, frame: Frame<'_>) {
        for (index, motion) in frame.moving_robots() {
            let (block, lane) = self.of(robot(index));
            block.begin(lane, &motion);
        }
    }

    /// Takes in detections of robots at an instant to which all estimates have gone on.
    pub(super) fn update(&mut self, frame: Frame<'_>, filters: &Filters) {
        for (block, seen) in self.blocks.iter_mut().zip(frame.blocks) {
            block.update(seen, &filters.robot, &filters.heading);
        }
    }
}

/// Filters of the ball, of robots and of headings.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Filters {
    pub(super) ball: Filter,
    robot: Filter,
    heading: Filter,
}

impl Filters {
    /// The filters for the noise of some senses, with a frame each `period` (s), and for robots that accelerate as
    /// given (m/s² and rad/s²) where nobody expects it.
    pub(super) fn of(sensing: &Sensing, period: f32, robot: f32, angular: f32) -> Self {
        let noise = Noise::of(sensing);
        Self {
            ball: Filter::new(noise.ball, period, BALL_ACCELERATION),
            robot: Filter::new(noise.robot, period, robot),
            heading: Filter::new(noise.heading, period, angular),
        }
    }
}
