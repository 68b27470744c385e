//! Two pieces of work at once.

/// What becomes of both, side by side where there are processors for it. From within [`on_workers`] that costs a microsecond,
/// from elsewhere the time to wake a thread.
pub(crate) fn both<A: Send, B: Send>(
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    rayon::join(first, second)
}

/// Work that often does two things at once, on one of the threads that they are shared out among. While it waits for one of
/// them such a thread may begin another's work: none of it may wait for what its own thread has begun.
pub(crate) fn on_workers<R: Send>(work: impl FnOnce() -> R + Send) -> R {
    rayon::scope(|_| work())
}
