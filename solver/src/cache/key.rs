//! What a stored value depends on, as a hash.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// Bytes of a SHA-256.
pub(super) const HASH: usize = 32;

/// What a stored value depends on, as a hash.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Key(pub(super) [u8; HASH]);

impl Key {
    /// The key of everything in `dependencies`.
    ///
    /// # Panics
    /// If `dependencies` refuses to be serialised, which no type of this workspace does.
    pub fn of(dependencies: &impl Serialize) -> Key {
        let bytes = postcard::to_allocvec(dependencies).expect("plain data can be serialised");
        Key(hash(&bytes))
    }

    /// 64 hexadecimal digits.
    pub fn hex(&self) -> String {
        self.0.iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

/// The key of bytes that come one after the other.
#[derive(Debug, Clone, Default)]
pub struct RunningKey(Sha256);

impl RunningKey {
    /// Takes in what follows.
    pub fn add(&mut self, bytes: &[u8]) {
        self.0.update(bytes);
    }

    /// Of all so far.
    pub fn key(&self) -> Key {
        Key(self.0.clone().finalize().into())
    }
}

/// The SHA-256 of bytes.
pub(super) fn hash(bytes: &[u8]) -> [u8; HASH] {
    Sha256::digest(bytes).into()
}
