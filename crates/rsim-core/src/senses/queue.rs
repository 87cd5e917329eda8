//! Queues of what is on its way. They mostly empty at once, which costs less than the general case.

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
    fn the_rest_keeps_its_order() {
        let queue = [1, 2, 3, 4];
        for count in 0..6 {
            let mut rest = queue.to_vec();
            remove_first(&mut rest, count);
            assert_eq!(rest, queue[count.min(queue.len())..]);
        }
    }
}
