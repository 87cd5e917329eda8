//! Memory that is asked for before it is needed.
//!
//! The senses of a match are in a dozen places of memory. A step that comes to them one after the other waits
//! for each of them where many matches do not fit into the processor's cache. Reads that depend on nothing wait
//! together, so a step begins with one of most places, for all matches that a thread moves together.

use crate::blocks::Lanes;

/// Reads whose values mean nothing.
#[derive(Default)]
pub(crate) struct Fetched(u64);

impl Fetched {
    /// Reads a number.
    pub(super) fn number(&mut self, number: u64) {
        self.0 ^= number;
    }

    /// Reads numbers of four bodies.
    pub(super) fn lanes(&mut self, lanes: &Lanes) {
        self.number(lanes.as_array()[0].to_bits().into());
    }

    /// Reads a number of about each cache line of some numbers.
    pub(super) fn numbers(&mut self, numbers: &[f32]) {
        numbers
            .iter()
            .step_by(64 / size_of::<f32>())
            .for_each(|number| self.number(number.to_bits().into()));
    }
}

impl Drop for Fetched {
    /// Uses what was read: otherwise the compiler would leave the reads out.
    fn drop(&mut self) {
        std::hint::black_box(self.0);
    }
}
