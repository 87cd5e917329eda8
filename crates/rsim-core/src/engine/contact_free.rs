//! Ticks without contacts: bodies move freely, and the solver does not run.
//!
//! Free motion is computed as the solver would, in its own sub-steps. The separation of bodies that
//! can meet in the tick is tested before the first sub-step, after each, and one beyond the last, since
//! the solver stops bodies one sub-step ahead. If a test fails, the tick is rolled back and solved
//! normally.

use super::near::NearPairs;
use crate::bodies::{Bodies, SubSteps, advance};
use crate::geometry::motion_block::MotionBlock;

/// Buffers of [`try_contact_free`], by block; their contents are of no use between ticks.
#[derive(Default)]
pub(super) struct ContactFreeBuffers {
    now: Vec<MotionBlock>,
    end: Vec<MotionBlock>,
}

/// Advances all bodies by a tick without the solver if nothing touches in it. Otherwise nothing
/// changes, and the result is false. `near` are the pairs that can meet in it and a sub-step more.
pub(super) fn try_contact_free(
    bodies: &mut Bodies,
    near: &NearPairs,
    buffers: &mut ContactFreeBuffers,
    sub_steps: SubSteps,
) -> bool {
    if near.pairs.is_empty() {
        bodies.move_freely(sub_steps);
        return true;
    }
    let ContactFreeBuffers { now, end } = buffers;
    now.clear();
    now.extend(bodies.blocks.iter().map(|block| block.motion));
    for index in 0..=sub_steps.count {
        if !near.are_separated(now) {
            return false;
        }
        if index == sub_steps.count {
            end.clone_from(now);
        }
        for (motion, block) in now.iter_mut().zip(&bodies.blocks) {
            advance(motion, &block.acceleration, SubSteps { count: 1, ..sub_steps });
        }
    }
    if !near.are_separated(now) {
        return false;
    }
    for (block, end) in bodies.blocks.iter_mut().zip(end) {
        block.motion = *end;
    }
    true
}
