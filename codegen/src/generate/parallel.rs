//! Work shared out to the processors.

use std::num::NonZeroUsize;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::{self, Builder};

/// Stack for the recursion of parsers, as the main thread has it.
const STACK: usize = 8 << 20;

/// `work` on every item, in the order of the items; they are taken up in the order of `size`, largest first,
/// so that none is left alone at the end.
pub(super) fn map<'a, T: Sync, R: Send>(
    items: &'a [T],
    size: impl Fn(&T) -> usize,
    work: impl Fn(&'a T) -> R + Sync,
) -> Vec<R> {
    let mut order: Vec<usize> = (0..items.len()).collect();
    order.sort_by_key(|place| std::cmp::Reverse(size(&items[*place])));
    let next = AtomicUsize::new(0);
    let run = || {
        let mut done = Vec::new();
        while let Some(place) = order.get(next.fetch_add(1, Ordering::Relaxed)) {
            done.push((*place, work(&items[*place])));
        }
        done
    };
    let threads = thread::available_parallelism().map_or(1, NonZeroUsize::get).min(items.len());
    let mut results = thread::scope(|scope| {
        // Where no thread can be started, this one does the work.
        let others: Vec<_> = (1..threads)
            .filter_map(|_| Builder::new().stack_size(STACK).spawn_scoped(scope, run).ok())
            .collect();
        let mut results = run();
        for other in others {
            results.extend(other.join().unwrap_or_else(|panic| resume_unwind(panic)));
        }
        results
    });
    results.sort_by_key(|(place, _)| *place);
    results.into_iter().map(|(_, result)| result).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_come_in_the_order_of_the_items() {
        let items: Vec<usize> = (0..1000).collect();
        let doubled = map(&items, |item| item * 7919 % 1000, |item| 2 * item);
        assert!(doubled.into_iter().eq((0..1000).map(|item| 2 * item)));
        assert!(map(&[0; 0], |_| 0, |_| 0).is_empty());
    }
}
