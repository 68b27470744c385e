//! A machine as it stands at a speed of a range, and work side by side on several of them.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

use super::linearised::{Linearised, Standstill};
use super::range::Range;
use super::round::LinearMachine;
use crate::error::Error;

/// The state that stands at a speed, and its equations.
pub(super) struct Stood {
    pub(super) speed: f64,
    pub(super) at: Standstill,
    pub(super) equations: Linearised,
}

impl LinearMachine {
    /// The machine as it stands at a speed, from a state nearby if there is one.
    pub(super) fn stood(
        &self,
        range: &Range,
        speed: f64,
        near: Option<&Standstill>,
    ) -> Result<Stood, Error> {
        let speeds = self.speeds(range.of, speed, &range.ratios);
        let at = self.standing_round(&speeds, near)?;
        let equations = self.linearised(&at)?;
        Ok(Stood { speed, at, equations })
    }
}

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
