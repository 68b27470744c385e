//! Work on several parts side by side.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

/// What becomes of each of the parts, in their order, on so many threads at most.
pub(super) fn beside<P: Sync, R: Send>(
    threads: usize,
    parts: &[P],
    work: &(dyn Fn(&P) -> R + Sync),
) -> Vec<R> {
    let done: Vec<Mutex<Option<R>>> = parts.iter().map(|_| Mutex::new(None)).collect();
    let next = AtomicUsize::new(0);
    let worker = || {
        loop {
            let place = next.fetch_add(1, Ordering::Relaxed);
            let Some(part) = parts.get(place) else { return };
            let own = work(part);
            *done[place].lock().unwrap_or_else(PoisonError::into_inner) = Some(own);
        }
    };
    thread::scope(|scope| {
        for _ in 1..threads.min(parts.len()) {
            scope.spawn(worker);
        }
        worker();
    });
    let all = done.into_iter().map(|own| own.into_inner().unwrap_or_else(PoisonError::into_inner));
    all.map(|own| own.expect("all parts were done")).collect()
}
