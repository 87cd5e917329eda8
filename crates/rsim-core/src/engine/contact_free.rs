//! Ticks without contacts: bodies move freely, and the solver does not run.
//!
//! Free motion is computed as the solver would, in its own sub-steps. The separation of bodies that
//! can meet in the tick is tested before the first sub-step, after each, and one beyond the last, since
//! the solver stops bodies one sub-step ahead. If a test fails, the tick is rolled back and solved
//! normally.

use super::SubSteps;
use super::bodies::{Bodies, Motions};
use super::near::NearPairs;

/// Buffers of [`try_contact_free`]; their contents are of no use between ticks.
#[derive(Default)]
pub(super) struct ContactFreeBuffers {
    now: Motions,
    end: Motions,
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
    } else {
        let Bodies { motions, accelerations, .. } = bodies;
        let ContactFreeBuffers { now, end } = buffers;
        now.copy_from(motions);
        for index in 0..=sub_steps.count {
            if !near.are_separated(now) {
                return false;
            }
            if index == sub_steps.count {
                end.copy_from(now);
            }
            now.advance(accelerations, SubSteps { count: 1, ..sub_steps });
        }
        if !near.are_separated(now) {
            return false;
        }
        motions.copy_from(end);
    }
    bodies.moved.fill(true);
    true
}
