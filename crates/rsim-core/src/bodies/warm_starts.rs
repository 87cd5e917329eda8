//! List of all warm starts, of which each block holds a part.

use super::{Bodies, WARM_STARTS, WarmStart};

impl Bodies {
    /// Writes the first `count` warm starts into `all`.
    pub(crate) fn list_warm_starts(&self, count: usize, all: &mut Vec<WarmStart>) {
        all.clear();
        for block in &self.blocks[..count.div_ceil(WARM_STARTS)] {
            let left = (count - all.len()).min(WARM_STARTS);
            all.extend_from_slice(&block.warm_starts[..left]);
        }
    }

    /// Drops those of the first `count` warm starts whose keys fulfill a condition.
    pub(crate) fn drop_warm_starts(&mut self, count: usize, dropped: impl Fn(u16) -> bool) {
        let stored = self.blocks.iter_mut().flat_map(|block| &mut block.warm_starts);
        for warm_start in stored.take(count).filter(|stored| dropped(stored.key)) {
            *warm_start = WarmStart::NONE;
        }
    }

    /// Stores warm starts, and returns their number. Those beyond the capacity are dropped: their pairs
    /// start from no impulse.
    pub(crate) fn store_warm_starts(&mut self, all: impl Iterator<Item = WarmStart>) -> usize {
        let mut count = 0;
        let slots = self.blocks.iter_mut().flat_map(|block| &mut block.warm_starts);
        for (slot, warm_start) in slots.zip(all) {
            *slot = warm_start;
            count += 1;
        }
        count
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body_parameters::BodyParameters;
    use crate::models::config::SimConfig;
    use crate::state::State;

    fn warm_starts(count: u16) -> impl Iterator<Item = WarmStart> {
        (1..=count).map(|key| WarmStart { key, ..WarmStart::NONE })
    }

    #[test]
    fn warm_starts_fill_the_blocks_in_order_and_those_beyond_are_dropped() {
        let config = SimConfig::vss(3, 3);
        let mut state = State::new(&config, &BodyParameters::of(&config), &[]).boxed();
        let bodies = &mut state.bodies;
        for (given, kept) in [(0, 0), (1, 1), (16, 16), (17, 17), (32, 32), (40, 32)] {
            let count = bodies.store_warm_starts(warm_starts(given));
            assert_eq!(count, kept);
            let mut listed = Vec::new();
            bodies.list_warm_starts(count, &mut listed);
            assert!(listed.iter().map(|one| one.key).eq(1..=given.min(32)), "{given}");
        }
    }
}
