//! Several pieces of work at once.
//!
//! Workers are those of rayon's global pool. Threads do not live on in a process that was forked from one that had them, and what waits
//! for them waits for ever: such a process gets a pool of its own.

use std::cell::RefCell;
use std::process;
use std::rc::Rc;
use std::sync::OnceLock;

use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// What becomes of both, side by side where a worker is free. From within [`on_workers`] that costs a microsecond; elsewhere it
/// waits for a worker.
pub(crate) fn both<A: Send, B: Send>(
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    with_workers(|| rayon::join(first, second))
}

/// Work that often does two things at once, on a worker of the pool. While it waits, a worker may start unrelated work: never
/// hold a lock across [`both`].
pub(crate) fn on_workers<R: Send>(work: impl FnOnce() -> R + Send) -> R {
    with_workers(|| rayon::scope(|_| work()))
}

/// Does something with every part of so many values, parts side by side where workers are free.
pub(crate) fn each_part(values: &mut [f64], size: usize, work: impl Fn(&mut [f64]) + Send + Sync) {
    with_workers(|| values.par_chunks_mut(size).for_each(work));
}

/// Work that asks for workers, where there are some.
pub(crate) fn with_workers<R: Send>(work: impl FnOnce() -> R + Send) -> R {
    // A worker is among its own.
    if rayon::current_thread_index().is_some() {
        return work();
    }
    match pool_of_forked() {
        Some(pool) => pool.install(work),
        None => work(),
    }
}

/// The pool, one a thread, of a process that was forked from one that had workers.
fn pool_of_forked() -> Option<Rc<ThreadPool>> {
    /// The process that asked first.
    static FIRST: OnceLock<u32> = OnceLock::new();
    thread_local! {
        // No lock is needed that may have been held when the process was forked.
        static OWN: RefCell<Option<(u32, Rc<ThreadPool>)>> = const { RefCell::new(None) };
    }
    let this = process::id();
    if *FIRST.get_or_init(|| this) == this {
        return None;
    }
    OWN.with_borrow_mut(|own| {
        if own.as_ref().is_none_or(|own| own.0 != this) {
            // One of the process before cannot be let go of: its threads are not there to end.
            std::mem::forget(own.take());
            *own = Some((this, Rc::new(ThreadPoolBuilder::new().build().ok()?)));
        }
        own.as_ref().map(|own| own.1.clone())
    })
}
