//! The camera that each robot is followed by.
//!
//! Cameras see a body at places that differ by their errors. An estimate that took in all of them would get a velocity
//! from these differences, in each frame where two cameras overlap. So a robot is followed by one camera for as long as
//! that one sees it. Then another takes over, and the place moves while the velocity stays.

use serde::{Deserialize, Serialize};

use crate::blocks::{LANES, Lanes, mask_of_bits, set_bits};
use crate::senses::detections::{DetectedBlock, DetectedRobot};
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
}

impl Followed {
    /// Of bodies in `blocks` blocks that no camera has seen, by frames each `period`, s.
    pub(super) fn new(blocks: usize, period: f32) -> Self {
        let unseen = FollowedBlock { cameras: [0; LANES], unseen: Lanes::splat(f32::INFINITY) };
        Self { blocks: vec![unseen; blocks], time: 0.0, patience: PATIENCE * period }
    }

    /// Begins anew with the robots of a frame at a time, s.
    pub(super) fn begin(&mut self, time: f64, blocks: &[DetectedBlock]) {
        self.time = time;
        for (followed, seen) in self.blocks.iter_mut().zip(blocks) {
            for lane in set_bits(seen.bodies.into()) {
                followed.cameras[lane] = seen.cameras[lane];
                followed.unseen.as_mut_array()[lane] = 0.0;
            }
        }
    }

    /// Lets the detections that count be the ones of a frame at a time, s, that is not older than the last: of `blocks`,
    /// which had the first one of each robot, and `again`, which gets the others.
    pub(super) fn choose(
        &mut self,
        time: f64,
        blocks: &mut [DetectedBlock],
        again: &mut impl OtherDetections,
    ) {
        #[expect(clippy::cast_possible_truncation, reason = "time between two frames")]
        let elapsed = Lanes::splat((time - self.time) as f32);
        self.time = time;
        for (index, (followed, seen)) in self.blocks.iter_mut().zip(blocks).enumerate() {
            followed.unseen += elapsed;
            if !followed.sees(seen) {
                followed.choose(index, seen, self.patience, again);
            }
            followed.take(seen.bodies);
        }
    }
}

/// Detections of robots that do not count, as another camera detects them too.
pub(super) trait OtherDetections {
    /// Exchanges that of a robot by the camera of `wanted` for another; `false` if there is none.
    fn exchange(&mut self, wanted: u8, given: &mut DetectedRobot) -> bool;

    /// Adds one.
    fn add(&mut self, seen: DetectedRobot);
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

    /// Takes out what other cameras see, but where they take over. `index` is that of the block.
    fn choose(
        &mut self,
        index: usize,
        seen: &mut DetectedBlock,
        patience: f32,
        again: &mut impl OtherDetections,
    ) {
        for lane in set_bits(seen.bodies.into()) {
            let (camera, unseen) = (self.cameras[lane], self.unseen.as_array()[lane]);
            if seen.cameras[lane] == camera {
                continue;
            }
            let mut other = seen.get(index, lane);
            if again.exchange(camera, &mut other) {
                seen.set(lane, &other);
            } else if unseen < patience {
                again.add(other);
                seen.bodies &= !(1 << lane);
            } else {
                self.cameras[lane] = other.camera;
                // Where a lost robot stands is not known.
                seen.moved |= u8::from(unseen <= LOST) << lane;
            }
        }
    }
}
