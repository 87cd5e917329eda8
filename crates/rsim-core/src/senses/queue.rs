//! Queues of what is on its way. They mostly empty at once, which costs less than the general case.

/// Maximum number of things on their way that take up to a time (s) each, where one sets out each `period`, s: with one
/// that sets out before the first has left.
pub(super) fn most_under_way(seconds: f32, period: f32) -> usize {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "not negative")]
    let whole = (seconds / period) as usize;
    whole + 2
}

/// Removes the first `count` things, or all if there are fewer.
pub(super) fn remove_first<T: Copy>(queue: &mut Vec<T>, count: usize) {
    if count >= queue.len() {
        queue.clear();
    } else if count > 0 {
        queue.copy_within(count.., 0);
        queue.truncate(queue.len() - count);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_are_places_for_all_that_are_under_way() {
        for (seconds, expected) in [(0.0, 2), (0.02, 2), (0.03, 3), (0.26, 12)] {
            assert_eq!(most_under_way(seconds, 0.025), expected, "{seconds}");
        }
    }

    #[test]
    fn the_rest_keeps_its_order() {
        let queue = [1, 2, 3, 4];
        for count in 0..6 {
            let mut rest = queue.to_vec();
            remove_first(&mut rest, count);
            assert_eq!(rest, queue[count.min(queue.len())..]);
        }
    }
}
