//! Detected robots of frames, in a ring.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::senses::detections::DetectedBlock;

/// Frames by which a ring grows that is full.
const MORE: usize = 2;

/// Robots of frames by block, the oldest frame first. Frames come and go without a move of the others, which would read
/// and write all of them in each step.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct BlockRing {
    /// Blocks of all places.
    blocks: Vec<DetectedBlock>,
    /// Number of blocks of a frame.
    each: usize,
    /// Place of the first frame.
    first: usize,
    /// Number of frames.
    count: usize,
}

impl BlockRing {
    /// No frames yet, of `each` blocks, with places for a number of frames.
    pub(super) fn new(each: usize, places: usize) -> Self {
        Self { blocks: vec![DetectedBlock::NONE; places * each], each, first: 0, count: 0 }
    }

    /// Number of blocks of a frame.
    pub(super) fn each(&self) -> usize {
        self.each
    }

    /// The blocks of a frame.
    pub(super) fn frame(&self, nth: usize) -> &[DetectedBlock] {
        &self.blocks[self.place(nth)]
    }

    /// The place of the frame to come; what it holds means nothing yet.
    pub(super) fn next(&mut self) -> &mut [DetectedBlock] {
        if self.count == self.places() {
            self.grow();
        }
        let place = self.place(self.count);
        &mut self.blocks[place]
    }

    /// The same, if there is a place.
    pub(super) fn next_if_any(&self) -> &[DetectedBlock] {
        if self.count == self.places() { &[] } else { self.frame(self.count) }
    }

    /// Adds the frame to come.
    pub(super) fn add(&mut self) {
        self.count += 1;
    }

    /// Forgets the first `count` frames.
    pub(super) fn forget_first(&mut self, count: usize) {
        self.count -= count;
        self.first = if self.count == 0 { 0 } else { self.wrapped(self.first + count) };
    }

    /// Forgets all but the first `count` frames.
    pub(super) fn truncate(&mut self, count: usize) {
        self.count = self.count.min(count);
    }

    fn places(&self) -> usize {
        self.blocks.len() / self.each
    }

    fn wrapped(&self, place: usize) -> usize {
        let places = self.places();
        if place < places { place } else { place - places }
    }

    fn place(&self, nth: usize) -> Range<usize> {
        let start = self.wrapped(self.first + nth) * self.each;
        start..start + self.each
    }

    fn grow(&mut self) {
        self.blocks.rotate_left(self.first * self.each);
        self.first = 0;
        self.blocks.resize(self.blocks.len() + MORE * self.each, DetectedBlock::NONE);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_keep_their_order_while_others_come_and_go() {
        let mut ring = BlockRing::new(2, 1);
        let mut expected: Vec<u8> = Vec::new();
        for round in 0..40_u8 {
            for nth in 0..round % 4 {
                let number = round * 4 + nth;
                ring.next().iter_mut().for_each(|block| block.cameras[0] = number);
                ring.add();
                expected.push(number);
            }
            let gone = usize::from(round % 3).min(expected.len());
            ring.forget_first(gone);
            expected.drain(..gone);
            if round == 20 {
                ring.truncate(1);
                expected.truncate(1);
            }
            for (nth, number) in expected.iter().enumerate() {
                assert_eq!(ring.frame(nth).iter().map(|b| b.cameras[0]).max(), Some(*number));
                assert_eq!(ring.frame(nth).len(), 2);
            }
        }
        assert!(expected.len() > 4, "{expected:?}");
    }
}
