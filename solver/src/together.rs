//! Several pieces of work at once.

use rayon::prelude::*;

/// What becomes of both, side by side where a worker is free. From within [`on_workers`] that costs a microsecond; elsewhere it
/// waits for a worker.
pub(crate) fn both<A: Send, B: Send>(
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    rayon::join(first, second)
}

/// Work that often does two things at once, on a worker of the pool. While it waits, a worker may start unrelated work: never
/// hold a lock across [`both`].
pub(crate) fn on_workers<R: Send>(work: impl FnOnce() -> R + Send) -> R {
    rayon::scope(|_| work())
}

/// Does something with every part of so many values, parts side by side where workers are free.
pub(crate) fn each_part(values: &mut [f64], size: usize, work: impl Fn(&mut [f64]) + Send + Sync) {
    values.par_chunks_mut(size).for_each(work);
}
