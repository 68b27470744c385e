//! Values held in memory beside those on disk, so that many threads that need the same one have it made once.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::key::Key;

/// Packed values by their keys.
#[derive(Debug, Default)]
pub(super) struct Memory {
    slots: Mutex<BTreeMap<Key, Arc<Slot>>>,
}

/// Where a value is or will be. Who makes it holds the lock meanwhile, and the others wait for it.
pub(super) type Slot = Mutex<Option<Arc<[u8]>>>;

/// What is behind a lock. A thread that died with it has left what was there before.
pub(super) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Memory {
    /// The slot of a key.
    pub(super) fn slot(&self, key: &Key) -> Arc<Slot> {
        lock(&self.slots).entry(*key).or_default().clone()
    }

    /// All values that are there, in the order of their keys.
    pub(super) fn all(&self) -> Vec<Arc<[u8]>> {
        let slots: Vec<Arc<Slot>> = lock(&self.slots).values().cloned().collect();
        slots.iter().filter_map(|slot| lock(slot).clone()).collect()
    }
}
