//! The camera that each robot is followed by.
//!
//! Cameras see a body at places that differ by their errors. An estimate that took in all of them would get a velocity
//! from these differences, in each frame where two cameras overlap. So a robot is followed by one camera for as long as
//! that one sees it. Then another takes over, and the place moves while the velocity stays.

use serde::{Deserialize, Serialize};

use crate::blocks::{LANES, Lanes, mask_of_bits, place_of, robot, set_bits};
use crate::senses::detections::DetectedBlock;
use crate::senses::frames::Frame;
use crate::senses::track::LOST;

/// Frames in a row without the body, in periods of the cameras, after which another camera takes over.
pub(super) const PATIENCE: f32 = 1.5;

/// Cameras that the robots of a block are followed by.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct FollowedBlock {
    cameras: [u8; LANES],
    /// Time since these saw the robots, s.
    unseen: Lanes,
}

/// Cameras that all robots are followed by.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Followed {
    blocks: Vec<FollowedBlock>,
    /// Time of the last frame, s.
    time: f64,
    /// Time without a robot after which another camera takes over, s.
    patience: f32,
    /// Detections that count in the last frame, if they are not the first ones of all robots.
    #[serde(skip)]
    chosen: Vec<DetectedBlock>,
}

impl Followed {
    /// Of bodies in `blocks` blocks that no camera has seen, by frames each `period`, s.
    pub(super) fn new(blocks: usize, period: f32) -> Self {
        let unseen = FollowedBlock { cameras: [0; LANES], unseen: Lanes::splat(f32::INFINITY) };
        let patience = PATIENCE * period;
        Self { blocks: vec![unseen; blocks], time: 0.0, patience, chosen: Vec::new() }
    }

    /// Begins anew with the robots of a frame.
    pub(super) fn begin(&mut self, frame: Frame<'_>) {
        self.time = frame.time;
        for (followed, seen) in self.blocks.iter_mut().zip(frame.blocks) {
            for lane in set_bits(seen.bodies.into()) {
                followed.cameras[lane] = seen.cameras[lane];
                followed.unseen.as_mut_array()[lane] = 0.0;
            }
        }
    }

    /// The frame with the detections that count. One that is older than the last stays as it is.
    pub(super) fn choose<'a>(&'a mut self, frame: Frame<'a>) -> Frame<'a> {
        #[expect(clippy::cast_possible_truncation, reason = "time between two frames")]
        let elapsed = (frame.time - self.time) as f32;
        if elapsed < 0.0 {
            return frame;
        }
        self.time = frame.time;
        let Self { blocks, patience, chosen, .. } = self;
        let mut is_first = true;
        for (followed, seen) in blocks.iter_mut().zip(frame.blocks) {
            followed.unseen += Lanes::splat(elapsed);
            is_first &= followed.sees(seen);
        }
        if is_first {
            for (followed, seen) in blocks.iter_mut().zip(frame.blocks) {
                followed.take(seen.bodies);
            }
            return frame.with_robots(frame.blocks);
        }
        chosen.clear();
        chosen.extend_from_slice(frame.blocks);
        for seen in frame.again {
            let (block, lane) = place_of(robot(seen.robot.into()));
            if blocks[block].cameras[lane] == seen.camera {
                chosen[block].set(lane, seen);
            }
        }
        for (followed, seen) in blocks.iter_mut().zip(&mut *chosen) {
            followed.choose(seen, *patience);
        }
        frame.with_robots(chosen)
    }
}

impl FollowedBlock {
    /// Whether the first camera that saw each robot is the one that it is followed by.
    fn sees(&self, seen: &DetectedBlock) -> bool {
        seen.cameras == self.cameras
            || set_bits(seen.bodies.into()).all(|lane| seen.cameras[lane] == self.cameras[lane])
    }

    /// Takes note of robots that are seen by the cameras that they are followed by, one bit each.
    fn take(&mut self, bodies: u8) {
        self.unseen = mask_of_bits(bodies.into()).bitselect(Lanes::ZERO, self.unseen);
    }

    /// Takes out what other cameras see, but where they take over.
    fn choose(&mut self, seen: &mut DetectedBlock, patience: f32) {
        for lane in set_bits(seen.bodies.into()) {
            let unseen = self.unseen.as_array()[lane];
            if seen.cameras[lane] == self.cameras[lane] {
                continue;
            }
            if unseen < patience {
                seen.bodies &= !(1 << lane);
                continue;
            }
            self.cameras[lane] = seen.cameras[lane];
            // Where a lost robot stands is not known.
            seen.moved |= u8::from(unseen <= LOST) << lane;
        }
        self.take(seen.bodies);
    }
}
